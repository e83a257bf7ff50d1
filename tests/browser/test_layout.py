"""What stays in place: charts under words that change, and layers that the legend switches off."""

import pytest

from app.pages import PAGES
from app.results.analysis import CHARTS
from tests.testing.dashboard import READY
from tests.testing.page import FOCUS, agrees, drag, frame_of, open_groups, settle, visit

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
  const words = document.querySelector("[data-verdict]")?.textContent;
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
        context = browser.new_context(viewport={"width": width, "height": 900})
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
def test_the_full_verdict_moves_no_chart(watched, width, query):
    page = watched(width, query)  # a map that the server does not know yet
    page.wait_for_timeout(300)
    found = tops(page)
    assert set(found) >= set(CHART_TITLES)
    assert all(len(found[key]) == 1 for key in CHART_TITLES), found
    assert sum(size for size, _ in page.evaluate("shifts")) < 0.02, page.evaluate("shifts")


@pytest.mark.parametrize("width", [1280, 390])
def test_a_slider_at_rest_again_moves_no_chart(watched, width):
    page = watched(width)
    page.evaluate("for (const key in tops) delete tops[key]; said.clear()")
    for value in (1.96, 1.92, 1.88):
        page.evaluate("(value) => rotorstab.change('spin_speed', value)", value)
        page.wait_for_function("(value) => rotorstab.last.values.spin_speed === value", arg=value)
    settle(page, "spin_speed", 1.88)
    page.wait_for_timeout(200)
    assert page.evaluate("said.size") >= 2
    found = tops(page)
    assert all(len(found[key]) == 1 for key in CHART_TITLES), found


def test_a_layer_is_switched_off_and_on_in_the_legend(page):
    legend = page.locator("[aria-labelledby=instability-title] .legend")
    hidden = page.locator("[data-hidden-layers]")
    assert hidden.is_hidden()
    for name, words, told in [
        ("show_growth", "unstable (Floquet)", "the map of growth"),
        ("show_bolotin", "Bolotin region", "Bolotin regions"),
        ("show_disagreement", "stable, but in a Bolotin region", "the shading of disagreement"),
    ]:
        exact = words == "Bolotin region"
        button = legend.get_by_role("button", name=words, exact=exact)
        assert button.get_attribute("aria-pressed") == "true"
        button.click()
        settle(page, name, False)
        assert button.is_visible()
        assert button.get_attribute("aria-pressed") == "false"
        struck = "one => getComputedStyle(one.closest('li')).textDecorationLine"
        assert button.evaluate(struck) == "line-through"
        assert hidden.inner_text() == f"Hidden: {told}. The legend switches layers on and off."
        open_groups(page)
        assert not page.locator(f"#rs-{name}").is_checked()
        button.press("Enter")
        settle(page, name, True)
        assert button.evaluate(struck) == "none"
        assert hidden.is_hidden()


def test_what_is_hidden_is_told_in_one_sentence(open_page):
    page = open_page(path="/app?v=1&growth=0&bolotin=0&differ=0")
    assert page.locator("[data-hidden-layers]").inner_text() == (
        "Hidden: the map of growth, Bolotin regions and the shading of disagreement. "
        "The legend switches layers on and off."
    )
    # the strokes of a hidden layer are muted with it
    muted = page.locator("[aria-labelledby=instability-title] .legend li.off")
    assert muted.count() == 7


def test_words_on_the_white_picture_can_be_read_in_the_dark(open_page):
    page = open_page(color_scheme="dark", path="/app#paper")
    page.wait_for_function("rotorstab.last.page === 'paper'")
    colours = page.evaluate(
        """() => {
          const words = document.createElement("p");
          words.className = "sub";
          document.querySelector(".picture").append(words);
          return [words, words.parentElement].map((one) => getComputedStyle(one).color);
        }"""
    )
    assert colours[0] == colours[1]


def test_no_number_of_the_pins_table_breaks_on_a_phone(open_page):
    page = open_page(390, 900, path="/app?v=1&u=SI&p1=spin_1~~slow&p2=md_8~~heavy&p3=as_0.4~~c")
    # each pin of an address is solved in a turn of its own
    page.wait_for_function("document.querySelector('[data-pin-full]').textContent !== ''")
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


def test_a_chart_beside_a_lesson_keeps_its_tools(open_page):
    page = open_page(1440, 900, path="/app#lesson/04-gyroscope/3")
    page.wait_for_function("rotorstab.lessons.running")
    tools = page.locator("[aria-labelledby=instability-title] .bk-Toolbar .bk-tool-icon")
    tools.nth(4).wait_for(state="visible")  # Playwright looks into shadow roots
    assert page.locator("[aria-labelledby=instability-title] .bk-tool-overflow").count() == 0


def test_no_page_scrolls_sideways(page):
    for name in [one.key for one in PAGES][::-1]:
        visit(page, name)
        for width in (1920, 1280, 1024, 901, 768, 390):
            page.set_viewport_size({"width": width, "height": 900})
            page.wait_for_timeout(150)  # layout
            assert page.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
            if name == "explore":
                for key in CHARTS:
                    x, _, across, down = frame_of(page, key)
                    assert x >= 0
                    assert x + across <= width
                    assert min(across, down) > 150
    page.set_viewport_size({"width": 1280, "height": 900})


def test_the_drawer_opens_and_closes_on_a_phone(open_page):
    page = open_page(390, 844, has_touch=True)
    sidebar = page.locator("#sidebar")
    button = page.get_by_role("button", name="Parameters", exact=True)
    assert not sidebar.is_visible()
    button.tap()
    sidebar.wait_for(state="visible")
    assert button.get_attribute("aria-expanded") == "true"
    assert page.evaluate(FOCUS) == "Close parameters"
    page.keyboard.press("Escape")
    sidebar.wait_for(state="hidden")
    assert button.get_attribute("aria-expanded") == "false"
    assert page.evaluate(FOCUS) == "Parameters"
    button.tap()
    page.get_by_role("button", name="Close parameters").tap()
    sidebar.wait_for(state="hidden")
    button.tap()
    sidebar.wait_for(state="visible")
    drag(page, "static_load_factor", 0.3)
    agrees(page)
