"""The full picture of one session, made in the background while the session answers others."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from functools import partial

import panel as pn
from bokeh.document import Document

from rotorstab.window import FloquetMap, Window, floquet_map

from .growth import keep
from .processes import background

__all__ = ["Settling"]


class Settling:
    """Asks for the map that a session waits for, one at a time; a newer one drops the older.

    `show` is called on the server's loop when the map is there, or could not be made elsewhere.
    """

    def __init__(self, show: Callable[[], None]) -> None:
        self._show = show
        self._awaited: Window | None = None
        if pn.state.curdoc is not None:
            pn.state.curdoc.on_session_destroyed(lambda _: self._drop())

    def is_there(self, window: Window | None) -> bool:
        """Whether nothing must be made first; else have it made. None: nothing is needed."""
        document = pn.state.curdoc
        if window is None or document is None:  # without a server nobody else waits
            self._drop()
            return True
        if window != self._awaited:
            self._drop()
            self._awaited = window
            task = background.request(floquet_map, window, True)
            task.add_done_callback(partial(self._made, document, window))
        return False

    def _drop(self) -> None:
        if self._awaited is not None:
            background.withdraw(floquet_map, self._awaited, True)
            self._awaited = None

    def _made(self, document: Document, window: Window, task: asyncio.Task[FloquetMap]) -> None:
        if task.cancelled():
            return
        if task.exception() is None:  # else `show` meets the same problem and tells it
            keep(window, task.result())
        if window != self._awaited:
            return
        self._awaited = None
        if document.session_context:
            with suppress(RuntimeError):  # the session may have ended meanwhile
                document.add_next_tick_callback(self._show_unless_moved)

    def _show_unless_moved(self) -> None:
        if self._awaited is None:
            self._show()
