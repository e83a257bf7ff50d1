"""The page Paper: the figure fills its card, both methods are named, and the address holds it."""

import pytest

from tests.testing.dashboard import READY
from tests.testing.page import frame_of, shown, visit, wait_for_rest

pytestmark = pytest.mark.browser
DRAWN = """() => document.querySelector("[data-paper=reading]").children.length
  && !document.querySelector(".panel:not([hidden])[data-waits]") && Bokeh.documents[0].is_idle"""
PANELS = "[...document.querySelectorAll('.panel')].filter((one) => one.checkVisibility())"


def drawn(page, number):
    """Wait until a figure is there with all its charts."""
    page.locator("[data-paper=title]").filter(has_text=f"Figure {number}. ").wait_for()
    page.wait_for_function(DRAWN, timeout=60_000)  # Floquet takes seconds
    wait_for_rest(page)


def show(page, fragment, number):
    """Go to a figure by its address on a page that is open, and wait until it is drawn."""
    page.evaluate("(fragment) => { location.hash = fragment; }", fragment)
    drawn(page, number)


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (1920, 1080)])
def test_a_figure_fills_its_card_on_one_screen(page, width, height):
    page.set_viewport_size({"width": width, "height": height})
    show(page, "paper", 6)
    assert not page.locator("#sidebar").is_visible()
    card = page.locator(".card.figure").bounding_box()
    assert card["width"] > width - 40
    assert card["y"] + card["height"] <= height
    frames = [
        frame_of(page, f"figure-{letter}{kind}") for kind in ("", "-floquet") for letter in "abc"
    ]
    for row in (frames[:3], frames[3:]):
        assert sum(across for _, _, across, _ in row) > 0.75 * card["width"]
        assert all(down > 0.2 * height for *_, down in row)
    for left, top, across, down in frames:
        assert card["x"] < left
        assert left + across < card["x"] + card["width"]
        assert top + down < card["y"] + card["height"]
    # a panel stands above its other one, over the same frequencies
    for own, other in zip(frames[:3], frames[3:], strict=True):
        assert abs(own[0] - other[0]) < 2
        assert abs(own[2] - other[2]) < 2


def test_the_title_stands_once_and_both_methods_are_named(page):
    show(page, "paper", 6)
    words = page.locator(".card.figure").inner_text()
    assert words.count("Effect of the static load factor") == 1
    assert words.count("Bolotin’s method (the paper)") == 3
    assert words.count("Floquet’s method: unstable") == 3


def test_the_address_names_what_is_not_usual(open_page):
    page = open_page(path="/app#paper/8/paper-only")
    drawn(page, 8)
    assert not page.locator("#paper-floquet").is_checked()
    assert page.evaluate(f"{PANELS}.map((one) => one.dataset.panel)") == ["figure-a", "figure-b"]
    page.locator("#paper-floquet").check()
    assert page.evaluate("location.hash") == "#paper/8"
    drawn(page, 8)
    page.get_by_role("button", name="Fig. 6", exact=True).click()
    assert page.evaluate("location.hash") == "#paper"
    page.get_by_role("button", name="Fig. 3", exact=True).click()
    drawn(page, 3)
    page.reload()
    page.wait_for_function(READY)
    drawn(page, 3)
    assert page.evaluate(f"{PANELS}.length") == 4
    # the figure stays while another page is open
    visit(page, "explore")
    visit(page, "paper")
    drawn(page, 3)
    assert page.evaluate("location.hash") == "#paper/3"


def test_a_name_in_the_legend_hides_its_curves(page):
    page.set_viewport_size({"width": 390, "height": 844})
    show(page, "paper/9/paper-only", 9)
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    before = len(shown(page)["figure-a"]["layers"][1]["xs"])
    button = page.locator("[data-paper=legend]").get_by_role("button", name="follower force")
    assert button.get_attribute("aria-pressed") == "true"
    button.click()
    page.wait_for_function("rotorstab.messages.waited() === 0 && Bokeh.documents[0].is_idle")
    assert button.get_attribute("aria-pressed") == "false"
    assert len(shown(page)["figure-a"]["layers"][1]["xs"]) == before / 2
