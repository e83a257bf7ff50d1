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
from dataclasses import dataclass
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


@dataclass
class _Work:
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    task: asyncio.Task[Any] | None = None
    wanted: int = 0
    begun: bool = False


class Background:
    """One process of low priority for work that may wait; equal work is done once.

    All calls come from the server's own loop, so nothing is locked.
    """

    def __init__(self, niceness: int = 19) -> None:
        self._niceness = niceness
        self._pool: ProcessPoolExecutor | None = None
        self._turn = asyncio.Lock()
        self._works: dict[Any, _Work] = {}

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
            work.begun = True
            try:
                return await self._call(work)
            finally:
                self._forget(work)

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
