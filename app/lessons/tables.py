"""Pieces of TOML in a lesson's file, and faults that name their line."""

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
    """What is wrong with a lesson's file, and in which line."""

    def __init__(self, line: int, reason: str) -> None:
        super().__init__(f"line {line}: {reason}")
        self.line = line
        self.reason = reason


@dataclass(frozen=True)
class Table:
    """A piece of TOML and where it stands, to name the line of a fault."""

    text: str
    line: int  # of its first line

    def read(self) -> dict[str, Any]:
        try:
            return read_toml(self.text)
        except TomlError as error:
            raise LessonError(self.line + error.line - 1, error.reason) from None

    def where(self, key: str) -> int:
        for number, line in enumerate(self.text.splitlines()):
            if re.match(rf"\s*\[*\s*{re.escape(key)}\b", line):
                return self.line + number
        return self.line

    def error(self, key: str, reason: str) -> LessonError:
        return LessonError(self.where(key), reason)

    def only(self, values: Mapping[str, Any], allowed: tuple[str, ...], what: str) -> None:
        for key in values:
            if key not in allowed:
                raise self.error(key, f"{what} has no {key[:40]!r}; known: {', '.join(allowed)}")

    def line_of_text(
        self, values: Mapping[str, Any], key: str, needed: bool = True, what: str = ""
    ) -> str:
        value = values.get(key, None if needed else "")
        if not isinstance(value, str) or (needed and not value.strip()):
            raise self.error(key, f"{what or key} must be a text")
        if len(value) > LONGEST_LINE:
            raise self.error(key, f"{what or key} is longer than {LONGEST_LINE} characters")
        return value.strip()


def set_inputs(given: Mapping[str, Any], on: Mapping[str, Any], table: Table) -> dict[str, Any]:
    """Return all inputs after some were set; what the page would refuse is an error."""
    state = State(**on)
    refused = state.change(given)
    if refused:
        name, why = next(iter(refused.items()))
        raise table.error(name, f"{name}: {why}")
    return state.inputs()
