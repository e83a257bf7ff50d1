"""Edits of a rotor in the tables of the page Your rotor: one cell, or a row more or less."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from rotorstab import MATERIALS, Bearing, Disk, Material, Rotor, ShaftSection

from ..reading.numbers import printable
from ..reading.user_error import UserError

__all__ = ["MOST_ROWS", "edited", "tables"]

MOST_ROWS = 60
"""Largest number of rows of a table on the page; a rotor with more is edited in its file."""


class _Column(NamedTuple):
    """One column: the argument of the part, its head, and one unit of it in SI."""

    key: str
    head: str
    unit: float = 1.0


_MATERIAL = "material"
_COLUMNS: Mapping[str, tuple[_Column, ...]] = {
    "sections": (
        _Column("length", "length [mm]", 1e-3),
        _Column("outer_diameter", "outer Ø [mm]", 1e-3),
        _Column("inner_diameter", "bore Ø [mm]", 1e-3),
        _Column(_MATERIAL, "material"),
    ),
    "disks": (
        _Column("position", "position [mm]", 1e-3),
        _Column("mass", "mass [kg]"),
        _Column("diametral_inertia", "I_D [kg m²]"),
        _Column("polar_inertia", "I_P [kg m²]"),
    ),
    "bearings": (
        _Column("position", "position [mm]", 1e-3),
        _Column("kxx", "kxx [MN/m]", 1e6),
        _Column("kyy", "kyy [MN/m]", 1e6),
        _Column("cxx", "cxx [N s/m]"),
        _Column("cyy", "cyy [N s/m]"),
    ),
}
_Part = ShaftSection | Disk | Bearing


def tables(rotor: Rotor) -> dict[str, Any]:
    """Return the tables of a rotor as plain values, in the units of their heads."""
    return {
        name: {
            "keys": [column.key for column in columns],
            "heads": [column.head for column in columns],
            "rows": [
                [_shown(part, column) for column in columns]
                for part in getattr(rotor, name)[:MOST_ROWS]
            ],
            "more": max(0, len(getattr(rotor, name)) - MOST_ROWS),
        }
        for name, columns in _COLUMNS.items()
    } | {_MATERIAL: list(MATERIALS)}


def _shown(part: _Part, column: _Column) -> float | str:
    value = getattr(part, column.key)
    if isinstance(value, Material):
        names = (name for name, known in MATERIALS.items() if known == value)
        return next(names, "own")
    return float(f"{value / column.unit:.9g}")


def edited(rotor: Rotor, message: Mapping[str, Any]) -> Rotor:
    """Return a rotor with the edit that a message asks for.

    Parameters
    ----------
    rotor : Rotor
    message : mapping
        With "part" and "row", and "key" and "value" of a cell, or "do", "add" or "remove". It may
        be forged.

    Raises
    ------
    UserError
        If there is no such cell.
    ValueError
        If the part or the rotor refuses the value; the message says what is allowed.
    """
    name, row = message.get("part"), message.get("row")
    if not isinstance(name, str) or name not in _COLUMNS:
        raise UserError("there is no such table")
    parts: list[_Part] = list(getattr(rotor, name))
    number = row if isinstance(row, int) and not isinstance(row, bool) else -1
    if message.get("do") == "add":
        parts.insert(max(number, -1) + 1, _copied(rotor, name, number))
    elif not 0 <= number < len(parts):
        raise UserError("there is no such row")
    elif message.get("do") == "remove":
        del parts[number]
    else:
        parts[number] = _changed(parts[number], name, message)
    changed: dict[str, Any] = {name: tuple(parts)}
    return replace(rotor, **changed)


def _copied(rotor: Rotor, name: str, row: int) -> _Part:
    """Return a new part: a copy of the row above it, or a usual one in an empty table."""
    parts: tuple[_Part, ...] = getattr(rotor, name)
    if 0 <= row < len(parts):
        return parts[row]
    if parts:
        return parts[-1]
    middle = rotor.length / 2
    return Bearing(middle, 1e6) if name == "bearings" else Disk(middle, 1.0, 1e-3, 2e-3)


def _changed(part: _Part, name: str, message: Mapping[str, Any]) -> _Part:
    """Return a part with another value in one of its columns."""
    columns = {column.key: column for column in _COLUMNS[name]}
    key, value = message.get("key"), message.get("value")
    if not isinstance(key, str) or key not in columns:
        raise UserError("there is no such column")
    values: dict[str, Any] = {}
    if key == _MATERIAL:
        if not isinstance(value, str) or value not in MATERIALS:
            raise UserError(f"the material must be one of {', '.join(MATERIALS)}")
        values[key] = MATERIALS[value]
    elif isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
        raise UserError(f"{columns[key].head} must be a number, got {printable(repr(value)[:40])}")
    else:
        values[key] = float(value) * columns[key].unit
    if isinstance(part, ShaftSection) and _has_usual_shear(part):
        values["shear_coefficient"] = None
    return replace(part, **values)


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(float(value))
    except OverflowError:  # an integer of hundreds of digits
        return False


def _has_usual_shear(section: ShaftSection) -> bool:
    """Whether the shear coefficient is the one that follows from the section itself."""
    return section.shear_coefficient == replace(section, shear_coefficient=None).shear_coefficient
