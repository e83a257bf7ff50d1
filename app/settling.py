"""The full picture of one session, made in the background while the session answers others."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

import panel as pn
from bokeh.document import Document

from rotorstab.window import Window, floquet_map, whole_map

from .growth import Detail, keep, known_detail
from .processes import background

__all__ = ["Settling"]


def _next_step(window: Window) -> tuple[Any, ...] | None:
    """Return the function and arguments of what must be made next, None once all is there."""
    detail = known_detail(window)
    if detail == "map":
        return whole_map, window
    return None if detail else (floquet_map, window, True)


class Settling:
    """Asks for what a session waits for, first the map, then the rest of it; a newer one drops it.

    `show` is called on the server's loop when either is there, or could not be made elsewhere.
    """

    def __init__(self, show: Callable[[Detail], None]) -> None:
        self._show = show
        self._awaited: Window | None = None
        self._asked: tuple[Any, ...] | None = None
        if pn.state.curdoc is not None:
            pn.state.curdoc.on_session_destroyed(lambda _: self.drop())

    def detail(self, window: Window | None) -> Detail:
        """Return how much can be shown at once, and have the rest made.

        A window of None needs nothing.
        """
        document = pn.state.curdoc
        if window is None or document is None:  # without a server nobody else waits
            self.drop()
            return True
        if window != self._awaited:
            self.drop()
            self._awaited = window
            self._ask(document, window)
        return known_detail(window)

    def drop(self) -> None:
        """Wait no longer."""
        if self._asked is not None:
            background.withdraw(*self._asked)
        self._awaited = self._asked = None

    def _ask(self, document: Document, window: Window) -> None:
        self._asked = _next_step(window)
        if self._asked is not None:
            task = background.request(*self._asked)
            task.add_done_callback(partial(self._made, document, window, self._asked))

    def _made(
        self, document: Document, window: Window, asked: tuple[Any, ...], task: asyncio.Task[Any]
    ) -> None:
        if task.cancelled():
            return
        failed = task.exception() is not None
        if not failed:
            keep(window, task.result(), whole=asked[0] is whole_map)
        if window != self._awaited:
            return
        self._asked = None
        if not failed:
            self._ask(document, window)
        # what failed is tried once more where the problem can be told
        detail: Detail = True if failed else known_detail(window)
        if document.session_context:
            with suppress(RuntimeError):  # the session may have ended meanwhile
                document.add_next_tick_callback(partial(self._show_unless_moved, window, detail))

    def _show_unless_moved(self, window: Window, detail: Detail) -> None:
        if window == self._awaited:
            if detail is True:
                self._awaited = None
            self._show(detail)
