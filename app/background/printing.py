"""Files of figures and sheets, made one after the other by one process.

Matplotlib needs about a second for a picture; a table of a map takes half a second. The last files
are kept.
"""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Hashable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial
from threading import Lock
from typing import Any

from rotorstab.charts.sheet import Sheet
from rotorstab.drawing import printed, printed_sheet
from rotorstab.drawing.formats import TABLE_FORMATS
from rotorstab.paper import Figure

from .processes import Worker, settle

__all__ = ["Printer", "gather", "printer"]


@dataclass(eq=False)
class _Job:
    """A file that was requested."""

    figure: Figure | Sheet
    kind: str
    future: Future[bytes] = field(default_factory=Future)

    def begin(self, worker: Worker) -> Future[Any]:
        """Return the future of the process's call."""
        if isinstance(self.figure, Sheet):
            return worker.call(printed_sheet.sheet_files, self.figure, (self.kind,))
        if self.kind in TABLE_FORMATS:
            return worker.call(TABLE_FORMATS[self.kind].figure, self.figure)
        return worker.call(printed.figure_files, self.figure, (self.kind,))

    def end(self, made: Future[Any]) -> None:
        """Complete the file's future with the outcome of the call."""

        def data() -> bytes:
            if self.kind in TABLE_FORMATS:
                text: str = made.result()
                marked = TABLE_FORMATS[self.kind].marked_for_excel
                return text.encode("utf-8-sig" if marked else "utf-8")
            files: dict[str, bytes] = made.result()
            return files[self.kind]

        settle(self.future, data)


class Printer:
    """Makes files of figures and keeps the last `keep` ones; owners with requests take turns."""

    def __init__(self, keep: int = 64) -> None:
        self._keep = keep
        self._worker = Worker()
        self._lock = Lock()
        self._made: OrderedDict[Hashable, Future[bytes]] = OrderedDict()
        self._queues: OrderedDict[Hashable, deque[_Job]] = OrderedDict()  # by who asked
        self._waiting: dict[Future[bytes], _Job] = {}
        self._running = False

    def file(
        self, key: Hashable, figure: Figure | Sheet, kind: str, owner: Hashable = None
    ) -> Future[bytes]:
        """Return the future of a figure's file, or of a sheet's.

        Parameters
        ----------
        key : hashable
            What the figure shows; the same key and kind give the same future.
        figure : Figure or Sheet
        kind : str
            A name in `rotorstab.drawing.formats.FORMATS`; for a sheet in `PICTURE_FORMATS`.
        owner : hashable
            On whose behalf the file is made. Of two owners with requests each has every second
            turn.
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
            if future in self._waiting:  # another owner who asked may have a longer queue
                self._queues.setdefault(owner, deque()).append(self._waiting[future])
        self._go_on()
        return future

    def _next(self) -> _Job | None:
        """Return the first file of the owner whose turn it is, or None."""
        with self._lock:
            while self._queues and not self._running:
                owner, queue = self._queues.popitem(last=False)
                job = queue.popleft()
                if queue:
                    self._queues[owner] = queue  # the owner is now the last one
                if self._waiting.pop(job.future, None) is not None:
                    self._running = True
                    return job
        return None

    def _go_on(self) -> None:
        """Begin the next file, unless one is being made."""
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
        """Cancel the files that this owner waits for and nobody else does."""
        with self._lock:
            left = self._queues.pop(owner, ())
            wanted = {job for queue in self._queues.values() for job in queue}
            own = [job.future for job in left if job not in wanted]
            # those that are not begun
            dropped = [future for future in own if self._waiting.pop(future, None)]
        for future in dropped:
            future.cancel()

    def pending(self) -> int:
        """Return the number of files that are being made or wait for their turn."""
        with self._lock:
            return len(self._waiting) + self._running

    def pids(self) -> list[int]:
        """Return the ids of the processes that are alive."""
        return self._worker.pids()

    def close(self) -> None:
        """Cancel the files that are not begun, and end the process after its present one."""
        with self._lock:
            dropped = list(self._waiting)
            self._waiting.clear()
            self._queues.clear()
        for future in dropped:
            future.cancel()
        self._worker.close()


def gather(futures: Sequence[Future[bytes]]) -> Future[list[bytes]]:
    """Return the future of all results in order; it fails if any of them failed."""
    together: Future[list[bytes]] = Future()
    left = len(futures)
    lock = Lock()

    def count(_: Future[bytes]) -> None:
        nonlocal left
        with lock:
            left -= 1
            last = left == 0
        if last:
            settle(together, lambda: [future.result() for future in futures])

    for future in futures:
        future.add_done_callback(count)
    return together


printer = Printer()
"""The one printer, shared by all sessions of this server process."""
