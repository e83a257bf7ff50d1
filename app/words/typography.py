"""A number and its unit stay on one line: a no-break space stands between them."""

from __future__ import annotations

import re

__all__ = ["keep_units_together", "with_unit"]

_NO_BREAK_SPACE = "\u00a0"
_UNITS = "%|k?Hz|[kM]?N|kg|m?m|s|1/s|rpm|rad/s|GPa|kB"
_PAIR = re.compile(rf"(?<=\d) (?=(?:{_UNITS})(?![\w/]))")


def with_unit(number: str, unit: str) -> str:
    """Return a number with its unit, or the number alone where the unit is empty."""
    return f"{number}{_NO_BREAK_SPACE}{unit}" if unit else number


def keep_units_together(text: str) -> str:
    """Return a written text with no-break spaces between its numbers and their units.

    Examples
    --------
    >>> keep_units_together("6.1 % of it at 20 Hz").split(" ")
    ['6.1\\xa0%', 'of', 'it', 'at', '20\\xa0Hz']
    """
    return _PAIR.sub(_NO_BREAK_SPACE, text)
