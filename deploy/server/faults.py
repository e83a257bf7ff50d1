"""Callbacks that try to end the process: they end themselves, and the log says so."""

import asyncio
import functools
import logging
import signal

from bokeh.server.server import BaseServer
from tornado.platform.asyncio import BaseAsyncIOLoop

log = logging.getLogger("rotorstab.faults")

run_until_shutdown = BaseServer.run_until_shutdown
loop_start = BaseAsyncIOLoop.start


class EndedItself(RuntimeError):
    """A callback raised SystemExit or KeyboardInterrupt."""


async def contain(awaitable):
    """The result; what would end the process becomes an error like any other."""
    try:
        return await awaitable
    except (SystemExit, KeyboardInterrupt) as error:
        raise EndedItself(f"a callback raised {type(error).__name__}") from error


@functools.wraps(loop_start)
def start(self):
    """Run the loop; a callback of its own, such as a timer, that exits does not end it."""
    while True:
        try:
            return loop_start(self)
        except (SystemExit, KeyboardInterrupt):
            log.exception("a callback tried to end the server")


@functools.wraps(run_until_shutdown)
def run(self):
    """Run until SIGTERM or Ctrl-C: both are handled by the loop and raise nothing in callbacks."""
    asyncio.get_event_loop().add_signal_handler(signal.SIGINT, lambda: self._sigterm())
    run_until_shutdown(self)


def install():
    """Keep this process's server alive until it is told to stop."""
    BaseAsyncIOLoop.start = start
    BaseServer.run_until_shutdown = run
