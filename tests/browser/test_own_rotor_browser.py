"""The page Your rotor in a browser: a file of ROSS opens, and its charts fit on one screen."""

import pytest

from app.results.own_charts import OWN_CHARTS
from rotorstab.rotors.rotor_file import rotor_to_toml
from tests.rotors.test_ross import as_toml, ross
from tests.testing.page import frame_of, shown, visit, wait_for_rest, wait_for_value
from tests.testing.rotors import FRISWELL_599

pytestmark = pytest.mark.browser
LONG = 90_000  # ms: the growth is computed with the lowest priority of the machine
READY = "rotorstab.last.own && !rotorstab.last.own.waits && Bokeh.documents[0].is_idle"


def open_file(page, name, text):
    file = {"name": name, "mimeType": "text/plain", "buffer": text.encode()}
    page.locator("input[type=file][aria-label='Rotor file']").last.set_input_files(file)


def test_a_ross_file_opens_and_every_chart_is_in_view(page):
    page.set_viewport_size({"width": 1366, "height": 768})
    visit(page, "rotor")
    open_file(page, "compressor.toml", as_toml({**ross(), "SealElement_A": {"n": 3}}))
    wait_for_value(page, "own_rotor", "file")
    page.get_by_text("From the file compressor.toml.").wait_for()
    page.get_by_text("SealElement_A").wait_for()
    page.wait_for_function(READY, timeout=LONG)
    wait_for_rest(page)
    size = page.evaluate(
        "[document.documentElement.scrollWidth, document.documentElement.scrollHeight]"
    )
    assert size == [1366, 768]  # nothing to scroll
    charts = shown(page)
    for key in OWN_CHARTS:
        left, top, across, down = frame_of(page, key)
        assert left > 0
        assert top > 0
        assert left + across <= 1366
        assert top + down <= 768
        assert min(across, down) > 80
        assert any(len(next(iter(layer.values()), [])) for layer in charts[key]["layers"])
    # one metre is as long on both axes of the drawing
    (left, right), (low, high) = charts["rotor-drawing"]["axes"]
    _, _, across, down = frame_of(page, "rotor-drawing")
    assert (right - left) / across == pytest.approx((high - low) / down, rel=1e-3)


def test_a_refused_file_is_named_and_a_slider_moves_the_charts(page):
    visit(page, "rotor")
    open_file(page, "bad.toml", rotor_to_toml(FRISWELL_599).replace("kg", "lb", 1))
    page.get_by_text("line ").filter(has_text="Nothing was changed").wait_for()
    assert page.evaluate("rotorstab.last.values.own_rotor") == "two-disks"
    before = shown(page)["rotor-campbell"]
    page.evaluate("rotorstab.change('own_disk_mass', 3)")
    page.wait_for_function("rotorstab.last.values.own_disk_mass === 3")
    page.wait_for_function("location.search.includes('rmass=3')")
    assert shown(page)["rotor-campbell"] != before
    # only the sliders of this rotor are offered
    assert page.locator("#rs-own_spin").is_visible()
    assert not page.locator("#rs-shear").is_visible()
