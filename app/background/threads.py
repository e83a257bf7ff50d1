"""Threads: one at a time works for the pages.

Panel 1.9 runs all callbacks of a server on the thread of its event loop. From Panel 1.10 on (Bokeh
3.10) the callbacks of different pages run in worker threads, at the same time. HoloViews, Pint and
the charts of the app are made for one thread, so a thread that works for a page holds `turn`.
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
"""The lock of the thread that builds a page, answers its message or runs its callback."""


def _in_turn(callback: Callable[[], None]) -> None:
    with turn:
        callback()


class Scheduler:
    """Calls functions under the lock of one page's document; any thread may request a call.

    It is created while the page is built, and belongs to the document and the event loop of that
    moment.
    """

    def __init__(self) -> None:
        self.document = pn.state.curdoc
        self._loop: asyncio.AbstractEventLoop | None = None
        with suppress(RuntimeError):  # no server runs, or it does not run yet
            self._loop = asyncio.get_running_loop()

    def call(self, callback: Callable[[], None]) -> None:
        """Call a function soon: at once if there is no document, never if the session has ended."""
        if self.document is None:
            _in_turn(callback)
            return
        add = partial(self._add, partial(_in_turn, callback))
        with suppress(RuntimeError):  # the loop has ended
            # on the loop: only there Bokeh takes callbacks of a document
            add() if self._loop is None else self._loop.call_soon_threadsafe(add)

    def _add(self, callback: Callable[[], None]) -> None:
        if self.document.session_context:
            with suppress(RuntimeError):  # the session has ended meanwhile
                self.document.add_next_tick_callback(callback)

    def call_later(self, seconds: float, callback: Callable[[], None]) -> None:
        """Call a function after some time; never without a document or once the session ended."""
        loop = self._loop
        if self.document is not None and loop is not None:
            with suppress(RuntimeError):  # the loop has ended
                loop.call_soon_threadsafe(loop.call_later, seconds, self.call, callback)

    def at_end(self, callback: Callable[[], None]) -> None:
        """Call a function when the session ends."""
        if self.document is not None:
            self.document.on_session_destroyed(lambda _: _in_turn(callback))
