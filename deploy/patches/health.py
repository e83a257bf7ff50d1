"""Health: whether the server's loop still turns.

A loop that hangs cannot answer, so `/health` fails by itself; but somebody has to end the process.
The loop gives a sign of life each second. A thread that misses it logs once where the loop
hangs, and later ends the process, so that its supervisor starts it again. Where not even that
thread can run (a lock held in compiled code), faulthandler's own thread does the same.
"""

import faulthandler
import logging
import os
import sys
import threading
import time
import traceback

from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.web import RequestHandler

from ..settings import Settings
from .sessions import draining

LOG = logging.getLogger("rotorstab.health")
BEAT = 1.0  # s
LOGGED_AFTER = 10  # beats missed
SPARE = 5.0  # s that faulthandler waits longer than the thread


class HealthHandler(RequestHandler):
    """200 where pages are served, 503 where the server is about to end."""

    async def get(self):
        self.set_header("Cache-Control", "no-store")
        if draining.is_set():
            self.set_status(503)
        self.write({"status": "draining" if draining.is_set() else "ok"})

    head = get


class Watchdog:
    """Watches the loop of the thread that makes it."""

    def __init__(self, hang, end=os._exit):
        self.hang = hang
        self.end = end
        self.lag = 0.0
        self._beats = 0
        self._due = 0.0
        self._watched = threading.get_ident()

    def beat(self):
        """Give a sign of life, from the loop."""
        now = time.monotonic()
        self.lag = max(0.0, now - self._due) if self._due else 0.0
        self._due = now + BEAT
        self._beats += 1
        faulthandler.dump_traceback_later(self.hang + SPARE, exit=True)

    def watch(self, sleep=time.sleep):
        """Count the beats that are missed, by this thread's own turns: where the whole process
        was stopped, neither of the two has turned."""
        missed, last = 0, 0
        while True:
            sleep(BEAT)
            missed = missed + 1 if self._beats == last else 0
            last = self._beats
            if missed == min(LOGGED_AFTER, self.hang):
                LOG.error("the loop hangs for %d s at:\n%s", missed * BEAT, self.where())
            if missed >= self.hang:
                LOG.critical("the loop hangs for %d s: this worker ends itself", missed * BEAT)
                self.end(1)
                return

    def where(self):
        """Return the stack of the watched thread."""
        frame = sys._current_frames().get(self._watched)
        return "".join(traceback.format_stack(frame)[-12:]) if frame else "no such thread"


watchdog = None


def install(settings: Settings):
    """Watch the loop of this thread, from its first turn on."""
    global watchdog
    watchdog = Watchdog(settings.hang)

    def start():
        watchdog.beat()
        PeriodicCallback(watchdog.beat, BEAT * 1000).start()
        threading.Thread(target=watchdog.watch, name="watchdog", daemon=True).start()

    IOLoop.current().add_callback(start)
