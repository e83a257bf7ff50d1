"""Undo, redo, and the browser's Back and Forward through the settings."""

import pytest

from tests.testing.page import box_of, drag, open_groups, settle, wait_for_address, wait_for_value

pytestmark = pytest.mark.browser


def type_in(page, name, text):
    box_of(page, name).fill(text)
    box_of(page, name).press("Enter")
    settle(page, name, float(text))


def test_undo_and_redo_step_through_the_settings(open_page):
    page = open_page()  # without earlier steps
    settle(page)
    undo = page.get_by_role("button", name="Undo")
    redo = page.get_by_role("button", name="Redo")
    assert undo.is_disabled()
    assert redo.is_disabled()
    type_in(page, "spin_speed", "1.5")
    type_in(page, "disk_mass", "9")
    undo.click()
    settle(page, "disk_mass", 5.0)
    assert page.evaluate("rotorstab.last.values.spin_speed") == 1.5
    wait_for_address(page, "md=5&")
    undo.click()
    settle(page, "spin_speed", 2.0)
    assert undo.is_disabled()
    redo.click()
    settle(page, "spin_speed", 1.5)
    assert redo.is_enabled()
    # a new change ends what can be redone
    type_in(page, "shear", "0.05")
    assert redo.is_disabled()


def test_a_drag_is_one_step_however_long_it_rests(page):
    entries = page.evaluate("history.length")
    slider = page.locator("#rs-spin_speed")
    place = slider.bounding_box()
    y = place["y"] + place["height"] / 2
    page.mouse.move(place["x"] + place["width"] / 2, y)
    page.mouse.down()
    for share in (0.6, 0.7, 0.8):
        page.mouse.move(place["x"] + share * place["width"], y, steps=3)
        page.wait_for_function("rotorstab.last.at_rest")
        page.wait_for_timeout(400)
    page.mouse.up()
    settle(page)
    assert page.evaluate("rotorstab.last.values.spin_speed") > 2.8
    assert page.evaluate("history.length") == entries + 1
    page.get_by_role("button", name="Undo").click()
    settle(page, "spin_speed", 2.0)


def test_back_and_forward_of_the_browser_step_too(page):
    drag(page, "static_load_factor", 0.3)
    value = settle(page)["static_load_factor"]
    drag(page, "shear", 0.7)
    settle(page)
    page.go_back()
    wait_for_value(page, "shear", 0.0192)
    page.go_back()
    wait_for_value(page, "static_load_factor", 0.5)
    page.go_forward()
    wait_for_value(page, "static_load_factor", value)


def test_the_keys_undo_unless_a_text_is_typed(page):
    open_groups(page)
    page.locator("#rs-show_bolotin").uncheck()
    settle(page, "show_bolotin", False)
    page.keyboard.press("Control+z")
    settle(page, "show_bolotin", True)
    page.keyboard.press("Control+Shift+Z")
    settle(page, "show_bolotin", False)
    box_of(page, "spin_speed").focus()
    page.keyboard.press("Control+z")
    page.wait_for_timeout(300)
    assert page.evaluate("rotorstab.last.values.show_bolotin") is False


def test_undo_returns_from_a_preset_and_from_reset(page):
    page.locator("#rs-preset").select_option("Table 1, at rest")
    settle(page, "spin_speed", 0.0)
    page.get_by_role("button", name="Reset all").click()
    settle(page, "spin_speed", 2.0)
    page.get_by_role("button", name="Undo").click()
    settle(page, "spin_speed", 0.0)
    page.get_by_role("button", name="Undo").click()
    settle(page, "spin_speed", 2.0)
