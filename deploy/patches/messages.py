"""Messages on the socket: what our page sends and nothing else.

Bokeh lets a client set every property of every model, build models by name, replace the whole
document and attach buffers without end. Our page needs three things: the custom messages of its
components, the ranges of a zoomed chart, the sizes of a laid-out chart. The rest is refused
before Bokeh looks at it, so that no forged message can be a question of Bokeh's or Panel's checks.
"""

import functools
import json
import logging

from bokeh.models import Plot, Range1d
from bokeh.protocol import Protocol
from bokeh.protocol.exceptions import ValidationError
from bokeh.server.protocol_handler import ProtocolHandler
from bokeh.server.views.ws import WSHandler
from panel.models.esm import ReactiveESM

from .faults import EndedItself, contain
from .limits import count_refused
from .patching import replace

log = logging.getLogger("rotorstab.messages")

LARGEST_NUMBER = 1e15  # of a range or a size
MOST_PULLS = 3  # of a socket: a page asks once, and the whole document takes the server long
MOST_EVENTS, MOST_PARTS, DEEPEST = 100, 5000, 8
LONGEST_NAME = 100

NUMBERS = {
    Range1d: frozenset({"start", "end"}),
    Plot: frozenset({"inner_width", "inner_height", "outer_width", "outer_height"}),
}


# what describe() names of an event
NAMES = ("kind", "attr", "msg_type", "model")

assemble = Protocol.assemble
handle = ProtocolHandler.handle
receive = WSHandler._receive


def is_number(value):
    """Whether a value is a finite number of a sensible size."""
    return (
        isinstance(value, int | float)
        and not isinstance(value, bool)
        and -LARGEST_NUMBER <= value <= LARGEST_NUMBER
    )


def is_plain(value):
    """Whether a value is text, numbers, lists and maps only: nothing that Bokeh would build."""
    waiting, parts = [(value, 0)], 0
    while waiting:
        one, depth = waiting.pop()
        parts += 1
        if parts > MOST_PARTS or depth > DEEPEST:
            return False
        if one is None or isinstance(one, bool | int | float):
            continue
        if isinstance(one, str):
            if not is_text(one):
                return False
        elif isinstance(one, list):
            waiting += [(item, depth + 1) for item in one]
        elif isinstance(one, dict) and set(one) == {"type", "entries"} and one["type"] == "map":
            pairs = one["entries"]
            if not isinstance(pairs, list) or not all(map(is_pair, pairs)):
                return False
            waiting += [(item, depth + 1) for _, item in pairs]
        elif not (isinstance(one, dict) and set(one) == {"type", "value"} and is_special(one)):
            return False
    return True


def is_text(text):
    """Whether a text can be sent and logged: it has no half of a surrogate pair."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def is_pair(pair):
    """Whether an entry of a map is a short name and a value."""
    return (
        isinstance(pair, list)
        and len(pair) == 2
        and isinstance(pair[0], str)
        and len(pair[0]) <= LONGEST_NAME
        and is_text(pair[0])
    )


def is_special(value):
    """Whether a value is Bokeh's way to write a NaN or an infinity."""
    return value["type"] == "number" and value["value"] in ("nan", "+inf", "-inf")


def model_of(reference, document):
    """The document's own model that is referred to, or None."""
    if not isinstance(reference, dict) or set(reference) != {"id"}:
        return None
    name = reference["id"]
    return document.models.get_by_id(name) if isinstance(name, str) else None


def is_size_or_range(event, document):
    """Whether an event sets a range or a size of a chart to a finite number."""
    if set(event) != {"kind", "model", "attr", "new"} or not isinstance(event["attr"], str):
        return False
    model = model_of(event["model"], document)
    allowed = (names for kind, names in NUMBERS.items() if isinstance(model, kind))
    return event["attr"] in next(allowed, ()) and is_number(event["new"])


def is_component_message(event, document):
    """Whether an event is a custom message to a component, or says that the page is ready."""
    if set(event) != {"kind", "msg_type", "msg_data"} or event["msg_type"] != "bokeh_event":
        return False
    data = event["msg_data"]
    if not isinstance(data, dict) or set(data) != {"type", "name", "values"}:
        return False
    values = data["values"]
    if data["type"] != "event" or not isinstance(values, dict) or values.get("type") != "map":
        return False
    pairs = values.get("entries", [])
    if data["name"] == "document_ready":
        return pairs == []
    if data["name"] != "data_event" or set(values) != {"type", "entries"}:
        return False
    if not isinstance(pairs, list) or not all(map(is_pair, pairs)):
        return False
    if [name for name, _ in pairs] != ["model", "data"]:
        return False
    return isinstance(model_of(pairs[0][1], document), ReactiveESM) and is_plain(pairs[1][1])


CHECKS = {"ModelChanged": is_size_or_range, "MessageSent": is_component_message}


def is_allowed(message, document):
    """Whether a message is one that our page sends."""
    if message.msgtype == "PULL-DOC-REQ":
        return True
    content = message.content
    if message.msgtype != "PATCH-DOC" or not isinstance(content, dict):
        return False
    events = content.get("events")
    if set(content) != {"events"} or not isinstance(events, list) or len(events) > MOST_EVENTS:
        return False
    for event in events:
        kind = event.get("kind") if isinstance(event, dict) else None
        check = CHECKS.get(kind) if isinstance(kind, str) else None
        if check is None or not check(event, document):
            return False
    return True


def describe(message):
    """What a refused message was, for one line of the log."""
    content = message.content
    events = content.get("events") if isinstance(content, dict) else None
    first = events[0] if isinstance(events, list) and events else None
    names = [first[name] for name in NAMES if name in first] if isinstance(first, dict) else []
    return f"{message.msgtype} message {json.dumps(names)[:200]}"


@functools.wraps(assemble)
def assemble_checked(self, header_json, metadata_json, content_json):
    """Bokeh's reading of a message, without buffers: they would be kept until the last came."""
    header = json.loads(header_json)
    names = [header.get(name) for name in ("msgid", "msgtype")] if isinstance(header, dict) else []
    if not all(isinstance(name, str) and len(name) <= LONGEST_NAME for name in names or [None]):
        raise ValidationError("a message without a name")
    if header.get("num_buffers", 0) != 0:
        raise ValidationError("a message with buffers")
    return assemble(self, header_json, metadata_json, content_json)


@functools.wraps(handle)
async def handle_allowed(self, message, connection):
    """Answer an allowed message; tell that another one is refused."""
    socket = connection._socket
    if message.msgtype == "PULL-DOC-REQ":
        socket.pulls = getattr(socket, "pulls", 0) + 1
    refused = getattr(socket, "pulls", 0) > MOST_PULLS and message.msgtype == "PULL-DOC-REQ"
    if refused or not is_allowed(message, connection.session.document):
        count_refused(socket, describe(message))
        return connection.error(message, "refused")
    try:
        return await contain(handle(self, message, connection))
    except EndedItself as error:
        log.error("%s", error, exc_info=error)
        return connection.error(message, "failed")


def close_broken(self, message):
    """Close a socket whose messages cannot be read; its words are for the log only."""
    log.warning("closed a socket: %s", message)
    self.close(1002, "unreadable message")


def close_failed(self, message):
    """Close a socket on which the server failed."""
    log.error("closed a socket: %s", message)
    self.close(1011, "the server could not use this message")


@functools.wraps(receive)
async def receive_quietly(self, fragment):
    """Bokeh's reading of a fragment; one that cannot be read closes the socket, no traceback."""
    try:
        return await receive(self, fragment)
    except Exception as error:  # JSON, recursion, a number of 5000 digits, a missing key
        close_broken(self, type(error).__name__)
        return None


def install(settings):
    """Refuse foreign messages to this process's server."""
    replace(Protocol, "assemble", assemble_checked)
    replace(ProtocolHandler, "handle", handle_allowed)
    replace(WSHandler, "_receive", receive_quietly)
    replace(WSHandler, "_protocol_error", close_broken)
    replace(WSHandler, "_internal_error", close_failed)
