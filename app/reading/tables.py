"""The tables of a user's TOML file, checked key by key.

Every error is one line of text with the line of the file, the key, what is allowed and the value.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NoReturn

from .numbers import printable, read_number
from .quantities import quantity
from .toml import read_toml
from .user_error import UserError

__all__ = ["Tables", "shown"]


def shown(value: object) -> str:
    """Return a user's value as one short line."""
    try:
        return printable(repr(value)[:99])
    except ValueError:  # Python writes no integer of thousands of digits
        return "a number of thousands of digits"


def _lines(text: str) -> dict[str, int]:
    """Return the number of the line of every table and key, in the usual way of writing TOML."""
    found: dict[str, int] = {}
    table = ""
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.match(r"\s*\[\s*([\w-]{1,40})\s*\]", line):
            table = match[1]
            found.setdefault(table, number)
        elif match := re.match(r"\s*([\w-]{1,40})(?:\s*\.\s*([\w-]{1,40}))?\s*=", line):
            keys = [key for key in (table, match[1], match[2]) if key]
            found.setdefault(".".join(keys), number)
            found.setdefault(keys[0], number)
    return found


class Tables:
    """The tables of one text.

    Parameters
    ----------
    text : str
        TOML.
    keys : mapping of str to tuple of str
        The keys that each table may have.
    """

    def __init__(self, text: str, keys: Mapping[str, tuple[str, ...]]) -> None:
        self.keys = keys
        self.lines = _lines(text)
        self.tables = read_toml(text)

    def sentence(self, key: str, problem: str) -> str:
        """Return the problem of a key, such as "shaft.length", with the number of its line."""
        line = self.lines.get(key) or self.lines.get(key.partition(".")[0])
        where = f"line {line}: " if line else ""
        return f"{where}{printable(key, 80)} {problem}"

    def fail(self, key: str, problem: str) -> NoReturn:
        """Refuse the file because of a key."""
        raise UserError(self.sentence(key, problem))

    def table(self, name: str) -> Mapping[str, Any]:
        """Return a table; an unknown key in it is an error."""
        found = self.tables[name]
        if not isinstance(found, dict):
            self.fail(name, f"must be a table, [{name}]")
        for key in found:
            if key not in self.keys[name]:
                self.fail(
                    f"{name}.{key}", f"is unknown; [{name}] takes {', '.join(self.keys[name])}"
                )
        return found

    def need(self, name: str, keys: tuple[str, ...]) -> None:
        """Refuse a table that lacks a key."""
        for key in keys:
            if key not in self.tables[name]:
                self.fail(name, f"lacks {key}")

    def quantity(self, path: str, value: object, dimension: str) -> float:
        """Return a quantity in SI."""
        try:
            return quantity(value, dimension)
        except UserError as error:
            self.fail(path, printable(str(error), 250))

    def positive(self, path: str, value: object, dimension: str, zero: bool = False) -> float:
        """Return a quantity in SI that is above 0, or 0 where `zero` allows it."""
        found = self.quantity(path, value, dimension)
        if found < 0 or (found == 0 and not zero):
            allowed = "0 or more" if zero else "more than 0"
            self.fail(path, f"must be {allowed}; {shown(value)} is not")
        return found

    def number(self, path: str, value: object) -> float:
        """Return a plain finite number, which may be a text."""
        if isinstance(value, str):
            try:
                value = read_number(value)
            except UserError as error:
                self.fail(path, f"must be a plain number; {error}")
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        if not plain or not -1e100 < value < 1e100:  # type: ignore[operator]
            self.fail(path, f"must be a plain number; {shown(value)} is not one")
        return float(value)  # type: ignore[arg-type]
