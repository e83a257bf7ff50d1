"""One lesson in a browser, by keyboard: wrong answer, right answer, next, and a reload."""

import pytest

from app.lessons import library, solution
from tests.testing.page import visit

pytestmark = pytest.mark.browser
LESSON = library().lessons["04-gyroscope"]
RIGHT = solution(LESSON.steps[0])


def open_lesson(page):
    visit(page, "lessons")
    page.locator("h3 a", has_text=LESSON.title).focus()
    page.keyboard.press("Enter")
    page.locator(".lesson").wait_for(state="visible")


def answer(page, choice):
    page.locator(".lesson-choice input").nth(choice).focus()
    page.keyboard.press("Space")
    page.keyboard.press("Enter")


def heading(page):
    return page.locator('[data-lesson="heading"]')


def test_a_lesson_from_a_wrong_answer_to_a_reload(page):
    open_lesson(page)
    page.wait_for_function("document.activeElement.id === 'lesson-title'")
    heading(page).get_by_text(LESSON.steps[0].title).wait_for()
    for part in ("try-part", "see-part"):
        assert page.locator(f'[data-lesson="{part}"]').is_hidden()

    answer(page, (RIGHT + 1) % 3)
    page.locator(".lesson-words.hint").wait_for()
    assert page.locator('[data-lesson="try-part"]').is_visible()
    assert page.locator('[data-lesson="see-part"]').is_hidden()

    answer(page, RIGHT)
    page.locator(".lesson-words.right").wait_for()
    assert page.locator('[data-lesson="see-part"]').is_visible()

    page.get_by_role("button", name="Set it for me").press("Enter")
    page.wait_for_function("rotorstab.last.values.spin_speed === 1")
    slider = page.locator("#lesson-spin_speed")
    slider.press("ArrowRight")
    page.wait_for_function("Math.abs(rotorstab.last.values.spin_speed - 1.05) < 1e-9")

    page.get_by_role("button", name="Next").press("Enter")
    heading(page).get_by_text(LESSON.steps[1].title).wait_for()
    page.wait_for_function("document.activeElement.dataset.lesson === 'heading'")
    page.wait_for_function("rotorstab.last.values.spin_speed === 0")
    page.locator(".lesson-steps button.done").wait_for()

    # a slider moved by the student is not lost, nor is the place in the lesson
    page.evaluate("rotorstab.change('spin_speed', 1.5)")
    page.wait_for_function("location.search.includes('spin=1.5')")
    page.reload()
    heading(page).get_by_text(LESSON.steps[1].title).wait_for()
    assert page.evaluate("rotorstab.last.values.spin_speed") == 1.5
    assert page.locator(".lesson-steps button.done").count() == 1

    page.get_by_role("button", name="Leave the lesson").press("Enter")
    page.get_by_text(f"1 of {len(LESSON.steps)} steps done").wait_for()
    page.get_by_role("button", name="Clear my progress").press("Enter")
    page.get_by_text("steps done").wait_for(state="detached")
    assert page.evaluate("localStorage.getItem('rotorstab-lessons')") is None


@pytest.mark.parametrize(
    "stored",
    [
        "{",
        pytest.param("[7]", marks=pytest.mark.long),
        pytest.param('{"04-gyroscope": {"at": 99, "steps": 1}}', marks=pytest.mark.long),
    ],
)
def test_spoilt_progress_is_no_obstacle(page, stored):
    visit(page, "lessons")
    page.evaluate("text => localStorage.setItem('rotorstab-lessons', text)", stored)
    page.reload()
    page.wait_for_function("window.rotorstab?.last?.page === 'lessons'")
    page.locator("h3 a", has_text=LESSON.title).click()
    heading(page).get_by_text(LESSON.steps[0].title).wait_for()
    page.go_back()
    page.wait_for_function("rotorstab.last.page === 'lessons'")


@pytest.mark.parametrize(
    ("width", "theme"), [(390, "dark"), pytest.param(1280, "light", marks=pytest.mark.long)]
)
def test_the_list_and_a_lesson_have_no_accessibility_fault(page, width, theme):
    from axe_playwright_python.sync_playwright import Axe

    page.set_viewport_size({"width": width, "height": 900})
    page.evaluate("(theme) => rotorstab.setTheme(theme)", theme)
    visit(page, "lessons")
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
    page.locator("h3 a", has_text=LESSON.title).click()
    page.locator(".lesson").wait_for(state="visible")
    answer(page, (RIGHT + 1) % 3)
    page.locator(".lesson-words.hint").wait_for()
    answer(page, RIGHT)
    page.locator(".lesson-words.right").wait_for()
    found = Axe().run(page, context=".lesson")
    assert found.violations_count == 0, found.generate_report()
    # nothing wider than the screen
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
