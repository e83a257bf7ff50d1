"""Connections: as many as there is room for, and no spinning where the system has none left."""

import errno
import logging
import resource
import socket
import time
from contextlib import suppress

import tornado.tcpserver as tornado_tcpserver
from tornado.ioloop import IOLoop

from . import sessions
from .patching import replace

LOG = logging.getLogger("rotorstab.connections")

MOST_DESCRIPTORS = 65_536  # more are of no use to one worker
RESERVED = 150  # descriptors for modules, logs, pipes and the pictures that are being made
A_PAGE = 20  # connections: six of the browser, its socket, and others that only wait
BACKLOG = 128  # connections accepted in one turn of the loop
SILENCE = 60.0  # s between two warnings of one cause
YOUNG = 5.0  # s that a connection is left alone
PAUSE = 1.0  # s without accepting after the system had no descriptor
EXHAUSTED = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)

most_connections = 0


class Complaint:
    """A warning that is logged once in a while, however often its cause comes back."""

    def __init__(self, message, clock=time.monotonic):
        self._message, self._clock, self._next = message, clock, 0.0

    def make(self):
        """Log the warning, unless that was done a short time ago."""
        now = self._clock()
        if now >= self._next:
            LOG.warning(self._message)
            self._next = now + SILENCE


def raise_limit():
    """Allow this process as many descriptors as the system lets it; return their number."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = MOST_DESCRIPTORS if hard == resource.RLIM_INFINITY else min(hard, MOST_DESCRIPTORS)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
        soft = wanted
    return MOST_DESCRIPTORS if soft == resource.RLIM_INFINITY else soft


def held(callback):
    """Number of connections of the server whose method takes new ones."""
    server = getattr(callback, "__self__", None)
    return len(getattr(server, "_connections", ())) + len(sessions.open_sockets)


class Accepted:
    """The connections that were accepted, the oldest first."""

    def __init__(self, clock=time.monotonic):
        self._clock = clock
        self._since = {}  # seconds by connection, in the order of their coming

    def add(self, connection):
        """Note a new connection."""
        self._since[connection] = self._clock()

    def end_oldest(self, in_use):
        """End the oldest connection that is no page's socket; return whether there was one.

        Young ones are spared: a request may be under way on them.
        """
        for one in [one for one in self._since if one.fileno() < 0]:
            del self._since[one]
        now = self._clock()
        for one, since in self._since.items():
            if now - since < YOUNG:
                return False
            if one.fileno() not in in_use:
                del self._since[one]
                with suppress(OSError):  # the other side was faster
                    one.shutdown(socket.SHUT_RDWR)
                return True
        return False


def page_sockets():
    """Descriptors of the sockets of pages, which are silent while nobody moves."""
    streams = [one.ws_connection and one.ws_connection.stream for one in sessions.open_sockets]
    return {stream.fileno() for stream in streams if stream and not stream.closed()}


def add_accept_handler(listener, callback):
    """Tornado's loop of accepting connections, with a bound and a pause.

    Tornado accepts without end; where no descriptor is left it fails in every turn of the loop,
    with a traceback each time, until one is free.
    """
    loop = IOLoop.current()
    too_many = Complaint(
        f"there are {most_connections} connections, as many as are allowed: the oldest are closed"
    )
    exhausted = Complaint("the system has no descriptor left: new connections wait")
    accepted = Accepted()
    removed = False

    def resume():
        if not removed:
            loop.add_handler(listener, accept, IOLoop.READ)

    def accept(fd, events):
        for _ in range(BACKLOG):
            if removed:
                return
            try:
                connection, address = listener.accept()
            except BlockingIOError:
                return
            except ConnectionAbortedError:
                continue
            except OSError as problem:
                if problem.errno not in EXHAUSTED:
                    raise
                exhausted.make()
                loop.remove_handler(listener)
                loop.call_later(PAUSE, resume)
                return
            if held(callback) >= most_connections:
                too_many.make()
                if not accepted.end_oldest(page_sockets()):
                    connection.close()
                    continue
            accepted.add(connection)
            callback(connection, address)

    def remove():
        nonlocal removed
        removed = True
        loop.remove_handler(listener)

    resume()
    return remove


def install(settings):
    """Bound the connections of this process's server."""
    global most_connections
    room = max(raise_limit() - RESERVED, 16)
    most_connections = min(room, RESERVED + A_PAGE * settings.max_sessions)
    replace(tornado_tcpserver, "add_accept_handler", add_accept_handler)
