"""Seeded hostile input: values, messages of the page, fragments of the protocol, queries, files."""

import json
import math
from urllib.parse import quote

from app.lessons import library
from app.state import PRESETS, State
from app.state.address import KEYS, PIN_KEYS, PINNED
from tests.testing.wire import changed, custom

NAMES = [name for name in State.param if name != "name"]
KINDS = tuple(
    [
        "change",
        "preset",
        "reset",
        "view",
        "page",
        "export",
        "python",
        "report",
        "settle",
        "hello",
        "pin",
        "unpin",
        "use_shaft",
        "rotor_file",
        "save_rotor_file",
        "own_file",
        "own_save",
        "own_edit",
        "figure",
        "lesson",
        "lesson-set",
        "lesson-answer",
        "lesson-show",
        "lesson-end",
    ]
)
NUMBERS = (
    math.nan,
    math.inf,
    -math.inf,
    1e308,
    -1e308,
    5e-324,
    -0.0,
    0,
    -1,
    2**53,
    -(2**63),
    10**308,
    10**400,
    True,
    False,
)
TEXTS = (
    "",
    "nan",
    "Infinity",
    "1e999",
    "0x10",
    "１２",
    "²",
    "\0",
    "\ud800",
    "../../../etc/passwd",
    "<img src=x onerror=alert(1)>",
    "{{7*7}}",
    "%s%n",
    "__class__",
    "axial\n",
    "‮",
)


def value(rng, depth=0):
    """A value that no honest page sends, or not there."""
    kind = rng.randrange(9)
    if kind < 3:
        return rng.choice(NUMBERS)
    if kind == 3:
        return rng.choice(TEXTS)
    if kind == 4:
        return rng.uniform(-1, 1) * 10.0 ** rng.randrange(-300, 300)
    if kind == 5:
        return rng.choice("aß\n") * 10 ** rng.randrange(5)
    if kind == 6 or depth > 3:
        return None
    if kind == 7:
        return [value(rng, depth + 1) for _ in range(rng.randrange(3))]
    return {rng.choice(NAMES): value(rng, depth + 1) for _ in range(rng.randrange(3))}


def near(rng, name):
    """A value at, just inside or just outside a bound of an input."""
    bounds = getattr(State.param[name], "bounds", None)
    if not bounds:
        return rng.choice([*getattr(State.param[name], "objects", (True, False)), "none"])
    low, high = bounds
    edge = rng.choice(bounds)
    beside = [math.nextafter(edge, math.inf), math.nextafter(edge, -math.inf)]
    return rng.choice([edge, *beside, low - 1, high + 1, rng.uniform(low, high)])


def values(rng, count):
    """Inputs by name, each hostile or near a bound."""
    return {
        name: near(rng, name) if rng.random() < 0.25 else value(rng)
        for name in rng.sample(NAMES, count)
    }


def message(rng):
    """A message to the page's component, of a known or an unknown kind."""
    kind = rng.choice(KINDS) if rng.random() < 0.9 else value(rng)
    found = {"type": kind}
    for name in (
        "name",
        "values",
        "number",
        "format",
        "chart",
        "label",
        "text",
        "floquet",
        "lesson",
        "step",
        "keep",
        "value",
    ):
        if rng.random() < 0.3:
            found[name] = value(rng)
    # lessons that exist, so that their steps, answers and ends are reached as well
    if kind == "lesson" and rng.random() < 0.8:
        found["lesson"] = rng.choice(list(library().lessons))
        found["step"] = rng.choice([*range(6), value(rng)])
    if kind == "change" or rng.random() < 0.1:
        found["values"] = values(rng, rng.randrange(1, 6))
    if kind == "preset" and rng.random() < 0.5:
        found["name"] = rng.choice(list(PRESETS))
    if kind == "page" and rng.random() < 0.7:
        found["name"] = rng.choice(["explore", "rotor", "stiffness", "paper", "lessons"])
    return found


def pin(rng):
    """A pin of an address: parts that are good, hostile or near a bound, and a name."""
    parts = []
    for _ in range(rng.randrange(4)):
        name = rng.choice(PINNED)
        one = near(rng, name) if rng.random() < 0.7 else value(rng)
        try:
            text = str(one)[: rng.choice([20, 100])]
        except ValueError:
            text = "9" * 5000
        parts.append(f"{KEYS[name] if rng.random() < 0.9 else 'x'}_{text}")
    name = rng.choice([*TEXTS, "slow", "a" * 2000])
    return "~".join(parts) + rng.choice(["~~", "~~", "~~", "~", ""]) + name


def query(rng):
    """A query of known and unknown keys, with pins."""
    pairs = []
    for _ in range(rng.randrange(1, 12)):
        key = rng.choice([*KEYS.values(), "v", "x", "bokeh-session-id"])
        one = near(rng, rng.choice(NAMES)) if rng.random() < 0.4 else value(rng)
        try:
            text = str(one)[: rng.choice([20, 5000])]
        except ValueError:  # an integer of thousands of digits
            text = "9" * 5000
        pairs.append(f"{key}={quote(text, errors='replace')}")
    for key in rng.sample([*PIN_KEYS, "p0", "p4"], rng.randrange(4)):
        pairs += [f"{key}={quote(pin(rng), errors='replace')}"] * rng.choice([1, 1, 1, 2])
    return "&".join(pairs)


def rotor_file(rng, good):
    """A rotor file with a few lines or characters spoilt."""
    lines = good.splitlines()
    for _ in range(rng.randrange(1, 4)):
        at = rng.randrange(len(lines))
        key, equals, _ = lines[at].partition("=")
        try:
            text = f"{value(rng)}"
        except ValueError:
            text = "9" * 5000
        choice = rng.randrange(4)
        if choice == 0 and equals:
            lines[at] = f"{key}= {text}"
        elif choice == 1 and equals:
            lines[at] = f'{key}= "{text} m"'
        elif choice == 2:
            lines.insert(at, text)
        else:
            del lines[at]
            lines = lines or [""]
    return "\n".join(lines)


def fragments(rng, models):
    """One malformed message of the protocol: what goes over the socket, piece by piece.

    `models` is {type: ids} of a document that was pulled.
    """
    every = [one for ids in models.values() for one in ids]
    component = models["ReactiveESM"][0]
    ranges = models.get("Range1d", every)
    header = {"msgid": "m", "msgtype": "PATCH-DOC"}
    hostile = _jsonable(value(rng))
    events = [
        changed(rng.choice(every), rng.choice(["end", "start", "value", "data", "esm"]), hostile),
        changed(rng.choice(ranges), "start", rng.choice([math.nan, 1e308, "0", None, True, []])),
        changed("p0", "end", 1),
        {"kind": "ColumnDataChanged", "model": {"id": rng.choice(every)}, "attr": "data",
         "data": {"type": "map", "entries": [["x", hostile]]}, "cols": None},
        {"kind": "RootAdded", "model": {"type": "object", "name": "Div", "id": "x1"}},
        {"kind": "RootRemoved", "model": {"id": component}},
        {"kind": "TitleChanged", "title": hostile},
        {"kind": hostile},
        custom(component, {"type": "object"}) | {"msg_type": "other"},
        custom(rng.choice(every), {"type": "reset"}),
        custom(component, {"type": {"type": "object", "name": "ColumnDataSource", "id": "x2"}}),
        {"kind": "MessageSent", "msg_type": "bokeh_event",
         "msg_data": {"type": "event", "name": "button_click", "values": {}}},
        hostile,
    ]  # fmt: skip
    content = {"events": [rng.choice(events) for _ in range(rng.randrange(1, 4))]}
    kind = rng.randrange(12)
    if kind < 6:
        pass
    elif kind == 6:
        header["msgtype"] = rng.choice(["PUSH-DOC", "ACK", "OK", "SERVER-INFO-REQ", "?", "ERROR"])
        content = rng.choice([{}, {"doc": {"roots": [], "title": "t"}}, content])
    elif kind == 7:
        content = rng.choice([None, [], 7, {"events": 3}, {"events": None}, {"references": []}])
    elif kind == 8:
        header = rng.choice([None, [], {}, {"msgid": 1, "msgtype": []}, {"msgtype": "PATCH-DOC"}])
    elif kind == 9:
        header["num_buffers"] = rng.choice([1, 10**9, -1, "x"])
    elif kind == 10:
        text = rng.choice(["", "{", "[" * 50_000, "nul", "\0", '{"a":' * 5000, "9" * 6000])
        return [text, "{}", text]
    else:
        return [rng.randbytes(rng.randrange(1, 400))]
    return [json.dumps(header), rng.choice(["{}", "[]", "null"]), json.dumps(content)]


def _jsonable(one):
    """A value that json.dumps takes: it refuses to write integers of thousands of digits."""
    try:
        json.dumps(one)
    except ValueError:
        return None
    return one
