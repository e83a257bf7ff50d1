"""The wheel and a pinch zoom the charts, alone or side by side, which then show what is seen."""

import numpy as np
import pytest

from app.results.analysis import window_of
from app.results.views import fineness_of
from app.state import State
from rotorstab import floquet_solution
from tests.testing.page import FRAME, settle, shown, wait_for_rest

pytestmark = pytest.mark.browser
KEYS = ("instability", "load-frequency", "campbell")


@pytest.fixture
def desktop(page):
    """The page on a laptop, where nothing scrolls."""
    page.set_viewport_size({"width": 1366, "height": 768})
    settle(page)
    wait_for_rest(page)
    return page


def ranges(page, key):
    return shown(page)[key]["axes"]


def wheel(page, key, turn, share=0.3):
    """Turn the wheel over a place of a chart that is away from the marker."""
    x, y, width, height = page.evaluate(FRAME, key)
    page.mouse.move(x + share * width, y + 0.3 * height)
    page.mouse.wheel(0, turn)
    page.evaluate("() => new Promise(requestAnimationFrame)")


@pytest.mark.parametrize("key", KEYS)
def test_the_wheel_zooms_where_nothing_scrolls(desktop, key):
    whole = ranges(desktop, key)
    wheel(desktop, key, -240)
    end = whole[0][1]
    desktop.wait_for_function(
        "([key, end]) => rotorstab.places.window(key)[0][1] < end", arg=[key, end]
    )
    settle(desktop)
    (left, right), _ = ranges(desktop, key)
    assert right - left < 0.9 * (whole[0][1] - whole[0][0])
    if key != "instability":
        # the curves have been computed for what is seen
        desktop.wait_for_function(
            """([key, left, right]) => {
              const line = rotorstab.places.view(key).model.renderers
                .find((one) => one.name === "whirl").data_source.data.xs[0];
              return line.some((x) => Math.abs(x - left) < 1e-9);
            }""",
            arg=[key, left, right],
        )
    # no zoom leaves what has an answer
    for _ in range(30):
        wheel(desktop, key, 600)
    settle(desktop)
    bounds = desktop.evaluate(
        """(key) => {
          const { x_range, y_range } = rotorstab.places.view(key).model;
          return [x_range.bounds, y_range.bounds];
        }""",
        key,
    )
    for found, bound in zip(ranges(desktop, key), bounds, strict=True):
        assert found == pytest.approx(bound)
    assert desktop.evaluate("[scrollX, scrollY]") == [0, 0]
    desktop.get_by_role("button", name="Reset zoom").click()
    desktop.wait_for_function(
        "([key, end]) => rotorstab.places.window(key)[0][1] === end", arg=[key, end]
    )
    settle(desktop)
    assert ranges(desktop, key) == whole


def along(outline, pixel, count=60):
    """Return points on an outline with gaps, evenly spread over its length in pixels."""
    starts, ends = outline[:-1] / pixel, outline[1:] / pixel
    length = np.nan_to_num(np.hypot(*(ends - starts).T))
    random = np.random.default_rng(0)
    chosen = random.choice(len(length), count, p=length / length.sum())
    part = random.uniform(size=(count, 1))
    return ((1 - part) * starts[chosen] + part * ends[chosen]) * pixel


def unstable(inputs, points):
    """Return what Floquet's method says of single points (θ/ω_n, β_d)."""
    state = State(**inputs)
    operation = window_of(state).operation
    theta = [operation.excitation_frequency(ratio) for ratio in points[..., 0].ravel()]
    load = [operation.pulsating_load(max(factor, 0.0)) for factor in points[..., 1].ravel()]
    found = floquet_solution(
        operation.system, operation.static_load, np.array(load), np.array(theta)
    )
    return (found.growth_rate > 1e-7).reshape(points.shape[:-1])


def test_outlines_are_right_to_a_pixel_of_a_fine_screen_also_zoomed(open_page):
    page = open_page(1366, 768, device_scale_factor=2)
    settle(page)
    for zoom in (None, [1.1, 2.3]):
        if zoom:
            page.evaluate(
                """([start, end]) =>
                  rotorstab.places.view("instability").model.x_range.setv({ start, end })""",
                zoom,
            )
            page.wait_for_timeout(400)  # the window is sent, then the request for the full picture
        values = settle(page)
        wait_for_rest(page)
        _, _, width, height = page.evaluate(FRAME, "instability")
        sent = page.evaluate("rotorstab.restMessage()")
        assert (sent["width"], sent["height"]) == (round(2 * width), round(2 * height))
        assert fineness_of(sent) == 2
        chart = shown(page)["instability"]
        (left, right), (low, high) = chart["axes"]
        edge = next(
            one for one in chart["layers"] if one.get("name") == ["edge of what is unstable"]
        )
        outline = np.array([edge["xs"][0], edge["ys"][0]], float).T
        pixel = np.array([(right - left) / sent["width"], (high - low) / sent["height"]])
        turns = np.linspace(0, 2 * np.pi, 9)[:, None]
        around = np.hstack([np.cos(turns), np.sin(turns)])
        points = along(outline, pixel)[:, None] + pixel * np.vstack([around, 0.4 * around])
        grows = unstable(values, points)
        assert (grows.any(axis=1) & ~grows.all(axis=1)).mean() > 0.95


def test_the_wheel_scrolls_a_page_that_is_longer_than_the_window(page):
    page.set_viewport_size({"width": 1100, "height": 700})
    settle(page)
    wait_for_rest(page)
    whole = ranges(page, "instability")
    wheel(page, "instability", 120)
    page.wait_for_function("scrollY > 50")
    assert ranges(page, "instability") == whole
    page.evaluate("scrollTo(0, 0)")
    page.wait_for_function("scrollY === 0")
    page.keyboard.down("Control")
    wheel(page, "instability", -240)
    page.keyboard.up("Control")
    page.wait_for_function("rotorstab.places.window('instability')[0][1] < 6")
    assert page.evaluate("scrollY") == 0


def test_two_fingers_zoom_and_one_scrolls(phone):
    x, y, width, height = phone.evaluate(FRAME, "instability")
    middle = x + width / 2, y + 0.3 * height
    marker = phone.evaluate("rotorstab.last.values.marker_frequency")

    def touch(kind, gap):
        points = [{"x": middle[0] + side * gap, "y": middle[1], "id": side} for side in (-1, 1)]
        points = [point | {"id": number} for number, point in enumerate(points)]
        phone.touches.send(
            "Input.dispatchTouchEvent",
            {"type": kind, "touchPoints": points if kind != "touchEnd" else []},
        )
        phone.wait_for_timeout(16)

    touch("touchStart", 30)
    for gap in range(32, 92, 4):
        touch("touchMove", gap)
    touch("touchEnd", 0)
    phone.wait_for_function(
        "(() => { const [[a, b]] = rotorstab.places.window('instability'); return b - a < 5; })()"
    )
    settle(phone)
    # the marked point has not moved, and the page neither zoomed nor scrolled
    assert phone.evaluate("rotorstab.last.values.marker_frequency") == marker
    assert phone.evaluate("[visualViewport.scale, scrollY]") == [1, 0]


def test_a_pin_stands_beside_the_present_chart_on_one_screen(desktop):
    page = desktop
    page.locator(".pins summary").click()
    page.get_by_role("button", name="Pin curves").click()
    page.wait_for_function("rotorstab.last.pins")
    page.get_by_label("Side by side").select_option("pin 1")
    page.wait_for_function("rotorstab.places.view('comparison') && rotorstab.last.side_by_side")
    settle(page)
    wait_for_rest(page)
    now, beside = (page.evaluate(FRAME, key) for key in ("instability", "comparison"))
    assert now[0] + now[2] < beside[0]
    assert now[1:] == pytest.approx(beside[1:], abs=1)  # as high and as wide
    assert beside[0] + beside[2] < 1366
    assert page.evaluate("document.documentElement.scrollHeight") <= 768
    # the wheel over one of them zooms both
    wheel(page, "comparison", -240)
    page.wait_for_function("rotorstab.places.window('instability')[0][1] < 6")
    assert ranges(page, "instability") == ranges(page, "comparison")
    page.get_by_label("Side by side").select_option("none")
    page.wait_for_function("!rotorstab.last.side_by_side")
    wait_for_rest(page)
    assert page.evaluate(FRAME, "instability")[2] > 1.5 * now[2]
