"""Callbacks that try to end the process: they end themselves, and the log says so."""

import functools
import logging

from tornado.platform.asyncio import BaseAsyncIOLoop

from .patching import replace

log = logging.getLogger("rotorstab.faults")

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


def install(settings):
    """Keep this process's server alive until it is told to stop."""
    replace(BaseAsyncIOLoop, "start", start)
