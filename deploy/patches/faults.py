"""Callbacks that try to end the process: only the callback ends, and the log says so."""

from __future__ import annotations

import functools
import logging
from collections.abc import Awaitable
from typing import TypeVar

from tornado.platform.asyncio import BaseAsyncIOLoop

from ..settings import Settings
from .patching import replace

LOG = logging.getLogger("rotorstab.faults")
T = TypeVar("T")

loop_start = BaseAsyncIOLoop.start


class EndedItself(RuntimeError):
    """A callback raised SystemExit or KeyboardInterrupt."""


async def contain(awaitable: Awaitable[T]) -> T:
    """Return the result of an awaitable.

    Raises
    ------
    EndedItself
        Where it raised SystemExit or KeyboardInterrupt, which would end the process.
    """
    try:
        return await awaitable
    except (SystemExit, KeyboardInterrupt) as error:
        raise EndedItself(f"a callback raised {type(error).__name__}") from error


@functools.wraps(loop_start)
def start(self: BaseAsyncIOLoop) -> None:
    """Run the loop, and go on where one of its own callbacks, such as a timer, exits."""
    while True:
        try:
            return loop_start(self)
        except (SystemExit, KeyboardInterrupt):
            LOG.exception("a callback tried to end the server")


def install(settings: Settings | None) -> None:
    """Keep this process's server alive until it is told to stop."""
    replace(BaseAsyncIOLoop, "start", start)
