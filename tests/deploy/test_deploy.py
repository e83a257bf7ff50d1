"""The shipped start script and hardening on a real server with a small throw-away app."""

import asyncio
import contextlib
import functools
import json
import os
import re
import subprocess
import sys
from types import SimpleNamespace
from urllib.parse import urlsplit

import pytest
from bokeh.util.token import get_token_payload
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.web import HTTPError
from tornado.websocket import websocket_connect

from deploy.patches import sessions
from tests.testing.serving import START, Server, run

APP = '''
import panel as pn

class Part(pn.custom.JSComponent):
    _esm = """export function render() {
        const part = document.createElement("p")
        part.innerText = "rendered here"
        return part
    }"""

if "fail" in pn.state.session_args:
    raise RuntimeError("a detail of the failure")
text = pn.widgets.TextInput(value=str(pn.state.location.query_params))
pn.Column(text, pn.pane.Markdown("throw-away"), Part(), pn.widgets.Button(name="press")).servable()
'''
LIMIT = 3


class TinyServer(Server):
    """A server of the throw-away app, with sockets to it."""

    def __init__(self, folder, limit):
        (folder / "module_that_exits.py").write_text("raise SystemExit(3)\n")
        app = folder / "tiny.py"
        app.write_text(APP)
        super().__init__(
            folder / "log.txt",
            app,
            origins=["lab.example"],
            PYTHONPATH=str(folder),
            ROTORSTAB_MAX_SESSIONS=str(limit),
        )

    def token(self, path="/tiny", **headers):
        status, _, page = self.get(path, **headers)
        assert status == 200
        return re.search(r'"token":"([^"]+)"', page)[1]

    @contextlib.asynccontextmanager
    async def connect(self, token, **headers):
        """An open socket, closed and drained at the end."""
        request = HTTPRequest(f"ws://127.0.0.1:{self.port}/tiny/ws", headers=headers)
        connection = await websocket_connect(request, subprotocols=["bokeh", token])
        try:
            yield connection
        finally:
            connection.close()
            while await asyncio.wait_for(connection.read_message(), 10) is not None:
                pass

    async def exchange(self, token, *parts, **headers):
        """Read the ACK's header, metadata and content, send a message, read its answer."""
        async with self.connect(token, **headers) as connection:
            first = [await asyncio.wait_for(connection.read_message(), 10) for _ in range(3)]
            for part in parts:
                await connection.write_message(part)
            answer = [await asyncio.wait_for(connection.read_message(), 10) for _ in parts]
        return first, answer

    def refusal(self, token, **headers):
        """Status with which the handshake is refused."""

        async def attempt():
            with pytest.raises(HTTPClientError) as refused:
                async with self.connect(token, **headers):
                    pass
            return refused.value.code

        return run(attempt())


@pytest.fixture(scope="module")
def servers(tmp_path_factory):
    started = [
        TinyServer(tmp_path_factory.mktemp("many"), 60),
        TinyServer(tmp_path_factory.mktemp("few"), LIMIT),
    ]
    try:
        for server in started:
            server.wait()
        yield started
    finally:
        for server in started:
            server.stop()


@pytest.fixture
def server(servers):
    return servers[0]


@pytest.fixture
def small_server(servers):
    return servers[1]


@pytest.fixture
def origin(server):
    return f"http://localhost:{server.port}"


@pytest.mark.parametrize(
    "path",
    [
        "/components/module_that_exits/Row/css/a.css",
        "/components/panel.layout/Row/_css/a.css",
        "/components/",
        "/tiny/autoload.js?bokeh-autoload-element=1",
        "/admin",
        "/rest/session_info",
    ],
)
def test_addresses_that_import_or_embed_are_not_there(server, path):
    assert server.get(path)[0] == 404
    assert server.get("/health")[0] == 200


@pytest.mark.parametrize("path", ["/tiny", "/health", "/nowhere", "/static/js/bokeh.min.js"])
def test_every_reply_carries_the_security_headers(server, path):
    headers = server.get(path)[1]
    policy = headers["Content-Security-Policy"]
    assert "default-src 'self'" in policy
    assert "frame-ancestors 'none'" in policy
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["Server"] is None


def test_the_page_names_no_other_host(server):
    page = server.get("/tiny?bokeh-absolute-url=http://other.example/tiny")[2]
    assert "other.example/static" not in page
    assert re.findall(r'(?:src|href)="(?:https?:)?//[^"]*"', page) == []


def test_the_token_holds_no_cookie_and_no_password_of_another_service(server):
    others = {"Cookie": "moodle=c00kie; rotorstab=ours", "Authorization": "Basic c2VjcmV0"}
    token = server.token(**others, **{"X-Api-Key": "k3y"})
    text = get_token_payload(token)
    assert text["cookies"] == {"rotorstab": "ours"}
    assert set(text["headers"]) == {"Host"}


@pytest.mark.parametrize(
    "path",
    [
        "/static/js/bokeh.min.js%00",
        "/static/%00",
        "/static/js/bokeh.js",
        "/static/js/lib/index.js",
        "/static/extensions/panel/bundled/theme/../../../../setup.py",
    ],
)
def test_a_file_that_the_page_does_not_use_is_not_there(server, path):
    before = server.log.read_text()
    assert server.get(path)[0] == 404
    assert "Traceback" not in server.log.read_text().removeprefix(before)
    assert server.get("/static/js/bokeh.min.js?v=1", method="HEAD")[0] == 200


def test_a_link_cannot_choose_the_session(server):
    status, _, page = server.get("/tiny?bokeh-session-id=chosen&bokeh-token=chosen")
    assert status == 200
    assert "token" in page


def test_root_redirects_to_the_app(server):
    status, headers, _ = server.get("/")
    assert (status, headers["Location"]) == (302, "./tiny")


def test_a_socket_of_a_listed_origin_opens_and_answers(server, origin):
    first, _ = run(server.exchange(server.token(), Origin=origin))
    assert '"ACK"' in first[0]


def test_a_socket_of_another_origin_is_refused(server):
    token = server.token()
    assert server.refusal(token, Origin="http://other.example") == 403
    # A host name that an attacker points at this server: Origin equals Host.
    same = {"Host": "other.example", "Origin": "http://other.example"}
    assert server.refusal(token, **same) == 421
    same["Sec-Fetch-Site"] = "same-origin"
    assert server.refusal(token, **same) == 421
    # and one that names a loopback host instead, which is always this server
    same["Host"] = "localhost:1"
    assert server.refusal(token, **same) == 403
    assert server.refusal(token, Host="lab.example", Origin="null") == 403


def test_a_socket_without_origin_is_refused(server):
    assert server.refusal(server.token()) == 403


@pytest.mark.parametrize("token", ["garbage", "e30", "e30.e30", "bnVsbA", "%00"])
def test_a_socket_with_a_false_token_is_refused(server, origin, token):
    assert server.refusal(token, Origin=origin) == 403


@pytest.mark.parametrize(
    "query",
    [
        "x=" + "9" * 5000,
        "x=" + "9" * 310,
        "x=%C2%B2",
        "x=NaN&y=-Infinity",
        "x=" + "[" * 3000,
        "x=1?y=2",
        "&" * 500,
        "x=%ff",
        "theme=%3Cimg%20onerror=alert(1)%3E",
    ],
)
def test_a_hostile_query_still_gets_the_page(server, query):
    status, _, page = server.get("/tiny?" + query)
    assert status == 200
    assert '"token":"' in page
    assert "<img onerror" not in page


def test_a_readable_query_value_beside_a_hostile_one_arrives(server, origin):
    token = server.token("/tiny?good=2.5&bad=" + "9" * 5000)
    pull = '{"msgid":"1","msgtype":"PULL-DOC-REQ"}', "{}", "{}"
    _, (_, _, text) = run(server.exchange(token, *pull, Origin=origin))
    assert "'good': 2.5" in text
    assert "9999'" not in text


def test_a_failing_app_answers_500_without_its_traceback(server):
    status, _, page = server.get("/tiny?fail=1")
    assert status == 500
    assert "Traceback" not in page
    assert "detail" not in page
    assert "a detail of the failure" in server.log.read_text()
    assert server.get("/tiny")[0] == 200


def test_an_error_reply_on_the_socket_has_no_traceback_and_a_short_log_line(server, origin):
    event = {"kind": "ModelChanged", "model": {"id": "none"}, "attr": "a" * 200_000, "new": 1}
    patch = '{"msgid":"1","msgtype":"PATCH-DOC"}', "{}", json.dumps({"events": [event]})
    _, (header, _, content) = run(server.exchange(server.token(), *patch, Origin=origin))
    assert '"ERROR"' in header
    assert "File " not in content
    assert "Traceback" not in content
    assert max(map(len, server.log.read_text().splitlines())) < 5000


def test_head_answers_without_building_a_page(server):
    for path in ("/tiny", "/health"):
        status, _, body = server.get(path, method="HEAD")
        assert (status, body) == (200, "")


def test_the_log_says_where_and_holds_no_secret(server):
    log = server.log.read_text()
    assert f"http://127.0.0.1:{server.port}/" in log
    assert "BOKEH_SECRET_KEY" not in log


def test_places_are_limited_for_pages_and_sockets(small_server):
    server = small_server
    origin = f"http://localhost:{server.port}"

    async def crowd():
        async with contextlib.AsyncExitStack() as stack:
            for _ in range(LIMIT - 1):
                token = await asyncio.to_thread(server.token)
                await stack.enter_async_context(server.connect(token, Origin=origin))
            late = await asyncio.to_thread(server.token)
            async with server.connect(token, Origin=origin):
                with pytest.raises(HTTPClientError, match="503"):
                    await stack.enter_async_context(server.connect(late, Origin=origin))
            for _ in range(50):
                try:
                    await stack.enter_async_context(server.connect(late, Origin=origin))
                    break
                except HTTPClientError:
                    await asyncio.sleep(0.1)
            else:
                pytest.fail("the place of a closed socket stayed taken")
            status, headers, page = await asyncio.to_thread(server.get, "/tiny")
            assert status == 503
            assert int(headers["Retry-After"]) > 0
            assert "places are taken" in page
            # neither /health nor HEAD builds a document
            assert (await asyncio.to_thread(server.get, "/health?endpoint=/tiny"))[0] == 200
            head = await asyncio.to_thread(functools.partial(server.get, "/tiny", method="HEAD"))
            assert head[0] == 200

    run(crowd())
    # a full class is no error of the server; operators watch the errors
    metrics = server.get("/metrics")[2]
    assert not re.search(r'rotorstab_errors_total{logger="tornado.access"} [1-9]', metrics)
    assert float(re.search(r"^rotorstab_refused_total (\S+)$", metrics, re.M)[1]) >= 2


def test_pages_that_never_connect_shut_nobody_out(small_server):
    """A monitor that asked for the page once occupied every place for a minute."""
    server = small_server
    origin = f"http://localhost:{server.port}"
    first = server.token()
    tokens = [server.token() for _ in range(4 * LIMIT)]
    held = re.search(r"^rotorstab_sessions (\S+)$", server.get("/metrics")[2], re.M)
    assert float(held[1]) <= LIMIT + 1

    async def crowd():
        async with contextlib.AsyncExitStack() as stack:
            # the first page gave way, and its browser connects all the same
            for token in (first, *tokens[1 - LIMIT :]):
                await stack.enter_async_context(server.connect(token, Origin=origin))

    run(crowd())


def test_messages_are_answered_between_two_pages_and_nothing_is_built_for_who_has_left(
    monkeypatch,
):
    """Twenty-five pages that were asked for at once delayed all messages until the last page."""
    order = []

    async def build(context, session_id, request=None, token=None):
        order.append("page")

    async def messages():
        while order.count("page") < 5:
            order.append("message")
            await asyncio.sleep(0)

    def request(closed):
        return SimpleNamespace(connection=SimpleNamespace(stream=SimpleNamespace(closed=closed)))

    async def crowd():
        monkeypatch.setattr(sessions, "building", asyncio.Lock())
        pages = [sessions.create_session(context, number) for number in range(5)]
        await asyncio.gather(*pages, messages())
        await sessions.create_session(context, "waits", request(lambda: False))
        with pytest.raises(HTTPError):
            await sessions.create_session(context, "left", request(lambda: True))

    context = SimpleNamespace(_sessions={}, _pending_sessions={})
    monkeypatch.setattr(sessions, "create_session_if_needed", build)
    run(crowd())
    assert "page page" not in " ".join(order[:-1])
    assert order.count("page") == 6


def test_a_page_that_never_connects_is_kept_for_a_quarter_of_a_minute(monkeypatch):
    """A page that was connected is kept as long as the setting says: its tab may come back."""

    async def nothing(self, linger):
        pass

    class Session:
        expiration_blocked = False

        def __init__(self, seconds, connections=0, **more):
            self.milliseconds_since_last_unsubscribe = 1000 * seconds
            self.connection_count = connections
            vars(self).update(more)

    class Context:
        def __init__(self, *held):
            self._sessions = dict(enumerate(held))
            self.gone = []

        async def _discard_session(self, session, allowed):
            assert allowed(session)
            self.gone.append(session)

    monkeypatch.setattr(sessions, "cleanup_sessions", nothing)
    late = Session(16)  # no page has connected to it for longer than a page takes
    context = Context(Session(14), late, Session(20, 1), Session(30, was_connected=True))
    run(sessions.cleanup(context, 60_000))
    assert context.gone == [late]


@pytest.mark.parametrize("value", ["0", "many", "-1"])
def test_a_senseless_limit_stops_the_start(value):
    setup = START.with_name("setup.py")
    done = subprocess.run(
        [sys.executable, setup],
        env=os.environ | {"ROTORSTAB_MAX_SESSIONS": value},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode != 0
    assert f"must be an integer from 1 to 10000, got '{value}'" in done.stderr


def test_a_short_key_stops_the_start():
    done = subprocess.run(
        ["sh", START],
        env=os.environ | {"BOKEH_SECRET_KEY": "short"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "at least 32 characters, got 5" in done.stderr


@pytest.mark.browser
def test_the_policy_blocks_nothing_that_the_page_needs(server, origin, browser):
    complaints, hosts = [], set()
    page = browser.new_page()
    page.on("console", lambda m: complaints.append(m.text) if m.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: hosts.add(urlsplit(request.url).netloc))
    page.goto(f"{origin}/tiny")
    page.get_by_text("rendered here").wait_for(timeout=30_000)
    page.get_by_role("button", name="press").wait_for(timeout=30_000)
    page.close()
    # what Panel sends about the browser on a page without our template is refused, without harm
    assert [one for one in complaints if "Unhandled ERROR reply" not in one] == []
    assert hosts - {""} == {f"localhost:{server.port}"}
