"""The full picture of one session, made in the background while the session goes on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from functools import partial

from ..results.growth_maps import keep, known_detail
from ..results.limits import Detail
from ..results.window import FloquetMap, Window, floquet_map
from .processes import background
from .threads import Scheduler

__all__ = ["Ahead", "Settling"]


class Settling:
    """Has the full picture of a session made.

    A newer request cancels an older one. `show` is called by the scheduler when the map is there,
    or could not be made in the background.
    """

    def __init__(self, show: Callable[[Detail], None], scheduler: Scheduler) -> None:
        self._show = show
        self._scheduler = scheduler
        self._awaited: Window | None = None
        scheduler.at_end(self.drop)

    def detail(self, window: Window | None) -> Detail:
        """Return how fine a picture can be shown at once, and have the full one made.

        A window of None needs nothing.
        """
        # without a server no page waits for a finer picture
        if window is None or self._scheduler.document is None:
            self.drop()
            return Detail.FULL
        if window != self._awaited:
            self.drop()
            if known_detail(window) is Detail.FULL:
                return Detail.FULL
            made = background.request(floquet_map, window, Detail.FULL)
            self._awaited = window
            made.add_done_callback(partial(self._made, window))
        return known_detail(window)

    def drop(self) -> None:
        """Cancel what was requested: this session no longer waits for it."""
        window, self._awaited = self._awaited, None
        if window is not None:
            background.withdraw(floquet_map, window, Detail.FULL)

    def _made(self, window: Window, made: Future[FloquetMap]) -> None:
        """Keep a map for all sessions and have it shown; any thread may call this."""
        if made.cancelled():
            return
        if made.exception() is None:
            keep(window, Detail.FULL, made.result())
        self._scheduler.call(partial(self._arrived, window))

    def _arrived(self, window: Window) -> None:
        if window == self._awaited:
            self._awaited = None
            # the session makes what failed itself: it can show the reason on its page
            self._show(Detail.FULL)


class Ahead:
    """Has full maps made that a page shows besides its own, one after the other.

    `show` is called by the scheduler when one of them is there, or could not be made.
    """

    def __init__(self, show: Callable[[], None], scheduler: Scheduler) -> None:
        self._show = show
        self._settling = Settling(self._made, scheduler)
        self._wanted: Window | None = None
        self._given_up: set[Window] = set()

    def request(self, windows: Sequence[Window]) -> None:
        """Have the first of some maps made, but those that could not be made before."""
        self._wanted = next((one for one in windows if one not in self._given_up), None)
        if self._wanted is None:
            self._settling.drop()
        else:
            self._settling.detail(self._wanted)

    def drop(self) -> None:
        """Cancel what was requested; what could not be made may be tried again."""
        self._settling.drop()
        self._given_up.clear()

    def _made(self, detail: Detail) -> None:
        if detail is not Detail.FULL or self._wanted is None:
            return
        if known_detail(self._wanted) is not Detail.FULL:
            self._given_up.add(self._wanted)
        self._show()
