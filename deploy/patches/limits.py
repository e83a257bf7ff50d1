"""Limits of one client: messages and work per second, refused messages, silence, request sizes.

The clocks are monotonic: a jump of the machine's time changes nothing.
"""

from __future__ import annotations

import asyncio
import functools
import logging
import time
from collections.abc import Awaitable, Callable
from typing import Any

import bokeh.server.server as bokeh_server
from bokeh.server.views.ws import WSHandler

from ..settings import Settings
from .patching import replace

LOG = logging.getLogger("rotorstab.limits")

RATE, BURST = 150, 900  # messages per second: a drag sends one per frame, a zoom a few
PATIENCE = 15.0  # s above the rate after which the socket is closed
# Share of the server's one thread that a sender may use while others are active, and the seconds of
# it that a sender may use in advance. Half a minute of dragging costs some 10 s, and a user who
# drags half of the time is never delayed.
THREAD_SHARE, THREAD_CREDIT = 0.25, 10.0
# The same for messages that take longer than LONG_MESSAGE [s]: each of them delays everybody who
# comes meanwhile. A page has one now and then. A stream of them is kept below one twentieth of the
# time, so that nineteen of twenty messages of the others find the thread free.
LONG_MESSAGE, LONG_SHARE, LONG_CREDIT = 0.06, 0.04, 2.0
ACTIVE = 2.0  # s after its last message during which a sender counts as active
LOOK_AGAIN = 1.0  # s after which a waiting sender looks whether anybody else is still active
CHEAP = 1e-3  # s of the thread; a message comes in fragments, of which only the last is work
REFUSED_RATE, MOST_REFUSED = 1, 100  # refused messages per second, and at once
FRAGMENTS = 3  # of one message
LARGEST_HEADER = 262_144  # bytes; Tornado drops a longer request
LARGEST_BODY = 65_536  # bytes; no address takes a body
IDLE_PINGS = 3  # keep-alives during which a connection may be silent between requests

on_message = WSHandler.on_message
on_close = WSHandler.on_close
http_server = bokeh_server.HTTPServer


class Bucket:
    """A token bucket on a monotonic clock.

    Parameters
    ----------
    rate : float
        Amount that is earned per second.
    burst : float
        Largest amount that can be saved; the bucket begins with it.
    clock : callable
        Returns the time [s].
    """

    def __init__(
        self, rate: float, burst: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._last = float(burst), clock()

    def wait(self, amount: float = 1.0) -> float:
        """Take an amount; return the time until it is earned [s], 0 where it was saved."""
        now = self._clock()
        self._left = min(self._burst, self._left + (now - self._last) * self._rate) - amount
        self._last = now
        return max(0.0, -self._left / self._rate)


def count_refused(socket: Any, kind: str) -> None:
    """Log the first refused message of a socket; close a socket that sends too many of them."""
    if not hasattr(socket, "refused"):
        socket.refused = Bucket(REFUSED_RATE, MOST_REFUSED)
        LOG.warning("refused a %s; more of this socket are not logged", kind)
    if socket.refused.wait() > 0:
        close(socket, "too many refused messages")


def close(socket: Any, reason: str) -> None:
    """Close a socket once, and log the reason."""
    if not is_closing(socket):
        LOG.warning("closed a socket: %s", reason)
        socket.close(1008, reason)


def is_closing(socket: Any) -> bool:
    """Return whether a socket is closed or about to be."""
    return socket.ws_connection is None or bool(socket.ws_connection.is_closing())


active: dict[Any, float] = {}
"""Time at which each socket was last sent a message [s]."""


def others_wait(socket: Any) -> bool:
    """Return whether another socket has sent a message in the last `ACTIVE` seconds."""
    now = time.monotonic()
    for sender in [each for each, last in active.items() if now - last > ACTIVE]:
        del active[sender]
    return any(sender is not socket for sender in active)


async def pay(socket: Any) -> None:
    """Wait until a sender has paid for its share of the thread, as long as others are active."""
    while not is_closing(socket) and others_wait(socket):
        debt = max(socket.work.wait(0), socket.long_work.wait(0))
        if debt < CHEAP:
            return
        await asyncio.sleep(min(debt, LOOK_AGAIN))


async def hold_to_rate(socket: Any) -> bool:
    """Have a sender above the rate wait; return False where it was closed for being too fast."""
    if not hasattr(socket, "pace"):
        socket.pace, socket.hurried_since = Bucket(RATE * FRAGMENTS, BURST * FRAGMENTS), None
        socket.work, socket.long_work = (
            Bucket(THREAD_SHARE, THREAD_CREDIT),
            Bucket(LONG_SHARE, LONG_CREDIT),
        )
    seconds = socket.pace.wait()
    if seconds == 0:
        socket.hurried_since = None
        return True
    now = time.monotonic()
    socket.hurried_since = socket.hurried_since or now
    if now - socket.hurried_since > PATIENCE:
        close(socket, "too many messages")
        return False
    await asyncio.sleep(seconds)
    return True


async def paced(
    self: Any, fragment: Any, handle: Callable[[Any, Any], Awaitable[Any]] = on_message
) -> None:
    """Handle a fragment within the sender's limits.

    A sender that has to wait is not read meanwhile, so the network holds the rest back.
    """
    if is_closing(self) or not await hold_to_rate(self):
        return
    began = time.thread_time()
    await handle(self, fragment)
    used = time.thread_time() - began
    active[self] = time.monotonic()
    self.work.wait(used)
    if used > LONG_MESSAGE:
        self.long_work.wait(used)
    # At least one turn of the loop: all fragments that were read at once would be handled at once.
    await asyncio.sleep(0)
    if used > CHEAP:
        await pay(self)


@functools.wraps(on_close)
def close_once(self: Any) -> None:
    """Leave the session; a socket that was cut in the middle of an answer has none."""
    active.pop(self, None)
    if self.connection is None or self.connection._session is not None:
        on_close(self)


def install(settings: Settings) -> None:
    """Bound what a client may send to this process's server."""
    replace(WSHandler, "on_message", paced)
    replace(WSHandler, "on_close", close_once)
    # Bokeh sends pings and never looks for the answers; Tornado does both
    for name in ("ping_interval", "ping_timeout"):
        replace(WSHandler, name, settings.keep_alive)
    server = functools.partial(
        http_server,
        max_header_size=LARGEST_HEADER,
        max_body_size=LARGEST_BODY,
        idle_connection_timeout=IDLE_PINGS * settings.keep_alive,
    )
    replace(bokeh_server, "HTTPServer", server)
