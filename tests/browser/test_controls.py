"""The controls of the sidebar: what they send, and what they refuse.

`tests/app/test_session.py` moves every input to its charts; here is one control of each kind.
"""

import pytest

from app.state import PRESETS, State
from tests.testing.page import (
    CHOICES,
    SLIDERS,
    SWITCHES,
    agrees,
    box_of,
    drag,
    error_of,
    open_groups,
    settle,
    shown,
    wait_for_value,
)

pytestmark = pytest.mark.browser

HIDDEN_LAYERS = """() => Bokeh.documents[0].roots().flatMap((top) => [...top.references()])
  .filter((model) => model.type === 'GlyphRenderer' && !model.visible).length"""


def share_away_from_default(name):
    """Return a share of a slider's length at some distance from its default."""
    if name == "lowest_frequency":
        return 0.1  # below the highest
    low, high = State.param[name].bounds
    return 0.35 if (State.param[name].default - low) / (high - low) > 0.5 else 0.65


@pytest.mark.parametrize("name", ["spin_speed", "lowest_frequency"])
def test_a_dragged_slider_redraws_the_charts_as_the_solver_says(page, name):
    """One that moves all charts, and one that moves an axis of one chart."""
    open_groups(page)
    low, high = State.param[name].bounds
    share = share_away_from_default(name)
    before = shown(page)
    drag(page, name, share)
    values = agrees(page)
    assert values[name] == pytest.approx(low + share * (high - low), abs=0.05 * (high - low))
    assert float(box_of(page, name).input_value()) == pytest.approx(values[name])
    assert shown(page) != before


def test_every_slider_sets_its_own_input(page):
    open_groups(page)
    # the slider of the tangency is there for a partly follower load only
    assert not page.locator("#rs-tangency").is_visible()
    page.locator("input[name='rs-load_type'][value='partly']").check()
    wait_for_value(page, "load_type", "partly")
    values = page.evaluate("rotorstab.last.values")
    for name in SLIDERS:
        low, high = State.param[name].bounds
        wanted = low + share_away_from_default(name) * (high - low)
        page.locator(f"#rs-{name}").fill(str(wanted))
        value = float(box_of(page, name).input_value())  # snapped to the slider's step
        assert value == pytest.approx(wanted, abs=0.05 * (high - low))
        assert value != values[name]
        values[name] = value
        wait_for_value(page, name, value)
    found = settle(page)
    for name in ("marker_frequency", "marker_factor"):  # the marker follows the tongue
        values[name] = found[name]
    assert found == values


def test_every_choice_sets_its_own_input(page):
    open_groups(page)

    def choose(name, value):
        page.locator(f"input[name='rs-{name}'][value='{value}']").check()
        wait_for_value(page, name, value)

    for name in CHOICES:
        default = State.param[name].default
        others = [one for one in State.param[name].objects if one != default]
        for value in (*others, default):
            if (name, value) != ("reference", "flutter"):  # the default load has none
                choose(name, value)
    assert page.evaluate("rotorstab.last.values") == State().inputs()
    choose("load_type", "follower")
    choose("units", "SI")
    values = agrees(page)
    assert (values["load_type"], values["units"]) == ("follower", "SI")


def test_switches_hide_layers_and_show_them_again(page):
    open_groups(page)
    page.locator("#rs-show_disagreement").check()
    settle(page, "show_disagreement", True)
    page.wait_for_function(f"({HIDDEN_LAYERS})() === 0")
    for name in SWITCHES:
        page.locator(f"#rs-{name}").uncheck()
        settle(page, name, False)
        page.wait_for_function(f"({HIDDEN_LAYERS})() > 0")
        page.locator(f"#rs-{name}").check()
        settle(page, name, True)
        page.wait_for_function(f"({HIDDEN_LAYERS})() === 0")


def test_a_number_out_of_range_is_refused_at_the_control(page):
    before = shown(page)
    box, error = box_of(page, "spin_speed"), error_of(page, "spin_speed")
    for typed in ("99", "-1", "1e999", "NaN", "", "abc", "0x10000", "1e308"):
        box.fill(typed)
        box.press("Enter")
        error.filter(has_text="must be a number from 0 to 4").wait_for()
        assert box.get_attribute("aria-invalid") == "true"
        assert error.get_attribute("id") in box.get_attribute("aria-describedby")
        assert page.evaluate("rotorstab.last.values.spin_speed") == 2.0
        box.press("Escape")
        assert box.input_value() == "2.00"
        assert error.text_content() == ""
    assert shown(page) == before


def test_a_typed_number_is_taken(page):
    box, slider = box_of(page, "spin_speed"), page.locator("#rs-spin_speed")
    for typed, value in (("3.217", 3.217), (" 1,5 ", 1.5), ("0", 0.0), ("4", 4.0), ("1e-3", 1e-3)):
        box.fill(typed)
        box.press("Enter")
        wait_for_value(page, "spin_speed", value)
        assert float(box.input_value().replace(",", ".")) == pytest.approx(value)
        assert float(slider.input_value()) == pytest.approx(value)


def test_the_servers_refusal_is_shown_at_the_control(page):
    open_groups(page)
    box = box_of(page, "lowest_frequency")
    box.fill("20")
    box.press("Enter")
    words = error_of(page, "lowest_frequency")
    words.filter(has_text="Lowest frequency must be below the highest by 0.4 or more").wait_for()
    assert page.evaluate("rotorstab.last.values.lowest_frequency") == 0


def refuse(page, name, typed):
    """Type what is refused; return the box."""
    box = page.locator(f".box[aria-describedby~=rs-{name}-error]")
    box.fill(typed)
    box.press("Tab")
    error_of(page, name).filter(has_text="must be").wait_for()
    return box


REFUSED_BY = {
    "the server": ("lowest_frequency", "20"),
    "a slider's box": ("disk_mass", "abc"),
    "a quantity": ("shaft_length", "-1"),
}


def test_a_refusal_stays_when_answers_to_other_changes_come(page):
    open_groups(page)
    before = page.evaluate("rotorstab.last.values")
    boxes = {name: refuse(page, name, typed) for name, typed in REFUSED_BY.values()}
    for share in (0.3, 0.5):
        drag(page, "spin_speed", share)
        settle(page)
    for name, typed in REFUSED_BY.values():
        assert page.evaluate(f"rotorstab.last.values.{name}") == before[name]
        assert "must be" in error_of(page, name).text_content()
        assert boxes[name].input_value() == typed
        assert boxes[name].get_attribute("aria-invalid") == "true"
        if name != "shaft_length":
            assert float(page.locator(f"#rs-{name}").input_value()) == before[name]


@pytest.mark.parametrize("way", ["reset", "preset"])
def test_a_refusal_goes_with_values_that_replace_all(page, way):
    box = refuse(page, "disk_mass", "abc")
    if way == "reset":
        page.get_by_role("button", name="Reset all").click()
    else:
        page.locator("#rs-preset").select_option(index=1)
    error_of(page, "disk_mass").filter(has_not_text="must").wait_for(state="attached")
    assert float(box.input_value()) == page.evaluate("rotorstab.last.values.disk_mass")
    assert box.get_attribute("aria-invalid") is None


def test_presets_and_reset(page):
    for preset, changed in PRESETS.items():
        page.locator("#rs-preset").select_option(preset)
        for name, value in changed.items():
            wait_for_value(page, name, value)
    page.get_by_role("button", name="Reset all").click()
    for name, value in State().inputs().items():
        wait_for_value(page, name, value)
    assert agrees(page) == State().inputs()


def test_sustained_dragging_settles_on_the_last_value(page):
    page.evaluate(
        """async () => {
          const controls = [...Bokeh.index].find((view) => view.model.name === "controls");
          const slider = controls.shadow_el.querySelector("#rs-spin_speed");
          for (let step = 1; step <= 120; step += 1) {
            slider.value = 2 + Math.sin(step / 9) * 1.9;
            slider.dispatchEvent(new Event("input"));
            await new Promise((resolve) => { setTimeout(resolve, 1000 / 60); });
          }
          slider.value = 3.3;
          slider.dispatchEvent(new Event("input"));
        }"""
    )
    settle(page, "spin_speed", 3.3)
    agrees(page)


def test_in_si_the_sliders_themselves_are_in_si(page):
    page.locator("#rs-preset").select_option("Table 1, 1000 rpm")
    open_groups(page)
    page.locator("input[name='rs-units'][value='SI']").check()
    page.wait_for_function("rotorstab.last.si")
    box = box_of(page, "spin_speed")
    assert box.input_value() == "1000"
    row = page.locator(".row", has=page.locator("#rs-spin_speed"))
    assert row.locator(".unit").inner_text() == "rpm"
    assert page.locator("#rs-spin_speed").get_attribute("aria-valuetext") == "1000 rpm"
    before = page.evaluate("rotorstab.last.values.spin_speed")
    box.fill("1500")
    box.press("Enter")
    page.wait_for_function(
        "(value) => Math.abs(rotorstab.last.values.spin_speed - value) < 1e-9", arg=1.5 * before
    )
    # the steps of the slider are round in SI
    page.locator("#rs-spin_speed").press("ArrowRight")
    assert float(box.input_value()) % 10 == 0
    # the same value as is shown, rounded, changes nothing
    mass = page.evaluate("rotorstab.last.values.disk_mass")
    box_of(page, "disk_mass").press("Enter")
    settle(page)
    assert page.evaluate("rotorstab.last.values.disk_mass") == mass
    box.fill("99999")
    box.press("Enter")
    error_of(page, "spin_speed").filter(has_text="rpm").wait_for()
    page.locator("input[name='rs-units'][value='non-dimensional']").check()
    page.wait_for_function("rotorstab.last.si === null")
    assert row.locator(".unit").text_content() == ""
