"""Processes of the server's own for work that would hold up its one thread.

A worker that is killed takes its processes along, and one that ends waits for one piece of
work at most.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic
from types import ModuleType
from typing import Any

from rotorstab import child

__all__ = ["Background", "background", "no_main", "start_pool"]


@contextmanager
def no_main() -> Iterator[None]:
    """Hide the main module: a spawned process would run it again, and while a session is
    built it is the app itself."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def start_pool(niceness: int = 0) -> ProcessPoolExecutor:
    """Return a pool of one process; submit to it under `no_main`."""
    # spawn: a fork would carry the server's sockets along
    return ProcessPoolExecutor(
        1, multiprocessing.get_context("spawn"), initializer=child.prepare, initargs=(niceness,)
    )


CROWD = 3  # that many who are active at once are busy, for this long [s] after a message of theirs
ACTIVE = 2.0
PAUSE = 0.3  # s without a message in a crowd, after which nobody is held up
PATIENCE = 3.0  # s; whoever has waited so long is served though a crowd is busy


@dataclass
class _Work:
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    requested: float = field(default_factory=monotonic)
    task: asyncio.Task[Any] | None = None
    wanted: int = 0
    begun: bool = False


class Background:
    """One process of low priority for work that may wait; equal work is done once.

    A low priority is not enough: cores share their caches and more, and while a class moves its
    sliders most of what it asks for is dropped soon. So in a crowd work waits for a pause.

    All calls come from the server's own loop, so nothing is locked.
    """

    def __init__(self, niceness: int = 19) -> None:
        self._niceness = niceness
        self._pool: ProcessPoolExecutor | None = None
        self._turn = asyncio.Lock()
        self._works: dict[Any, _Work] = {}
        self._active: dict[Any, float] = {}

    def touch(self, who: Any) -> None:
        """Note that a message of somebody is being answered."""
        self._active.pop(who, None)
        self._active[who] = monotonic()  # the latest is the last

    def _busy_until(self) -> float:
        """Return until when the server is busy with a crowd, if no more messages come."""
        now = monotonic()
        for who in [one for one, when in self._active.items() if now - when > ACTIVE]:
            del self._active[who]
        return [*self._active.values()][-1] + PAUSE if len(self._active) >= CROWD else 0.0

    def request(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Task[Any]:
        """Return the task of a call; the arguments can be hashed and pickled.

        Whoever no longer needs it says so with `withdraw`.
        """
        key = function, arguments
        work = self._works.get(key)
        if work is None:
            work = self._works[key] = _Work(function, arguments)
            work.task = asyncio.create_task(self._run(work))
        work.wanted += 1
        assert work.task is not None
        return work.task

    def withdraw(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Drop a call that nobody else waits for, unless it has begun."""
        work = self._works.get((function, arguments))
        if work is None:
            return
        work.wanted -= 1
        if work.wanted <= 0 and not work.begun and work.task is not None:
            self._forget(work)
            work.task.cancel()

    def _forget(self, work: _Work) -> None:
        key = work.function, work.arguments
        if self._works.get(key) is work:
            del self._works[key]

    async def _run(self, work: _Work) -> Any:
        async with self._turn:  # first come, first served
            await self._pause(work.requested + PATIENCE)
            work.begun = True
            try:
                return await self._call(work)
            finally:
                self._forget(work)

    async def _pause(self, latest: float) -> None:
        """Wait until no crowd is busy, but no longer than to a time."""
        while (now := monotonic()) < (until := min(latest, self._busy_until())):
            await asyncio.sleep(until - now)

    async def _call(self, work: _Work) -> Any:
        for last in (False, True):
            try:
                if self._pool is None:
                    self._pool = start_pool(self._niceness)
                with no_main():
                    future = self._pool.submit(work.function, *work.arguments)
                return await asyncio.wrap_future(future)
            except BrokenProcessPool:  # it was killed; the next one may live
                self._pool = None
                if last:
                    raise
        raise AssertionError("not reached")

    def close(self) -> None:
        """End the process, whatever it works on: nobody waits for it any more."""
        if self._pool is not None:
            for process in multiprocessing.active_children():
                process.kill()
            self._pool.shutdown(wait=True, cancel_futures=True)
            self._pool = None


background = Background()
"""The server's one process for settled maps, shared by all sessions."""
