"""Limits of one client: messages and work a second, refused messages, silence, sizes of requests.

Clocks are monotonic: a jump of the machine's time changes nothing.
"""

import asyncio
import functools
import logging
import time

import bokeh.server.server as bokeh_server
from bokeh.server.views.ws import WSHandler

from .patching import replace

log = logging.getLogger("rotorstab.limits")

RATE, BURST = 150, 900  # messages a second: a drag sends one a frame, a zoom a few
PATIENCE = 15.0  # s above the rate, then the socket is closed
# Seconds of the server's one thread that a sender may use while others are active. Half a minute of
# dragging costs some 10 s, and whoever drags half of the time never runs out.
SHARE, CREDIT = 0.25, 10.0
# Of messages that take long, each of which holds up whoever comes meanwhile: a page has one now and
# then, a stream of them is kept below one twentieth of the time, so that nineteen of twenty
# messages of the others find the thread free.
LONG, LONG_SHARE, LONG_CREDIT = 0.06, 0.04, 2.0
ACTIVE = 2.0  # s since the last message
LOOK_AGAIN = 1.0  # s after which a sender that waits is let go if nobody else is active any more
CHEAP = 1e-3  # s of the thread: a message comes in fragments, only the last of which is work
REFUSED_RATE, MOST_REFUSED = 1, 100  # refused messages a second, and at once
FRAGMENTS = 3  # of one message
LARGEST_HEADER = 262_144  # bytes; a longer request is dropped by Tornado
LARGEST_BODY = 65_536  # bytes; no address takes a body
IDLE_PINGS = 3  # keep-alives that a connection may say nothing between requests

on_message = WSHandler.on_message
on_close = WSHandler.on_close
http_server = bokeh_server.HTTPServer


class Bucket:
    """A token bucket on a clock that never jumps."""

    def __init__(self, rate, burst, clock=time.monotonic):
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._last = float(burst), clock()

    def wait(self, amount=1.0):
        """Take an amount; return the seconds until it is earned, 0 where it was there."""
        now = self._clock()
        self._left = min(self._burst, self._left + (now - self._last) * self._rate) - amount
        self._last = now
        return max(0.0, -self._left / self._rate)


def count_refused(socket, kind):
    """Log the first refused message of a socket; close one that goes on with them."""
    if not hasattr(socket, "refused"):
        socket.refused = Bucket(REFUSED_RATE, MOST_REFUSED)
        log.warning("refused a %s; more of this socket are not logged", kind)
    if socket.refused.wait() > 0:
        close(socket, "too many refused messages")


def close(socket, why):
    """Close a socket once, with a logged line."""
    if not is_closing(socket):
        log.warning("closed a socket: %s", why)
        socket.close(1008, why)


def is_closing(socket):
    """Whether a socket is closed or about to be."""
    return socket.ws_connection is None or socket.ws_connection.is_closing()


active = {}  # when each socket last sent something


def others_wait(socket):
    """Whether another socket has sent something lately."""
    now = time.monotonic()
    for one in [one for one, last in active.items() if now - last > ACTIVE]:
        del active[one]
    return any(one is not socket for one in active)


async def pay(socket):
    """Wait until a sender has paid for its share of the thread, as long as others are active."""
    while not is_closing(socket) and others_wait(socket):
        debt = max(socket.work.wait(0), socket.long_work.wait(0))
        if debt < CHEAP:
            return
        await asyncio.sleep(min(debt, LOOK_AGAIN))


async def paced(self, fragment, handle=on_message):
    """Handle a fragment; a sender above the rate waits, and the network holds the rest back."""
    if is_closing(self):
        return
    if not hasattr(self, "pace"):
        self.pace, self.hurried = Bucket(RATE * FRAGMENTS, BURST * FRAGMENTS), None
        self.work, self.long_work = Bucket(SHARE, CREDIT), Bucket(LONG_SHARE, LONG_CREDIT)
    wait = self.pace.wait()
    if wait > 0:
        now = time.monotonic()
        self.hurried = self.hurried or now
        if now - self.hurried > PATIENCE:
            close(self, "too many messages")
            return
        await asyncio.sleep(wait)
    else:
        self.hurried = None
    began = time.thread_time()
    await handle(self, fragment)
    used = time.thread_time() - began
    active[self] = time.monotonic()
    self.work.wait(used)
    if used > LONG:
        self.long_work.wait(used)
    # at least one turn of the loop: what was read in one go would be handled in one go
    await asyncio.sleep(0)
    if used > CHEAP:
        await pay(self)


@functools.wraps(on_close)
def close_once(self):
    """Take leave of a session; a socket that was cut in the middle of an answer has none."""
    active.pop(self, None)
    if self.connection is None or self.connection._session is not None:
        on_close(self)


def install(settings):
    """Bound what a client may send to this process's server."""
    replace(WSHandler, "on_message", paced)
    replace(WSHandler, "on_close", close_once)
    # Bokeh pings and never looks for the answer; Tornado does
    for name in ("ping_interval", "ping_timeout"):
        replace(WSHandler, name, settings.keep_alive)
    server = functools.partial(
        http_server,
        max_header_size=LARGEST_HEADER,
        max_body_size=LARGEST_BODY,
        idle_connection_timeout=IDLE_PINGS * settings.keep_alive,
    )
    replace(bokeh_server, "HTTPServer", server)
