"""Every reply: security headers, no version of the server, no traceback."""

from __future__ import annotations

import functools
from typing import Any

from bokeh.server.connection import ServerConnection
from tornado.web import RequestHandler

from ..constants import HEADERS
from ..error_pages import error_page, retry_seconds
from ..settings import Settings
from .patching import replace
from .sessions import draining

tornado_clear = RequestHandler.clear
connection_error = ServerConnection.error


@functools.wraps(tornado_clear)
def clear(self: RequestHandler) -> None:
    """Reset the reply. Handlers override `set_default_headers`; none overrides this method."""
    tornado_clear(self)
    self.clear_header("Server")
    for name, value in HEADERS.items():
        self.set_header(name, value)


def write_error(self: RequestHandler, status_code: int, **kwargs: Any) -> None:
    """Finish with a short page, whatever `serve_traceback` says; the log has the details."""
    if seconds := retry_seconds(status_code, draining.is_set()):
        self.set_header("Retry-After", str(seconds))
    self.set_header("Content-Type", "text/html; charset=UTF-8")
    self.set_header("Cache-Control", "no-store")
    prefix = getattr(self.application, "prefix", "")
    self.finish(error_page(status_code, draining.is_set(), prefix))


@functools.wraps(connection_error)
def error_reply(self: Any, message: Any, text: str) -> Any:
    """Return Bokeh's reply to a message on which it failed, without the traceback and its paths."""
    reply = connection_error(self, message, "the server could not use this message")
    reply.content = {"text": reply.content["text"], "traceback": None}
    return reply


def install(settings: Settings | None) -> None:
    """Give every reply of this process its headers and plain error pages."""
    replace(RequestHandler, "clear", clear)
    replace(RequestHandler, "write_error", write_error)
    replace(ServerConnection, "error", error_reply)
