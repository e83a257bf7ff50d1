"""What stays in place: charts under words that change, and layers that the legend switches off."""

import pytest

from app.pages import PAGES
from app.results.analysis import CHARTS
from app.state import State
from tests.testing.dashboard import READY
from tests.testing.page import (
    box_of,
    drag,
    frame_of,
    open_groups,
    settle,
    visit,
    wait_for_rest,
)

pytestmark = pytest.mark.browser

# every frame from the first: where the charts begin, and what the browser counts as a shift
WATCH = """
window.tops = {}; window.shifts = []; window.said = new Set();
new PerformanceObserver((list) => {
  for (const one of list.getEntries()) {
    if (one.hadRecentInput) continue;
    for (const { node } of one.sources) {
      if (node?.closest?.("main")) shifts.push([one.value, node.className || node.tagName]);
    }
  }
}).observe({ type: "layout-shift", buffered: true });
const look = () => {
  const words = document.querySelector("[data-point]")?.textContent;
  if (words) said.add(words);
  for (const plot of document.querySelectorAll('[data-page="explore"] .plot')) {
    const key = plot.closest(".card").getAttribute("aria-labelledby");
    const place = plot.getBoundingClientRect();
    if (place.height && !(key in tops)) tops[key] = new Set();
    if (place.height) tops[key].add(Math.round(place.top + scrollY));
  }
  requestAnimationFrame(look);
};
addEventListener("DOMContentLoaded", look, { once: true });
"""
MAIN = (
    "static_load_factor",
    "spin_speed",
    "shear",
    "disk_mass",
    "diametral_inertia",
    "polar_inertia",
)
CHART_TITLES = ("instability-title", "load-title", "campbell-title")


def tops(page):
    """Every height at which each chart of the page has begun, since it was last asked."""
    return page.evaluate(
        "() => Object.fromEntries(Object.entries(tops).map(([key, all]) => [key, [...all]]))"
    )


@pytest.fixture
def watched(browser, dashboard):
    contexts = []

    def open_one(width, query=""):
        size = {"width": width, "height": 900}
        # a moving shaft takes the processor, and moves no chart
        context = browser.new_context(viewport=size, reduced_motion="reduce")
        contexts.append(context)
        context.add_init_script(WATCH)
        page = context.new_page()
        page.goto(f"{dashboard.origin}/app{query}")
        page.wait_for_function(READY)
        settle(page)
        return page

    yield open_one
    for context in contexts:
        context.close()


@pytest.mark.parametrize(
    ("width", "query"),
    [
        (1600, "?v=1&spin=1.71"),
        (390, "?v=1&u=SI&spin=1.3&ze=0.012"),
        pytest.param(1280, "?v=1&u=SI&spin=1.3&ze=0.011", marks=pytest.mark.long),
        pytest.param(820, "?v=1&spin=1.72", marks=pytest.mark.long),
    ],
)
def test_neither_the_full_verdict_nor_a_slider_at_rest_again_moves_a_chart(watched, width, query):
    page = watched(width, query)  # a map that the server does not know yet
    page.wait_for_timeout(300)  # a chart that moves late is seen
    found = tops(page)
    assert set(found) >= set(CHART_TITLES)
    assert all(len(found[key]) == 1 for key in CHART_TITLES), found
    assert sum(size for size, _ in page.evaluate("shifts")) < 0.02, page.evaluate("shifts")

    page.evaluate("for (const key in tops) delete tops[key]; said.clear()")
    for value in (1.96, 1.92, 1.88):
        page.evaluate("(value) => rotorstab.change('spin_speed', value)", value)
        page.wait_for_function("(value) => rotorstab.last.values.spin_speed === value", arg=value)
    settle(page, "spin_speed", 1.88)
    page.wait_for_function("said.size >= 2")
    page.wait_for_timeout(200)  # a chart that moves late is seen
    found = tops(page)
    assert all(len(found[key]) == 1 for key in CHART_TITLES), found


VIEWS = ("instability", "load-frequency", "campbell", "shaft")
# each view and its charts with their axes, in the window: left, top, right, bottom
PLACES = """() => {
  const box = (one) => {
    const { left, top, right, bottom } = one.getBoundingClientRect();
    return [left, top, right, bottom];
  };
  const figures = {};
  const walk = (view) => {
    const shown = view.model.type === "Figure" && view.el.checkVisibility();
    if (shown) figures[view.model.name] = box(view.el);
    for (const child of view.children()) walk(child);
  };
  for (const view of Bokeh.index) walk(view);
  const views = Object.fromEntries(
    [...document.querySelectorAll("[data-view]")].map((one) => [one.dataset.view, box(one)]));
  const { scrollWidth, scrollHeight } = document.documentElement;
  return { views, figures, page: [scrollWidth, scrollHeight] };
}"""


def within(inner, outer):
    return (
        inner[0] >= outer[0] - 1
        and inner[1] >= outer[1] - 1
        and inner[2] <= outer[2] + 1
        and inner[3] <= outer[3] + 1
    )


def test_explore_fits_on_one_screen(page):
    page.set_viewport_size({"width": 1366, "height": 768})
    settle(page)
    assert page.locator(".marker-handle").is_visible()
    fits(page, 1366, 768)
    page.set_viewport_size({"width": 1920, "height": 1080})
    fits(page, 1920, 1080)


def fits(page, width, height):
    wait_for_rest(page)
    found = page.evaluate(PLACES)
    window = [0, 0, width, height]
    assert found["page"] == [width, height]  # nothing to scroll
    assert set(found["views"]) == set(VIEWS)
    for key, box in found["views"].items():
        assert within(box, window), (key, box)
    for key in CHARTS:  # each with its axes
        assert within(found["figures"][key], found["views"][key]), (key, found)
        left, top, across, down = frame_of(page, key)
        assert within([left, top, left + across, top + down], found["figures"][key]), key
    _, _, across, down = frame_of(page, "instability")
    assert down > 0.36 * height
    # the load type and the six sliders, each on one line, in the user's order
    places = [page.locator("#rs-preset").bounding_box()]
    places += [page.locator("[role=radiogroup]").first.bounding_box()]
    places += [page.locator(f"#rs-{name}").bounding_box() for name in MAIN]
    tops = [place["y"] for place in places]
    assert tops == sorted(tops)
    assert places[-1]["y"] + places[-1]["height"] < height
    for name in MAIN:
        slider, box = page.locator(f"#rs-{name}").bounding_box(), box_of(page, name).bounding_box()
        assert abs(slider["y"] + slider["height"] / 2 - box["y"] - box["height"] / 2) < 2
    assert page.evaluate("document.querySelector('#sidebar').scrollTop") == 0


def test_a_layer_is_switched_off_and_on_beside_the_chart(page):
    legend = page.locator("[data-view=instability] .layers")
    defaults = State().inputs()
    for name, words in [
        ("show_bolotin", "Bolotin region"),
        ("show_disagreement", "disagreement"),
    ]:
        button = legend.get_by_role("button", name=words)
        assert button.get_attribute("aria-pressed") == str(defaults[name]).lower()
        button.click()
        settle(page, name, not defaults[name])
        assert button.get_attribute("aria-pressed") == str(not defaults[name]).lower()
        open_groups(page)
        assert page.locator(f"#rs-{name}").is_checked() != defaults[name]
        button.press("Enter")
        settle(page, name, defaults[name])


def test_growth_that_is_hidden_is_named_beside_the_chart(page):
    """The scale of colours stands for the map, and is away with it."""
    page.evaluate("rotorstab.change('show_growth', false)")
    settle(page, "show_growth", False)
    button = page.locator("[data-view=instability] .layers").get_by_role("button", name="growth")
    assert button.get_attribute("aria-pressed") == "false"
    button.click()
    settle(page, "show_growth", True)
    button.wait_for(state="hidden")


@pytest.mark.parametrize("key", ["paper", "lessons"])
def test_pages_without_parameters_have_no_sidebar(page, key):
    assert page.locator("#sidebar").is_visible()
    visit(page, key)
    assert not page.locator("#sidebar").is_visible()
    visit(page, "stiffness")
    assert page.locator("#sidebar").is_visible()


def test_no_number_of_the_pins_table_breaks_on_a_phone(page):
    page.set_viewport_size({"width": 390, "height": 900})
    for name, value in (("spin_speed", 1), ("disk_mass", 8), ("static_load_factor", 0.4)):
        page.evaluate("rotorstab.send({ type: 'reset' })")
        change = {"type": "change", "values": {"units": "SI", name: value}}
        page.evaluate("(change) => rotorstab.send(change)", change)
        page.evaluate("rotorstab.send({ type: 'pin', label: 'pin' })")
    page.wait_for_function("document.querySelector('[data-pin-full]').textContent !== ''")
    page.get_by_role("button", name="Compare the settings").click()
    lines = page.evaluate(
        """() => [...document.querySelectorAll(".pin-table td")].map((cell) => {
          const range = document.createRange();
          range.selectNodeContents(cell);
          return new Set([...range.getClientRects()].map((one) => Math.round(one.top))).size;
        })"""
    )
    assert lines
    assert set(lines) == {1}
    full = page.locator("[data-pin-full]")
    assert full.inner_text() == "There are three pins already: remove one first."
    assert page.locator(".pin-add").is_disabled()
    page.keyboard.press("Escape")
    for number in (1, 2, 3):
        page.evaluate("(number) => rotorstab.send({ type: 'unpin', number })", number)
    page.wait_for_function("rotorstab.last.pins === null")


def test_a_chart_beside_a_lesson_keeps_its_tools(page):
    page.set_viewport_size({"width": 1440, "height": 900})
    page.evaluate("location.hash = 'lesson/04-gyroscope/3'")
    page.wait_for_function("rotorstab.lessons.running")
    tools = page.locator("[data-view=instability] .bk-Toolbar .bk-tool-icon")
    tools.nth(4).wait_for(state="visible")  # Playwright looks into shadow roots
    assert page.locator("[data-view=instability] .bk-tool-overflow").count() == 0


def test_no_page_scrolls_sideways(page):
    for name in [one.key for one in PAGES][::-1]:
        visit(page, name)
        for width in (1920, 1280, 1024, 901, 768, 390):
            page.set_viewport_size({"width": width, "height": 900})
            wait_for_rest(page)
            assert page.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
            if name == "explore":
                # on a narrow screen the other charts stand beside the first one
                for key in CHARTS if width > 960 else CHARTS[:1]:
                    x, _, across, down = frame_of(page, key)
                    assert x >= 0
                    assert x + across <= width
                    assert min(across, down) > 100
    page.set_viewport_size({"width": 1280, "height": 900})


SHOWN_VIEW = """() => [...document.querySelectorAll("[data-view]")].filter((one) => {
  const { left, right } = one.getBoundingClientRect();
  return left >= -1 && right <= innerWidth + 1;
}).map((one) => one.dataset.view)"""


def test_a_phone_shows_one_chart_and_the_chosen_sliders_below_it(phone):
    page = phone
    assert page.evaluate(SHOWN_VIEW) == ["instability"]
    names = page.get_by_role("navigation", name="Charts")
    for key, name in [("shaft", "Shaft"), ("campbell", "Campbell"), ("instability", "Instability")]:
        names.get_by_role("button", name=name).tap()
        page.wait_for_function(f"({SHOWN_VIEW})().join() === '{key}'")
        names.locator("[aria-pressed=true]").filter(has_text=name).wait_for()
        assert names.locator("[aria-pressed=true]").count() == 1
    # the chart stays in view while the sheet is scrolled
    top = frame_of(page, "instability")[1]
    page.evaluate("scrollTo(0, document.documentElement.scrollHeight)")
    wait_for_rest(page)
    assert 0 < frame_of(page, "instability")[1] <= top
    assert page.locator("#rs-spin_speed").is_visible()
    assert not page.locator("#rs-shear").is_visible()
    chooser = page.get_by_role("group", name="Sliders in view")
    chooser.get_by_role("button", name="Shear parameter").tap()
    assert page.locator("#rs-shear").is_visible()
    drag(page, "shear", 0.5)
    page.reload()
    page.wait_for_function(READY)
    assert page.locator("#rs-shear").is_visible()
    chooser.get_by_role("button", name="Shear parameter").tap()


def test_a_touch_screen_has_boxes_into_which_the_browser_does_not_zoom(phone):
    sizes = phone.evaluate(
        """() => {
          const controls = [...Bokeh.index].find((view) => view.model.name === "controls");
          const inside = controls.shadow_el.querySelectorAll("input.box, select");
          const page = document.querySelectorAll('input[type="text"], select');
          return [...inside, ...page].map((one) => parseFloat(getComputedStyle(one).fontSize));
        }"""
    )
    assert min(sizes) >= 16


def test_nothing_scrolls_sideways_with_large_letters(page):
    """A default font of 26 px, as set in the browser."""
    style = page.add_style_tag(content="html { font-size: 26px !important; }")
    for name in ("explore", "stiffness", "lessons", "paper"):
        visit(page, name)
        for width in (320, 1366):
            page.set_viewport_size({"width": width, "height": 768})
            wait_for_rest(page)
            assert page.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
    style.evaluate("(one) => one.remove()")


def test_forced_colours_keep_swatches_and_the_selection(page):
    page.emulate_media(forced_colors="active")
    found = page.evaluate(
        """() => {
          const controls = [...Bokeh.index].find((view) => view.model.name === "controls");
          const chosen = controls.shadow_el.querySelector(".choice input:checked + span");
          const other = controls.shadow_el.querySelector(".choice input:not(:checked) + span");
          const ground = (one) => getComputedStyle(one).backgroundColor;
          return {
            swatches: [...document.querySelectorAll('[data-page="explore"] .layers .swatch')]
              .map((one) => getComputedStyle(one).backgroundImage),
            chosen: ground(chosen), other: ground(other),
          };
        }"""
    )
    assert all("gradient" in image for image in found["swatches"])
    assert found["chosen"] != found["other"]
    page.emulate_media(forced_colors="none")
