"""The address: the state and its pins as a short query, and back.

A pin is written as its inputs that differ from the present state, and its name:
`p1=spin_1.5~as_0.2~~slow`. No part of an address is trusted. An input that is missing keeps its
default; a key or value that is unknown, repeated, too long, not a number or out of range is left
out, and the page names it. Only `at=0` with `follow=…` means that the user removed the marker.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlencode

import param

from rotorstab.rotors.materials import material_named

from ..reading.numbers import TwoReadings, read_number
from ..reading.user_error import UserError
from .declaration import Use
from .inputs import FACTS, names_for
from .own_link import OWN_KEY
from .state import State

__all__ = [
    "KEYS",
    "MOST_PINS",
    "PINNED",
    "PIN_KEYS",
    "VERSION",
    "PinnedInputs",
    "describe_problems",
    "from_arguments",
    "named_problems",
    "pin_name",
    "pins_from_arguments",
    "to_query",
]

VERSION = 1
KEYS = {name: facts.key for name, facts in FACTS.items()}
"""The key of each input in the address, by the name of the input."""
_NAMES = {key: name for name, key in KEYS.items()}
_MARKER = ("marker", "marker_frequency", "marker_factor")
# keys that other programs add to links: they mean nothing here, and the user did not write them
_TRACKING = re.compile(
    "(utm|mtm|pk|piwik|matomo|hsa|_hs|mc|ga|at|fb)_.*|_hsenc|_hsmi|_ga|_gl|fbclid|gclid|dclid|gclsrc"
    "|gbraid|wbraid|msclkid|twclid|ttclid|yclid|ysclid|irclickid|sccid|rdt_cid|li_fat_id|igshid|igsh"
    "|mkt_tok|vero_id|oly_anon_id|oly_enc_id|wickedid|s_cid|srsltid|epik|ref_src|ref_url|trk",
    re.IGNORECASE,
)
_LONGEST = 40  # characters of one value; the longest that the page writes has 18
_MOST_NAMED = 8  # problems in one sentence
MOST_PINS = 3
"""Largest number of pins."""
PIN_KEYS = {f"p{number}": number for number in range(1, MOST_PINS + 1)}
"""The number of the pin of each key in the address that stands for a pin."""
_LONGEST_PIN = 1000  # characters; enough for every input and a name
_LONGEST_NAME = 24  # characters
PINNED = names_for(Use.PINNED)
"""The inputs that a pin keeps."""


@dataclass(frozen=True)
class PinnedInputs:
    """A setting of the inputs that is kept to be compared with later ones.

    Parameters
    ----------
    name : str
    number : int
        1 to `MOST_PINS`; it decides how the curves are drawn.
    inputs : mapping
        By name, those of `PINNED`.
    """

    name: str
    number: int
    inputs: Mapping[str, Any]


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "1" if value else "0"
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def to_query(inputs: Mapping[str, Any], pins: Sequence[PinnedInputs] = ()) -> str:
    """Return every input and pin as a query: the version first, without the question mark."""
    texts = {name: _text(inputs[name]) for name in KEYS}
    pairs = [("v", str(VERSION)), *((key, texts[name]) for name, key in KEYS.items())]
    for pin in pins:
        others = {name: _text(pin.inputs[name]) for name in PINNED}
        moved = [f"{KEYS[name]}_{text}" for name, text in others.items() if text != texts[name]]
        pairs.append((f"p{pin.number}", f"{'~'.join(moved)}~~{pin.name}"))
    return urlencode(pairs)


def _value(name: str, text: str) -> Any:
    """Return the value that a text means for an input, or the text itself if it means none.

    Raises
    ------
    TwoReadings
        If it is a number with two readings.
    """
    parameter = State.param[name]
    if isinstance(parameter, param.Boolean):
        return {"0": False, "1": True}.get(text, text)
    if isinstance(parameter, param.Number):
        try:
            return read_number(text)
        except TwoReadings:
            raise
        except UserError:
            return text
    if name == "material":
        return material_named(text) or text.casefold()
    choices = {choice.casefold(): choice for choice in parameter.objects}
    return choices.get(text.casefold(), text)


def _is_tracking(key: str) -> bool:
    """Whether a mail program, a search engine or a social network added a key."""
    return _TRACKING.fullmatch(key[:_LONGEST]) is not None


def _decoded(texts: Sequence[bytes | str]) -> list[str]:
    return [
        text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text) for text in texts
    ]


def from_arguments(
    arguments: Mapping[str, Sequence[bytes | str]],
) -> tuple[dict[str, Any], list[str]]:
    """Return the values of an address by input name, and the keys that were not understood.

    `pins_from_arguments` reads the pins, and `State.change` checks the ranges.
    """
    values: dict[str, Any] = {}
    doubtful: list[str] = []
    for key, encoded in arguments.items():
        texts = _decoded(encoded)
        if key in PIN_KEYS or key == OWN_KEY or _is_tracking(str(key)):
            continue
        if key == "v":
            if texts != [str(VERSION)]:
                doubtful.append("v")
        elif key not in _NAMES:
            doubtful.append(str(key)[:20])
        elif len(texts) != 1:
            doubtful.append(f"{key} (given more than once)")
        elif len(texts[0]) > _LONGEST:
            doubtful.append(f"{key} (too long)")
        else:
            try:
                values[_NAMES[key]] = _value(_NAMES[key], texts[0])
            except TwoReadings as error:
                doubtful.append(f"{key} ({error})")
    if values.get("marker") is False and "marker_follows" not in values:
        # earlier versions wrote at=0 with a place for a marker that nobody had asked for
        values = {name: value for name, value in values.items() if name not in _MARKER}
    return values, doubtful


def pins_from_arguments(
    arguments: Mapping[str, Sequence[bytes | str]], inputs: Mapping[str, Any]
) -> tuple[list[PinnedInputs], list[str]]:
    """Return the pins of an address whose present state is `inputs`, and the problems of others.

    A pin with a problem is left out as a whole.
    """
    pins: list[PinnedInputs] = []
    doubtful: list[str] = []
    for key, number in PIN_KEYS.items():
        texts = _decoded(arguments.get(key, ()))
        if not texts:
            continue
        try:
            pins.append(_pin(number, texts, inputs))
        except UserError as error:
            doubtful.append(f"{key} ({error})")
    return pins, doubtful


def _pin(number: int, texts: Sequence[str], inputs: Mapping[str, Any]) -> PinnedInputs:
    if len(texts) != 1:
        raise UserError("given more than once")
    if len(texts[0]) > _LONGEST_PIN:
        raise UserError("too long")
    moved, mark, name = texts[0].partition("~~")
    if not mark:
        raise UserError("not a pin")
    values = dict(inputs)
    for part in moved.split("~") if moved else ():
        key, _, text = part.partition("_")
        name_of = _NAMES.get(key)
        if name_of not in PINNED:
            raise UserError(f"no input {key[:20]!r}")
        if not text or len(text) > _LONGEST:
            raise UserError(f"no value of {key}")
        values[name_of] = _value(name_of, text)
    state = State()
    for problem_of, problem in state.change(values).items():
        raise UserError(f"{KEYS.get(problem_of, problem_of)} {problem}")
    kept = state.inputs()
    return PinnedInputs(pin_name(name, number), number, {name: kept[name] for name in PINNED})


def pin_name(words: Any, number: int) -> str:
    """Return a name of printable characters, shortened, or "Pin A" and so on by the number."""
    words = words[: 4 * _LONGEST_NAME] if isinstance(words, str) else ""
    name = "".join(letter for letter in " ".join(words.split()) if letter.isprintable())
    return name[:_LONGEST_NAME].strip() or f"Pin {chr(ord('A') + number - 1)}"


def named_problems(doubtful: Sequence[str], refused: Mapping[str, str]) -> str:
    """Return the keys of an address that were not taken, with reasons; empty if there is none."""
    named = [*doubtful, *(f"{KEYS.get(name, name)} ({why})" for name, why in refused.items())]
    more = f" and {len(named) - _MOST_NAMED} more" if len(named) > _MOST_NAMED else ""
    return ", ".join(named[:_MOST_NAMED]) + more


def describe_problems(doubtful: Sequence[str], refused: Mapping[str, str]) -> str:
    """Return one sentence that names what of an address was ignored, or an empty text."""
    problems = named_problems(doubtful, refused)
    return f"Ignored in the address: {problems}." if problems else ""
