"""How messages are written to a page.

Arrays are sent within their message: a frame and a system call for each array cost more than the
third by which text is longer.

Writing to a page that has just gone is no error. Panel writes a message in parts and keeps the
futures of the parts once all writes have begun. Where the socket closes in between, the first
future is lost with its `WebSocketClosedError`, and asyncio logs a traceback for an error that
nobody could handle. Here the result of each such future is taken.
"""

from __future__ import annotations

import logging
from asyncio import Future
from functools import cache, partial, wraps
from inspect import getmodule
from typing import Any

from bokeh.core.serialization import Serializer
from bokeh.protocol.messages import patch_doc
from bokeh.settings import settings
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from .patching import replace

__all__ = ["install"]

LOG = logging.getLogger("rotorstab.app")
write_message = WebSocketHandler.write_message


def take_result(future: Future[None]) -> None:
    """Log the error of a write, unless the socket was only closed."""
    if future.cancelled():
        return
    error = future.exception()  # asyncio logs nothing about an error that was taken
    if error is not None and not isinstance(error, WebSocketClosedError):
        LOG.error("a message could not be sent", exc_info=error)


@wraps(write_message)
def write_and_look(self: WebSocketHandler, *args: Any, **kwargs: Any) -> Future[None]:
    """Write a message, and take the result of the write."""
    future = write_message(self, *args, **kwargs)
    future.add_done_callback(take_result)
    return future


@cache
def warn(message: str) -> None:
    """Log a warning once."""
    LOG.warning(message)


def install() -> None:
    """Change how this process writes to its pages; calling it again changes nothing."""
    module: Any = getmodule(patch_doc)  # its package has the class of the same name in its place
    if hasattr(module, "Serializer"):
        module.Serializer = partial(Serializer, deferred=False)
    else:
        warn("this Bokeh sends arrays apart from their messages: pages will be slower")
    settings.compression_level = 0  # the network of a lab is faster than gzip
    replace(WebSocketHandler, "write_message", write_and_look)
