"""Connections: a bounded number, and no busy loop where the system has no descriptor left."""

from __future__ import annotations

import errno
import logging
import resource
import socket
import time
from collections.abc import Callable, Collection
from contextlib import suppress
from functools import partial
from typing import Any

import tornado.tcpserver as tornado_tcpserver
from tornado.ioloop import IOLoop

from ..settings import Settings
from . import sessions
from .patching import replace

LOG = logging.getLogger("rotorstab.connections")

MOST_DESCRIPTORS = 65_536  # more are of no use to one worker
RESERVED = 150  # descriptors for modules, logs, pipes and the pictures that are being made
CONNECTIONS_OF_A_PAGE = 20  # six of the browser, its socket, and others that only wait
BACKLOG = 128  # connections accepted in one turn of the loop
SILENCE = 60.0  # s between two warnings of the same cause
YOUNG = 5.0  # s during which a connection is never closed
PAUSE = 1.0  # s without accepting after the system had no descriptor
EXHAUSTED = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)


class RareWarning:
    """A warning that is logged at most once in `SILENCE`, however often its cause comes back."""

    def __init__(self, message: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._message, self._clock, self._next = message, clock, 0.0

    def log(self) -> None:
        """Log the warning, unless it was logged a short time ago."""
        now = self._clock()
        if now >= self._next:
            LOG.warning(self._message)
            self._next = now + SILENCE


def raise_limit() -> int:
    """Allow this process as many descriptors as the system permits; return their number."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = MOST_DESCRIPTORS if hard == resource.RLIM_INFINITY else min(hard, MOST_DESCRIPTORS)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
        soft = wanted
    return MOST_DESCRIPTORS if soft == resource.RLIM_INFINITY else soft


def held(callback: Callable[..., object]) -> int:
    """Return how many connections a server holds; the callback is its method for new ones."""
    server = getattr(callback, "__self__", None)
    return len(getattr(server, "_connections", ())) + len(sessions.open_sockets)


class Accepted:
    """The connections that were accepted, the oldest first."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._since: dict[socket.socket, float] = {}  # s; in the order in which they came

    def add(self, connection: socket.socket) -> None:
        """Note a new connection."""
        self._since[connection] = self._clock()

    def end_oldest(self, in_use: Collection[int]) -> bool:
        """End the oldest connection that is not in use; return whether there was one.

        Connections younger than `YOUNG` are spared, because a request may be under way on them.

        Parameters
        ----------
        in_use : collection of int
            Descriptors of the sockets of pages.
        """
        for connection in [each for each in self._since if each.fileno() < 0]:
            del self._since[connection]
        now = self._clock()
        for connection, since in self._since.items():
            if now - since < YOUNG:
                return False
            if connection.fileno() not in in_use:
                del self._since[connection]
                with suppress(OSError):  # the other side has closed it meanwhile
                    connection.shutdown(socket.SHUT_RDWR)
                return True
        return False


def page_sockets() -> set[int]:
    """Return the descriptors of the pages' sockets, which are silent while nobody acts."""
    streams = [each.ws_connection and each.ws_connection.stream for each in sessions.open_sockets]
    return {stream.fileno() for stream in streams if stream and not stream.closed()}


class Acceptor:
    """Accepts the connections of one listening socket, with a bound and a pause.

    Parameters
    ----------
    listener : socket
    callback : callable
        Takes a new connection and its address; a method of the server.
    most : int
        Largest number of connections that the server holds.
    """

    def __init__(
        self, listener: socket.socket, callback: Callable[[socket.socket, Any], None], most: int
    ) -> None:
        self._listener, self._callback, self._most = listener, callback, most
        self._loop = IOLoop.current()
        self._accepted = Accepted()
        self._removed = False
        self._too_many = RareWarning(
            f"there are {most} connections, as many as are allowed: the oldest are closed"
        )
        self._exhausted = RareWarning("the system has no descriptor left: new connections wait")

    def start(self) -> None:
        """Accept from now on."""
        if not self._removed:
            self._loop.add_handler(self._listener, self._accept, IOLoop.READ)

    def remove(self) -> None:
        """Accept nothing any more."""
        self._removed = True
        self._loop.remove_handler(self._listener)

    def _accept(self, listener: socket.socket, events: int) -> None:
        for _ in range(BACKLOG):
            if self._removed:
                return
            try:
                connection, address = self._listener.accept()
            except BlockingIOError:
                return
            except ConnectionAbortedError:
                continue
            except OSError as problem:
                if problem.errno not in EXHAUSTED:
                    raise
                self._exhausted.log()
                self._loop.remove_handler(self._listener)
                self._loop.call_later(PAUSE, self.start)
                return
            self._admit(connection, address)

    def _admit(self, connection: socket.socket, address: Any) -> None:
        """Hand a new connection to the server, or close it where there is no room for it."""
        if held(self._callback) >= self._most:
            self._too_many.log()
            if not self._accepted.end_oldest(page_sockets()):
                connection.close()
                return
        self._accepted.add(connection)
        self._callback(connection, address)


def add_accept_handler(
    listener: socket.socket, callback: Callable[[socket.socket, Any], None], most: int
) -> Callable[[], None]:
    """Accept at most some connections in place of Tornado's function; return what ends it.

    Tornado accepts without a bound. Where no descriptor is left, it fails in every turn of the
    loop, each time with a traceback, until one is free.
    """
    acceptor = Acceptor(listener, callback, most)
    acceptor.start()
    return acceptor.remove


def install(settings: Settings) -> None:
    """Bound the connections of this process's server."""
    room = max(raise_limit() - RESERVED, 16)
    most = min(room, RESERVED + CONNECTIONS_OF_A_PAGE * settings.max_sessions)
    replace(tornado_tcpserver, "add_accept_handler", partial(add_accept_handler, most=most))
