"""The elements of one ROSS file: their numbers, and messages that say where they stand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NoReturn

import numpy as np

from .._types import Array
from .places import RotorFileError
from .quantities import plain_number

__all__ = ["RossTables"]


class RossTables:
    """The tables of one ROSS file.

    Parameters
    ----------
    tables : mapping
        As parsed from TOML or JSON.
    lines : mapping of str to int
        Where each table and key stands, for messages.

    Attributes
    ----------
    elements : dict of str to dict
        The table of each element by its name, such as "DiskElement_Disk 0".
    rated_speed : float or None
        [rad/s], where the file has one.
    left_out : dict of str to list of str
        What the rotor does not have, and the names of the elements that have it.
    """

    def __init__(self, tables: Mapping[str, Any], lines: Mapping[str, int]) -> None:
        self.lines = lines
        parameters = tables.get("parameters")
        rated = parameters.get("rated_w") if isinstance(parameters, dict) else None
        speed = plain_number(rated)
        self.rated_speed = speed if speed is not None and math.isfinite(speed) else None
        self.left_out: dict[str, list[str]] = {}
        self.elements = {
            name: table
            for name, table in tables.items()
            if isinstance(table, dict) and "_" in name and not name.startswith("_")
        }

    def named(self, *kinds: str) -> list[str]:
        """Return the names of the elements of some kinds, also of ROSS's 6-DoF variants."""
        return [name for name in self.elements if name.startswith(kinds)]

    def fail(self, name: str, problem: object, key: str = "") -> NoReturn:
        """Refuse the file because of an element."""
        line = self.lines.get(f"{name}.{key}") or self.lines.get(name)
        where = f"line {line}: " if line else ""
        raise RotorFileError(f"{where}{name}{f', {key}' if key else ''}: {problem}")

    def note(self, reason: str, name: str) -> None:
        """Name an element in a warning."""
        self.left_out.setdefault(reason, []).append(name)

    def number(self, name: str, key: str, default: float | None = None) -> float:
        """Return a number of an element."""
        value = self.elements[name].get(key, default)
        if value is None:
            self.fail(name, f"lacks {key}")
        found = plain_number(value)
        if found is None or not math.isfinite(found):
            self.fail(name, f"must be a number, got {repr(value)[:40]}", key)
        return found

    def numbers(self, name: str, key: str) -> Array:
        """Return the numbers of an element's key, one or several; 0 if there is none."""
        value = self.elements[name].get(key, 0.0)
        try:
            numbers = np.atleast_1d(np.asarray(value, dtype=np.float64))
        except (TypeError, ValueError, OverflowError):
            numbers = np.array([])
        if numbers.ndim != 1 or not numbers.size or not np.isfinite(numbers).all():
            self.fail(name, f"must be a number or a list of numbers, got {repr(value)[:40]}", key)
        return numbers

    def node(self, name: str, most: int) -> int:
        """Return the number of the node of an element, 0 to `most`."""
        at = self.number(name, "n")
        if not at.is_integer() or not 0 <= at <= most:
            self.fail(name, f"must be a node of the shaft, 0 to {most}", "n")
        return int(at)

    def position(self, name: str, nodes: list[float]) -> float:
        """Return the position [m] of the node of an element."""
        return nodes[self.node(name, len(nodes) - 1)]
