"""Messages on a socket: refused before Bokeh reads them, unless our page sends such messages.

So a forged message never reaches the checks of Bokeh and Panel. `allowed_messages` says what is
allowed.
"""

from __future__ import annotations

import functools
import json
import logging
from typing import Any

from bokeh.protocol import Protocol
from bokeh.protocol.exceptions import ValidationError
from bokeh.server.protocol_handler import ProtocolHandler
from bokeh.server.views.ws import WSHandler

from ..settings import Settings
from .allowed_messages import LONGEST_NAME, describe, is_allowed
from .faults import EndedItself, contain
from .limits import count_refused
from .patching import replace

LOG = logging.getLogger("rotorstab.messages")
MOST_PULLS = (
    3  # of a socket: a page asks once for the document, which takes the server long to send
)

assemble = Protocol.assemble
handle = ProtocolHandler.handle
receive = WSHandler._receive


@functools.wraps(assemble)
def assemble_checked(self: Any, header_json: str, metadata_json: str, content_json: str) -> Any:
    """Assemble a message as Bokeh does, without buffers, which are kept until the last has come."""
    header = json.loads(header_json)
    names = [header.get(name) for name in ("msgid", "msgtype")] if isinstance(header, dict) else []
    if not all(isinstance(name, str) and len(name) <= LONGEST_NAME for name in names or [None]):
        raise ValidationError("a message without a name")
    if header.get("num_buffers", 0) != 0:
        raise ValidationError("a message with buffers")
    return assemble(self, header_json, metadata_json, content_json)


def pulls_too_often(socket: Any, message: Any) -> bool:
    """Count the requests of a socket for the whole document; return whether there are too many."""
    if message.msgtype != "PULL-DOC-REQ":
        return False
    socket.pulls = getattr(socket, "pulls", 0) + 1
    return bool(socket.pulls > MOST_PULLS)


@functools.wraps(handle)
async def handle_allowed(self: Any, message: Any, connection: Any) -> Any:
    """Answer an allowed message, and refuse every other one."""
    socket = connection._socket
    if pulls_too_often(socket, message) or not is_allowed(message, connection.session.document):
        count_refused(socket, describe(message))
        return connection.error(message, "refused")
    try:
        return await contain(handle(self, message, connection))
    except EndedItself as error:
        LOG.error("%s", error, exc_info=error)
        return connection.error(message, "failed")


def close_broken(self: Any, message: str) -> None:
    """Close a socket whose messages cannot be read; the reason is for the log only."""
    LOG.warning("closed a socket: %s", message)
    self.close(1002, "unreadable message")


def close_failed(self: Any, message: str) -> None:
    """Close a socket on which the server failed; the reason is for the log only."""
    LOG.error("closed a socket: %s", message)
    self.close(1011, "the server could not use this message")


@functools.wraps(receive)
async def receive_quietly(self: Any, fragment: Any) -> Any:
    """Receive a fragment as Bokeh does; one that cannot be read closes the socket."""
    try:
        return await receive(self, fragment)
    except Exception as error:  # JSON, recursion, a number of 5000 digits, a missing key
        close_broken(self, type(error).__name__)
        return None


def install(settings: Settings | None) -> None:
    """Refuse foreign messages to this process's server."""
    replace(Protocol, "assemble", assemble_checked)
    replace(ProtocolHandler, "handle", handle_allowed)
    replace(WSHandler, "_receive", receive_quietly)
    replace(WSHandler, "_protocol_error", close_broken)
    replace(WSHandler, "_internal_error", close_failed)
