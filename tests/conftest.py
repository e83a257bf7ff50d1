"""One server and one browser for all tests that look at the real page."""

from urllib.parse import urlsplit

import pytest
from hypothesis import HealthCheck, settings

from tests.browser import FLAGS, HELP, find_browser
from tests.serving import Server

# no test asserts a time, and machines of a CI are slow and shared
settings.register_profile("shared", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("shared")


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


class Watch:
    """What a page complains of, and the hosts it asks."""

    def __init__(self, page):
        self.complaints = []
        self.hosts = set()
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.complaints.append(f"page error: {error}"))
        page.on("requestfailed", self._failed)
        page.on("request", lambda request: self.hosts.add(urlsplit(request.url).netloc))

    def _console(self, message):
        if message.type == "error":
            where = message.location
            self.complaints.append(
                f"console: {message.text} ({where['url']}:{where['lineNumber']})"
            )

    def _failed(self, request):
        if request.failure != "net::ERR_ABORTED":  # a page that is left
            self.complaints.append(f"request: {request.url} {request.failure}")


@pytest.fixture
def open_page(browser, dashboard):
    """Open dashboard pages in contexts of their own; any complaint fails the test."""
    opened = []

    def open_one(width=1280, height=900, path="/app", **options):
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        context.set_default_timeout(20_000)
        page = context.new_page()
        opened.append((context, Watch(page)))
        page.goto(dashboard.origin + path)
        page.wait_for_function("window.rotorstab?.last && Bokeh.documents[0]?.is_idle")
        return page

    yield open_one
    for context, _ in opened:
        context.close()
    for _, watch in opened:
        assert watch.complaints == []
        assert watch.hosts - {""} == {urlsplit(dashboard.origin).netloc}


@pytest.fixture
def page(open_page):
    """The dashboard at 1280 px."""
    return open_page()
