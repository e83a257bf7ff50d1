"""The full picture of one session, made in the background while the session answers others."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from typing import Any

from rotorstab.maps.window import Window, floquet_map, whole_map

from ..results.growth_maps import Detail, keep, known_detail
from .processes import background
from .threads import Scheduler

__all__ = ["Settling"]


def _next_step(window: Window) -> tuple[Any, ...] | None:
    """Return the function and arguments of what must be made next, None once all is there."""
    detail = known_detail(window)
    if detail == "map":
        return whole_map, window
    return None if detail else (floquet_map, window, True)


class Settling:
    """Asks for what a session waits for, first the map, then the rest of it.

    A newer request cancels it. `show` is called by the scheduler when either is there, or could
    not be made elsewhere.
    """

    def __init__(self, show: Callable[[Detail], None], scheduler: Scheduler) -> None:
        self._show = show
        self._scheduler = scheduler
        self._awaited: Window | None = None
        self._asked: tuple[Any, ...] | None = None
        scheduler.at_end(self.drop)

    def detail(self, window: Window | None) -> Detail:
        """Return how much can be shown at once, and have the rest made.

        A window of None needs nothing.
        """
        if window is None or self._scheduler.document is None:  # without a server nobody waits
            self.drop()
            return True
        if window != self._awaited:
            self.drop()
            self._ask(window)
            self._awaited = window
        return known_detail(window)

    def drop(self) -> None:
        """Wait no longer."""
        asked, self._asked = self._asked, None
        self._awaited = None
        if asked is not None:
            background.withdraw(*asked)

    def _ask(self, window: Window) -> None:
        step = _next_step(window)
        if step is not None:
            made = background.request(*step)
            self._asked = step
            made.add_done_callback(partial(self._made, window, step))

    def _made(self, window: Window, step: tuple[Any, ...], made: Future[Any]) -> None:
        """Keep what was made for everybody, from whatever thread, and have it shown."""
        if made.cancelled():
            return
        failed = made.exception() is not None
        if not failed:
            keep(window, made.result(), whole=step[0] is whole_map)
        self._scheduler.call(partial(self._arrived, window, failed))

    def _arrived(self, window: Window, failed: bool) -> None:
        if window != self._awaited:
            return
        self._asked = None
        if not failed:
            self._ask(window)
        # what failed is tried once more where the problem can be told
        detail: Detail = True if failed else known_detail(window)
        if detail is True:
            self._awaited = None
        self._show(detail)
