"""What a page may send: the messages of our own page, and nothing else.

Bokeh lets a client set every property of every model, build models by name, replace the whole
document and attach buffers without a bound. Our page needs three kinds of message: the custom
messages of its component, the ranges of a zoomed chart, and the sizes of a laid-out chart.

The messages are parsed JSON that anybody may have written, so every type is checked.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from bokeh.models import Plot, Range1d
from panel.models.esm import ReactiveESM

LARGEST_NUMBER = 1e15  # of a range or a size
MOST_EVENTS = 100  # of one message
MOST_PARTS, DEEPEST = 5000, 8  # values of a custom message, and how deep they are nested
LONGEST_NAME = 100  # characters of a key of a map, or of a message's name
LONGEST_SHOWN = 200  # characters of a refused message that are logged
SHOWN_FIELDS = ("kind", "attr", "msg_type", "model")  # of a refused message's first event

NUMBERS: dict[type, frozenset[str]] = {
    Range1d: frozenset({"start", "end"}),
    Plot: frozenset({"inner_width", "inner_height", "outer_width", "outer_height"}),
}
"""Properties that a browser may set, by the kind of model; all of them are numbers."""


def is_number(value: object) -> bool:
    """Return whether a value is a finite number of a sensible size."""
    return (
        isinstance(value, int | float)
        and not isinstance(value, bool)
        and -LARGEST_NUMBER <= value <= LARGEST_NUMBER
    )


def is_plain(value: object) -> bool:
    """Return whether a value has only texts, numbers, lists and maps: nothing that Bokeh builds."""
    waiting, parts = [(value, 0)], 0
    while waiting:
        part, depth = waiting.pop()
        parts += 1
        if parts > MOST_PARTS or depth > DEEPEST:
            return False
        if part is None or isinstance(part, bool | int | float):
            continue
        if isinstance(part, str):
            if not is_text(part):
                return False
        elif isinstance(part, list):
            waiting += [(item, depth + 1) for item in part]
        elif isinstance(part, dict) and set(part) == {"type", "entries"} and part["type"] == "map":
            pairs = part["entries"]
            if not isinstance(pairs, list) or not all(map(is_pair, pairs)):
                return False
            waiting += [(item, depth + 1) for _, item in pairs]
        elif not is_special_number(part):
            return False
    return True


def is_text(text: str) -> bool:
    """Return whether a text can be sent and logged: it has no half of a surrogate pair."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def is_pair(pair: object) -> bool:
    """Return whether an entry of a map is a short name and a value."""
    return (
        isinstance(pair, list)
        and len(pair) == 2
        and isinstance(pair[0], str)
        and len(pair[0]) <= LONGEST_NAME
        and is_text(pair[0])
    )


def is_special_number(value: object) -> bool:
    """Return whether a value is Bokeh's way to write a NaN or an infinity."""
    return (
        isinstance(value, dict)
        and set(value) == {"type", "value"}
        and value["type"] == "number"
        and value["value"] in ("nan", "+inf", "-inf")
    )


def model_of(reference: object, document: Any) -> Any:
    """Return the document's own model to which a value refers, or None."""
    if not isinstance(reference, dict) or set(reference) != {"id"}:
        return None
    name = reference["id"]
    return document.models.get_by_id(name) if isinstance(name, str) else None


def is_size_or_range(event: dict[str, Any], document: Any) -> bool:
    """Return whether an event sets a range or a size of a chart to a finite number."""
    if set(event) != {"kind", "model", "attr", "new"} or not isinstance(event["attr"], str):
        return False
    model = model_of(event["model"], document)
    allowed = (names for kind, names in NUMBERS.items() if isinstance(model, kind))
    return event["attr"] in next(allowed, ()) and is_number(event["new"])


def is_component_message(event: dict[str, Any], document: Any) -> bool:
    """Return whether an event is a component's message, or says that the page is ready."""
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
        return bool(pairs == [])
    if data["name"] != "data_event" or set(values) != {"type", "entries"}:
        return False
    if not isinstance(pairs, list) or not all(map(is_pair, pairs)):
        return False
    if [name for name, _ in pairs] != ["model", "data"]:
        return False
    return isinstance(model_of(pairs[0][1], document), ReactiveESM) and is_plain(pairs[1][1])


CHECKS: dict[str, Callable[[dict[str, Any], Any], bool]] = {
    "ModelChanged": is_size_or_range,
    "MessageSent": is_component_message,
}
"""By the kind of an event, whether it is allowed in a document."""


def is_allowed(message: Any, document: Any) -> bool:
    """Return whether a message of Bokeh's protocol is one that our page sends."""
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


def describe(message: Any) -> str:
    """Return what a refused message was, for one line of the log."""
    content = message.content
    events = content.get("events") if isinstance(content, dict) else None
    first = events[0] if isinstance(events, list) and events else None
    shown = (
        [first[name] for name in SHOWN_FIELDS if name in first] if isinstance(first, dict) else []
    )
    return f"{message.msgtype} message {json.dumps(shown)[:LONGEST_SHOWN]}"
