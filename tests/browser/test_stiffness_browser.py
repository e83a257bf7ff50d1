"""The page Stiffness: all of it on one screen, and only the inputs that change it."""

import pytest

from app.pages.stiffness import Stiffness
from tests.testing.page import frame_of, visit, wait_for_value

pytestmark = pytest.mark.browser


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (1920, 1080)])
def test_stiffness_fits_on_one_screen(page, width, height):
    page.set_viewport_size({"width": width, "height": height})
    visit(page, "stiffness")
    size = page.evaluate(
        "[document.documentElement.scrollWidth, document.documentElement.scrollHeight]"
    )
    assert size == [width, height]  # nothing to scroll
    for key in Stiffness.chart_keys:
        left, top, across, down = frame_of(page, key)
        card = page.locator(f"[data-coefficient={key}]").bounding_box()
        assert left > card["x"]
        assert top + down < card["y"] + card["height"] < height
        assert left + across < card["x"] + card["width"] < width
        assert down > 0.2 * height
    limits = page.locator("[data-coefficient=limits]")
    assert limits.evaluate("(card) => card.scrollHeight <= card.clientHeight")


@pytest.mark.parametrize("width", [1366, 390])
def test_stiffness_offers_the_inputs_that_change_its_charts(page, width):
    page.set_viewport_size({"width": width, "height": 768})
    visit(page, "stiffness")
    assert page.locator("#rs-shear").is_visible()
    for name in ("static_load_factor", "spin_speed", "disk_mass", "polar_inertia"):
        assert not page.locator(f"#rs-{name}").is_visible(), name
    assert not page.locator("details.pins").is_visible()
    page.evaluate("rotorstab.change('load_type', 'partly')")
    wait_for_value(page, "load_type", "partly")
    assert page.locator("#rs-tangency").is_visible()
    visit(page, "explore")
    assert page.locator("#rs-static_load_factor").is_visible()
