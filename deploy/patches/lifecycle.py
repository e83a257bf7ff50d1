"""The end of a server: after a signal it drains, within seconds, and leaves nothing behind.

New pages and sockets are refused at once, running exports may finish, then the sockets are closed.
An open page that loses its socket asks again, and comes back where a server answers.
"""

from __future__ import annotations

import asyncio
import atexit
import logging
import os
import signal
import threading
from collections.abc import Callable
from types import FrameType
from typing import Any

from bokeh.server.server import BaseServer

from .. import dashboard
from ..settings import Settings
from .patching import replace
from .sessions import draining, open_sockets

LOG = logging.getLogger("rotorstab.server")
GOING_AWAY = 1001  # code of a socket that is closed because its server ends
CLOSING = 1.0  # s for the closing handshake of the sockets
SPARE = 1.0  # s beyond the time to drain, after which the process is ended
SENDING = 0.2  # s that a finished file may take on its way to the page
EVERYWHERE = ("", "0.0.0.0", "::", None)  # addresses that no browser can open


async def wait_until(is_done: Callable[[], bool], seconds: float) -> None:
    """Wait until a condition holds, at most some seconds."""
    loop = asyncio.get_running_loop()
    end = loop.time() + seconds
    while not is_done() and loop.time() < end:
        await asyncio.sleep(0.05)


async def drain(seconds: float, stop: Callable[[], object]) -> None:
    """Let running exports finish, close the sockets, then stop the loop."""
    running = dashboard.exports_running()
    LOG.info("draining: %d sockets, %d exports", len(open_sockets), running)
    if running:
        await wait_until(lambda: not dashboard.exports_running(), seconds - CLOSING)
        await asyncio.sleep(SENDING)
    for socket in list(open_sockets):
        socket.close(GOING_AWAY, "the server restarts")
    await wait_until(lambda: not open_sockets, CLOSING)
    LOG.info("stopped")
    stop()


def run_until_shutdown(server: Any, seconds: float) -> None:
    """Serve until SIGTERM or SIGINT, then drain; a second signal ends the process at once."""
    if not server._started:
        server.start()
    atexit.register(server._atexit)
    loop = asyncio.get_event_loop()
    # the loop may hang and never drain
    ending = threading.Timer(seconds + SPARE, os._exit, (1,))
    ending.daemon = True
    tasks: list[asyncio.Task[None]] = []

    def on_signal(number: int, frame: FrameType | None) -> None:
        if draining.is_set():
            os._exit(1)
        draining.set()
        ending.start()
        loop.call_soon_threadsafe(
            lambda: tasks.append(loop.create_task(drain(seconds, server._loop.stop)))
        )

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, on_signal)
    host = "localhost" if server.address in EVERYWHERE else server.address
    prefix = server._tornado.prefix
    LOG.info("serving http://%s:%s%s/ (Ctrl-C or SIGTERM ends it)", host, server.port, prefix)
    server._loop.start()
    server.stop()
    dashboard.close()


def install(settings: Settings) -> None:
    """Drain this process's server at its end."""

    def run(self: Any) -> None:
        run_until_shutdown(self, settings.drain)

    replace(BaseServer, "run_until_shutdown", run)
