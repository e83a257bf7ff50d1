"""The real page behind a network that is slow, deaf or without WebSockets."""

import pytest

from tests.testing.proxy import Proxy

pytestmark = [pytest.mark.browser, pytest.mark.long]


@pytest.fixture
def far(browser, dashboard):
    """A proxy in front of the dashboard, and a page that has not been opened yet."""
    with Proxy(dashboard) as proxy:
        context = browser.new_context(viewport={"width": 1366, "height": 768})
        context.set_default_timeout(90_000)
        yield proxy, context.new_page()
        context.close()


def spin(page):
    return page.get_by_role("slider", name="spin speed")


def opened(page):
    page.wait_for_function("window.rotorstab?.last?.at_rest && Bokeh.documents[0].is_idle")


@pytest.mark.parametrize(
    ("upgrade", "words"),
    [("strip", "is refused"), ("foreign", "is refused"), ("swallow", "does not open")],
)
def test_a_page_without_a_live_connection_says_so_and_comes_once_there_is_one(far, upgrade, words):
    proxy, page = far
    proxy.upgrade = upgrade
    page.goto(f"{proxy.origin}/app?v=1&spin=1.5")
    page.locator(".lost", has_text=words).wait_for(state="visible")
    if upgrade != "swallow":  # it came back once by itself for a new token
        page.wait_for_function("sessionStorage.getItem('rotorstab-returns') === '1'")
        page.locator(".lost", has_text=words).wait_for(state="visible")
    assert "Drawing" not in page.locator(".plot").first.evaluate(
        "(one) => getComputedStyle(one, '::before').content"
    )
    proxy.upgrade = "pass"
    opened(page)
    assert page.evaluate("rotorstab.last.values.spin_speed") == 1.5
    assert page.locator(".lost").is_hidden()


@pytest.mark.parametrize("returns", ["the same", "another"])
def test_moves_on_a_dead_connection_are_told_kept_and_applied(far, returns):
    """The network is gone and comes back; or the connection never does, as after a sleep."""
    proxy, page = far
    page.goto(f"{proxy.origin}/app?v=1&spin=1.5")
    opened(page)
    page.evaluate("window.same = true")
    if returns == "the same":
        proxy.held = True
    else:
        proxy.kill()
    spin(page).fill("2.24")
    page.evaluate("rotorstab.change('shear', 0.0444)")
    notice = page.locator(".lost", has_text="does not answer at the moment")
    notice.wait_for(state="visible")
    if returns == "the same":
        assert spin(page).input_value() == "2.24"
        spin(page).fill("2.5")
        proxy.held = False
    wanted = 2.5 if returns == "the same" else 2.24
    page.wait_for_function(
        "(spin) => rotorstab.last?.at_rest && rotorstab.last.values.spin_speed === spin"
        " && location.search.includes(`spin=${spin}`) && location.search.includes('phi=0.0444')",
        arg=wanted,
    )
    assert float(spin(page).input_value()) == wanted
    assert page.evaluate("window.same === true") == (returns == "the same")
    page.locator(".lost").wait_for(state="hidden")


def test_a_late_answer_never_moves_a_slider_that_was_moved_since(far):
    proxy, page = far
    page.goto(f"{proxy.origin}/app")
    opened(page)
    proxy.delay = 1.3
    spin(page).fill("2.6")
    spin(page).fill("2.44")
    seen = set()
    for _ in range(600):
        seen.add(spin(page).input_value())
        if page.evaluate("rotorstab.last.at_rest && location.search.includes('spin=2.44')"):
            break
        page.wait_for_timeout(100)
    assert seen == {"2.44"}
    assert page.evaluate("location.search.includes('spin=2.44')")
