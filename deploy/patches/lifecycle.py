"""The end of a server: told by a signal it drains, within seconds and leaving nothing behind.

New pages and sockets are refused at once, running exports may finish, then the sockets are
closed; an open page that loses its socket asks again and comes back where a server answers.
"""

import asyncio
import atexit
import logging
import os
import signal
import threading

from bokeh.server.server import BaseServer

from .. import dashboard
from ..settings import Settings
from .patching import replace
from .sessions import draining, open_sockets

LOG = logging.getLogger("rotorstab.server")
GOING_AWAY = 1001
CLOSING = 1.0  # s for the closing handshake of the sockets
SPARE = 1.0  # s after which a process that should have ended is ended


async def _until(done, seconds):
    """Wait until a condition holds, at most some seconds."""
    loop = asyncio.get_running_loop()
    end = loop.time() + seconds
    while not done() and loop.time() < end:
        await asyncio.sleep(0.05)


async def drain(seconds, stop):
    """Refuse, finish, close, stop."""
    running = dashboard.exports_running()
    LOG.info("draining: %d sockets, %d exports", len(open_sockets), running)
    if running:
        await _until(lambda: not dashboard.exports_running(), seconds - CLOSING)
        await asyncio.sleep(0.2)  # the files are on their way to the pages
    for socket in list(open_sockets):
        socket.close(GOING_AWAY, "the server restarts")
    await _until(lambda: not open_sockets, CLOSING)
    LOG.info("stopped")
    stop()


def run_until_shutdown(server, seconds):
    """Serve until SIGTERM or SIGINT, then drain; a second signal ends at once."""
    if not server._started:
        server.start()
    atexit.register(server._atexit)
    loop = asyncio.get_event_loop()
    ended = threading.Timer(seconds + SPARE, os._exit, (1,))
    ended.daemon = True
    tasks = []

    def told(number, frame):
        if draining.is_set():
            os._exit(1)
        draining.set()
        # the loop may hang and never hear of it
        ended.start()
        loop.call_soon_threadsafe(
            lambda: tasks.append(loop.create_task(drain(seconds, server._loop.stop)))
        )

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, told)
    where = server.address if server.address not in ("", "0.0.0.0", "::", None) else "localhost"
    prefix = server._tornado.prefix
    LOG.info("serving http://%s:%s%s/ (Ctrl-C or SIGTERM ends it)", where, server.port, prefix)
    server._loop.start()
    server.stop()
    dashboard.close()


def install(settings: Settings):
    """Drain this process's server at its end."""
    replace(BaseServer, "run_until_shutdown", lambda self: run_until_shutdown(self, settings.drain))
