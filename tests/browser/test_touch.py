"""A phone: taps, swipes and sliders under a finger, as touches of the browser's protocol."""

import pytest

from app.results.analysis import CHARTS
from app.state import State
from tests.testing.page import show_chart, wait_for_rest

pytestmark = pytest.mark.browser

CHART = """(key) => {
  const walk = (view) => (view.model.type === "Figure" && view.model.name === key)
    ? view : [...view.children()].map(walk).find(Boolean);
  const view = [...Bokeh.index].map(walk).find(Boolean);
  view.el.scrollIntoView({ block: "center" });
  const { left, top } = view.el.getBoundingClientRect();
  const { x, y, width, height } = view.frame.bbox;
  return [left + x, top + y, width, height];
}"""

PLACE = """(key) =>
  document.querySelector(`[data-view="${key}"]`).getBoundingClientRect().left"""
ZOOM = """(key) => {
  const walk = (view) => (view.model.name === key && view.model.x_range)
    ? view.model : [...view.children()].map(walk).find(Boolean);
  const { x_range: x, y_range: y } = [...Bokeh.index].map(walk).find(Boolean);
  return [x.start - x.reset_start, y.end - y.reset_end];
}"""


def swipe(page, start, end, steps=8):
    """Move one finger from a point to another."""
    places = [
        [a + (b - a) * step / steps for a, b in zip(start, end, strict=True)]
        for step in range(steps + 1)
    ]
    for kind, (x, y) in zip(["touchStart"] + ["touchMove"] * steps, places, strict=True):
        page.touches.send(
            "Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]}
        )
        page.wait_for_timeout(16)  # a frame
    page.touches.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    wait_for_rest(page)  # it may go on scrolling


def test_a_swipe_over_a_chart_scrolls_the_page(phone):
    for key in CHARTS:
        show_chart(phone, key)
        phone.evaluate("scrollTo(0, 0)")
        x, y, width, height = phone.evaluate(CHART, key)
        before = phone.evaluate("scrollY")
        swipe(phone, (x + width / 2, y + 0.8 * height), (x + width / 2, y + 0.2 * height))
        assert phone.evaluate("scrollY") > before, key
        assert phone.evaluate(ZOOM, key) == [0, 0], key


def test_the_shaft_is_one_swipe_away(phone):
    x, y, width, height = phone.evaluate(CHART, "instability")
    for key, start, end in (
        ("shaft", x + 0.95 * width, 8),
        ("instability", 100, 170),  # a short one
        ("shaft", 200, 140),
    ):
        swipe(phone, (start, y + height / 2), (end, y + height / 2))
        phone.wait_for_function(f"(key) => Math.abs(({PLACE})(key)) < 20", arg=key)
    assert phone.evaluate(ZOOM, "instability") == [0, 0]
    # a finger that has hardly moved changes nothing
    swipe(phone, (200, y + height / 2), (215, y + height / 2))
    assert abs(phone.evaluate(PLACE, "shaft")) < 20


def test_a_tap_places_the_marker(phone):
    x, y, width, height = phone.evaluate(CHART, "instability")
    phone.touchscreen.tap(x + 0.6 * width, y + 0.5 * height)  # away from the marker
    phone.wait_for_function("!rotorstab.last.values.marker_follows")
    values = phone.evaluate("rotorstab.last.values")
    assert values["marker_frequency"] == pytest.approx(0.6 * State().highest_frequency, abs=0.15)
    assert values["marker_factor"] == pytest.approx(0.5, abs=0.03)
    phone.get_by_role("heading", name="The shaft in motion").wait_for(state="visible")
    phone.wait_for_function("rotorstab.last.at_rest && Bokeh.documents[0].is_idle")


def test_a_finger_drags_the_marker_and_the_page_stays(phone):
    phone.evaluate(CHART, "instability")  # in view
    box = phone.locator(".marker-handle").bounding_box()
    assert min(box["width"], box["height"]) >= 44
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    before = phone.evaluate("[scrollY, rotorstab.last.values.marker_factor]")
    swipe(phone, (x, y), (x + 60, y - 40))
    phone.wait_for_function("rotorstab.last.values.marker_follows === false")
    values = phone.evaluate("rotorstab.last.values")
    assert values["marker_frequency"] > 2.5
    assert values["marker_factor"] > before[1] + 0.05
    assert phone.evaluate("scrollY") == before[0]
    assert phone.evaluate(ZOOM, "instability") == [0, 0]
    phone.wait_for_function("rotorstab.last.at_rest && Bokeh.documents[0].is_idle")


def test_sliders_and_menus_work_under_a_finger(phone):
    slider = phone.locator("#rs-spin_speed")
    box = slider.bounding_box()
    assert box["height"] >= 24
    y = box["y"] + box["height"] / 2
    at = [box["x"] + 9 + (box["width"] - 18) * share for share in (0.5, 0.75)]
    swipe(phone, (at[0], y), (at[1], y))
    phone.wait_for_function("Math.abs(rotorstab.last.values.spin_speed - 3) < 0.1")
    # a swipe that only starts on a slider scrolls the page
    here = "[rotorstab.last.values.spin_speed, scrollY]"
    before = phone.evaluate(here)
    box = slider.bounding_box()
    swipe(phone, (at[0], box["y"] + 12), (at[0], box["y"] - 200))
    after = phone.evaluate(here)
    assert after[0] == before[0]
    assert after[1] > before[1] + 50
    phone.evaluate("scrollTo(0, 0)")

    phone.locator("details.share-menu summary").tap()
    phone.get_by_role("button", name="As Python").tap()
    dialog = phone.locator("dialog.code")
    dialog.wait_for(state="visible")
    dialog.get_by_role("button", name="Close").tap()

    # a native menu: it has the focus, and nothing lies over it
    show_chart(phone, "campbell")
    menu = phone.locator("select.export[data-chart=campbell]")
    menu.scroll_into_view_if_needed()
    assert menu.bounding_box()["height"] >= 24
    menu.tap()
    phone.wait_for_function("document.activeElement.dataset.chart === 'campbell'")
    with phone.expect_download(timeout=60_000):
        menu.select_option("csv")
