"""Serve an app as a process of its own, for tests and benchmarks."""

import asyncio
import http.client
import os
import signal
import socket
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

START = Path(__file__).parents[2] / "deploy" / "start.sh"
STARTING = 60  # s


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def run(coroutine):
    """Run a coroutine to its end in a thread of its own; Playwright's loop holds the main one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, coroutine).result()


def ended(process):
    """Whether a process has ended; a zombie has."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


class Server:
    """A server of its own port and process group, ended by its own process id.

    It is started with the shipped start script, or with a command of which "PORT" is a word.
    """

    def __init__(
        self,
        log,
        app=None,
        origins=(),
        command=None,
        port=None,
        stderr=None,
        folder=None,
        **environment,
    ):
        self.port = port or free_port()
        self.origin = f"http://localhost:{self.port}"
        self.log = log
        environment = os.environ | {
            "PYTHON": sys.executable,
            "ADDRESS": "127.0.0.1",
            "PORT": str(self.port),
            "ROTORSTAB_SECRET_FILE": f"{log}.secret",
            "ROTORSTAB_ORIGINS": ",".join([f"localhost:{self.port}", *origins]),
            **environment,
        }
        environment.pop("BOKEH_SECRET_KEY", None)
        command = command or ["sh", START, *([app] if app else [])]
        command = [str(self.port) if word == "PORT" else word for word in command]
        with log.open("w") as output:
            self.process = subprocess.Popen(
                command,
                env=environment,
                cwd=folder,
                stdout=output,
                stderr=stderr or subprocess.STDOUT,
                start_new_session=True,
            )

    def wait(self):
        """Return once the server answers; fail with its log where it ends first."""
        deadline = time.monotonic() + STARTING
        while time.monotonic() < deadline and self.process.poll() is None:
            try:
                self.get("/health")
            except OSError:
                time.sleep(0.1)
            else:
                return self
        self.stop()
        raise RuntimeError("the server did not start:\n" + self.log.read_text())

    def get(self, path, method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        try:
            connection.request(method, path, headers=headers)
            reply = connection.getresponse()
            return reply.status, reply.headers, reply.read().decode()
        finally:
            connection.close()

    def stop(self):
        """End the process and what it started; the start script execs, so its id is the group's."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGTERM)
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait(20)
