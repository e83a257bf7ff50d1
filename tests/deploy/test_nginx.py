"""The real nginx in front of real workers on loopback, started by the shipped launcher."""

import asyncio
import contextlib
import http.client
import http.server
import json
import os
import re
import signal
import socket
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import pytest
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.websocket import websocket_connect

from deploy.constants import HEADERS, LONGEST_ADDRESS
from tests.testing.dashboard import open_dashboard
from tests.testing.lab import (
    APP_FOLDER,
    COOKIE,
    NEEDS_NGINX,
    PATIENCE,
    PLACES,
    Lab,
    answers,
    next_fragment,
    shut,
)
from tests.testing.serving import run

PAGES = 22

pytestmark = NEEDS_NGINX


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    lab = Lab(tmp_path_factory.mktemp("lab"))
    try:
        # nginx serves long before the workers, and says that the server restarts
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
    """HEAD fetches no file: 300 such requests with versions of their own once filled the disk."""
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
    """This includes requests that nginx cannot read, and so assigns to no server."""
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
    """The real page lists what it ignores, uses the rest, and can be used."""
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
    # this includes sockets, whose origin the worker checks as well
    cookie, token = lab.page()
    headers = {"Origin": "http://other.example", "Cookie": cookie}
    request = HTTPRequest(f"ws://localhost:{lab.port}/app/ws", headers=headers)

    async def attempt():
        with pytest.raises(HTTPClientError, match="403"):
            await websocket_connect(request, subprotocols=["bokeh", token])

    run(attempt())


def test_a_listed_name_without_a_port_is_served(lab):
    """On port 80 or 443 the address line shows no port."""
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
    """This includes a student whose worker is full and who is served by the other one."""

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
            # an open page keeps its place, and files are still served
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
            # the pages come back at once on the other worker, with the cookies that they have
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
