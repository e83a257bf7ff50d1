"""Processes of the server for work that would block its pages.

A server process that is killed ends its own processes too. Any thread may use everything here.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import CancelledError, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing.context import SpawnContext, SpawnProcess
from threading import Lock, Thread
from time import monotonic, sleep
from types import ModuleType
from typing import Any

from . import child

__all__ = ["Background", "Worker", "background", "settle"]

_main = Lock()  # held while the main module is hidden


@contextmanager
def _no_main() -> Iterator[None]:
    """Hide the main module while a process is spawned, which would run it again."""
    with _main:
        main = sys.modules["__main__"]
        sys.modules["__main__"] = ModuleType("__main__")
        try:
            yield
        finally:
            sys.modules["__main__"] = main


def settle(future: Future[Any], result: Callable[[], Any]) -> None:
    """Complete a future with what `result` returns or raises, unless it is complete."""
    if future.done() or not (future.running() or future.set_running_or_notify_cancel()):
        return
    try:
        made = result()
    except BaseException as problem:  # a CancelledError too: whoever waits must know
        future.set_exception(problem)
    else:
        future.set_result(made)


def _failed(problem: Exception) -> Future[Any]:
    """Return a future that has failed, or a cancelled one if the interpreter is ending."""
    failed: Future[Any] = Future()
    if isinstance(problem, RuntimeError) and not isinstance(problem, BrokenProcessPool):
        failed.cancel()
    else:
        failed.set_exception(problem)
    return failed


class _Spawn(SpawnContext):
    """Starts processes without a fork, which would inherit the server's sockets, and lists them."""

    def __init__(self) -> None:
        super().__init__()
        self.started: list[SpawnProcess] = []

    def Process(self, *args: Any, **kwargs: Any) -> SpawnProcess:  # type: ignore[override]
        """Return a new process; the pool uses this name like the class."""
        self.started.append(SpawnProcess(*args, **kwargs))
        return self.started[-1]


class Worker:
    """One process that makes one call after the other.

    The process starts with the first call; after it has died another one starts with the next call.

    Parameters
    ----------
    niceness : int
        By which the priority of the process is lowered, 0 to 19.
    """

    def __init__(self, niceness: int = 0) -> None:
        self._niceness = niceness
        self._lock = Lock()
        self._pool: ProcessPoolExecutor | None = None
        self._spawn = _Spawn()

    def call(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Return the future of a call; the future fails if no process can be started."""
        with self._lock:
            for last in (False, True):
                try:
                    if self._pool is None:
                        self._pool = self._started()
                    with _no_main():
                        return self._pool.submit(function, *arguments)
                except Exception as problem:  # it was killed, or memory is exhausted
                    self._pool = None
                    if last:
                        return _failed(problem)
        raise AssertionError("not reached")

    def _started(self) -> ProcessPoolExecutor:
        self._spawn = _Spawn()
        return ProcessPoolExecutor(1, self._spawn, child.prepare, (self._niceness,))

    def pids(self) -> list[int]:
        """Return the ids of the processes that are alive."""
        return [
            process.pid for process in self._spawn.started if process.pid and process.is_alive()
        ]

    def close(self, kill: bool = False) -> None:
        """End the process: after its present call or, with `kill`, at once."""
        with self._lock:
            pool, self._pool = self._pool, None
        if pool is not None:
            if kill:
                for process in self._spawn.started:
                    process.kill()
            pool.shutdown(wait=True, cancel_futures=True)


CROWD = 3
"""Number of sessions active at the same time from which on background work is postponed."""
ACTIVE = 2.0
"""Seconds for which a session counts as active after its last message."""
PAUSE = 0.3
"""Seconds without a message of any session after which postponed work begins."""
PATIENCE = 3.0
"""Seconds after which postponed work begins in any case."""


@dataclass
class _Work:
    """A call that was requested.

    Parameters
    ----------
    function, arguments
        The call.
    requested : float
        Time of the first request.
    future : Future
        Of the result.
    wanted : int
        Number of requests that were not withdrawn.
    begun : bool
        Whether the process works on it.
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    requested: float
    future: Future[Any] = field(default_factory=Future)
    wanted: int = 0
    begun: bool = False


class Background:
    """One process of low priority for work that may be postponed; equal work is done once.

    A low priority is not enough: a busy core slows down the others, since they share caches and
    memory. While a class moves its sliders, most requests are withdrawn soon. So while many
    sessions are active, work waits for a pause.
    """

    def __init__(self, niceness: int = 19) -> None:
        self._worker = Worker(niceness)
        self._lock = Lock()
        self._works: dict[Hashable, _Work] = {}  # the oldest first
        self._active: dict[Hashable, float] = {}
        self._serving = False  # whether a thread waits for the works' turns
        self._closed = False

    def touch(self, who: Hashable) -> None:
        """Note that a message of a session is being answered."""
        with self._lock:
            self._active.pop(who, None)
            self._active[who] = monotonic()  # the latest is the last

    def is_quiet(self, seconds: float) -> bool:
        """Whether no session has sent a message for some time."""
        with self._lock:
            return all(monotonic() - at >= seconds for at in self._active.values())

    def request(self, function: Callable[..., Any], *arguments: Hashable) -> Future[Any]:
        """Return the future of a call whose arguments can be pickled and hashed.

        Whoever no longer needs the result calls `withdraw`.
        """
        key = function, arguments
        with self._lock:
            work = self._works.get(key) or _Work(function, arguments, monotonic())
            if self._closed:
                work.future.cancel()
                return work.future
            if not self._serving:
                try:
                    Thread(target=self._serve, name="background", daemon=True).start()
                except RuntimeError as problem:  # memory is exhausted
                    work.future.set_exception(problem)
                    return work.future
                self._serving = True
            self._works[key] = work
            work.wanted += 1
            return work.future

    def withdraw(self, function: Callable[..., Any], *arguments: Hashable) -> None:
        """Cancel a call that nobody else waits for, unless it has begun."""
        key = function, arguments
        with self._lock:
            work = self._works.get(key)
            if work is None:
                return
            work.wanted -= 1
            if work.wanted > 0 or work.begun:
                return
            del self._works[key]
        work.future.cancel()

    def pending(self) -> int:
        """Return the number of calls that are being made or wait for their turn."""
        with self._lock:
            return len(self._works)

    def _serve(self) -> None:
        """Make the requested calls in their order until none is left."""
        while (work := self._next()) is not None:
            result = self._call(work)
            with self._lock:
                del self._works[work.function, work.arguments]
            settle(work.future, result)

    def _call(self, work: _Work) -> Callable[[], Any]:
        """Make a call and wait for it; return a function that returns or raises its outcome."""
        for last in (False, True):
            made = self._worker.call(work.function, *work.arguments)
            with suppress(CancelledError):
                killed = isinstance(made.exception(), BrokenProcessPool)
                if killed and not last and not self._closed:
                    continue  # another process may survive the call
            break
        return made.result

    def _next(self) -> _Work | None:
        """Wait for a pause; return the oldest work, or None if there is none."""
        while True:
            with self._lock:
                work = next(iter(self._works.values()), None)
                if work is None:
                    self._serving = False
                    return None
                wait = min(work.requested + PATIENCE, self._busy_until()) - monotonic()
                if wait <= 0:
                    work.begun = True
                    return work
            sleep(wait)

    def _busy_until(self) -> float:
        """Return the time at which a pause begins if no more messages come."""
        now = monotonic()
        for who, last in list(self._active.items()):
            if now - last > ACTIVE:
                del self._active[who]
        return [*self._active.values()][-1] + PAUSE if len(self._active) >= CROWD else 0.0

    def close(self) -> None:
        """End the process at once: nobody waits for its work any more."""
        with self._lock:
            self._closed = True
            waiting = [key for key, work in self._works.items() if not work.begun]
            dropped = [self._works.pop(key) for key in waiting]
        for work in dropped:
            work.future.cancel()
        self._worker.close(kill=True)


background = Background()
"""The one process that makes full maps, shared by all sessions of this server process."""
