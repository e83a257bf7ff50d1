"""Labels on the charts: none lies over another one or is cut, at any width and at any moment."""

import pytest

from tests.testing.dashboard import READY, Watch, reset
from tests.testing.page import settle, visit, wait_for_rest

pytestmark = pytest.mark.browser

# what is written on each canvas, as boxes in its own pixels, for each time that it was painted
RECORD = """
(() => {
  const paint = CanvasRenderingContext2D.prototype;
  const { clearRect, fillText } = paint;
  window.written = new Map();
  paint.clearRect = function (...box) {
    const all = written.get(this.canvas) ?? [];
    written.set(this.canvas, [...all.slice(-200), []]);
    return clearRect.apply(this, box);
  };
  paint.fillText = function (text, x, y, ...rest) {
    if (text.trim()) {
      const { actualBoundingBoxLeft: l, actualBoundingBoxRight: r, actualBoundingBoxAscent: u,
        actualBoundingBoxDescent: d } = this.measureText(text);
      const corners = [[x - l, y - u], [x + r, y - u], [x - l, y + d], [x + r, y + d]]
        .map(([x, y]) => this.getTransform().transformPoint({ x, y }));
      const xs = corners.map((one) => one.x), ys = corners.map((one) => one.y);
      const box = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
      written.get(this.canvas)?.at(-1)?.push({ text, box });
    }
    return fillText.call(this, text, x, y, ...rest);
  };
})();
"""
# the boxes inside of the frames of the charts in view, for each painting since the last call
LABELS = """() => {
  const found = [];
  const walk = (view) => {
    const { model, el, frame } = view;
    if (model.type === "Figure" && el.checkVisibility() && frame.bbox.width > 0) {
      const ratio = window.devicePixelRatio;
      const { x, y, width, height } = frame.bbox;
      const [left, top, right, bottom] = [x, y, x + width, y + height].map((one) => one * ratio);
      for (const [canvas, paintings] of written) {
        if (!view.canvas_view.shadow_el.contains(canvas)) continue;
        for (const painting of paintings) {
          const inside = painting.filter(({ box: [a, b, c, d] }) =>
            c > left + 2 && a < right - 2 && d > top + 2 && b < bottom - 2);
          if (inside.length) found.push([model.name, [left, top, right, bottom], inside]);
        }
        written.set(canvas, paintings.slice(-1));
      }
    }
    for (const child of view.children()) walk(child);
  };
  for (const view of Bokeh.index) walk(view);
  return found;
}"""
WIDTHS = {320: 568, 390: 844, 820: 1100, 1366: 768, 1920: 1080}


def faults(page):
    """Return the labels that were painted over others or beyond the frame since the last call."""
    found = set()
    for name, (left, top, right, bottom), labels in page.evaluate(LABELS):
        room = 2 * page.evaluate("devicePixelRatio")
        for index, one in enumerate(labels):
            a = one["box"]
            if (
                a[0] < left - room
                or a[1] < top - room
                or a[2] > right + room
                or a[3] > bottom + room
            ):
                found.add((name, one["text"], "is cut"))
            for other in labels[index + 1 :]:
                b = other["box"]
                if min(a[2], b[2]) - max(a[0], b[0]) > 1 and min(a[3], b[3]) - max(a[1], b[1]) > 1:
                    found.add((name, one["text"], other["text"]))
    return sorted(found)


def labels(page):
    """Return the texts of the labels that were painted last."""
    return {one["text"] for _, _, inside in page.evaluate(LABELS) for one in inside}


@pytest.fixture(scope="module")
def recorded(browser, dashboard):
    """A page that records what it writes on its canvases."""
    context = browser.new_context(
        viewport={"width": 1366, "height": 768}, reduced_motion="reduce", has_touch=True
    )
    context.set_default_timeout(20_000)
    context.add_init_script(RECORD)
    page = context.new_page()
    watch = Watch(page)
    page.goto(f"{dashboard.origin}/app")
    page.wait_for_function(READY)
    settle(page)
    yield page
    watch.check(dashboard)
    context.close()


@pytest.fixture
def written(recorded):
    """The page with every input at its default, and with nothing recorded."""
    recorded.set_viewport_size({"width": 1366, "height": 768})
    reset(recorded)
    settle(recorded)
    recorded.wait_for_timeout(100)
    recorded.evaluate(LABELS)
    return recorded


def at_every_width(page):
    """Return the faults of what is shown at each width."""
    found = {}
    for width, height in WIDTHS.items():
        page.set_viewport_size({"width": width, "height": height})
        wait_for_rest(page)
        page.wait_for_timeout(100)
        page.evaluate(LABELS)  # while the window changes, Bokeh paints with the old sizes
        page.evaluate("rotorstab.relayout()")
        page.wait_for_timeout(100)
        if bad := faults(page):
            found[width] = bad
    return found


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"highest_frequency": 16.0},
        {"units": "SI", "stiffness": "both", "load_type": "partly"},
        {"spin_speed": 4.0, "polar_inertia": 1.5, "static_load_factor": 0.9},
        {"model": "finite elements", "external_damping": 0.01},
    ],
)
def test_no_label_lies_over_another_one(written, values):
    for name, value in values.items():
        written.evaluate("([name, value]) => rotorstab.change(name, value)", [name, value])
    settle(written, *next(iter(values.items()), ()))
    assert at_every_width(written) == {}


def test_nor_while_a_slider_moves_or_a_chart_is_zoomed(written):
    for width in (1366, 390):
        written.set_viewport_size({"width": width, "height": 768})
        wait_for_rest(written)
        written.evaluate(LABELS)
        for step in range(12):
            written.evaluate("(value) => rotorstab.change('spin_speed', value)", 0.5 + 0.25 * step)
            written.wait_for_function(
                "(value) => rotorstab.last.values.spin_speed === value", arg=0.5 + 0.25 * step
            )
            written.wait_for_timeout(30)
        settle(written)
        assert faults(written) == []
        for left, right in ((0.0, 2.5), (0.2, 0.9), (1.0, 1.4)):
            written.evaluate(
                """([start, end]) => {
                  rotorstab.places.view("instability").model.x_range.setv({ start, end });
                }""",
                [left, right],
            )
            written.wait_for_timeout(200)
            settle(written)
        assert faults(written) == []
        written.evaluate("rotorstab.send({ type: 'view' })")
        settle(written)


def test_pins_have_their_names_beside_the_others(written):
    for name, speed in (("slow", 0.4), ("a long name of a pin", 1.2), ("fast", 2.2)):
        written.evaluate("(value) => rotorstab.change('spin_speed', value)", speed)
        settle(written, "spin_speed", speed)
        written.evaluate("(label) => rotorstab.send({ type: 'pin', label })", name)
    written.wait_for_function("rotorstab.last.pins?.columns?.length !== 0")
    settle(written)
    assert at_every_width(written) == {}
    for number in (1, 2, 3):
        written.evaluate("(number) => rotorstab.send({ type: 'unpin', number })", number)


@pytest.mark.parametrize("number", [4, 6, 8, 9])
def test_no_name_in_a_figure_of_the_paper_is_cut_or_covered(written, number):
    visit(written, "paper")
    written.evaluate("(number) => { location.hash = `paper/${number}`; }", number)
    written.wait_for_function(
        """(number) => document.querySelector(".figure h2").textContent.includes(`Figure ${number}`)
          && !document.querySelector(".panel:not([hidden])[data-waits]")""",
        arg=number,
        timeout=60_000,
    )
    assert at_every_width(written) == {}


def test_a_phone_leaves_out_what_does_not_fit_and_says_it_elsewhere(written):
    reason = "not drawn: load too slow"
    written.set_viewport_size({"width": 1366, "height": 768})
    written.evaluate("rotorstab.relayout()")
    written.wait_for_timeout(200)
    written.evaluate("rotorstab.change('highest_frequency', 3)")
    settle(written, "highest_frequency", 3)
    written.wait_for_timeout(100)
    assert reason in labels(written)
    written.evaluate("rotorstab.change('highest_frequency', 16)")
    settle(written, "highest_frequency", 16)
    written.set_viewport_size({"width": 320, "height": 568})
    wait_for_rest(written)
    written.wait_for_timeout(200)
    written.evaluate(LABELS)  # those of the larger window
    assert reason not in labels(written)
    assert "load is too slow" in written.locator("#instability-help").text_content()
