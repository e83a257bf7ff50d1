"""Log lines: of bounded length, and one JSON object a line where no person reads them."""

from __future__ import annotations

import functools
import json
import logging
import sys
import time
from collections.abc import Callable
from typing import Any

from tornado.httpserver import _HTTPRequestContext
from tornado.httputil import HTTPServerRequest
from tornado.web import Application, RequestHandler

from ..settings import Settings
from .patching import replace

LONGEST_LINE = 2000  # characters of a message or a traceback

log_request = Application.log_request


def shorten(text: str) -> str:
    """Return a text, with its middle cut out where it is longer than a log line may be."""
    if len(text) <= LONGEST_LINE:
        return text
    half = LONGEST_LINE // 2
    return f"{text[:half]} ... {len(text) - 2 * half} characters cut ... {text[-half:]}"


class ShortRecord(logging.LogRecord):
    """A log record of bounded length that knows its session.

    Parameters
    ----------
    session_of : callable
        Returns the name of the session that is being served; empty where none is.
    """

    def __init__(self, session_of: Callable[[], str], *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.session = session_of()
        if self.exc_info and self.exc_info[0] is not None:
            self.exc_text = shorten(logging.Formatter().formatException(self.exc_info))

    def getMessage(self) -> str:
        return shorten(super().getMessage())


class JsonFormatter(logging.Formatter):
    """One JSON object a line: time [UTC], level, logger, message, session, traceback."""

    def converter(self, seconds: float | None) -> time.struct_time:
        return time.gmtime(seconds)

    def format(self, record: logging.LogRecord) -> str:
        line = {
            "time": self.formatTime(record, "%Y-%m-%dT%H:%M:%S") + f".{int(record.msecs):03}Z",
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        if session := getattr(record, "session", ""):
            line["session"] = session
        if record.exc_text:
            line["traceback"] = record.exc_text
        elif record.exc_info:
            line["traceback"] = self.formatException(record.exc_info)
        return json.dumps(line)


def summary(handler: RequestHandler) -> str:
    """Return what Tornado logs of a request: without address, and without the student's query."""
    return f"{handler.request.method} {handler.request.path}"


def shown_request(request: HTTPServerRequest) -> str:
    """Return the same for Tornado's log line of a request whose handler raised."""
    return f"HTTPServerRequest({request.method} {request.path})"


def shown_context(context: _HTTPRequestContext) -> str:
    """Return what Tornado logs of a connection: without the client's address."""
    return "a client"


@functools.wraps(log_request)
def log_request_by_kind(self: Application, handler: RequestHandler) -> None:
    """Log a request; a request that is refused for want of a place is no error of the server."""
    if handler.get_status() == 503:
        logging.getLogger("tornado.access").info("503 %s", handler._request_summary())
    else:
        log_request(self, handler)


def no_session() -> str:
    """Return an empty text, in a process that serves no sessions."""
    return ""


def install(settings: Settings, session_of: Callable[[], str] = no_session) -> None:
    """Send every log record of this process to standard error in one form.

    Parameters
    ----------
    settings : Settings
    session_of : callable
        Returns the name of the session that is being served; empty where none is.
    """
    logging.setLogRecordFactory(functools.partial(ShortRecord, session_of))
    replace(RequestHandler, "_request_summary", summary)
    replace(HTTPServerRequest, "__repr__", shown_request)
    replace(_HTTPRequestContext, "__str__", shown_context)
    replace(Application, "log_request", log_request_by_kind)
    plain = settings.log_format == "text" or (settings.log_format == "auto" and sys.stderr.isatty())
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(
        logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s")
        if plain
        else JsonFormatter()
    )
    root = logging.getLogger()
    root.handlers = [handler]
    root.setLevel(settings.log_level.upper())
    # Bokeh and Panel have set handlers and levels of their own
    for name in ("bokeh", "panel", "tornado"):
        logger = logging.getLogger(name)
        logger.handlers.clear()
        logger.propagate = True
        logger.setLevel(logging.NOTSET)
    # they log a line for each request, socket and session, which only `debug` shows
    if settings.log_level != "debug":
        for name in ("tornado.access", "bokeh", "panel"):
            logging.getLogger(name).setLevel(logging.WARNING)
    logging.captureWarnings(True)
