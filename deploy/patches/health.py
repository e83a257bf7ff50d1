"""Health: whether the server's loop still turns.

A loop that hangs cannot answer, so `/health` fails by itself; but somebody has to end the process.
The loop gives a sign of life each second. A thread that misses these signs logs once where the loop
hangs, and later ends the process, so that its supervisor starts it again. Where not even that
thread can run, because compiled code holds a lock, the own thread of faulthandler does the same.
"""

from __future__ import annotations

import faulthandler
import logging
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable

from prometheus_client import Gauge
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.web import RequestHandler

from ..settings import Settings
from .sessions import draining

LOG = logging.getLogger("rotorstab.health")
BEAT = 1.0  # s between two signs of life
LOGGED_AFTER = 10  # signs of life that were missed
SPARE = 5.0  # s that faulthandler waits longer than the thread
SHOWN_FRAMES = 12  # of the stack that is logged
LAG = Gauge("rotorstab_loop_lag_seconds", "How late the loop was last.")


class HealthHandler(RequestHandler):
    """200 where pages are served, 503 where the server is about to end."""

    async def get(self) -> None:
        self.set_header("Cache-Control", "no-store")
        if draining.is_set():
            self.set_status(503)
        self.write({"status": "draining" if draining.is_set() else "ok"})

    head = get


class Watchdog:
    """Watches the loop of the thread that makes it.

    Parameters
    ----------
    hang : int
        Signs of life, one each `BEAT`, that may be missed before the process is ended.
    end : callable
        Ends the process with an exit code.
    """

    def __init__(self, hang: int, end: Callable[[int], object] = os._exit) -> None:
        self.hang = hang
        self.end = end
        self.lag = 0.0
        self._beats = 0
        self._due = 0.0
        self._watched = threading.get_ident()

    def beat(self) -> None:
        """Give a sign of life; the loop calls this."""
        now = time.monotonic()
        self.lag = max(0.0, now - self._due) if self._due else 0.0
        self._due = now + BEAT
        self._beats += 1

    def watch(self, sleep: Callable[[float], object] = time.sleep) -> None:
        """Count the signs of life that are missed, by the turns of this thread.

        Turns and not seconds: where the whole process was stopped, neither this thread nor the loop
        has turned.
        """
        missed, last = 0, 0
        while True:
            sleep(BEAT)
            missed = missed + 1 if self._beats == last else 0
            last = self._beats
            if missed == min(LOGGED_AFTER, self.hang):
                LOG.error("the loop hangs for %d s at:\n%s", missed * BEAT, self.stack())
            if missed >= self.hang:
                LOG.critical("the loop hangs for %d s: this worker ends itself", missed * BEAT)
                self.end(1)
                return

    def stack(self) -> str:
        """Return the stack of the watched thread."""
        frame = sys._current_frames().get(self._watched)
        if frame is None:
            return "no such thread"
        return "".join(traceback.format_stack(frame)[-SHOWN_FRAMES:])


def install(settings: Settings) -> None:
    """Watch the loop of this thread, from its first turn on."""
    watchdog = Watchdog(settings.hang)
    LAG.set_function(lambda: watchdog.lag)

    def beat() -> None:
        watchdog.beat()
        faulthandler.dump_traceback_later(settings.hang + SPARE, exit=True)

    def start() -> None:
        beat()
        PeriodicCallback(beat, BEAT * 1000).start()
        threading.Thread(target=watchdog.watch, name="watchdog", daemon=True).start()

    IOLoop.current().add_callback(start)
