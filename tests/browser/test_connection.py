"""Every way in which a page fails to reach its server: what it says, and when it opens anew.

The page's own scripts run in a browser with a socket, a server and a clock of the test, so that
each way costs a moment. `test_connection_served.py` has the main ones with the real page.
"""

from contextlib import suppress
from pathlib import Path

import pytest
from playwright.sync_api import Error

pytestmark = pytest.mark.browser

ASSETS = Path(__file__).parents[2] / "app" / "assets"
SITE = "http://stub.test"
SOCKET = """
  window.made = [];
  window.asked = 0;  // fetches without an answer yet
  const ask = window.fetch;
  window.fetch = (...given) => {
    asked += 1;
    const answer = ask(...given);
    const count = () => { asked -= 1; };
    answer.then(count, count);
    return answer;
  };
  window.WebSocket = class extends EventTarget {
    constructor() {
      super();
      made.push(this);
      if (window.accepts) setTimeout(() => this.happen("open", "message"));
    }
    close() {}
    happen(...names) {
      for (const name of names) {
        const event = new Event(name);
        this[`on${name}`]?.(event);
        this.dispatchEvent(event);
      }
    }
  };
"""
PAGE = """<!doctype html><html><head><script>%s</script><script>%s</script>%s</head><body>
<p class="lost" role="alert" hidden></p><script>%s</script>
<script>
  window.shown = []; window.sent = [];
  rotorstab.answer = () => {};
  window.connect = () => new WebSocket("ws://stub.test/app/ws", ["bokeh", "token"]);
  window.greet = () => {
    connect(); made[0].happen("open", "message");
    rotorstab.messages.attach((one) => sent.push(one), (one) => shown.push(one));
    rotorstab.messages.take({ seq: 1, values: {} });
  };
</script></body></html>"""


class Stub:
    """The page of the test: `status` is what its server answers, None where nobody is there."""

    def __init__(self, browser, files=()):
        self.context = browser.new_context()
        self.page = self.context.new_page()
        self.page.clock.install(time=0)
        self.page.clock.pause_at(1000)
        self.opened = 0
        self.status = 200
        self.files = {f"/static/{name}": answers for name, answers in files}
        self.pending = set()
        self.hanging = 0  # fetches that get no answer
        self.page.on("request", lambda request: self.pending.add(request))
        for ending in ("requestfinished", "requestfailed"):
            self.page.on(ending, lambda request: self.pending.discard(request))
        self.context.route("**/*", self.answer)
        self.visit("/app?v=1")

    def visit(self, path):
        self.page.goto(SITE + path, wait_until="commit")
        self.ready()

    def ready(self):
        """Wait for the page's scripts; it has no frames, so Playwright's own waiting never ends."""
        names = "window.rotorstab" if self.files else "window.greet"
        for _ in range(500):
            with suppress(Error):  # the page before it is still going
                if self.page.evaluate(f"Boolean({names}) && !rotorstab.left"):
                    return
            self.page.wait_for_timeout(5)
        raise AssertionError("the page did not come")

    def answer(self, route):
        path = route.request.url.removeprefix(SITE).partition("?")[0]
        if path in self.files:
            answers = self.files[path]
            status = answers.pop(0) if len(answers) > 1 else answers[0]
            if status == "hangs":
                self.pending.discard(route.request)
                self.hanging += route.request.resource_type == "fetch"
            else:
                route.fulfill(status=status, body="")
        elif route.request.method == "HEAD":
            if self.status is None:
                route.abort()
            else:
                route.fulfill(status=self.status)
        elif path == "/app":
            self.opened += 1
            self.hanging = 0
            tags = "".join(f'<script src="{one}"></script>' for one in self.files)
            texts = [(ASSETS / f"{name}.js").read_text() for name in ("connection", "messages")]
            body = PAGE % (SOCKET, texts[0], tags, texts[1])
            route.fulfill(body=body, content_type="text/html; charset=utf-8")
        else:
            route.fulfill(status=404)

    def wait(self, seconds):
        """Let that much of the page's time pass, with the answers that come meanwhile."""
        for _ in range(seconds):
            before = self.opened
            self.page.clock.run_for(1000)
            self.settle()
            if self.opened != before:
                self.ready()
                return

    def settle(self):
        """Wait in real time until every request has its answer, however busy the machine is.

        The page counts what it fetches, because a request is noticed here only later. A page that
        reloads is waited for until the new one is asked for.
        """
        before = self.opened
        for _ in range(2000):
            with suppress(Error):  # the page is going
                asked, left = self.page.evaluate("[asked, Boolean(rotorstab.left)]")
                if asked == self.hanging and not left and not self.pending:
                    return
            if self.opened != before:
                return
            self.page.wait_for_timeout(5)
        raise AssertionError(f"no answer: {[one.url for one in self.pending]}")

    def told(self):
        return self.page.evaluate(
            "[...document.querySelectorAll('.lost')].filter((one) => !one.hidden)"
            ".map((one) => one.textContent).join()"
        )


@pytest.fixture
def stub(browser):
    made = []

    def make(*args, **kwargs):
        made.append(Stub(browser, *args, **kwargs))
        return made[-1]

    yield make
    for one in made:
        one.context.unroute_all(behavior="ignoreErrors")
        one.context.close()


AGAIN = "sessionStorage.setItem('rotorstab-returns', 1);"
SOCKETS = {
    # what happens, what is said, whether one new page is tried at once, since its token is new
    "refused": ("connect(); made[0].happen('close')", "is refused", True),
    "token too old": ("connect(); made[0].happen('open', 'close')", "is refused", True),
    "refused again": (AGAIN + "connect(); made[0].happen('close')", "is refused", False),
    "hangs": ("connect()", "does not open", False),
    "never answers": ("connect(); made[0].happen('open')", "but no data arrives", False),
}


@pytest.mark.parametrize("way", SOCKETS)
def test_a_live_connection_that_does_not_come_is_told_and_tried(stub, way):
    happens, words, at_once = SOCKETS[way]
    stub = stub()
    stub.status = None
    stub.page.evaluate(happens)
    stub.wait(30)
    # the server may be gone altogether
    assert "The server does not answer" in stub.told()
    assert stub.opened == 1
    stub.status = 200
    stub.wait(20)
    if not at_once:
        # the page stays as it is until an attempt succeeds
        assert words in stub.told()
        assert "tries again by itself" in stub.told()
        assert stub.opened == 1
        stub.page.evaluate("window.accepts = true")
        stub.wait(30)
    assert stub.opened == 2


def test_a_refused_connection_is_told_before_the_server_was_asked(stub):
    stub = stub()
    stub.page.evaluate("connect(); made[0].happen('close')")
    stub.page.clock.run_for(350)
    assert "is refused" in stub.told()
    assert "WebSocket" in stub.told()


LONG = pytest.mark.long  # answers of a kind that another case has


@pytest.mark.parametrize(
    "status", [503, 429, *(pytest.param(one, marks=LONG) for one in (502, 504))]
)
def test_a_server_that_has_no_place_or_restarts_is_waited_for(stub, status):
    stub = stub()
    stub.page.evaluate("greet(); made[0].happen('close')")
    stub.status = status
    stub.wait(20)
    assert "The server does not answer" in stub.told()
    assert "with your settings" in stub.told()
    assert stub.opened == 1
    stub.status = 200
    stub.wait(20)
    assert stub.opened == 2


@pytest.mark.parametrize(
    "status", [302, 404, *(pytest.param(one, marks=LONG) for one in (403, 405, 421))]
)
def test_any_other_answer_is_shown_by_opening_anew(stub, status):
    stub = stub()
    stub.page.evaluate("greet(); made[0].happen('close')")
    stub.status = status
    stub.wait(10)
    assert stub.opened == 2


def test_a_device_without_a_network_is_told_so(stub):
    stub = stub()
    stub.page.evaluate("greet(); made[0].happen('close')")
    stub.context.set_offline(True)
    stub.status = None
    stub.wait(2)
    assert "no network" in stub.told()
    stub.context.set_offline(False)


def test_a_file_that_does_not_load_is_named_and_fetched_again(stub):
    stub = stub([("bokeh.min.js", [404, 404, 404, 200])])
    told = ""
    for _ in range(60):
        told = told or stub.told()
        if stub.opened > 1:
            break
        stub.wait(1)
    assert "could not be loaded: bokeh.min.js" in told
    # anew once the file is there
    assert stub.opened == 2
    assert stub.files["/static/bokeh.min.js"] == [200]


def test_a_file_that_does_not_arrive_is_told_while_it_holds_the_page_up(stub):
    stub = stub([("panel.min.js", ["hangs", "hangs", 200, 200])])
    stub.wait(14)
    assert "has not arrived yet" in stub.told()
    assert stub.opened == 1


def test_files_that_came_but_do_not_run_are_told(stub):
    stub = stub()
    stub.page.clock.run_for(12_300)
    assert "has not arrived yet" in stub.told()
    stub.wait(10)
    assert stub.opened == 2


def test_pages_that_come_back_in_vain_wait_longer_each_time(stub):
    waits = []
    stub = stub()
    for number in range(1, 6):
        stub.page.evaluate("connect(); made[0].happen('open', 'message', 'close')")
        waited = 0
        while stub.opened == number:
            stub.wait(1)
            waited += 1
        waits.append(waited)
    assert waits[-1] > 3 * waits[0]
    # an answer ends that
    stub.page.evaluate("greet()")
    assert stub.page.evaluate("sessionStorage.getItem('rotorstab-returns')") == "0"


# -- an open page whose messages are not answered ----------------------------------------------


def greeted(stub):
    stub = stub()
    stub.page.evaluate("greet()")
    return stub


def sent(stub):
    return stub.page.evaluate("sent.map(({ type, values, name }) => values ?? name ?? type)")


def test_a_page_at_rest_asks_whether_anybody_is_there_and_only_then(stub):
    stub = greeted(stub)
    stub.wait(4)
    assert sent(stub) == ["hello"]
    stub.wait(3)
    assert sent(stub) == ["hello", "ping"]
    stub.wait(4)  # while one is under way no other is sent
    assert sent(stub) == ["hello", "ping"]
    assert stub.told() == ""
    stub.wait(4)
    assert "The server does not answer at the moment" in stub.told()
    stub.page.evaluate("rotorstab.messages.take({ seq: 2 })")
    assert stub.told() == ""
    assert stub.opened == 1


def test_a_move_that_is_not_answered_is_told_kept_and_sent_on_return(stub):
    stub = greeted(stub)
    stub.page.evaluate("rotorstab.change('spin', 1)")
    stub.wait(1)
    stub.page.evaluate("rotorstab.change('spin', 2); rotorstab.change('shear', 0.1)")
    stub.wait(1)
    stub.page.evaluate("rotorstab.send({ type: 'export' }); rotorstab.send({ type: 'pin' })")
    stub.page.evaluate("rotorstab.change('spin', 3)")
    stub.status = None
    stub.wait(20)
    assert "What you set here is kept" in stub.told()
    assert stub.opened == 1
    stub.status = 200
    stub.wait(20)
    assert stub.opened == 2
    stub.page.evaluate("greet()")
    expected = [{"spin": 1}, {"spin": 2, "shear": 0.1}, "pin", {"spin": 3}, "settle"]
    assert sent(stub)[1:] == expected
    # once: another page of this tab begins without them
    stub.visit("/app?v=1")
    stub.page.evaluate("greet()")
    assert sent(stub) == ["hello"]


@pytest.mark.parametrize("address", ["/app?v=1", "/app?v=2"])
def test_what_was_kept_outlasts_a_second_return_and_is_not_for_another_address(stub, address):
    stub = greeted(stub)
    stub.page.evaluate("rotorstab.change('spin', 1)")
    stub.wait(1)
    for number in (1, 2):
        stub.page.evaluate("made[0].happen('close')")
        stub.wait(10)
        assert stub.opened == number + 1
        stub.page.evaluate("connect(); made[0].happen('open', 'message')")
    stub.visit(address)
    stub.page.evaluate("greet()")
    assert ({"spin": 1} in sent(stub)) == (address == "/app?v=1")


def test_a_device_that_slept_is_not_blamed_on_the_server(stub):
    stub = greeted(stub)
    stub.page.evaluate("rotorstab.change('spin', 1)")
    stub.page.clock.run_for(1000)
    stub.page.clock.fast_forward(3_600_000)
    stub.page.clock.run_for(1000)
    assert stub.told() == ""
    stub.wait(8)
    assert "does not answer" in stub.told()


LATE = {
    # messages after hello (1), the answer that comes, what is shown
    "moved again": (
        ["change('spin', 2.6)", "change('spin', 2.44)"],
        {"seq": 2, "values": {"spin": 2.6, "shear": 0}},
        {"spin": 2.44, "shear": 0},
    ),
    "sent by a button and moved": (
        ["send({ type: 'preset', name: 'paper' })", "change('spin', 2.44)"],
        {"seq": 2, "values": {"spin": 2, "shear": 0.1}},
        {"spin": 2.44, "shear": 0.1},
    ),
    "its own answer": (
        ["change('spin', 2.6)"],
        {"seq": 2, "values": {"spin": 2.5, "shear": 0}},
        {"spin": 2.5, "shear": 0},
    ),
    "a full picture of before": (
        ["change('spin', 2.6)"],
        {"values": {"spin": 1, "shear": 0}},
        None,
    ),
}


@pytest.mark.parametrize("case", LATE)
def test_a_late_answer_never_moves_what_was_moved_since(stub, case):
    steps, answer, expected = LATE[case]
    stub = greeted(stub)
    stub.page.evaluate("shown.length = 0")
    for step in steps:
        stub.page.evaluate(f"rotorstab.{step}")
    stub.page.evaluate("(answer) => rotorstab.messages.take(answer)", answer)
    assert stub.page.evaluate("shown.at(-1)?.values ?? null") == expected


def test_a_button_comes_after_the_moves_before_it(stub):
    stub = greeted(stub)
    stub.page.evaluate("rotorstab.change('spin', 1)")
    stub.page.evaluate("rotorstab.change('spin', 2); rotorstab.send({ type: 'reset' })")
    assert sent(stub)[1:] == [{"spin": 1}, {"spin": 2}, "reset"]
