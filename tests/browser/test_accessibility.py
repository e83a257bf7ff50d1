"""Keyboard and screen reader: focus, tooltips, and what axe finds on every page."""

import pytest
from markupsafe import Markup

from app.lessons import library
from app.pages import PAGES
from app.state import State
from tests.testing.dashboard import READY
from tests.testing.page import (
    CHOICES,
    DEEPEST,
    FOCUS,
    NUMBERS,
    SLIDERS,
    SWITCHES,
    open_groups,
    serious_faults,
    settle,
    visit,
    wait_for_rest,
    wait_for_value,
)

pytestmark = pytest.mark.browser


def tab_through(page):
    """Press Tab until the focus has been all round; return what had it, in order."""
    page.evaluate("window.focused = new Set()")
    seen = []
    for _ in range(300):
        page.keyboard.press("Tab")
        again = page.evaluate(
            f"() => {{ {DEEPEST} const had = focused.has(element); focused.add(element);"
            " return had && element !== document.body; }"
        )
        if again:
            break
        seen.append(page.evaluate(FOCUS))
    return seen


def test_tab_reaches_every_control(page):
    open_groups(page)
    page.locator("input[name='rs-load_type'][value='partly']").check(force=True)
    page.locator("#rs-tangency").wait_for(state="visible")  # for a partly follower load
    seen = tab_through(page)
    wanted = [f"rs-{name}" for name in SLIDERS + SWITCHES]
    wanted += [f"rs-{name}:box" for name in NUMBERS]
    wanted += ["rs-preset", "Reset all", "Reset zoom", "Dark", "Skip to the charts"]
    assert [one for one in wanted if one not in seen] == []
    for name in CHOICES:
        assert any(one in (f"rs-{name}", f"rs-{name}-label") for one in seen), name


def test_the_keyboard_alone_changes_every_kind_of_control(page):
    open_groups(page)
    page.locator("#rs-spin_speed").focus()
    for key, value in [
        ("ArrowRight", 2.02),
        ("ArrowUp", 2.04),
        ("ArrowLeft", 2.02),
        ("PageUp", 2.22),
        ("PageDown", 2.02),
        ("End", 4.0),
        ("Home", 0.0),
    ]:
        page.keyboard.press(key)
        wait_for_value(page, "spin_speed", value)
    page.keyboard.press("Tab")
    page.keyboard.press("Control+a")
    page.keyboard.type("1.25")
    page.keyboard.press("Enter")
    wait_for_value(page, "spin_speed", 1.25)
    page.locator("input[name='rs-load_type'][value='axial']").focus()
    page.keyboard.press("ArrowLeft")
    wait_for_value(page, "load_type", "follower")
    page.locator("#rs-show_growth").focus()
    page.keyboard.press("Space")
    wait_for_value(page, "show_growth", False)
    page.locator("#rs-preset").focus()
    page.keyboard.type("Base")
    wait_for_value(page, "load_type", "axial")
    page.get_by_role("button", name="Reset all").focus()
    page.keyboard.press("Enter")
    wait_for_value(page, "show_growth", True)
    assert settle(page) == State().inputs()


@pytest.mark.parametrize("name", ["load_type", "shear"])
def test_tooltips_open_by_mouse_and_by_keyboard(page, name):
    text = page.locator(f"#rs-{name}-help")
    button = page.get_by_role("button", name=f"What is {State.param[name].label}?")
    assert not text.is_visible()
    button.hover()
    text.wait_for(state="visible")
    assert text.text_content() == f"{State.param[name].label} {State.param[name].doc}"
    page.mouse.move(900, 20)
    text.wait_for(state="hidden")
    button.focus()
    text.wait_for(state="visible")
    assert text.get_attribute("role") == "tooltip"


COLOURS = ["color-contrast", "link-in-text-block"]  # the rules that the theme matters for


def themed(page):
    """Go through both themes."""
    for theme in ("dark", "light"):
        page.evaluate("(theme) => { document.documentElement.dataset.theme = theme; }", theme)
        wait_for_rest(page)
        yield theme


def test_axe_finds_nothing_serious(page):
    open_groups(page)
    for name in [one.key for one in PAGES][::-1]:
        visit(page, name)
        for theme in themed(page):
            rules = COLOURS if theme == "dark" else None
            assert serious_faults(page, rules=rules) == [], (name, theme)


def test_axe_finds_nothing_serious_on_a_phone(page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.emulate_media(color_scheme="dark")
    page.reload()  # the system's theme is looked for once
    page.wait_for_function(READY)
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    wait_for_rest(page)
    assert serious_faults(page) == []
    page.emulate_media(color_scheme="light")
    page.evaluate("rotorstab.setTheme('light')")
    assert serious_faults(page, rules=COLOURS) == []


OPEN = "?v=1&at=1&f=1.68&b=0.5&u=SI&spin=99&p1=spin_1~~slow&p2=load_follower~~follower#explore"


@pytest.mark.parametrize("width", [1280, pytest.param(390, marks=pytest.mark.long)])
def test_axe_finds_nothing_serious_with_everything_open(open_page, width):
    page = open_page(width, 900, path=f"/app{OPEN}")
    page.set_default_timeout(60_000)
    page.get_by_role("heading", name="The shaft in motion").wait_for(state="visible")
    page.locator(".notice").get_by_text("Ignored in the address: spin").wait_for()
    for theme in themed(page):
        rules = COLOURS if theme == "dark" else None
        assert serious_faults(page, rules=rules) == [], theme
    page.locator("details.share-menu summary").click()
    page.get_by_role("button", name="As Python").click()
    page.locator("dialog.code").wait_for(state="visible")
    for theme in themed(page):
        rules = COLOURS if theme == "dark" else None
        assert serious_faults(page, "dialog.code", rules) == [], theme


@pytest.mark.long
def test_axe_finds_nothing_serious_in_any_lesson(open_page):
    page = open_page(path="/app#lessons")
    for number, (key, lesson) in enumerate(library().lessons.items()):
        page.evaluate("(key) => { location.hash = `lesson/${key}`; }", key)
        heading = page.locator('[data-lesson="heading"]')
        heading.get_by_text(Markup(lesson.steps[0].title).striptags()).wait_for()
        # they share one layout: each theme on every other lesson
        theme = ("dark", "light")[number % 2]
        page.evaluate("(theme) => { document.documentElement.dataset.theme = theme; }", theme)
        assert serious_faults(page, ".lesson") == [], (key, theme)
