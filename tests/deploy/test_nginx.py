"""The real nginx in front of real workers on loopback, started by the shipped launcher."""

import asyncio
import contextlib
import http.client
import http.server
import json
import os
import random
import re
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import urljoin

import pytest
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.queues import QueueEmpty
from tornado.websocket import websocket_connect

from deploy import lab as lab_module
from deploy import nginx_log
from deploy.constants import HEADERS, LONGEST_ADDRESS
from deploy.nginx import command, find_nginx, write
from deploy.processes import keep_running
from deploy.settings import read
from tests.testing.dashboard import open_dashboard
from tests.testing.serving import START, Server, ended, free_port, run

APP = """
import os, signal
import panel as pn
if "die" in pn.state.session_args:
    os.kill(os.getpid(), signal.SIGKILL)
pn.pane.Markdown("throw-away").servable()
"""
LAB = ("-m", "deploy.lab")
APP_FOLDER = START.parents[1] / "app"
PLACES = 14  # of a worker
PAGES = 22
PATIENCE = 60  # s; nothing is measured by it
COOKIE = re.compile(r"rotorstab=([0-9a-f]{32}); Path=/; HttpOnly; SameSite=Lax")

pytestmark = pytest.mark.skipif(
    find_nginx() is None and not os.environ.get("CI"),
    reason="nginx is not installed (Debian and Ubuntu: apt-get install nginx-light)",
)


def worker_ports():
    """Two free ports, one after the other, which no outgoing connection is given meanwhile."""
    while True:
        first = random.randrange(20_000, 32_000)
        with contextlib.suppress(OSError):
            for port in (first, first + 1):
                http_free(port)
            return first, first + 1


def http_free(port):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", port))


class Lab(Server):
    """nginx and two workers of a throw-away app."""

    def __init__(self, folder, app=None, stderr=None, origins=(), **environment):
        if app is None:
            app = folder / "app.py"
            app.write_text(APP)
        self.ports = worker_ports()
        # nginx of root reads it as another user, who may not look into pytest's folders
        self.temporary = Path(tempfile.mkdtemp(prefix="rotorstab test "))
        self.temporary.chmod(0o755)
        super().__init__(
            folder / "log.txt",
            command=[sys.executable, *LAB, app],
            origins=["lab.example", *origins],
            ROTORSTAB_WORKERS="2",
            ROTORSTAB_WORKER_PORT=str(self.ports[0]),
            ROTORSTAB_MAX_SESSIONS=str(PLACES),
            ROTORSTAB_UNUSED_LIFETIME="5",
            ROTORSTAB_LOG_FORMAT="json",
            TMPDIR=str(self.temporary),
            stderr=stderr,
            **environment,
        )

    def wait(self):
        """Return once both workers serve."""
        for port in self.ports:
            self.wait_for(lambda port=port: self.worker(port, "/health")[0] == 200)
        return self

    def stop(self):
        super().stop()
        shutil.rmtree(self.temporary, ignore_errors=True)

    def wait_for(self, condition):
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline and self.process.poll() is None:
            with contextlib.suppress(OSError, http.client.HTTPException):
                if condition():
                    return
            time.sleep(0.1)
        pytest.fail("it did not happen:\n" + self.log.read_text())

    def worker(self, port, path):
        """Status and text of a worker's own answer."""
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
        with contextlib.closing(connection):
            connection.request("GET", path)
            reply = connection.getresponse()
            return reply.status, reply.read().decode()

    def counts(self, name):
        """A gauge of each worker."""
        pattern = re.compile(rf"^rotorstab_{name} (\S+)$", re.M)
        return [float(pattern.search(self.worker(port, "/metrics")[1])[1]) for port in self.ports]

    def cached(self):
        """Sizes of the files that nginx keeps."""
        return [one.stat().st_size for one in self.temporary.glob("*/cache/*") if one.is_file()]

    def process_of(self, name):
        """The id of the process that the launcher started last by that name."""
        found = re.findall(rf"started {name}: process (\d+)", self.log.read_text())
        return int(found[-1])

    def processes(self):
        return [int(one) for one in re.findall(r"process (\d+)\"", self.log.read_text())]

    def page(self, cookie=None):
        """(cookie, token) of a page."""
        status, headers, page = self.get("/app", **({"Cookie": cookie} if cookie else {}))
        assert status == 200
        if cookie is None:
            cookie = f"rotorstab={COOKIE.fullmatch(headers['Set-Cookie'])[1]}"
        return cookie, re.search(r'"token":"([^"]+)"', page)[1]

    async def connect(self, cookie, token):
        """A socket that the server has acknowledged."""
        request = HTTPRequest(
            f"ws://localhost:{self.port}/app/ws",
            headers={"Origin": self.origin, "Cookie": cookie},
            request_timeout=PATIENCE,
        )
        connection = await websocket_connect(request, subprotocols=["bokeh", token])
        assert "ACK" in await next_fragment(connection)
        for _ in range(2):
            await next_fragment(connection)
        return connection

    @contextlib.asynccontextmanager
    async def class_of(self, number):
        """Open so many pages and their sockets, or more until no worker is without one.

        Gives (cookie, socket) of each; closed at the end.
        """
        self.wait_for(lambda: not any(self.counts("sessions")))
        members = []
        try:
            while len(members) < number or 0.0 in self.counts("sessions"):
                cookie, token = await asyncio.to_thread(self.page)
                members.append((cookie, await self.connect(cookie, token)))
            yield members
        finally:
            await shut(*(connection for _, connection in members))


async def next_fragment(connection):
    return await asyncio.wait_for(connection.read_message(), PATIENCE)


async def shut(*connections):
    """Close sockets and wait for the other side's part."""
    open_ones = [(one, one.protocol.stream) for one in connections if one.protocol is not None]
    for connection, _ in open_ones:
        connection.close()
    for connection, stream in open_ones:
        while not stream.closed():
            with contextlib.suppress(QueueEmpty):  # a message that nobody read holds up the rest
                connection.read_queue.get_nowait()
            await asyncio.sleep(0.02)


async def answers(connection):
    """Whether a socket still answers a question."""
    for part in ('{"msgid":"1","msgtype":"PULL-DOC-REQ"}', "{}", "{}"):
        await connection.write_message(part)
    header = await next_fragment(connection)
    if header is None:
        return False
    for _ in range(2):
        await next_fragment(connection)
    return "PULL-DOC-REPLY" in header


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    lab = Lab(tmp_path_factory.mktemp("lab"))
    try:
        # nginx is there long before the workers: it says that the server restarts
        lab.wait_for(lambda: lab.get("/app"))
        yield lab.wait()
    finally:
        lab.stop()


def test_only_the_page_its_socket_and_its_files_are_reached(lab):
    assert lab.get("/app", method="HEAD")[0] == 200
    assert lab.get("/")[1]["Location"] == "/app"
    assert lab.get("/static/js/bokeh.min.js?v=1")[0] == 200
    assert lab.get("/favicon.ico", method="HEAD")[0] == 200
    for path in (
        "/metrics",
        "/health",
        "/app/metadata",
        "/app/autoload.js",
        "/components/panel.layout/Row/_css/a.css",
        "/static/%2e%2e/metrics",
        "/static/js/bokeh.js",
        "/static/js/lib/client/connection.js",
        "/static/extensions/panel/panel.js",
        "/static/../metrics",
        "/static/..%2fmetrics",
        "/static//../metrics",
        "/admin",
        "/app/x",
        "/_errors/full.html",
    ):
        status, headers, page = lab.get(path)
        assert (path, status) == (path, 404)
        assert headers["X-Frame-Options"] == "DENY"
        assert headers["Content-Security-Policy"]
        assert "nginx" not in page


def test_a_file_is_cached_once_whatever_version_is_asked_for(lab):
    """And HEAD fetches no file: 300 of them with their own versions once filled the disk."""
    path = "/static/extensions/panel/panel.min.js"
    assert lab.get(path)[0] == 200
    before = lab.cached()
    for number in range(100):
        assert lab.get(f"{path}?v={number}", method="HEAD")[0] == 200
        assert lab.get(f"{path}?{number}", method="HEAD")[0] == 200
        assert lab.get(f"/favicon.ico?{number}", method="HEAD")[0] == 200
    for number in range(5):
        assert lab.get(f"{path}?v={number}")[0] == 200
    after = lab.cached()
    assert len(after) <= len(before) + 2  # the answer to HEAD, which is empty, and the icon
    assert sum(after) < sum(before) + 100_000


def test_who_asks_for_pages_too_fast_is_told_so_and_not_that_all_places_are_taken(lab):
    with ThreadPoolExecutor(30) as many:
        replies = list(many.map(lambda _: lab.get("/app", method="HEAD"), range(4 * 2 * PLACES)))
    assert {status for status, _, _ in replies} == {200, 429}
    assert {headers["Retry-After"] for status, headers, _ in replies if status == 429} == {"5"}


def test_an_address_of_100_kB_gets_the_page_and_a_longer_one_words(lab):
    status, headers, page = lab.get("/app?x=" + "1" * 100_000)
    assert status == 200
    cookie = headers["Set-Cookie"].partition(";")[0]
    token = re.search(r'"token":"([^"]+)"', page)[1]
    assert len(token) < 8_000  # a header of the socket's request

    async def attempt():
        await shut(await lab.connect(cookie, token))

    run(attempt())
    most = LONGEST_ADDRESS - len("/app?x=")
    assert lab.get("/app?x=" + "1" * most)[0] == 200
    for more in (1, 10_000, 300_000):  # the worker's answer, and nginx's own
        status, headers, page = lab.get("/app?x=" + "1" * (most + more))
        assert status == 414
        assert '<a href="/app">' in page
        assert str(LONGEST_ADDRESS) in page
        assert headers["Content-Security-Policy"]


LINE = b"GET /app HTTP/1.1\r\nHost: localhost\r\n"


@pytest.mark.parametrize(
    ("request_", "status"),
    [
        (b"GET /app%zz HTTP/1.1\r\n\r\n", 400),
        (b"nonsense\r\n\r\n", 400),
        (b"GET /app HTTP/1.1\r\n\r\n", 400),  # no host
        (LINE + b"Host: localhost\r\n\r\n", 400),
        (b"GET /\0 HTTP/1.1\r\nHost: localhost\r\n\r\n", 400),
        (b"GET /a HTTP/1.1\r\nHost: localhost\r\n\r\n", 404),
        (b"POST /app HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n", 405),
        (LINE + b"Content-Length: 99999\r\n\r\n", 413),
        (b"GET /" + b"a" * 140_000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n", 414),
        (LINE + b"Cookie: " + b"a" * 140_000 + b"\r\n\r\n", 431),
        (LINE + b"Transfer-Encoding: rot13\r\n\r\n", 501),
        (b"GET /app HTTP/7.1\r\nHost: localhost\r\n\r\n", 505),
    ],
)
def test_what_nginx_answers_by_itself_is_our_page(lab, request_, status):
    """Also where a request is so broken that it belongs to no server yet."""
    with socket.create_connection(("127.0.0.1", lab.port), timeout=PATIENCE) as client:
        client.sendall(request_)
        reply = http.client.HTTPResponse(client)
        reply.begin()
        page = reply.read().decode()
    assert reply.status == status
    assert page.startswith("<!doctype html>")
    assert "rotorstab" in page
    assert "nginx" not in page
    assert re.fullmatch("nginx|", reply.headers.get("Server", ""))  # no version
    for name in HEADERS:
        assert reply.headers[name]
    assert reply.headers["Cache-Control"] == "no-store"


def test_the_redirect_has_the_headers_too_and_keeps_the_query(lab):
    for path in ("/", "/app/"):
        status, headers, _ = lab.get(f"{path}?spin=1")
        assert status == 302
        assert headers["Location"] == "/app?spin=1"
        assert headers["X-Frame-Options"] == "DENY"
        assert headers["Strict-Transport-Security"] is None


@pytest.mark.long
@pytest.mark.browser
def test_a_browser_opens_an_address_of_100_kB(browser, tmp_path):
    """The real page: it names what it ignores, keeps what is good, and can be used."""
    lab = Lab(tmp_path, app=APP_FOLDER)
    try:
        lab.wait()
        path = f"/app?v=1&spin=1.5&as={'9' * 50_000}&x={'1' * 50_000}&phi=0.03"
        context, page, watch = open_dashboard(browser, lab, path=path)
        notice = page.evaluate("rotorstab.last.address_notice")
        assert "as (" in notice
        assert "x" in notice
        page.get_by_text(notice).first.wait_for()
        assert page.evaluate("rotorstab.last.values.spin_speed") == 1.5
        assert page.evaluate("rotorstab.last.values.shear") == 0.03
        page.evaluate("rotorstab.change('shear', 0.01)")
        page.wait_for_function("location.search.includes('phi=0.01')")
        assert page.evaluate("location.search.length") < 1000
        context.close()
        watch.check(lab)
    finally:
        lab.stop()


def test_a_worker_tells_its_numbers_to_this_machine_only(lab):
    for port in lab.ports:
        assert lab.worker(port, "/metrics")[0] == 200


def test_another_host_is_closed_without_a_word(lab):
    with pytest.raises(ConnectionResetError):
        lab.get("/app", Host="other.example")
    # the sockets too, and the origin is checked by the worker besides
    cookie, token = lab.page()
    headers = {"Origin": "http://other.example", "Cookie": cookie}
    request = HTTPRequest(f"ws://localhost:{lab.port}/app/ws", headers=headers)

    async def attempt():
        with pytest.raises(HTTPClientError, match="403"):
            await websocket_connect(request, subprotocols=["bokeh", token])

    run(attempt())


def test_a_listed_name_without_a_port_is_served(lab):
    """As on port 80 or 443, where the address line shows none."""
    named = {"Host": "lab.example"}
    status, headers, page = lab.get("/app", **named)
    assert status == 200
    token = re.search(r'"token":"([^"]+)"', page)[1]
    named |= {"Origin": "http://lab.example", "Cookie": headers["Set-Cookie"].partition(";")[0]}
    request = HTTPRequest(f"ws://localhost:{lab.port}/app/ws", headers=named)

    async def attempt():
        connection = await websocket_connect(request, subprotocols=["bokeh", token])
        assert "ACK" in await next_fragment(connection)
        await shut(connection)

    run(attempt())


def test_the_cookie_is_nginxs_own(lab):
    forged = "rotorstab=' onerror=alert(1)"
    headers = lab.get("/app", Cookie=forged)[1]
    assert COOKIE.fullmatch(headers["Set-Cookie"])
    assert lab.get("/app", Cookie="rotorstab=" + "a" * 32)[1]["Set-Cookie"] is None


def test_large_files_are_compressed(lab):
    path = "/static/js/bokeh.min.js"
    connection = http.client.HTTPConnection("127.0.0.1", lab.port, timeout=10)
    with contextlib.closing(connection):
        connection.request("GET", path, headers={"Accept-Encoding": "gzip"})
        reply = connection.getresponse()
        assert reply.headers["Content-Encoding"] == "gzip"
        assert len(reply.read()) < 0.5 * len(lab.get(path)[2])


@pytest.mark.long
def test_a_class_has_as_many_sessions_as_pages_until_it_is_full(lab):
    """Also where a worker is full and its student goes to the other one."""

    async def lesson():
        async with lab.class_of(PAGES) as members:
            counts = await asyncio.to_thread(lab.counts, "sessions")
            assert sum(counts) == PAGES
            assert min(counts) > 0
            assert await asyncio.to_thread(lab.counts, "sockets") == counts
            assert all([await answers(connection) for _, connection in members])

            for _ in range(2 * PLACES - PAGES):
                cookie, token = await asyncio.to_thread(lab.page)
                members.append((cookie, await lab.connect(cookie, token)))
            status, headers, page = await asyncio.to_thread(lab.get, "/app")
            assert status == 503
            assert headers["Retry-After"] == "30"
            assert "All places are taken" in page
            # who has a place keeps it, and the files are not refused
            assert all([await answers(connection) for _, connection in members])
            assert (await asyncio.to_thread(lab.get, "/static/js/bokeh.min.js"))[0] == 200

    run(lesson())


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_worker_that_ends_takes_nobody_else_along(lab, number):
    async def lesson():
        async with lab.class_of(8) as members:
            victim = lab.ports[0]
            before = await asyncio.to_thread(lab.process_of, f"worker {victim}")
            homes = Counter()
            os.kill(before, number)
            lost = []
            for cookie, connection in members:
                try:
                    alive = await answers(connection)
                except Exception:  # closed while it was written to
                    alive = False
                homes[alive] += 1
                if not alive:
                    lost.append((cookie, connection))
            assert homes[True] > 0
            assert homes[False] > 0
            if number == signal.SIGTERM:
                assert {connection.close_code for _, connection in lost} == {1001}
            # the victims come back with the cookie they have, at once, on the other worker
            for cookie, _ in lost:
                _, token = await asyncio.to_thread(lab.page, cookie)
                connection = await lab.connect(cookie, token)
                assert await answers(connection)
                await shut(connection)
            # and the worker comes back
            await asyncio.to_thread(lab.wait)
            assert await asyncio.to_thread(lab.process_of, f"worker {victim}") != before

    run(lesson())


@pytest.mark.long
def test_a_page_that_ends_its_worker_is_given_to_no_other_one(lab):
    def started():
        return len(re.findall(r"started worker \d+: process", lab.log.read_text()))

    for _ in range(2):
        before = started()
        status, headers, page = lab.get("/app?die=1")
        assert status == 503
        assert headers["Retry-After"]
        assert "restart" in page
        assert lab.get("/app")[0] == 200  # on the other one
        lab.wait_for(lambda before=before: started() > before)
        lab.wait()
        assert started() == before + 1
    # the launcher says so, in JSON
    lines = [line for line in lab.log.read_text().splitlines() if line.startswith("{")]
    messages = [json.loads(line) for line in lines]
    assert {"time", "level", "logger", "message"} <= set(messages[0])
    assert any("again in" in one["message"] for one in messages)


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_the_end_leaves_nothing_behind(tmp_path, number):
    lab = Lab(tmp_path)
    try:
        lab.wait()
        assert lab.page()
        processes = lab.processes()
        assert len(processes) == 3
        os.kill(lab.process.pid, number)
        code = lab.process.wait(PATIENCE)
        deadline = time.monotonic() + PATIENCE
        while not all(map(ended, processes)) and time.monotonic() < deadline:
            time.sleep(0.1)
        assert all(map(ended, processes))
        if number == signal.SIGTERM:
            assert code == 0
            assert list(lab.temporary.iterdir()) == []
    finally:
        lab.stop()


@pytest.mark.long
def test_a_front_that_is_killed_leaves_no_orphan_and_comes_back(tmp_path):
    """nginx's workers once kept the port, and the new nginx could not have it."""
    lab = Lab(tmp_path)
    try:
        lab.wait()
        master = lab.process_of("nginx")
        children = Path(f"/proc/{master}/task/{master}/children").read_text().split()
        assert children
        os.kill(master, signal.SIGKILL)
        lab.wait_for(lambda: lab.process_of("nginx") != master and lab.get("/app")[0] == 200)
        assert all(ended(int(one)) for one in children)
    finally:
        lab.stop()


def test_the_folder_of_a_launcher_that_was_killed_is_removed_by_the_next(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    gone = subprocess.run(
        [sys.executable, "-c", "import os; print(os.getpid())"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.strip()
    stale, own = tmp_path / f"rotorstab-lab-{gone}-x", tmp_path / f"rotorstab-lab-{os.getpid()}-x"
    other = tmp_path / "rotorstab-lab-notes"
    for folder in (stale, own, other):
        (folder / "cache").mkdir(parents=True)
    lab_module.remove_stale_folders()
    assert sorted(tmp_path.iterdir()) == sorted([own, other])


STUDENT = "192.0.2.77"


@pytest.mark.parametrize(
    ("line", "level", "message"),
    [
        (
            f"2026/11/27 10:00:00 [error] 7#7: *12 upstream prematurely closed connection, client: "
            f'{STUDENT}, server: lab-pc, request: "GET /app?spin=1&name=Ada HTTP/1.1", upstream: '
            '"http://127.0.0.1:5101/app?spin=1&name=Ada", host: "lab-pc"',
            "ERROR",
            'upstream prematurely closed connection, upstream: "http://127.0.0.1:5101/app"',
        ),
        (
            f"2026/11/27 10:00:00 [warn] 7#7: *1 a client of {STUDENT}:4040 is slow, client: "
            f"{STUDENT}",
            "WARNING",
            "a client of … is slow",
        ),
        (
            '2026/11/27 10:00:00 [crit] 7#7: *1 open() "/tmp/a" failed (28: No space left), '
            'client: 2001:db8::7, server: lab, request: "GET /app?a=1 HTTP/1.1", host: "[::1]:80"',
            "CRITICAL",
            'open() "/tmp/a" failed (28: No space left)',
        ),
        (
            "2026/11/27 10:00:00 [notice] 7#7: signal process started",
            "INFO",
            "signal process started",
        ),
        (
            f"nginx: what it says otherwise of {STUDENT}",
            "WARNING",
            "nginx: what it says otherwise of …",
        ),
    ],
)
def test_nginxs_messages_are_logged_without_address_and_query(caplog, line, level, message):
    with caplog.at_level("DEBUG"):
        nginx_log.record(line)
    (found,) = caplog.records
    assert (found.levelname, found.getMessage()) == (level, message)


@pytest.mark.long
def test_debug_logs_requests_but_neither_address_nor_query(tmp_path):
    """With a socket as standard error too, as under journald, which nginx could not open."""
    ours, theirs = socket.socketpair()
    parts = []

    def read_all():
        while part := ours.recv(1 << 16):
            parts.append(part)

    reading = threading.Thread(target=read_all, daemon=True)
    reading.start()
    with ours, theirs:
        lab = Lab(tmp_path, stderr=theirs, ROTORSTAB_LOG_LEVEL="debug")
        theirs.close()
        try:
            lab.wait_for(lambda: lab.get("/app?name=Ada")[0] == 200)
            for port in lab.ports:
                lab.wait_for(lambda port=port: lab.worker(port, "/app?name=Ada")[0] == 200)
            lab.get("/app?name=Ada", method="POST")
            lab.get("/nothing?name=Ada")
        finally:
            lab.stop()
        reading.join(PATIENCE)
    log = b"".join(parts).decode()
    assert '"message":"GET /app","status":200' in log
    assert "GET /app" in log.replace('"message":"GET /app"', "")  # a worker's own line
    assert "Ada" not in log
    assert "127.0.0.1)" not in log
    for line in log.splitlines():
        json.loads(line)


@pytest.mark.long
def test_a_setting_that_a_worker_cannot_use_ends_the_launcher(tmp_path):
    """Before it serves; with the worker's own line."""
    with socket.socket() as taken:
        lab = Lab(tmp_path)
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        taken.bind(("127.0.0.1", lab.ports[1]))
        taken.listen()
        try:
            assert lab.process.wait(PATIENCE) == 2
        finally:
            lab.stop()
    assert f"rotorstab: PORT {lab.ports[1]} of 127.0.0.1 is in use" in lab.log.read_text()
    assert all(map(ended, lab.processes()))


class Named(http.server.BaseHTTPRequestHandler):
    """Answers with its own port."""

    def do_GET(self):
        body = str(self.server.server_port).encode()
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


@pytest.mark.long
def test_nginx_follows_workers_that_come_and_go(monkeypatch):
    """As in containers: a name stands for several addresses, and they change."""
    monkeypatch.setattr(lab_module, "LOOK_AGAIN", 0.1)
    monkeypatch.setattr(lab_module, "look_up", lambda upstream: list(places))
    servers = [http.server.ThreadingHTTPServer(("127.0.0.1", 0), Named) for _ in range(3)]
    for server in servers:
        threading.Thread(target=server.serve_forever, daemon=True).start()
    ports = [server.server_port for server in servers]
    places = []
    settings = read({"PORT": str(free_port()), "ROTORSTAB_UPSTREAM": "worker:5006"})

    def answer():
        """The port of the worker that answers a browser without a cookie."""
        connection = http.client.HTTPConnection("127.0.0.1", settings.port, timeout=10)
        with contextlib.closing(connection):
            connection.request("GET", "/app")
            reply = connection.getresponse()
            return int(reply.read()) if reply.status == 200 else reply.status

    async def until(expected):
        for _ in range(600):
            with contextlib.suppress(OSError):
                answers = {await asyncio.to_thread(answer) for _ in range(8)}
                if answers == set(expected):
                    return
            await asyncio.sleep(0.1)
        pytest.fail(f"{answers} answer, not {expected}")

    async def lesson(folder):
        ending = asyncio.Event()
        front = asyncio.create_task(
            keep_running("nginx", command(find_nginx(), write(settings, [], folder)), ending, 10)
        )
        following = asyncio.create_task(
            lab_module.follow(settings, find_nginx(), folder, [], ending)
        )
        await until([503])
        for here in (ports[:2], ports[1:], []):
            places[:] = [f"127.0.0.1:{port}" for port in here]
            # while no name is known the last ones are kept
            await until(here or ports[1:])
        ending.set()
        await asyncio.gather(front, following)

    with tempfile.TemporaryDirectory(prefix="rotorstab-test-") as name:
        Path(name).chmod(0o755)
        run(lesson(Path(name)))
    for server in servers:
        server.shutdown()
        server.server_close()


@pytest.mark.parametrize(
    "environment",
    [
        {},
        {"ADDRESS": "::1"},
        {"ADDRESS": "::", "ROTORSTAB_ORIGINS": "[2001:db8::1]:5006,[::1]"},
        {"ROTORSTAB_ORIGINS": "lab-pc,lab-pc.example:8080,127.0.0.1"},
        {"ROTORSTAB_LOG_LEVEL": "debug", "ROTORSTAB_MAX_SESSIONS": "10000"},
    ],
)
def test_nginx_accepts_its_configuration(tmp_path, environment):
    check(tmp_path, environment | {"PORT": str(free_port())})


def test_nginx_accepts_its_configuration_with_tls(tmp_path):
    folder = tmp_path / "with space"
    folder.mkdir()
    names = {"ROTORSTAB_TLS_KEY": "key.pem", "ROTORSTAB_TLS_CERTIFICATE": "certificate.pem"}
    files = {name: str(folder / file) for name, file in names.items()}
    files["ROTORSTAB_ORIGINS"] = "lab-pc"
    certify(files["ROTORSTAB_TLS_KEY"], files["ROTORSTAB_TLS_CERTIFICATE"])
    text = check(tmp_path, files | {"PORT": str(free_port())})
    assert "; Secure" in text
    assert "Strict-Transport-Security" not in text
    text = check(tmp_path, files | {"PORT": str(free_port()), "ROTORSTAB_HSTS": "86400"})
    # a location that adds a header of its own has none of the server's
    own = [block for block in text.split("location ") if "add_header" in block]
    assert len(own) > 4
    assert all('Strict-Transport-Security "max-age=86400" always;' in block for block in own)
    assert "ssl_reject_handshake on" in text


def test_tls_tells_browsers_to_stay_with_it_where_that_is_set(tmp_path):
    with tempfile.TemporaryDirectory(prefix="rotorstab-test-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        key, certificate = str(folder / "key.pem"), str(folder / "certificate.pem")
        certify(key, certificate)
        port = free_port()
        settings = read(
            {
                "PORT": str(port),
                "ROTORSTAB_TLS_KEY": key,
                "ROTORSTAB_TLS_CERTIFICATE": certificate,
                "ROTORSTAB_HSTS": "86400",
            }
        )
        front = subprocess.Popen(command(find_nginx(), write(settings, [], folder)))
        trusted = ssl.create_default_context(cafile=certificate)
        try:
            for path, status in (("/app", 503), ("/", 302), ("/nothing", 404)):
                found, headers, _ = eventually(port, path, trusted)
                assert found == status
                assert headers["Strict-Transport-Security"] == "max-age=86400"
            status, headers, page = eventually(port, "/app", None)  # http:// to this port
            assert status == 400
            assert "https://" in page
        finally:
            front.terminate()
            front.wait(PATIENCE)


@contextlib.contextmanager
def front_with_tls(**environment):
    """Settings and certificate of an nginx with TLS that has no worker yet, while it runs."""
    with tempfile.TemporaryDirectory(prefix="rotorstab-test-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        files = {
            "ROTORSTAB_TLS_KEY": str(folder / "key.pem"),
            "ROTORSTAB_TLS_CERTIFICATE": str(folder / "certificate.pem"),
        }
        certify(*files.values())
        environment |= files
        front = subprocess.Popen(command(find_nginx(), write(read(environment), [], folder)))
        try:
            yield environment, files["ROTORSTAB_TLS_CERTIFICATE"]
        finally:
            front.terminate()
            front.wait(PATIENCE)


def test_with_tls_health_is_found_and_http_is_sent_on():
    """The check once named no host in its handshake, so no container with TLS became healthy."""
    port, plain = free_port(), free_port()
    settings = {
        "PORT": str(port),
        "ROTORSTAB_HTTP_PORT": str(plain),
        "ROTORSTAB_ORIGINS": f"lab-pc:{port},localhost:{port},lab-pc.example",
    }
    with front_with_tls(**settings) as (environment, certificate):
        trusted = ssl.create_default_context(cafile=certificate)
        assert eventually(port, "/app", trusted)[0] == 503
        done = subprocess.run(
            [sys.executable, "-m", "deploy.check", "/app"],
            env=os.environ | environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stdout == "/app: 503\n"  # no worker yet, and no failed handshake
        for host, where in (
            ("localhost", f"localhost:{port}"),
            ("lab-pc", f"lab-pc:{port}"),
            ("lab-pc.example", "lab-pc.example"),
        ):
            connection = http.client.HTTPConnection("127.0.0.1", plain, timeout=10)
            with contextlib.closing(connection):
                connection.request("GET", "/app?spin=1", headers={"Host": host})
                reply = connection.getresponse()
                assert reply.status == 301
                assert reply.headers["Location"] == f"https://{where}/app?spin=1"
        # a number that is not listed gets no handshake
        with pytest.raises(ssl.SSLError):
            handshake(port, certificate)


def test_with_tls_a_listed_number_is_served():
    port = free_port()
    settings = {"PORT": str(port), "ROTORSTAB_ORIGINS": f"127.0.0.1:{port}"}
    with front_with_tls(**settings) as (_, certificate):
        eventually(port, "/app", ssl.create_default_context(cafile=certificate))
        assert handshake(port, certificate, f"127.0.0.1:{port}").startswith(b"HTTP/1.1 503")
        assert handshake(port, certificate, "192.0.2.1") == b""


@pytest.mark.long
def test_with_tls_the_launcher_serves_pages_and_sends_http_on(tmp_path):
    """Workers once found the second port in use, by nginx, and everything ended."""
    files = [str(tmp_path / name) for name in ("key.pem", "certificate.pem")]
    certify(*files)
    plain = free_port()
    lab = Lab(
        tmp_path,
        ROTORSTAB_TLS_KEY=files[0],
        ROTORSTAB_TLS_CERTIFICATE=files[1],
        ROTORSTAB_HTTP_PORT=str(plain),
    )
    try:
        lab.wait()
        assert eventually(lab.port, "/app", ssl.create_default_context(cafile=files[1]))[0] == 200
        status, headers, _ = eventually(plain, "/app?spin=1", None)
        assert (status, headers["Location"]) == (301, f"https://localhost:{lab.port}/app?spin=1")
    finally:
        lab.stop()


def handshake(port, certificate, host="127.0.0.1"):
    """The first bytes of the answer to a client that names no host in its handshake."""
    trusted = ssl.create_default_context(cafile=certificate)
    trusted.check_hostname = False
    with (
        socket.create_connection(("127.0.0.1", port), timeout=10) as plain,
        trusted.wrap_socket(plain) as client,
    ):
        client.sendall(f"GET /app HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        try:
            return client.recv(100)
        except ConnectionResetError:
            return b""


def eventually(port, path, trusted):
    """The answer of a server that may still be starting."""
    deadline = time.monotonic() + PATIENCE
    while True:
        more = {} if trusted is None else {"context": trusted}
        kind = http.client.HTTPConnection if trusted is None else http.client.HTTPSConnection
        connection = kind("localhost", port, timeout=10, **more)
        with contextlib.closing(connection):
            try:
                connection.request("GET", path)
                reply = connection.getresponse()
                return reply.status, reply.headers, reply.read().decode(errors="replace")
            except ConnectionRefusedError:
                assert time.monotonic() < deadline
                time.sleep(0.1)


def check(folder, environment):
    """Have nginx test the configuration of some settings; return it."""
    path = write(read(environment), ["127.0.0.1:5101", "127.0.0.1:5102"], folder)
    tested = subprocess.run(
        command(find_nginx(), path, "-t"), capture_output=True, text=True, check=False
    )
    assert tested.returncode == 0, tested.stderr
    assert "warn" not in tested.stderr.replace('the "user" directive makes sense only', "")
    return path.read_text()


OUTSIDE = """
daemon off;
pid "{folder}/nginx.pid";
error_log stderr warn;
events {{}}
http {{
    access_log off;
    client_body_temp_path "{folder}/body";
    proxy_temp_path "{folder}/proxy";
    fastcgi_temp_path "{folder}/fastcgi";
    uwsgi_temp_path "{folder}/uwsgi";
    scgi_temp_path "{folder}/scgi";
    server {{
        listen 127.0.0.1:{port} ssl;
        ssl_certificate "{folder}/certificate.pem";
        ssl_certificate_key "{folder}/key.pem";
        location / {{ return 200 "another service"; }}
{rules}
    }}
}}
"""


def documented_rules(port):
    """The lines that docs/deploy.md tells an outside nginx, for an inner port."""
    text = (START.parents[1] / "docs" / "deploy.md").read_text(encoding="utf-8")
    return re.search(r"```nginx\n(.*?)```", text, re.S)[1].replace("5006", str(port))


@pytest.fixture(scope="module")
def behind(tmp_path_factory):
    """A lab below /rotorstab/, and the port of a distribution's nginx with TLS before it."""
    outer = free_port()
    lab = Lab(
        tmp_path_factory.mktemp("behind"),
        app=APP_FOLDER,
        origins=[f"localhost:{outer}"],
        ROTORSTAB_PREFIX="/rotorstab",
        ROTORSTAB_OUTSIDE_TLS="yes",
    )
    certify(lab.temporary / "key.pem", lab.temporary / "certificate.pem")
    configuration = lab.temporary / "outside.conf"
    configuration.write_text(
        OUTSIDE.format(folder=lab.temporary, port=outer, rules=documented_rules(lab.port))
    )
    front = subprocess.Popen(
        [find_nginx(), "-e", "stderr", "-p", str(lab.temporary), "-c", configuration]
    )
    try:
        for port in lab.ports:
            lab.wait_for(lambda port=port: lab.worker(port, "/rotorstab/health")[0] == 200)
        lab.outer = outer
        lab.trusted = ssl.create_default_context(cafile=lab.temporary / "certificate.pem")
        yield lab
    finally:
        front.terminate()
        front.wait(PATIENCE)
        lab.stop()


@pytest.mark.long
def test_below_a_path_of_another_name_everything_is_found(behind):
    def ask(path):
        return eventually(behind.outer, path, behind.trusted)

    for path in ("/rotorstab", "/rotorstab/", "/rotorstab/app/"):
        status, headers, _ = ask(f"{path}?spin=1")
        assert status == 302
        assert headers["Location"].removeprefix(f"https://localhost:{behind.outer}") == (
            "/rotorstab/app?spin=1"
        )
    status, headers, page = ask("/rotorstab/app")
    assert status == 200
    assert headers["Set-Cookie"].endswith("; Path=/rotorstab/; HttpOnly; SameSite=Lax; Secure")
    named = re.findall(r'(?:src|href)="([^"]*static/[^"]*)"', page)
    files = {urljoin("/rotorstab/app", one) for one in named}
    assert any("bokeh.min.js" in one for one in files)
    for path in files:
        assert path.startswith("/rotorstab/static/")
        assert (path, ask(path)[0]) == (path, 200)
    assert ask("/rotorstab/static/js/bokeh.js")[0] == 404
    status, _, page = ask("/rotorstab/nothing")
    assert status == 404
    assert '<a href="/rotorstab/app">' in page
    assert ask("/app")[2] == "another service"
    done = subprocess.run(
        [sys.executable, "-m", "deploy.check", "/app"],
        env=os.environ | {"PORT": str(behind.port), "ROTORSTAB_PREFIX": "/rotorstab"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "/rotorstab/app: 200\n"


@pytest.mark.long
@pytest.mark.browser
def test_a_browser_uses_the_page_below_a_path_over_tls_that_ends_outside(browser, behind):
    context = browser.new_context(ignore_https_errors=True)
    try:
        page = context.new_page()
        failed = []
        page.on("requestfailed", lambda request: failed.append(request.url))
        page.on("response", lambda reply: reply.status >= 400 and failed.append(reply.url))
        page.goto(f"https://localhost:{behind.outer}/rotorstab/app?v=1&spin=1.5")
        page.wait_for_function("window.rotorstab?.last?.values?.spin_speed === 1.5", timeout=60_000)
        page.evaluate("rotorstab.change('shear', 0.01)")
        page.wait_for_function("location.search.includes('phi=0.01')")
        assert page.evaluate("location.pathname") == "/rotorstab/app"
        assert failed == []
    finally:
        context.close()


def certify(key, certificate):
    """Make a certificate for a day."""
    command = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1"]
    subprocess.run(
        [*command, "-subj", "/CN=localhost", "-keyout", key, "-out", certificate],
        check=True,
        capture_output=True,
    )
