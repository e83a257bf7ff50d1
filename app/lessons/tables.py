"""Blocks of TOML in a lesson's file, and errors with the number of their line."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..reading.toml import TomlError, read_toml
from ..state import State

__all__ = ["LessonError", "Table", "set_inputs"]

LONGEST_LINE = 600  # characters of one text


class LessonError(ValueError):
    """An error in a lesson's file, with the number of its line."""

    def __init__(self, line: int, reason: str) -> None:
        super().__init__(f"line {line}: {reason}")
        self.line = line
        self.reason = reason


@dataclass(frozen=True)
class Table:
    """A block of TOML and its place in the file, to give errors the number of their line.

    Parameters
    ----------
    text : str
    line : int
        Number of its first line in the file.
    """

    text: str
    line: int

    def read(self) -> dict[str, Any]:
        """Return the values of the block."""
        try:
            return read_toml(self.text)
        except TomlError as error:
            raise LessonError(self.line + error.line - 1, error.reason) from None

    def where(self, key: str) -> int:
        """Return the number of the line of a key."""
        for number, line in enumerate(self.text.splitlines()):
            if re.match(rf"\s*\[*\s*{re.escape(key)}\b", line):
                return self.line + number
        return self.line

    def error(self, key: str, reason: str) -> LessonError:
        """Return an error at a key."""
        return LessonError(self.where(key), reason)

    def only(self, values: Mapping[str, Any], allowed: tuple[str, ...], what: str) -> None:
        """Refuse keys that are not allowed; `what` names the block."""
        for key in values:
            if key not in allowed:
                raise self.error(key, f"{what} has no {key[:40]!r}; known: {', '.join(allowed)}")

    def line_of_text(
        self, values: Mapping[str, Any], key: str, needed: bool = True, what: str = ""
    ) -> str:
        """Return a short text; `what` names it in an error instead of its key."""
        value = values.get(key, None if needed else "")
        if not isinstance(value, str) or (needed and not value.strip()):
            raise self.error(key, f"{what or key} must be a text")
        if len(value) > LONGEST_LINE:
            raise self.error(key, f"{what or key} is longer than {LONGEST_LINE} characters")
        return value.strip()


def set_inputs(
    changes: Mapping[str, Any], inputs: Mapping[str, Any], table: Table
) -> dict[str, Any]:
    """Return all inputs after some were changed; a value that the page would refuse is an error."""
    state = State(**inputs)
    refused = state.change(changes)
    if refused:
        name, why = next(iter(refused.items()))
        raise table.error(name, f"{name}: {why}")
    return state.inputs()
