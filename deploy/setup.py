"""Harden `panel serve`: pass this file as `--setup deploy/setup.py`.

Panel and Bokeh trust whoever reaches the port. This file closes what a teaching lab meets: foreign
modules imported by an address, sockets from other sites, sessions without end, tracebacks in
replies, log lines of megabytes. It patches Panel 1.9, Bokeh 3.9 and Tornado 6.5 to 6.6, has no
effect outside the server's process, and `tests/test_deploy.py` checks each point on a real server.

Environment
-----------
ROTORSTAB_MAX_SESSIONS
    Documents, and likewise sockets, served at a time; more are answered 503. Default 60.
ROTORSTAB_LESSONS
    Folder of a teacher's lessons. They are read at start, so that a fault in one is logged then.
"""

import functools
import html
import importlib
import logging
import os
import sys
import urllib.parse

import panel.io.location as panel_location
from bokeh.server.connection import ServerConnection
from bokeh.server.contexts import ApplicationContext
from bokeh.server.views.session_handler import SessionHandler
from bokeh.util.token import check_token_signature, get_session_id
from panel.io.liveness import LivenessHandler
from panel.io.server import (
    AutoloadJsHandler,
    ComponentResourceHandler,
    DocHandler,
    RootHandler,
    WSHandler,
)
from tornado.web import HTTPError, RequestHandler

RETRY_SECONDS = 30
LONGEST_LOG_LINE = 2000
LONGEST_VALUE = 300

HEADERS = {
    # CustomJS needs 'unsafe-eval', inline scripts have no nonces, and Panel's JavaScript
    # components are fetched from blobs.
    "Content-Security-Policy": (
        "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; "
        "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self' blob:; "
        "frame-ancestors 'none'; object-src 'none'; base-uri 'self'; form-action 'self'"
    ),
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}


def read_limit():
    """Sessions allowed at a time, from the environment."""
    text = os.environ.get("ROTORSTAB_MAX_SESSIONS", "60")
    try:
        limit = int(text)
    except ValueError:
        limit = 0
    if limit < 1:
        # SystemExit: the server must not start with a limit that nobody meant.
        raise SystemExit(f"ROTORSTAB_MAX_SESSIONS must be an integer above 0, got {text!r}")
    return limit


MAX_SESSIONS = read_limit()
open_sockets = set()


# Log lines: a refused message of a megabyte must not become a log line of a megabyte.


def shorten(text):
    """The text with its middle cut out where it is longer than a log line may be."""
    if len(text) <= LONGEST_LOG_LINE:
        return text
    half = LONGEST_LOG_LINE // 2
    return f"{text[:half]} ... {len(text) - 2 * half} characters cut ... {text[-half:]}"


class ShortRecord(logging.LogRecord):
    """A log record of bounded length."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        if self.exc_info and self.exc_info[0] is not None:
            self.exc_text = shorten(logging.Formatter().formatException(self.exc_info))

    def getMessage(self):
        return shorten(super().getMessage())


logging.setLogRecordFactory(ShortRecord)


# Every reply: security headers, and no version of the server.

tornado_clear = RequestHandler.clear


@functools.wraps(tornado_clear)
def clear(self):
    """Reset the reply. Handlers override `set_default_headers`, none overrides this."""
    tornado_clear(self)
    self.clear_header("Server")
    for name, value in HEADERS.items():
        self.set_header(name, value)


RequestHandler.clear = clear


# Error pages: the number and its name. What happened is in the log.


def write_error(self, status_code, **kwargs):
    """Finish with a short page whatever `serve_traceback` says."""
    if status_code == 503:
        self.set_header("Retry-After", str(RETRY_SECONDS))
        text = f"All places are taken. This page tries again every {RETRY_SECONDS} seconds."
        refresh = f'<meta http-equiv="refresh" content="{RETRY_SECONDS}">'
    else:
        text, refresh = f"{status_code}: {html.escape(self._reason)}", ""
    self.finish(
        f'<!doctype html><html lang="en"><meta charset="utf-8">{refresh}'
        f"<title>{text}</title><h1>{text}</h1></html>"
    )


RequestHandler.write_error = write_error


connection_error = ServerConnection.error


@functools.wraps(connection_error)
def error_reply(self, message, text):
    """Bokeh's reply to a message it failed on, less the traceback and its paths."""
    reply = connection_error(self, message, "the server could not use this message")
    reply.content = {"text": reply.content["text"], "traceback": None}
    return reply


ServerConnection.error = error_reply

page_session = DocHandler.get_session


@functools.wraps(page_session)
async def session_or_error(self):
    """The page's session; 500, not an empty page, where the app's file raised."""
    session = await page_session(self)
    if any(handler.failed for handler in self.application_context.application.handlers):
        raise HTTPError(500)
    return session


DocHandler.get_session = session_or_error


# Addresses that are not there.


async def not_found(self):
    """Answer 404 before the handler does anything."""
    raise HTTPError(404)


# /components/<module>/... imports the module it names.
ComponentResourceHandler.prepare = not_found
# autoload.js makes a session for any other site; nothing embeds this dashboard.
AutoloadJsHandler.prepare = not_found


# Sessions and sockets: counted, and refused before anything is built for them.


def documents(application):
    """Number of documents that the server holds or is building."""
    return sum(
        len(context._sessions) + len(context._pending_sessions)
        for context in application.applications.values()
    )


def known_session(handler, token):
    """Whether the token's session exists; 403 where the token is not one of this server's."""
    server = handler.application
    try:
        genuine = check_token_signature(
            token, signed=server.sign_sessions, secret_key=server.secret_key
        )
        session_id = get_session_id(token)
    except Exception:  # garbage raises anything: base64, JSON, Unicode, a missing key
        genuine = False
    if not genuine:
        raise HTTPError(403, reason="Invalid token")
    return session_id in handler.application_context._sessions


create_session_if_needed = ApplicationContext.create_session_if_needed


@functools.wraps(create_session_if_needed)
async def create_session(self, session_id, *args, **kwargs):
    """Bokeh's creation of a session, less the place it keeps for ever after a failure."""
    try:
        return await create_session_if_needed(self, session_id, *args, **kwargs)
    except BaseException:
        pending = self._pending_sessions.pop(session_id, None)
        if pending is not None:
            pending.cancel()
        raise


ApplicationContext.create_session_if_needed = create_session

session_prepare = SessionHandler.prepare


@functools.wraps(session_prepare)
async def prepare_page(self):
    """Refuse a page where all places are taken."""
    # Bokeh's own arguments let a link choose the session or, through bokeh-absolute-url, the host
    # that the page's scripts come from. No page of ours uses one.
    self.request.headers.pop("Bokeh-Session-Id", None)
    for arguments in (self.request.arguments, self.request.query_arguments):
        for name in [name for name in arguments if name.startswith("bokeh-")]:
            del arguments[name]
    await session_prepare(self)
    if self.request.method != "HEAD" and documents(self.application) >= MAX_SESSIONS:
        raise HTTPError(503)


DocHandler.prepare = prepare_page

socket_prepare = WSHandler.prepare


@functools.wraps(socket_prepare)
async def prepare_socket(self):
    """Refuse a socket from another site, with a false token, or where all places are taken."""
    await socket_prepare(self)
    if self._finished:
        return
    # Tornado lets Origin pass where it equals Host, before Bokeh's list is asked, and lets a
    # missing one pass: a name that an attacker points at this server would get in.
    origins = self.request.headers.get_list("Origin")
    if len(origins) != 1 or not self.check_origin(origins[0]):
        raise HTTPError(403, reason="Origin not allowed")
    protocols = self.request.headers.get("Sec-WebSocket-Protocol", "").split(",")
    if len(protocols) != 2:
        raise HTTPError(403, reason="No token")
    known = known_session(self, protocols[1].strip())
    if len(open_sockets) >= MAX_SESSIONS:
        raise HTTPError(503)
    if not known and documents(self.application) >= MAX_SESSIONS:
        raise HTTPError(503)
    open_sockets.add(self)


WSHandler.prepare = prepare_socket

socket_connection_close = WSHandler.on_connection_close


@functools.wraps(socket_connection_close)
def socket_gone(self):
    """Free the place of a socket whose connection was lost."""
    open_sockets.discard(self)
    socket_connection_close(self)


WSHandler.on_connection_close = socket_gone

socket_finish = WSHandler.on_finish


@functools.wraps(socket_finish)
def socket_refused(self):
    """Free the place of a socket whose handshake failed; a good one finishes with 101."""
    if self.get_status() != 101:
        open_sockets.discard(self)
    socket_finish(self)


WSHandler.on_finish = socket_refused


# HEAD: the headers of a page, without building it.


async def head_page(self, *args, **kwargs):
    """Answer HEAD with the page's type."""
    self.set_header("Cache-Control", "no-store")
    self.set_header("Content-Type", "text/html")


DocHandler.head = head_page
RootHandler.head = RootHandler.get  # a redirect


# Liveness: the process answers. Panel's own handler builds a document where asked for one.


async def alive(self):
    """Answer that the server runs, and build nothing."""
    self.set_header("Cache-Control", "no-store")
    self.write({"alive": True})


LivenessHandler.get = LivenessHandler.head = alive


# Addresses with hostile queries: Panel parses each page's address, and a failure is a blank page.

panel_parse_query = panel_location.parse_query


@functools.wraps(panel_parse_query)
def parse_query(query):
    """Panel's reading of a query, less what it would fail on (a number of 5000 digits)."""
    parsed = {}
    for key, value in urllib.parse.parse_qsl(query.removeprefix("?")):
        if len(value) <= LONGEST_VALUE:
            try:
                parsed |= panel_parse_query("?" + urllib.parse.urlencode({key: value}))
            except Exception:  # int("²") and their like
                logging.getLogger("rotorstab").info("unreadable query value of %r", key)
    return parsed


panel_location.parse_query = parse_query

panel_location_params = panel_location._get_location_params


@functools.wraps(panel_location_params)
def location_params(protocol, host, uri):
    """Panel's parts of an address, and only its path where the rest cannot be taken apart."""
    try:
        return panel_location_params(protocol, host, uri)
    except Exception:  # two question marks, an IPv6 host
        return panel_location_params(protocol, "", (uri or "").partition("?")[0].partition("#")[0])


panel_location._get_location_params = location_params


# Lessons: a broken file is reported now, not when the first student comes.

if os.environ.get("ROTORSTAB_LESSONS"):
    sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    importlib.import_module("app.lessons").library()
