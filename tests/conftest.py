"""One server and one browser for all tests that look at the real page."""

import os
from collections import Counter

import pytest
from hypothesis import HealthCheck, settings

from tests.testing import paper
from tests.testing.browser import FLAGS, HELP, find_browser
from tests.testing.dashboard import PHONE, open_dashboard, reset
from tests.testing.page import show_chart, wait_for_rest
from tests.testing.serving import Server

# no test asserts a time, and machines of a CI are slow and shared
settings.register_profile("shared", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("shared")


def pytest_collection_modifyitems(items):
    """Put the tests with a browser first.

    pytest-xdist gives each worker a block of tests. So one worker has them all, with one server and
    one browser, and the other takes over what remains of that worker's block.
    """
    pages = Counter(item.path for item in items if "browser" in getattr(item, "fixturenames", ()))
    items.sort(key=lambda item: -pages[item.path])


@pytest.fixture(scope="session", autouse=True)
def _folder_of_the_run(tmp_path_factory):
    """A folder that all processes of this run have in common, for results that take seconds."""
    own = tmp_path_factory.getbasetemp()
    paper.folder = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


@pytest.fixture(scope="module")
def shared_paper():
    """Figures and conclusions with Floquet are computed once in this run, whoever asks for them."""
    with pytest.MonkeyPatch.context() as patch:
        paper.share(patch)
        yield


@pytest.fixture(scope="session")
def dashboard(tmp_path_factory):
    """The dashboard, served by the shipped start script; each page's first hit is slow."""
    server = Server(tmp_path_factory.mktemp("dashboard") / "log.txt")
    try:
        server.wait().get("/app")
        yield server
    finally:
        server.stop()


@pytest.fixture(scope="session")
def browser():
    """A Chromium; its absence is a failure, `-m "not browser"` leaves these tests out."""
    from playwright.sync_api import sync_playwright

    path = find_browser()
    if path is None:
        pytest.fail(HELP, pytrace=False)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture
def open_page(browser, dashboard):
    """Open dashboard pages; any complaint of theirs fails the test."""
    contexts, watches = [], []

    def open_one(*size, **options):
        context, page, watch = open_dashboard(browser, dashboard, *size, **options)
        contexts.append(context)
        watches.append(watch)
        return page

    yield open_one
    for context in contexts:
        context.close()
    for watch in watches:
        watch.check(dashboard)


@pytest.fixture(scope="session")
def kept_page(browser, dashboard):
    """One page for all tests that need no fresh one: opening it takes seconds."""
    context, page, watch = open_dashboard(browser, dashboard)
    yield page, watch
    context.close()


@pytest.fixture
def page(kept_page, dashboard):
    """The dashboard at 1280 px with every input at its default."""
    page, watch = kept_page
    page.set_viewport_size({"width": 1280, "height": 900})
    # a test that failed may have left another medium
    page.emulate_media(media="screen", forced_colors="none", reduced_motion="reduce")
    reset(page)
    yield page
    watch.check(dashboard)


@pytest.fixture(scope="session")
def kept_phone(browser, dashboard):
    """One page at 390 px with touch for all tests of phones."""
    context, page, watch = open_dashboard(browser, dashboard, 390, 844, **PHONE)
    page.touches = context.new_cdp_session(page)
    yield page, watch
    context.close()


@pytest.fixture
def phone(kept_phone, dashboard):
    """The page at 390 px with touch and with every input at its default."""
    page, watch = kept_phone
    reset(page)
    # the full picture's sentence is longer, and what stands below it moves
    page.evaluate("rotorstab.send({ type: 'settle' })")
    page.wait_for_function("rotorstab.last.settled && Bokeh.documents[0].is_idle")
    wait_for_rest(page)
    page.evaluate("scrollTo(0, 0)")
    show_chart(page, "instability")
    yield page
    watch.check(dashboard)
