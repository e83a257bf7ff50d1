"""Open the dashboard in a browser, and watch what its page complains of."""

from functools import partial
from urllib.parse import urlsplit

from app.state import State

PHONE = {"has_touch": True, "is_mobile": True, "device_scale_factor": 2}
BETWEEN_LOOKS = 30  # ms
READY = "window.rotorstab?.last && Bokeh.documents[0]?.is_idle"


class Watch:
    """What a page complains of, and the hosts that it asks."""

    def __init__(self, page):
        self.complaints = []
        self.hosts = set()
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.complaints.append(f"page error: {error.stack}"))
        page.on("requestfailed", self._failed)
        page.on("request", lambda request: self.hosts.add(urlsplit(request.url).netloc))

    def check(self, server):
        """Fail on any complaint since the last check, and on any request to another host."""
        complaints, self.complaints = self.complaints, []
        assert complaints == [], complaints
        assert self.hosts - {""} == {urlsplit(server.origin).netloc}

    def _console(self, message):
        if message.type == "error":
            where = message.location
            self.complaints.append(
                f"console: {message.text} ({where['url']}:{where['lineNumber']})"
            )

    def _failed(self, request):
        if request.failure != "net::ERR_ABORTED":  # the browser left the page
            self.complaints.append(f"request: {request.url} {request.failure}")


def open_dashboard(browser, server, width=1280, height=900, path="/app", **options):
    """Open the dashboard in a new context; return the context, the page and its `Watch`.

    The shaft stands still unless `reduced_motion` is "no-preference": without a graphics card, its
    frames take a large part of the processor from every other test.
    """
    options = {"reduced_motion": "reduce"} | options
    context = browser.new_context(viewport={"width": width, "height": height}, **options)
    context.set_default_timeout(20_000)
    page = context.new_page()
    # Playwright looks at every frame, and a page that draws all of them takes a fifth of a core
    page.wait_for_function = partial(page.wait_for_function, polling=BETWEEN_LOOKS)
    watch = Watch(page)
    page.goto(server.origin + path)
    page.wait_for_function(READY)
    return context, page, watch


def reset(page):
    """Bring a page that was used back to its start.

    Every input has its default, no curves are pinned, the theme is light, the shaft stands still,
    nothing has the focus, the browser keeps nothing, and Back leads nowhere.
    """
    # on a busy machine a page may be opening anew, because its server did not answer for a while
    page.wait_for_function(READY)
    protocol = page.context.new_cdp_session(page)
    protocol.send("Page.resetNavigationHistory")  # a browser counts no more than 50 entries
    protocol.detach()
    page.evaluate(
        """() => {
          let focused = document.activeElement;
          while (focused?.shadowRoot?.activeElement) focused = focused.shadowRoot.activeElement;
          focused?.blur();
          scrollTo(0, 0);
          for (const one of document.querySelectorAll("dialog[open]")) one.close();
          for (const one of document.querySelectorAll("[popover]:popover-open")) one.hidePopover();
          for (const one of document.querySelectorAll("aside details[open]")) one.open = false;
          localStorage.clear();  // answers to lessons, the chosen theme and sliders
          // a lesson goes on beside the charts until it is left
          if (rotorstab.lessons.running) document.querySelector('[data-lesson="close"]').click();
          location.hash = "explore";
          if (rotorstab.motion.state?.playing) document.querySelector(".shaft-play").click();
          const { theme } = document.documentElement.dataset;
          const button = document.querySelector("button.theme").textContent;
          if (theme === "dark" || button !== "Dark") rotorstab.setTheme("light");
          for (const { number } of rotorstab.last.pins?.names ?? []) {
            rotorstab.send({ type: "unpin", number });
          }
          rotorstab.last = {};
          rotorstab.send({ type: "reset" });
        }"""
    )
    # an answer to what was done before may still come
    page.wait_for_function(
        """(inputs) => {
          const { page, values, pins } = rotorstab.last;
          return page === "explore" && !pins && !rotorstab.lessons.running
            && Bokeh.documents[0].is_idle && rotorstab.messages.waited() === 0
            && Object.entries(inputs).every(([name, value]) => values?.[name] === value);
        }""",
        arg=State().inputs(),
    )
