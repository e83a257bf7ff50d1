"""nginx and two workers of a throw-away app, with what tests ask of them."""

import asyncio
import contextlib
import http.client
import http.server
import os
import random
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from tornado.httpclient import HTTPRequest
from tornado.queues import QueueEmpty
from tornado.websocket import websocket_connect

from deploy.nginx import find_nginx
from tests.testing.serving import START, Server

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
PATIENCE = 60  # s; nothing is measured by it
COOKIE = re.compile(r"rotorstab=([0-9a-f]{32}); Path=/; HttpOnly; SameSite=Lax")

NEEDS_NGINX = pytest.mark.skipif(
    find_nginx() is None and not os.environ.get("CI"),
    reason="nginx is not installed (Debian and Ubuntu: apt-get install nginx-light)",
)


def worker_ports():
    """Return two successive free ports, outside the range of outgoing connections."""
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
        # nginx that root has started reads it as another user, who may not read pytest's folders
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


def ask(port, path, trusted):
    """Return the answer of a server that may still be starting."""
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


def certify(key, certificate):
    """Make a certificate for one day."""
    command = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1"]
    subprocess.run(
        [*command, "-subj", "/CN=localhost", "-keyout", key, "-out", certificate],
        check=True,
        capture_output=True,
    )
