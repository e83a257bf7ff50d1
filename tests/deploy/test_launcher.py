"""The launcher: how nginx and the workers are started, kept running, followed and ended."""

import asyncio
import contextlib
import http.client
import http.server
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import pytest

from deploy import lab as lab_module
from deploy.nginx import command, find_nginx, write
from deploy.processes import keep_running
from deploy.settings import read
from tests.testing.lab import (
    NEEDS_NGINX,
    PATIENCE,
    Lab,
)
from tests.testing.serving import ended, free_port, run

pytestmark = NEEDS_NGINX


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
    """The workers of nginx once kept the port, so a new nginx could not listen on it."""
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


@pytest.mark.long
def test_a_setting_that_a_worker_cannot_use_ends_the_launcher(tmp_path):
    """It ends before it serves, with the line of the worker."""
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
    """As in containers, a name stands for several addresses, which change."""
    monkeypatch.setattr(lab_module, "LOOK_AGAIN", 0.1)
    monkeypatch.setattr(lab_module, "look_up", lambda upstream: list(places))
    servers = [http.server.ThreadingHTTPServer(("127.0.0.1", 0), Named) for _ in range(3)]
    for server in servers:
        threading.Thread(target=server.serve_forever, daemon=True).start()
    ports = [server.server_port for server in servers]
    places = []
    settings = read({"PORT": str(free_port()), "ROTORSTAB_UPSTREAM": "worker:5006"})

    def answer():
        """Return the port of the worker that answers a browser without a cookie."""
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
            # while the name has no address, the last addresses are kept
            await until(here or ports[1:])
        ending.set()
        await asyncio.gather(front, following)

    with tempfile.TemporaryDirectory(prefix="rotorstab-test-") as name:
        Path(name).chmod(0o755)
        run(lesson(Path(name)))
    for server in servers:
        server.shutdown()
        server.server_close()
