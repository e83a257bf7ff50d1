"""The show block of a step: what is on the screen, and what the student moves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..state import State
from .quantities import find
from .tables import Table

__all__ = ["POINT_PARTS", "Show", "read_show"]

_CHARTS = ("instability", "load-frequency", "campbell")
POINT_PARTS = ("shaft", "response", "multipliers", "orbit")
"""Parts of the panel of the marked point, in the order in which they are shown."""
_KEYS = ("look", "cover", "move", "sliders", "given", "watch")
_MOST_NAMES = 8
_STATE = State()

Range = tuple[float, float, float]


@dataclass(frozen=True)
class Show:
    """What a step shows; nothing else of the dashboard can be seen or changed during it.

    Parameters
    ----------
    look : tuple of str
        The charts, and parts of the panel of the marked point.
    cover : tuple of str
        Those of `look` that are covered until the question is answered.
    move : tuple of str
        Inputs that the student changes.
    sliders : mapping of str to (float, float, float)
        Smallest value, largest value and step of those of `move` that do not have the usual ones.
    given, watch : tuple of str
        Quantities shown with Predict, and with Try.
    """

    look: tuple[str, ...]
    cover: tuple[str, ...]
    move: tuple[str, ...]
    sliders: Mapping[str, Range]
    given: tuple[str, ...]
    watch: tuple[str, ...]

    @property
    def charts(self) -> tuple[str, ...]:
        """The charts of `look`, without the parts of the marked point."""
        return tuple(name for name in self.look if name in _CHARTS)


def read_show(
    values: Mapping[str, Any],
    table: Table,
    before: Mapping[str, Any],
    after: Mapping[str, Any],
) -> Show:
    """Return the show block of a step.

    Parameters
    ----------
    values : mapping
        The block; empty if the step has none.
    table : Table
        Its text, for errors.
    before, after : mapping
        Every input when the step begins, and after its Try.

    Raises
    ------
    LessonError
        With the line and the reason.
    """
    table.only(values, _KEYS, "a show block")
    look = _look(values, table, before["marker"] or after["marker"])
    sliders = _sliders(values, table, before, after)
    move = _names(values, "move", table, _STATE.inputs().__contains__)
    for name in move:
        if name in sliders:
            raise table.error("sliders", f"sliders: {name} is in move already; name it once")
    return Show(
        look=look,
        cover=_cover(values, table, look),
        move=(*move, *sliders),
        sliders=sliders,
        given=_names(values, "given", table, _is_quantity),
        watch=_names(values, "watch", table, _is_quantity),
    )


def _is_quantity(name: str) -> bool:
    return find(name) is not None


def _names(values: Mapping[str, Any], key: str, table: Table, known: Any) -> tuple[str, ...]:
    value = values.get(key, [])
    names = [value] if isinstance(value, str) else value
    if not isinstance(names, list) or len(names) > _MOST_NAMES:
        raise table.error(key, f"{key} must be a list of up to eight names")
    for name in names:
        if not isinstance(name, str):
            raise table.error(key, f"{key} must be a list of names")
        if not known(name):
            raise table.error(key, f"{key}: there is no {name[:60]!r}")
    return tuple(names)


def _look(values: Mapping[str, Any], table: Table, marked: bool) -> tuple[str, ...]:
    """Return what the step shows; without `look` the three charts."""
    known = (*_CHARTS, *POINT_PARTS, "inspector")
    look = _names(values, "look", table, known.__contains__) or _CHARTS
    # all parts of the marked point have this name together
    if "inspector" in look:
        look = (*(name for name in look if name in _CHARTS), *POINT_PARTS)
    elif not marked and (parts := [name for name in look if name in POINT_PARTS]):
        raise table.error("look", f"look: {parts[0]} needs a marked point: set marker = true")
    return tuple(dict.fromkeys(look))


def _cover(values: Mapping[str, Any], table: Table, look: tuple[str, ...]) -> tuple[str, ...]:
    value = values.get("cover", False)
    if isinstance(value, bool):
        return look if value else ()
    if not isinstance(value, str | list):
        raise table.error("cover", "cover must be true, false or a list of names of look")
    return _names(values, "cover", table, look.__contains__)


def _sliders(
    values: Mapping[str, Any],
    table: Table,
    before: Mapping[str, Any],
    after: Mapping[str, Any],
) -> dict[str, Range]:
    """Return the range of each slider; it holds what the step sets."""
    value = values.get("sliders", {})
    if not isinstance(value, dict) or len(value) > _MOST_NAMES:
        raise table.error("sliders", "sliders must be a table of up to eight inputs")
    found = {}
    for name, triple in value.items():
        found[name] = low, high, _ = _range(name, triple, table)
        for inputs, when in ((before, "when the step begins"), (after, "after Try")):
            if not low <= inputs[name] <= high:
                raise table.error(
                    "sliders", f"sliders: {name} is {inputs[name]:g} {when}, beyond its slider"
                )
    return found


def _range(name: str, triple: Any, table: Table) -> Range:
    if not isinstance(_STATE.inputs().get(name), float):
        raise table.error("sliders", f"sliders: there is no number {name[:60]!r}")
    match triple:
        case [int() | float() as low, int() | float() as high, int() | float() as step]:
            smallest, largest = State.param[name].bounds
            if smallest <= low < high <= largest and 0 < step <= high - low:
                return float(low), float(high), float(step)
            raise table.error(
                "sliders",
                f"sliders: {name} must be [low, high, step] within {smallest:g} to {largest:g}",
            )
    raise table.error("sliders", f"sliders: {name} must be three numbers, [low, high, step]")
