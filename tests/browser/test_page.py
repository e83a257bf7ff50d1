"""The real page in a real browser, served as it ships."""

from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest

from app.results.analysis import CHARTS
from app.state import State
from tests.testing.dashboard import READY
from tests.testing.page import (
    SHOWN,
    agrees,
    box_of,
    drag,
    expected,
    frame_of,
    is_drawn,
    settle,
    shown,
    visit,
    wait_for_address,
)

pytestmark = pytest.mark.browser

INK = """() => {
  for (const top of Bokeh.documents[0].roots()) {
    for (const model of top.references()) {
      if (model.type === "LinearAxis") return model.major_label_text_color;
    }
  }
}"""


def test_it_opens_with_the_solvers_picture(page):
    values = agrees(page)
    assert values == State().inputs()
    assert page.locator("h1").count() == 1
    assert set(shown(page)) >= set(CHARTS)


def test_zoom_survives_a_slider_and_reset_zoom_restores(page):
    page.locator("[aria-labelledby=instability-title] .plot").scroll_into_view_if_needed()
    x, y, width, height = frame_of(page, "instability")
    page.mouse.move(x + 0.3 * width, y + 0.3 * height)
    page.mouse.down()
    page.mouse.move(x + 0.6 * width, y + 0.6 * height, steps=5)
    page.mouse.up()
    page.wait_for_function(f"() => JSON.parse(({SHOWN})()).instability.axes[0][0] > 1")
    zoomed = shown(page)["instability"]["axes"]
    highest = State().highest_frequency
    assert zoomed[0] == pytest.approx([0.3 * highest, 0.6 * highest], abs=0.15)
    assert zoomed[1] == pytest.approx([0.4, 0.7], abs=0.03)
    drag(page, "static_load_factor", 0.3)
    values = settle(page)
    got = shown(page)
    assert got["instability"]["axes"] == zoomed
    # the part that is seen is computed at the resolution of the whole chart
    wanted = expected(values, zoomed)
    assert is_drawn(got["instability"], wanted["instability"])
    page.get_by_role("button", name="Reset zoom").click()
    page.wait_for_function(f"() => JSON.parse(({SHOWN})()).instability.axes[0][0] === 0")
    agrees(page)


def test_the_theme_button_recolours_page_and_charts_and_is_remembered(page):
    ground = "getComputedStyle(document.body).backgroundColor"
    # the charts take the page's colours a little after they are made, and with the button at once
    page.get_by_role("button", name="Dark").click()
    dark = page.evaluate(INK), page.evaluate(ground)
    page.get_by_role("button", name="Light").click()
    light = page.evaluate(INK), page.evaluate(ground)
    page.get_by_role("button", name="Dark").click()
    assert (page.evaluate(INK), page.evaluate(ground)) == dark
    assert light[0] != dark[0]
    assert light[1] != dark[1]
    assert page.get_by_role("button", name="Light").is_visible()
    page.reload()
    page.wait_for_function(READY)
    page.wait_for_function(f"(ink) => ({INK})() === ink", arg=dark[0])
    assert page.evaluate(ground) == dark[1]


def test_the_address_carries_the_state_to_another_page_and_the_two_go_their_own_ways(
    page, open_page
):
    one = page
    box_of(one, "spin_speed").fill("1.5")
    box_of(one, "spin_speed").press("Enter")
    settle(one, "spin_speed", 1.5)
    wait_for_address(one, "spin=1.5&")
    address = urlsplit(one.url)
    assert parse_qs(address.query)
    other = open_page(path=f"{address.path}?{address.query}")
    before = agrees(one)
    assert agrees(other) == before
    drag(one, "shear", 0.7)
    assert settle(one)["shear"] > 0.05
    assert agrees(other) == before
    box_of(other, "disk_mass").fill("9")
    box_of(other, "disk_mass").press("Enter")
    settle(other, "disk_mass", 9.0)
    assert agrees(one)["disk_mass"] == 5.0


def test_the_policy_is_never_violated(page):
    """Every page, the inspector, an export and the code window; the browser reports violations."""
    page.evaluate(
        """() => {
          window.violations = [];
          document.addEventListener("securitypolicyviolation",
            (event) => window.violations.push(`${event.violatedDirective} ${event.blockedURI}`));
        }"""
    )
    page.locator(".marker-handle").press("ArrowUp")
    page.wait_for_function("rotorstab.last.inspector && Bokeh.documents[0].is_idle")
    with page.expect_download() as download:
        page.locator('select.export[data-chart="campbell"]').select_option("csv")
    assert Path(download.value.path()).read_bytes().startswith(b"\xef\xbb\xbf# ")  # for Excel
    for key in ("stiffness", "paper", "lessons", "explore"):
        page.evaluate("key => { location.hash = key }", key)
        page.wait_for_function("key => rotorstab.last.page === key", arg=key)
        page.wait_for_function("Bokeh.documents[0].is_idle")
    assert page.evaluate("window.violations") == []


def test_an_address_is_read_and_the_legend_names_the_curves_that_are_drawn(open_page):
    page = open_page(path="/app?v=1&load=partly&stiff=both&spin_speed=2")
    settle(page)
    # a name in a notice is not a subscript
    notice = page.locator(".notice")
    assert "spin_speed" in notice.inner_text()
    assert notice.locator("sub").count() == 0

    def named():
        return page.evaluate(
            "[...document.querySelectorAll('[data-curve]')]"
            ".filter((one) => one.getClientRects().length).map((one) => one.dataset.curve)"
        )

    assert named() == [
        "axial",
        "follower",
        "partly",
        "axial exact",
        "follower exact",
        "partly exact",
    ]
    # with all of the slope a partly follower load is a follower load
    values = "{ stiffness: 'linear', tangency: 1 }"
    page.evaluate(f"rotorstab.send({{ type: 'change', values: {values} }})")
    page.wait_for_function("rotorstab.last.values.tangency === 1")
    assert named() == ["axial", "follower"]


def test_a_figure_that_is_being_made_shows_nothing_of_another(page):
    visit(page, "paper")
    title = page.locator("[data-paper=title]")
    title.filter(has_text="Figure 6. ").wait_for()
    # its answer has not come
    page.evaluate("window.sends = rotorstab.send; rotorstab.send = () => {}")
    page.get_by_role("button", name="Fig. 9", exact=True).click()
    assert title.text_content() == "Figure 9"
    for part in ("caption", "parameters", "reading", "legend"):
        assert page.locator(f"[data-paper={part}]").text_content() == ""
    plot = page.locator("[data-panel=figure-a] .plot > div")
    assert plot.evaluate("(one) => getComputedStyle(one).visibility") == "hidden"
    page.evaluate("rotorstab.paper.answer({ not_drawn: 'It was <b>not</b> computed.' })")
    problem = page.locator("[data-paper=problem]")
    assert problem.inner_text() == "It was <b>not</b> computed."
    page.evaluate("rotorstab.send = sends")
