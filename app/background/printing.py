"""Files of figures, made one after the other by one worker process.

Matplotlib needs about a second for a picture, a table of a map takes half of one. What is made is
kept, bounded.
"""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Callable, Hashable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial
from threading import Lock
from typing import Any

from rotorstab.drawing import printed, tables
from rotorstab.paper import Figure

from .processes import Worker, settle

__all__ = ["FORMATS", "MIME", "Printer", "gather", "printer"]

MIME = {
    "pdf": "application/pdf",
    "svg": "image/svg+xml",
    "png": "image/png",
    "csv": "text/csv",
    "json": "application/json",
    "html": "text/html",
}
FORMATS = ("pdf", "svg", "png", "csv", "json")
_TABLES: dict[str, Callable[[Figure], str]] = {
    "csv": tables.figure_csv,
    "json": tables.figure_json,
}


@dataclass(eq=False)
class _Job:
    """A file to be made."""

    figure: Figure
    kind: str
    future: Future[bytes] = field(default_factory=Future)

    def begin(self, worker: Worker) -> Future[Any]:
        if self.kind in _TABLES:
            return worker.call(_TABLES[self.kind], self.figure)
        return worker.call(printed.figure_files, self.figure, (self.kind,))

    def end(self, made: Future[Any]) -> None:
        def data() -> bytes:
            if self.kind in _TABLES:
                text: str = made.result()
                # Excel reads UTF-8 only behind a byte order mark
                return text.encode("utf-8-sig" if self.kind == "csv" else "utf-8")
            files: dict[str, bytes] = made.result()
            return files[self.kind]

        settle(self.future, data)


class Printer:
    """Makes files of figures and keeps the last ones. Those who ask are served in turns."""

    def __init__(self, keep: int = 64) -> None:
        self._keep = keep
        self._worker = Worker()
        self._lock = Lock()
        self._made: OrderedDict[Hashable, Future[bytes]] = OrderedDict()
        self._queues: OrderedDict[Hashable, deque[_Job]] = OrderedDict()  # by who asked
        self._waiting: dict[Future[bytes], _Job] = {}
        self._running = False

    def file(
        self, key: Hashable, figure: Figure, kind: str, owner: Hashable = None
    ) -> Future[bytes]:
        """Return the future of a figure's file of one kind, one of `FORMATS`.

        `key` says what the figure shows; the same key and kind give the same future. `owner` is
        whoever asks: of two owners with files to be made, each has every second turn.
        """
        with self._lock:
            future = self._made.get((key, kind))
            if future is None or (future.done() and (future.cancelled() or future.exception())):
                job = _Job(figure, kind)
                future = self._made[key, kind] = job.future
                self._waiting[future] = job
                while len(self._made) > self._keep:
                    self._made.popitem(last=False)
            self._made.move_to_end((key, kind))
            if future in self._waiting:  # whoever else asked may have a longer queue
                self._queues.setdefault(owner, deque()).append(self._waiting[future])
        self._go_on()
        return future

    def _next(self) -> _Job | None:
        """Take the first file of the owner whose turn it is."""
        with self._lock:
            while self._queues and not self._running:
                owner, queue = self._queues.popitem(last=False)
                job = queue.popleft()
                if queue:
                    self._queues[owner] = queue  # the last of all owners again
                if self._waiting.pop(job.future, None) is not None:
                    self._running = True
                    return job
        return None

    def _go_on(self) -> None:
        while (job := self._next()) is not None:
            made = job.begin(self._worker)
            if not made.done():
                made.add_done_callback(partial(self._end, job))
                return
            self._finish(job, made)

    def _finish(self, job: _Job, made: Future[Any]) -> None:
        with self._lock:
            self._running = False
        job.end(made)

    def _end(self, job: _Job, made: Future[Any]) -> None:
        self._finish(job, made)
        self._go_on()

    def drop(self, owner: Hashable) -> None:
        """Cancel what an owner waits for and nobody else does."""
        with self._lock:
            left = self._queues.pop(owner, ())
            wanted = {job for queue in self._queues.values() for job in queue}
            own = [job.future for job in left if job not in wanted]
            dropped = [future for future in own if self._waiting.pop(future, None)]  # not begun
        for future in dropped:
            future.cancel()

    def pending(self) -> int:
        """Return the number of files that are being made or wait for it."""
        with self._lock:
            return len(self._waiting) + self._running

    def pids(self) -> list[int]:
        """Return the ids of the processes that live."""
        return self._worker.pids()

    def close(self) -> None:
        """End the process after the file that it makes; the others are cancelled."""
        with self._lock:
            dropped = list(self._waiting)
            self._waiting.clear()
            self._queues.clear()
        for future in dropped:
            future.cancel()
        self._worker.close()


def gather(futures: Sequence[Future[bytes]]) -> Future[list[bytes]]:
    """Return the future of all results, in order; the first failure fails it."""
    together: Future[list[bytes]] = Future()
    left = len(futures)
    lock = Lock()

    def count(_: Future[bytes]) -> None:
        nonlocal left
        with lock:
            left -= 1
            last = left == 0
        if last:
            settle(together, lambda: [one.result() for one in futures])

    for one in futures:
        one.add_done_callback(count)
    return together


printer = Printer()
"""The server's one printer, shared by all sessions."""
