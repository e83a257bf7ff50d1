"""Print-quality pictures, made in one worker process so that no slider waits for them.

Matplotlib needs about a second a picture and the server has one thread. The worker is
started at the first picture and again after it died; what it makes is kept, bounded.
"""

from __future__ import annotations

import multiprocessing
from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any

__all__ = ["Printer", "printer"]


class Printer:
    """Runs jobs (importable functions of hashable arguments) and keeps their results."""

    def __init__(self, keep: int = 64) -> None:
        self._keep = keep
        self._pool: ProcessPoolExecutor | None = None
        self._futures: OrderedDict[Hashable, Future[Any]] = OrderedDict()

    def submit(self, job: Callable[..., Any], *arguments: Hashable) -> Future[Any]:
        """Return the future of job(*arguments); the same one for the same job."""
        key = (job.__module__, job.__qualname__, arguments)
        known = self._futures.get(key)
        if known is not None and not (known.done() and known.exception()):
            self._futures.move_to_end(key)
            return known
        future = self._futures[key] = self._start(job, arguments)
        while len(self._futures) > self._keep:
            self._futures.popitem(last=False)
        return future

    def _start(self, job: Callable[..., Any], arguments: tuple[Hashable, ...]) -> Future[Any]:
        for _ in range(2):
            if self._pool is None:
                # spawn: a fork would carry the server's sockets along
                self._pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))
            try:
                return self._pool.submit(job, *arguments)
            except (BrokenProcessPool, RuntimeError):
                self._pool = None
        failed: Future[Any] = Future()
        failed.set_exception(RuntimeError("the picture process does not start"))
        return failed

    def close(self) -> None:
        """End the worker."""
        if self._pool is not None:
            self._pool.shutdown(wait=True, cancel_futures=True)
            self._pool = None


printer = Printer()
"""The server's one printer, shared by all sessions."""
