"""The dashboard's page in a browser: operate its controls, read what it shows."""

import json
import math

import numpy as np
import param

from app.live.controls import GROUPS
from app.pages.explore import Explore
from app.results.analysis import CHARTS
from app.state import SI_INPUTS, State
from rotorstab.drawing import screen

PLACED = [name for _, _, names in GROUPS for name in names]
NUMBERS = [name for name in PLACED if isinstance(State.param[name], param.Number)]
SLIDERS = [name for name in NUMBERS if name not in SI_INPUTS]
CHOICES = [name for name in PLACED if isinstance(State.param[name], param.Selector)]
SWITCHES = [name for name in PLACED if isinstance(State.param[name], param.Boolean)]

SHOWN = """() => {
  const found = {};
  const walk = (view) => {
    const figure = view.model;
    if (figure.type === "Figure") {
      const axes = [figure.x_range, figure.y_range].map((axis) => [axis.start, axis.end]);
      found[figure.name] = { layers: figure.renderers.map((one) => one.data_source.data), axes };
    }
    for (const child of view.children()) walk(child);
  };
  for (const view of Bokeh.index) walk(view);
  const plain = (key, value) => ArrayBuffer.isView(value) ? Array.from(value) : value;
  return JSON.stringify(found, plain);
}"""
DEEPEST = """
  let element = document.activeElement;
  while (element?.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
"""
FOCUS = f"""() => {{
  {DEEPEST}
  if (!element) return "";
  const box = element.classList.contains("box") ? ":box" : "";
  const row = box ? element.closest(".row").querySelector("label").htmlFor : "";
  return (row + box) || element.id || element.name || element.textContent.trim().slice(0, 40);
}}"""
AT_REST = """async () => {
  const places = () => [...document.querySelectorAll("body *")].map((one) => {
    const { x, y, width, height } = one.getBoundingClientRect();
    return [x, y, width, height];
  }).join();
  const end = performance.now() + 20000;
  let before = "", equal = 0;
  while (equal < 5 || !Bokeh.documents[0].is_idle) {
    if (performance.now() > end) throw new Error("the page does not come to rest");
    await new Promise(requestAnimationFrame);
    const now = places();
    equal = now === before ? equal + 1 : 0;
    before = now;
  }
}"""
FRAME = """(key) => {
  const walk = (view) => {
    if (view.model.type === "Figure" && view.model.name === key) return view;
    return [...view.children()].map(walk).find(Boolean);
  };
  for (const top of Bokeh.index) {
    const view = walk(top);
    if (!view) continue;
    const { left, top: above } = view.el.getBoundingClientRect();
    const { x, y, width, height } = view.frame.bbox;
    return [left + x, above + y, width, height];
  }
}"""


def settle(page, name=None, value=None):
    """Wait for the full picture, of one input's value where that is given; return all inputs."""
    page.wait_for_function(
        "([name, value]) => rotorstab.last.settled && rotorstab.inspector.ready && "
        "(name === null || rotorstab.last.values[name] === value)",
        arg=[name, value],
    )
    page.wait_for_function("Bokeh.documents[0].is_idle")
    return page.evaluate("rotorstab.last.values")


def wait_for_value(page, name, value):
    """Wait until the server has answered that an input has a value."""
    page.wait_for_function(
        "([name, value]) => rotorstab.last.values[name] === value", arg=[name, value]
    )


def wait_for_address(page, part):
    """Wait until the address holds a part: it is written some time after the answer."""
    page.wait_for_function("(part) => location.search.includes(part)", arg=part)


def shown(page):
    """Return the columns and axes that Bokeh holds in the browser, for each chart."""
    return json.loads(page.evaluate(SHOWN))


def expected(values, seen=None):
    """Return the columns and axes that the solver gives for these inputs, for each chart.

    `seen` are the axes of the instability chart where it is zoomed.
    """
    state, explore = State(), Explore()
    assert state.change(values) == {}
    if seen is not None:
        ends = zip(("left", "right", "low", "high"), (*seen[0], *seen[1]), strict=True)
        explore.handle({"type": "window", "chart": "instability", **dict(ends)}, state)
    return {
        key: {
            "layers": [_plain(screen.columns(layer)) for layer in chart.layers],
            "axes": [list(chart.x_range), list(chart.y_range)],
        }
        for key, chart in explore.compute(state).items()
    }


def agrees(page):
    """Wait for the full picture of every chart as the solver gives it; return the inputs."""
    for attempt in range(20):  # a part of the picture may still be under way
        values = settle(page)
        found, wanted = shown(page), expected(values)
        # no comparison by `==`: pytest would spend an hour on the difference of so many numbers
        differing = [key for key in CHARTS if not is_drawn(found[key], wanted[key])]
        if not differing:
            return values
        page.wait_for_timeout(50 * attempt)
    raise AssertionError(f"these charts are not as the solver gives them: {differing}")


def _plain(value):
    """Return columns as JSON holds them: images flat, NaN as null."""
    if isinstance(value, np.ndarray):
        return [None if math.isnan(one) else one for one in value.ravel().tolist()]
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return value


def is_drawn(found, wanted):
    """Whether a chart has the axes and the layers that it should have.

    Layers without data do not count: those of pins stay in a chart that has once shown a pin.
    """
    layers = [
        [columns for columns in chart["layers"] if any(map(len, columns.values()))]
        for chart in (found, wanted)
    ]
    return is_same(found["axes"], wanted["axes"]) and is_same(*layers)


def is_same(found, wanted):
    """Whether two columns agree; the server's BLAS may round differently from the test's."""
    if isinstance(wanted, dict):
        return found.keys() == wanted.keys() and all(is_same(found[k], wanted[k]) for k in wanted)
    if isinstance(wanted, list):
        return len(found) == len(wanted) and all(map(is_same, found, wanted))
    if isinstance(wanted, float):
        return found is not None and math.isclose(found, wanted, rel_tol=1e-6, abs_tol=1e-9)
    return found == wanted


def wait_for_rest(page):
    """Wait until nothing on the page has moved for five frames and Bokeh is idle."""
    page.evaluate(AT_REST)


NAMES_ON_A_PHONE = {"instability": "Instability", "load-frequency": "Load", "campbell": "Campbell"}


def show_chart(phone, key):
    """Bring one chart of a phone's row into view by its name."""
    name = NAMES_ON_A_PHONE[key]
    phone.get_by_role("navigation", name="Charts").get_by_role("button", name=name).tap()
    wait_for_rest(phone)  # it scrolls


def visit(page, name):
    """Go to one of the dashboard's pages by its link, and wait until it is laid out."""
    page.evaluate("(name) => { location.hash = name; }", name)
    page.wait_for_function("(name) => rotorstab.last.page === name", arg=name)
    wait_for_rest(page)


def open_groups(page):
    """Open every group of the sidebar."""
    closed = page.locator("details.group:not([open]) > summary")
    while closed.count():
        closed.first.click()


def box_of(page, name):
    """Return the number box of a slider."""
    return page.get_by_label(f"{State.param[name].label}, number", exact=True)


def error_of(page, name):
    """Return the place beside a control where the refusal of its value is shown."""
    return page.locator(f"#rs-{name}-error")


def drag(page, name, share):
    """Drag a slider by its thumb to a share of its length, in steps as a hand does."""
    slider = page.locator(f"#rs-{name}")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    low, high = State.param[name].bounds
    here = (page.evaluate("rotorstab.last.values")[name] - low) / (high - low)
    at = [box["x"] + 9 + (box["width"] - 18) * place for place in (here, share)]
    y = box["y"] + box["height"] / 2
    page.mouse.move(at[0], y)
    page.mouse.down()
    page.mouse.move(at[1], y, steps=8)
    page.mouse.up()
    page.wait_for_function(
        "([name, value]) => Math.abs(rotorstab.last.values[name] - value) < 1e-6",
        arg=[name, float(box_of(page, name).input_value())],
    )


def frame_of(page, key):
    """Return the frame of a chart in the window, as x, y, width, height."""
    return page.evaluate(FRAME, key)


def serious_faults(page, part=None, rules=None):
    """Return what axe finds serious or critical, in short.

    Of the whole page or of a part, by all rules or by some.
    """
    from axe_playwright_python.sync_playwright import Axe

    options = {"resultTypes": ["violations"]} | (
        {"runOnly": {"type": "rule", "values": rules}} if rules else {}
    )
    findings = Axe().run(page, context=part, options=options).response["violations"]
    return [
        (one["id"], [node["target"] for node in one["nodes"]][:3])
        for one in findings
        if one["impact"] in ("serious", "critical")
    ]
