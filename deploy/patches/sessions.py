"""Sessions and sockets: counted, and refused before anything is built for them.

A place is held by a session that has a socket. A page whose socket has not come yet, or has gone,
holds none. It is kept for a while, and the oldest of these pages gives way where there are too
many. Its browser loses nothing: the session is built again from the token when the socket comes.
"""

from __future__ import annotations

import asyncio
import functools
import threading
from typing import Any, NoReturn

from bokeh.server.contexts import ApplicationContext
from bokeh.server.session import ServerSession
from bokeh.server.views.session_handler import SessionHandler
from bokeh.settings import settings as bokeh_settings
from bokeh.util.token import check_token_signature, get_session_id
from panel.io.server import DocHandler, WSHandler
from panel.io.state import state as panel_state
from prometheus_client import Counter
from tornado.web import HTTPError

from ..settings import Settings
from .faults import contain
from .patching import replace

CONNECTING = 15_000  # ms that a page is kept whose socket has never come
BETWEEN = 0.02  # s left to messages before a page is built; a message comes in three fragments
SWITCHING_PROTOCOLS = 101  # status of a handshake that opens a socket

open_sockets: set[Any] = set()
draining = threading.Event()
"""Set when the server ends: nobody new is served."""
building = asyncio.Lock()
"""Held while a page is built: one at a time, so that messages are answered between two pages."""
REFUSED = Counter("rotorstab_refused", "Pages and sockets answered 503.")


def refuse() -> NoReturn:
    """Answer 503: all places are taken, or the server is about to end."""
    REFUSED.inc()
    raise HTTPError(503)


page_session = DocHandler.get_session
create_session_if_needed = ApplicationContext.create_session_if_needed
cleanup_sessions = ApplicationContext._cleanup_sessions
subscribe = ServerSession.subscribe
session_prepare = SessionHandler.prepare
socket_prepare = WSHandler.prepare
socket_connection_close = WSHandler.on_connection_close
socket_finish = WSHandler.on_finish
SHOWN_OF_ID = 8  # characters of a session's name


def current_session() -> str:
    """Return the first characters of the session that is being served; empty where none is."""
    try:
        return str(panel_state.curdoc.session_context.id)[:SHOWN_OF_ID]
    except Exception:  # there is none; writing a log line never fails
        return ""


def documents(application: Any) -> int:
    """Return the number of documents that the server holds or is building."""
    return sum(
        len(context._sessions) + len(context._pending_sessions)
        for context in application.applications.values()
    )


def places_taken(application: Any) -> int:
    """Return the number of sessions that have a socket."""
    return sum(
        session.connection_count > 0
        for context in application.applications.values()
        for session in context._sessions.values()
    )


def without_socket(context: Any) -> list[Any]:
    """Return the sessions of one app that have no socket, beginning with the longest without it."""
    alone = [each for each in context._sessions.values() if each.connection_count == 0]
    return sorted(alone, key=lambda each: -each.milliseconds_since_last_unsubscribe)


async def discard(context: Any, session: Any) -> None:
    """Discard a session, unless a page connects to it or a message of it is being answered."""
    if session.connection_count == 0 and not session.expiration_blocked:
        await context._discard_session(session, lambda each: each.connection_count == 0)


async def make_room(context: Any, most: int) -> None:
    """Discard the oldest sessions without a socket, of which `most` may be held."""
    alone = without_socket(context)
    for session in alone[: max(0, len(alone) + 1 - most)]:
        await discard(context, session)


@functools.wraps(subscribe)
def subscribe_and_note(self: Any, connection: Any) -> None:
    """Connect a session, which is kept longer from then on if its connection is lost."""
    self.was_connected = True
    subscribe(self, connection)


@functools.wraps(cleanup_sessions)
async def cleanup(self: Any, linger: int) -> None:
    """Discard sessions that were left, and earlier those to which no page ever connected."""
    await cleanup_sessions(self, linger)
    for session in without_socket(self):
        late = session.milliseconds_since_last_unsubscribe > CONNECTING
        if late and not hasattr(session, "was_connected"):
            await discard(self, session)


def known_session(handler: Any, token: str) -> bool:
    """Return whether the session of a token exists; 403 where this server did not sign it."""
    server = handler.application
    try:
        genuine = check_token_signature(
            token, signed=server.sign_sessions, secret_key=server.secret_key
        )
        session_id = get_session_id(token)
    except Exception:  # of base64, JSON, Unicode, a missing key
        genuine = False
    if not genuine:
        raise HTTPError(403, reason="Invalid token")
    return session_id in handler.application_context._sessions


@functools.wraps(page_session)
async def session_or_error(self: Any) -> Any:
    """Return the session of a page; 500 instead of an empty page where the app's file raised."""
    session = await page_session(self)
    if any(handler.failed for handler in self.application_context.application.handlers):
        raise HTTPError(500)
    return session


def is_gone(request: Any) -> bool:
    """Return whether the browser that sent a request has closed its connection."""
    stream = getattr(getattr(request, "connection", None), "stream", None)
    return stream is not None and stream.closed()


@functools.wraps(create_session_if_needed)
async def create_session(
    self: Any, session_id: str, request: Any = None, token: str | None = None
) -> Any:
    """Create a session as Bokeh does, one after another; a failure leaves no pending session."""
    if session_id in self._sessions:
        return await create_session_if_needed(self, session_id, request, token)
    async with building:
        await asyncio.sleep(BETWEEN)
        if is_gone(request):
            raise HTTPError(400, "nobody waits for this page any more")
        try:
            return await contain(create_session_if_needed(self, session_id, request, token))
        except BaseException:
            # From Bokeh 3.10 on the pending session is a task, which removes itself, and for which
            # others may wait.
            if not isinstance(self._pending_sessions.get(session_id), asyncio.Task):
                pending = self._pending_sessions.pop(session_id, None)
                if pending is not None:
                    pending.cancel()
            raise


async def prepare_page(self: Any, places: int) -> None:
    """Prepare the request of a page; refuse it where all places are taken."""
    # Bokeh's own arguments let a link choose the session or, with bokeh-absolute-url, the host from
    # which the page's scripts come. No page of ours uses them.
    self.request.headers.pop("Bokeh-Session-Id", None)
    for arguments in (self.request.arguments, self.request.query_arguments):
        for name in [name for name in arguments if name.startswith("bokeh-")]:
            del arguments[name]
    await session_prepare(self)
    if self.request.method == "HEAD":
        return
    if draining.is_set() or places_taken(self.application) >= places:
        refuse()
    await make_room(self.application_context, places)


async def prepare_socket(self: Any, places: int) -> None:
    """Refuse a socket from another site, with a false token, or where all places are taken."""
    await socket_prepare(self)
    if self._finished:
        return
    # Tornado accepts an Origin that equals Host before it asks Bokeh's list, and it accepts a
    # request without Origin: a host name that an attacker points at this server would get in.
    origins = self.request.headers.get_list("Origin")
    if len(origins) != 1 or not self.check_origin(origins[0]):
        raise HTTPError(403, reason="Origin not allowed")
    protocols = self.request.headers.get("Sec-WebSocket-Protocol", "").split(",")
    if len(protocols) != 2:
        raise HTTPError(403, reason="No token")
    known = known_session(self, protocols[1].strip())
    if draining.is_set() or len(open_sockets) >= places:
        refuse()
    if not known:
        await make_room(self.application_context, places)
    open_sockets.add(self)


@functools.wraps(socket_connection_close)
def socket_gone(self: Any) -> None:
    """Free the place of a socket whose connection was lost."""
    open_sockets.discard(self)
    socket_connection_close(self)


@functools.wraps(socket_finish)
def socket_refused(self: Any) -> None:
    """Free the place of a socket whose handshake failed."""
    if self.get_status() != SWITCHING_PROTOCOLS:
        open_sockets.discard(self)
    socket_finish(self)


def install(settings: Settings) -> None:
    """Count and limit the sessions and sockets of this process's server."""
    places = settings.max_sessions
    replace(DocHandler, "get_session", session_or_error)
    # It checks the references of each document that opens; the tests look at the page itself.
    replace(bokeh_settings, "perform_document_validation", False)
    replace(ApplicationContext, "create_session_if_needed", create_session)
    replace(ServerSession, "subscribe", subscribe_and_note)
    replace(ApplicationContext, "_cleanup_sessions", cleanup)
    replace(DocHandler, "prepare", functools.partialmethod(prepare_page, places))
    replace(WSHandler, "prepare", functools.partialmethod(prepare_socket, places))
    replace(WSHandler, "on_connection_close", socket_gone)
    replace(WSHandler, "on_finish", socket_refused)
