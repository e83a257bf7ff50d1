"""How messages are written to a page.

Arrays are sent within their message: a frame and a system call for each cost more than the third
by which text is longer.

Writing to a page that has just gone is no error. Panel writes a message in parts and keeps their
futures once all have begun. Where the socket closes in between, the first future is lost with its
`WebSocketClosedError`, and asyncio logs a traceback for an error that nobody could handle. Here
each such future is looked at.
"""

from __future__ import annotations

import logging
from asyncio import Future
from functools import cache, partial, wraps
from importlib import import_module
from typing import Any

from bokeh.core.serialization import Serializer
from bokeh.settings import settings
from tornado.websocket import WebSocketClosedError, WebSocketHandler

__all__ = ["install"]

_LOG = logging.getLogger("rotorstab.app")
_write = WebSocketHandler.write_message


def _look(future: Future[None]) -> None:
    if future.cancelled():
        return
    error = future.exception()
    if error is not None and not isinstance(error, WebSocketClosedError):
        # looked at here, so asyncio will not tell
        _LOG.error("a message could not be sent", exc_info=error)


@wraps(_write)
def _write_and_look(self: WebSocketHandler, *args: Any, **kwargs: Any) -> Future[None]:
    future = _write(self, *args, **kwargs)
    future.add_done_callback(_look)
    return future


@cache
def _tell(words: str) -> None:
    _LOG.warning(words)


def install() -> None:
    """Look at every write of this process; calling it again changes nothing."""
    patches = import_module("bokeh.protocol.messages.patch_doc")
    if hasattr(patches, "Serializer"):
        patches.Serializer = partial(Serializer, deferred=False)
    else:
        _tell("this Bokeh sends arrays apart from their messages: pages will be slower")
    settings.compression_level = 0  # the network of a lab is faster than gzip
    WebSocketHandler.write_message = _write_and_look
