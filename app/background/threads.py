"""Which thread does what: one thread at a time works for the pages.

Panel 1.9 runs all callbacks of a server on the thread of its event loop. From Panel 1.10 on (Bokeh
3.10) the callbacks of different pages run in worker threads, at the same time. HoloViews, Pint and
the caches of the app are made for one thread, so whoever works for a page holds `turn`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from threading import RLock

import panel as pn

__all__ = ["Scheduler", "turn"]

turn = RLock()
"""Held by the thread that works for a page: builds it, answers its message or calls it back."""


def _in_turn(callback: Callable[[], None]) -> None:
    with turn:
        callback()


class Scheduler:
    """Calls functions, on request of any thread, with the lock of one page's document.

    It is made while the page is built: the document and the loop are those of that moment.
    """

    def __init__(self) -> None:
        self.document = pn.state.curdoc
        self._loop: asyncio.AbstractEventLoop | None = None
        with suppress(RuntimeError):  # no server runs, or it does not run yet
            self._loop = asyncio.get_running_loop()

    def call(self, callback: Callable[[], None]) -> None:
        """Call soon, or never where the session has ended; at once where there is no document."""
        if self.document is None:
            _in_turn(callback)
            return
        add = partial(self._add, partial(_in_turn, callback))
        with suppress(RuntimeError):  # the loop has ended
            # on the loop, because Bokeh gives a session the callbacks of its document there
            add() if self._loop is None else self._loop.call_soon_threadsafe(add)

    def _add(self, callback: Callable[[], None]) -> None:
        if self.document.session_context:
            with suppress(RuntimeError):  # the session has ended meanwhile
                self.document.add_next_tick_callback(callback)

    def at_end(self, callback: Callable[[], None]) -> None:
        """Call when the session ends."""
        if self.document is not None:
            self.document.on_session_destroyed(lambda _: _in_turn(callback))
