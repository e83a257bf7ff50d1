"""A lesson's step in the address: links, Back, and what a step that asks does not give away."""

import pytest

from app.lessons import library

pytestmark = pytest.mark.browser
LESSON = library().lessons["07-damping"]
SPIN = LESSON.steps[3].before["spin_speed"]
SHOWN = "document.querySelector('[data-lesson=\"where\"]').textContent"


def at_step(page, number):
    page.wait_for_function(f"{SHOWN}.includes('step {number} of')")


def test_a_link_to_a_step_sets_it_up_or_keeps_the_senders_state(open_page):
    page = open_page(path="/app#lesson/07-damping/4")
    at_step(page, 4)
    page.wait_for_function(f"rotorstab.last.values.spin_speed === {SPIN}")
    other = open_page(path="/app?v=1&spin=1.5#lesson/07-damping/4")
    at_step(other, 4)
    assert other.evaluate("rotorstab.last.values.spin_speed") == 1.5


def test_a_step_beyond_the_last_is_the_last(open_page):
    page = open_page(path="/app#lesson/07-damping/99")
    at_step(page, len(LESSON.steps))
    page.wait_for_function(f"location.hash === '#lesson/07-damping/{len(LESSON.steps)}'")
    page.get_by_text("this is the last one").wait_for()


def test_back_goes_to_the_step_before_and_sliders_leave_no_entry(open_page):
    page = open_page(path="/app#lesson/07-damping/3")
    at_step(page, 3)
    entries = page.evaluate("history.length")
    page.evaluate("rotorstab.change('external_damping', 0.03)")
    page.wait_for_function("location.search.includes('0.03')")
    assert page.evaluate("history.length") == entries
    page.get_by_role("button", name="Next").click()
    at_step(page, 4)
    assert page.evaluate("history.length") == entries + 1
    # the menu says where one is
    assert page.locator("nav a[aria-current]").text_content() == "Lessons"
    page.go_back()
    at_step(page, 3)
    page.wait_for_function("location.hash === '#lesson/07-damping/3'")
    page.go_forward()
    at_step(page, 4)


def test_a_prediction_is_not_given_away_and_a_unit_is_no_wrong_answer(open_page):
    page = open_page(path="/app#lesson/01-parametric-resonance/1")
    at_step(page, 1)
    page.evaluate("rotorstab.change('show_growth', true)")
    page.wait_for_function("rotorstab.last.values.show_growth")
    assert page.locator("[data-verdict]").is_hidden()
    page.get_by_text("The verdict comes after your prediction.").wait_for()
    box = page.locator(".lesson-box")
    box.fill("2 ω_n")
    box.press("Enter")
    page.locator(".lesson-words.note", has_text="Write a number only").wait_for()
    assert page.locator("[data-verdict]").is_hidden()
    box.fill("2")
    box.press("Enter")
    page.locator(".lesson-words.right").wait_for()
    page.locator("[data-verdict]", has_text="1B+1F").wait_for()


def test_nothing_of_the_old_step_acts_while_the_new_one_is_under_way(open_page):
    page = open_page(path="/app#lesson/07-damping/3")
    at_step(page, 3)
    page.evaluate("rotorstab.send = () => {}")
    page.get_by_role("button", name="Next").click()
    assert page.locator(".lesson").get_attribute("aria-busy") == "true"
    assert page.locator('[data-lesson="form"]').evaluate("one => one.parentNode.inert")
    assert page.locator(".lesson-foot").evaluate("one => one.inert")
