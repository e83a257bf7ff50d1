"""What a link brings back, and what comes back after the server was gone."""

import os
import signal

import pytest

from app.lessons import library
from app.pages import PAGES
from tests.testing.serving import Server

pytestmark = pytest.mark.browser

LESSON = library().lessons["02-shear"]
MARKED = {"marker": True, "marker_frequency": 1.7, "marker_factor": 0.4, "spin_speed": 1.25}


def link(page):
    """The address as "Copy link" gives it, without its host."""
    return page.evaluate("location.pathname + location.search + location.hash")


def at_rest(page):
    page.wait_for_function("rotorstab.last?.at_rest && Bokeh.documents[0].is_idle")


def shown_pages(page):
    return page.evaluate(
        "[...document.querySelectorAll('[data-page]')].filter((one) => !one.hidden)"
        ".map((one) => one.dataset.page)"
    )


LONG = pytest.mark.long  # another address of a kind that one case has
NAMES = [one.key for one in PAGES[1:]]


@pytest.mark.parametrize(
    "name", [NAMES[0], *(pytest.param(name, marks=LONG) for name in NAMES[1:])]
)
def test_a_link_opens_on_its_page(open_page, name):
    page = open_page(path=f"/app?v=1&spin=1.125#{name}")
    page.wait_for_function("(name) => window.rotorstab?.last?.page === name", arg=name)
    assert shown_pages(page) == [name]
    assert page.locator("nav a[aria-current]").get_attribute("href") == f"#{name}"
    assert link(page).endswith(f"#{name}")
    assert page.evaluate("rotorstab.last.values.spin_speed") == 1.125


def test_a_link_opens_on_its_lesson_and_step_as_the_sender_left_it(page, open_page):
    page.evaluate("(key) => { location.hash = `lesson/${key}`; }", LESSON.key)
    heading = page.locator('[data-lesson="heading"]')
    heading.get_by_text(LESSON.steps[0].title).wait_for()
    page.wait_for_function(f"location.hash === '#lesson/{LESSON.key}/1'")
    page.get_by_role("button", name="Next").click()
    heading.get_by_text(LESSON.steps[1].title).wait_for()
    page.evaluate("rotorstab.change('shear', 0.0444)")
    page.wait_for_function("location.search.includes('phi=0.0444')")
    assert link(page).endswith(f"#lesson/{LESSON.key}/2")

    again = open_page(path=link(page))
    again.locator('[data-lesson="heading"]').get_by_text(LESSON.steps[1].title).wait_for()
    at_rest(again)
    assert shown_pages(again) == ["explore"]
    assert again.evaluate("rotorstab.last.values.shear") == 0.0444
    # a lesson without a step begins with its own settings, whatever the address says
    other = open_page(path=f"/app?phi=0.0444#lesson/{LESSON.key}")
    other.locator('[data-lesson="heading"]').get_by_text(LESSON.steps[0].title).wait_for()
    at_rest(other)
    wanted = LESSON.steps[0].before
    assert other.evaluate("rotorstab.last.values").items() >= wanted.items()


@pytest.mark.parametrize(
    "end", ["%3Cscript%3E", *(pytest.param(end, marks=LONG) for end in ("99", "1/2"))]
)
def test_a_senseless_step_opens_a_working_page(open_page, end):
    page = open_page(path=f"/app?spin=1.1#lesson/{LESSON.key}/{end}")
    page.wait_for_function("window.rotorstab?.last?.at_rest && Bokeh.documents[0].is_idle")
    assert shown_pages(page) == ["explore"]
    assert page.locator("script:text('<b>')").count() == 0


@pytest.mark.long
def test_a_page_that_lost_its_server_returns_with_state_pins_and_marker(browser, tmp_path):
    server = Server(tmp_path / "first.txt").wait()
    second = None
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.set_default_timeout(120_000)  # the first hit of a server is slow
    page = context.new_page()
    try:
        page.goto(f"{server.origin}/app")
        page.wait_for_function("window.rotorstab?.last")
        page.evaluate("rotorstab.send({ type: 'pin', label: 'before' })")
        page.wait_for_function("rotorstab.last.pins")
        page.evaluate("(all) => rotorstab.send({ type: 'change', values: all })", MARKED)
        page.evaluate("rotorstab.send({ type: 'settle' })")
        page.wait_for_function(
            "(all) => rotorstab.last.at_rest && rotorstab.last.inspector"
            " && Object.entries(all).every(([key, value]) => rotorstab.last.values[key] === value)",
            arg=MARKED,
        )
        page.evaluate("location.hash = 'explore'")
        at_rest(page)
        before = page.evaluate("rotorstab.last")
        os.killpg(server.process.pid, signal.SIGKILL)  # its own group: see Server
        server.process.wait(20)
        lost = page.locator(".lost")
        lost.wait_for(state="visible")
        assert "returns by itself" in lost.inner_text()
        page.evaluate("window.same = true")

        second = Server(tmp_path / "second.txt", port=server.port).wait()
        page.wait_for_function("!window.same && window.rotorstab?.last?.pins")
        at_rest(page)
        after = page.evaluate("rotorstab.last")
        for what in ("values", "query", "page"):
            assert after[what] == before[what], what
        for one in (before["pins"], after["pins"]):  # a share may be from the coarse map
            one["rows"] = [row for row in one["rows"] if not row[0].startswith("Unstable share")]
        assert after["pins"] == before["pins"]
        assert len(after["pins"]["rows"]) > 3
        assert after["inspector"]["sentence"] == before["inspector"]["sentence"]
        assert page.locator(".lost").is_hidden()
        page.get_by_role("button", name="Compare the settings").wait_for(state="visible")
        page.get_by_role("heading", name="The shaft in motion").wait_for(state="visible")
    finally:
        context.close()
        server.stop()
        if second:
            second.stop()
