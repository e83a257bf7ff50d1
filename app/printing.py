"""Files of figures: tables at once, pictures from one worker process.

Matplotlib needs about a second a picture and the server has one thread, so a worker draws.
It is started at the first picture and again after it died; what it makes is kept, bounded.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from threading import Lock

from rotorstab import export, plots_paper
from rotorstab.figures import Figure

from .processes import no_main, start_pool

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
_TABLES = {"csv": export.figure_csv, "json": export.figure_json}


class Printer:
    """Makes files of figures and keeps the last ones."""

    def __init__(self, keep: int = 64) -> None:
        self._keep = keep
        self._pool: ProcessPoolExecutor | None = None
        self._made: OrderedDict[Hashable, Future[bytes]] = OrderedDict()

    def file(self, key: Hashable, figure: Figure, kind: str) -> Future[bytes]:
        """Return the future of a figure's file of one kind, one of `FORMATS`.

        `key` says what the figure shows; the same key and kind give the same future.
        """
        known = self._made.get((key, kind))
        if known is not None and not (known.done() and known.exception()):
            self._made.move_to_end((key, kind))
            return known
        future = self._made[key, kind] = self._make(figure, kind)
        while len(self._made) > self._keep:
            self._made.popitem(last=False)
        return future

    def _make(self, figure: Figure, kind: str) -> Future[bytes]:
        made: Future[bytes] = Future()
        if kind in _TABLES:
            # Excel reads UTF-8 only behind a byte order mark
            made.set_result(_TABLES[kind](figure).encode("utf-8-sig" if kind == "csv" else "utf-8"))
            return made

        def hand_on(drawn: Future[dict[str, bytes]]) -> None:
            problem = drawn.exception()
            if problem is None:
                made.set_result(drawn.result()[kind])
            else:
                made.set_exception(problem)

        self._draw(figure, kind).add_done_callback(hand_on)
        return made

    def _draw(self, figure: Figure, kind: str) -> Future[dict[str, bytes]]:
        for _ in range(2):
            if self._pool is None:
                self._pool = start_pool()
            try:
                with no_main():
                    return self._pool.submit(plots_paper.figure_files, figure, (kind,))
            except (BrokenProcessPool, RuntimeError):
                self._pool = None
        failed: Future[dict[str, bytes]] = Future()
        failed.set_exception(RuntimeError("the picture process does not start"))
        return failed

    def pending(self) -> int:
        """Return the number of files that are being made."""
        return sum(not future.done() for future in self._made.values())

    def close(self) -> None:
        """End the worker."""
        if self._pool is not None:
            self._pool.shutdown(wait=True, cancel_futures=True)
            self._pool = None


def gather(futures: Sequence[Future[bytes]]) -> Future[list[bytes]]:
    """Return the future of all results, in order; the first failure fails it."""
    together: Future[list[bytes]] = Future()
    lock = Lock()

    def check(_: Future[bytes]) -> None:
        with lock:
            if together.done() or not all(one.done() for one in futures):
                return
            problems = [one.exception() for one in futures]
            failed = next((problem for problem in problems if problem is not None), None)
            if failed is None:
                together.set_result([one.result() for one in futures])
            else:
                together.set_exception(failed)

    for one in futures:
        one.add_done_callback(check)
    return together


printer = Printer()
"""The server's one printer, shared by all sessions."""
