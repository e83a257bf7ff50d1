"""A worker's life: its health, its numbers, its log, its end; on real servers of one process."""

import asyncio
import base64
import contextlib
import http.client
import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from tornado.httpclient import HTTPClientError

from app.background.telemetry import observe, observers
from benchmarks.classroom.client import User
from deploy.patches.health import Watchdog
from tests.testing.serving import Server, ended, free_port, run
from tests.testing.wire import opened

APP = """
import ctypes, time
import panel as pn
if "sleep" in pn.state.session_args:
    time.sleep(1000)
if "block" in pn.state.session_args:
    ctypes.PyDLL(None).sleep(1000)  # in compiled code, with the interpreter's lock
pn.pane.Markdown("throw-away").servable()
"""
PATIENCE = 60  # s; nothing is measured by it


class Tiny(Server):
    """A server of a throw-away app that can be made to hang."""

    def __init__(self, folder, **environment):
        app = folder / "app.py"
        app.write_text(APP)
        super().__init__(folder / "log.txt", app, **environment)

    def is_silent(self, path):
        """Whether a request has no answer within a second."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=1)
        with contextlib.closing(connection):
            connection.request("GET", path)
            try:
                connection.getresponse().close()
            except TimeoutError:
                return True
        return False

    def lines(self):
        """The log's JSON lines."""
        text = self.log.read_text().splitlines()
        return [json.loads(line) for line in text if line.startswith("{")]


@pytest.fixture
def tiny(tmp_path):
    servers = []

    def start(**environment):
        folder = tmp_path / str(len(servers))
        folder.mkdir()
        servers.append(Tiny(folder, **environment))
        return servers[-1].wait()

    yield start
    for server in servers:
        server.stop()


def served(folder, **environment):
    """A server that several tests use, until the last of them has ended."""
    server = Tiny(folder, **environment)
    try:
        yield server.wait()
    finally:
        server.stop()


@pytest.fixture(scope="module")
def idle(tmp_path_factory):
    """A server that no test makes hang or ends."""
    yield from served(tmp_path_factory.mktemp("idle"), ROTORSTAB_LOG_LEVEL="debug")


@pytest.fixture(scope="module")
def unusual(tmp_path_factory):
    """A server with other settings than most have; no test makes it hang or ends it."""
    yield from served(
        tmp_path_factory.mktemp("unusual"),
        ADDRESS="::",
        ROTORSTAB_ORIGINS="",
        ROTORSTAB_METRICS="on",
        ROTORSTAB_LOG_FORMAT="text",
    )


@pytest.fixture(scope="module")
def ending(tmp_path_factory):
    """A server without metrics, which a test ends."""
    yield from served(tmp_path_factory.mktemp("ending"), ROTORSTAB_METRICS="off")


@pytest.mark.long
@pytest.mark.parametrize("how", ["sleep", "block"])
def test_a_worker_whose_loop_hangs_fails_its_health_and_ends_itself(tiny, how):
    server = tiny(ROTORSTAB_HANG="5")
    assert server.get("/health")[0] == 200
    assert server.is_silent(f"/app?{how}=1")
    assert server.is_silent("/health")
    assert server.process.wait(PATIENCE) == 1
    log = server.log.read_text()
    assert "app.py" in log  # where it hung
    if how == "sleep":
        messages = [one["message"] for one in server.lines() if one["logger"] == "rotorstab.health"]
        assert len(messages) == 2
        assert messages[0].startswith("the loop hangs for 5 s at:")
        assert messages[1] == "the loop hangs for 5 s: this worker ends itself"


def test_a_process_that_was_stopped_as_a_whole_does_not_hang():
    """The watchdog counts its own turns, and it had none while the process was stopped."""
    ended = []
    watchdog = Watchdog(hang=5, end=ended.append)
    turns = iter([True, True, False, False, True, False])

    def sleep(seconds):
        try:
            turned = next(turns)
        except StopIteration:
            raise RuntimeError from None
        if turned:
            watchdog.beat()

    with pytest.raises(RuntimeError):
        watchdog.watch(sleep)
    assert ended == []


@pytest.mark.long
def test_sigterm_ends_a_worker_that_hangs(tiny):
    server = tiny(ROTORSTAB_DRAIN="1")
    assert server.is_silent("/app?sleep=1")
    os.kill(server.process.pid, signal.SIGTERM)
    assert server.process.wait(PATIENCE) == 1


def test_metrics_are_for_whom_they_are_meant(idle, unusual, ending):
    assert idle.get("/metrics")[0] == 200
    assert idle.get("/metrics", **{"X-Forwarded-For": "127.0.0.1"})[0] == 404
    assert unusual.get("/metrics", **{"X-Forwarded-For": "192.0.2.1"})[0] == 200
    assert ending.get("/metrics")[0] == 404


def test_sigterm_ends_an_idle_worker_with_0(ending):
    assert ending.get("/app")[0] == 200
    os.kill(ending.process.pid, signal.SIGTERM)
    assert ending.process.wait(PATIENCE) == 0
    with pytest.raises(ProcessLookupError):
        os.killpg(ending.process.pid, 0)
    assert ending.lines()[-1]["message"] == "stopped"


def test_the_check_of_a_container(idle):
    def check(path, port):
        done = subprocess.run(
            [sys.executable, "-m", "deploy.check", path],
            env=os.environ | {"ADDRESS": "0.0.0.0", "PORT": str(port)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stderr == ""
        return done.returncode, done.stdout

    assert check("/health", idle.port) == (0, "/health: 200\n")
    assert check("/nowhere", idle.port) == (1, "/nowhere: 404\n")
    code, told = check("/health", free_port())
    assert code == 1
    assert "refused" in told


def test_an_address_for_both_families_and_an_ipv6_origin(unusual, monkeypatch):
    for host in ("127.0.0.1", "::1"):
        connection = http.client.HTTPConnection(host, unusual.port, timeout=PATIENCE)
        with contextlib.closing(connection):
            connection.request("GET", "/app")
            assert connection.getresponse().status == 200

    async def open_socket(name):
        monkeypatch.setattr(unusual, "origin", f"http://{name}:{unusual.port}")
        async with opened(unusual):
            return True

    assert run(open_socket("[::1]"))
    with pytest.raises(HTTPClientError, match="403"):
        run(open_socket("[2001:db8::1]"))


def test_a_log_line_is_an_object_or_plain_text(idle, unusual):
    idle.get("/app")
    for line in idle.lines():
        assert {"time", "level", "logger", "message"} <= set(line)
    sessions = {line["session"] for line in idle.lines() if "session" in line}
    assert sessions
    assert {len(one) for one in sessions} == {8}
    assert unusual.lines() == []
    assert "INFO rotorstab.server: serving http://" in unusual.log.read_text()


def test_the_app_is_measured_only_where_somebody_observes():
    told = []
    observe("update", 0.5)
    observers.append(lambda *what: told.append(what))
    try:
        observe("update", 0.25)
    finally:
        observers.pop()
    assert told == [("update", 0.25)]


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    """The dashboard, which a test ends."""
    server = Server(tmp_path_factory.mktemp("real") / "log.txt", ROTORSTAB_DRAIN="60")
    try:
        yield server.wait()
    finally:
        server.stop()


KILLED = """
import os, signal
from app.background.printing import printer
from rotorstab.paper import FIGURES
assert printer.file("key", FIGURES[2](), "svg").result()
print(*printer.pids(), flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.long
def test_the_picture_process_ends_with_a_server_that_is_killed():
    done = subprocess.run([sys.executable, "-c", KILLED], stdout=subprocess.PIPE, check=False)
    assert done.returncode == -signal.SIGKILL
    picture_process = int(done.stdout)
    deadline = time.monotonic() + PATIENCE
    while not ended(picture_process) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert ended(picture_process)


def number(text, name):
    return float(re.search(rf"^{re.escape(name)} (\S+)$", text, re.M)[1])


def test_what_is_counted_of_a_lesson(real):
    async def lesson():
        users = [User(real.origin) for _ in range(2)]
        for user in users:
            await user.open()
        for user in users:
            await user.change(spin_speed=1.25)
        text = (await asyncio.to_thread(real.get, "/metrics"))[2]
        assert number(text, "rotorstab_sessions") == 2
        assert number(text, "rotorstab_sockets") == 2
        assert number(text, "rotorstab_session_open_seconds_count") == 2
        assert number(text, "rotorstab_update_seconds_count") >= 4
        # the second student has the picture of the first one from the cache
        assert number(text, 'rotorstab_cache_hits_total{cache="analysis.solve"}') >= 2
        assert number(text, "process_resident_memory_bytes") > 5e7
        assert "rotorstab_errors_total{" not in text
        for user in users:
            await user.close()

    run(lesson())


def test_a_running_export_is_finished_before_the_end(real):
    """The page gets its file, then its socket is closed; no new page is served meanwhile."""

    async def lesson():
        user = User(real.origin)
        await user.open()
        printing = await user.ask(type="export", chart="campbell", format="pdf")
        assert "making" in printing.content["toast"]
        file = asyncio.create_task(user.told(lambda content: "file" in content))
        os.kill(real.process.pid, signal.SIGTERM)
        status, headers, page = await asyncio.to_thread(real.get, "/app")
        assert status == 503
        assert headers["Retry-After"] == "5"
        assert "restarts" in page
        assert (await asyncio.to_thread(real.get, "/health"))[0] == 503
        content = await file
        assert base64.b64decode(content["file"]["base64"]).startswith(b"%PDF")
        while user.connected:
            await asyncio.sleep(0.05)
        assert user.close_code == 1001
        await user.close()

    run(lesson())
    assert real.process.wait(PATIENCE) == 0
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:  # the drawing process is a child of its own
        try:
            os.killpg(real.process.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    pytest.fail("a process is left")
