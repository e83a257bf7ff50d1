"""Numbers as people type them, with a decimal point or comma and with groups of thousands.

A text that can be read in two ways, such as "1,200", is refused. The browser's boxes read by the
same rules: `page.typed` in assets/page.js.
"""

from __future__ import annotations

import math
import re

from .user_error import UserError

__all__ = ["NUMBER", "TwoReadings", "printable", "read_number"]

_SPACES = "[ \u00a0\u2009\u202f'’_]"  # may stand between groups of thousands
_DIGITS = (
    rf"[0-9]{{1,3}}(?:{_SPACES}[0-9]{{3}})+(?:[.,][0-9]*)?"
    r"|[0-9]{1,3}(?:,[0-9]{3})+\.[0-9]*"
    r"|[0-9]{1,3}(?:\.[0-9]{3})+,[0-9]*"
    r"|[0-9]{1,3}(?:,[0-9]{3}){2,}"
    r"|[0-9]{1,3}(?:\.[0-9]{3}){2,}"
    r"|[0-9]+(?:[.,][0-9]*)?"
    r"|[.,][0-9]+"
)
NUMBER = rf"[+−-]?(?:{_DIGITS})(?:[eE][+−-]?[0-9]{{1,3}})?"
"""A regular expression of all numbers that are read, and of those with two readings."""
_NUMBER = re.compile(NUMBER)
_TWO_READINGS = re.compile(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}(?:[eE][+-]?[0-9]+)?")


class TwoReadings(UserError):
    """A number whose comma may be a decimal sign or a separator of thousands."""


def printable(text: str, longest: int = 40) -> str:
    """Return a foreign text as one short printable line."""
    line = "".join(letter if letter.isprintable() else " " for letter in text[: longest + 1])
    return line if len(text) <= longest else line[:longest] + " …"


def read_number(text: str) -> float:
    """Return the number that a text stands for.

    Parameters
    ----------
    text : str
        With a decimal point or a decimal comma; thousands may be grouped.

    Returns
    -------
    float
        Finite.

    Raises
    ------
    UserError
        If the text is no number or is too large.
    TwoReadings
        If its comma may be a decimal sign or a separator of thousands.

    Examples
    --------
    >>> read_number("0,3"), read_number("1,200.5"), read_number("7 850")
    (0.3, 1200.5, 7850.0)
    """
    plain = text.strip().replace("−", "-")
    if len(plain) > 400 or not _NUMBER.fullmatch(plain):
        raise UserError(f"{printable(text)!r} is not a number")
    if _TWO_READINGS.fullmatch(plain):
        readings = " or ".join(f"{float(plain.replace(',', point)):.10g}" for point in (".", ""))
        raise TwoReadings(f"{plain!r} can mean {readings}: write one of them")
    plain = re.sub(_SPACES, "", plain)
    last = max(plain.rfind("."), plain.rfind(","))
    if plain.count(".") > 1 or plain.count(",") > 1:
        # the sign that comes more than once groups thousands
        group = "." if plain.count(".") > 1 else ","
        plain = plain.replace(group, "").replace(",", ".")
    elif "." in plain and "," in plain:
        plain = plain.replace("," if plain[last] == "." else ".", "").replace(",", ".")
    value = float(plain.replace(",", "."))
    if not math.isfinite(value):
        raise UserError(f"{printable(text)!r} is too large")
    return value
