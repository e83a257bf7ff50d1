"""Reads a user's TOML: bounded before it is parsed, with errors that a user understands.

The time and memory that tomllib needs grow with the square of the number of parts of a key.
"""

from __future__ import annotations

import re
import tomllib
from typing import Any

from .numbers import NUMBER, printable, read_number
from .user_error import UserError

__all__ = ["MOST_LEVELS", "TomlError", "read_toml"]

MOST_LEVELS = 8
"""Largest number of parts of a dotted key, and of brackets within brackets."""
# A text may end with two quotes more than close it. One that is not closed reaches to its end,
# where tomllib stops as well. Each character is then looked at once: the time grows with the
# length, not with its square.
_TEXT_OR_COMMENT = re.compile(
    r'"""(?:\\.|[^\\])*?(?:"{3,5}|\\?\Z)|\'\'\'.*?(?:\'{3,5}|\Z)'
    r'|"(?:\\.|[^"\\\n])*(?:"|(?=\n)|\\?\Z)|\'[^\'\n]*(?:\'|(?=\n)|\Z)|#[^\n]*',
    re.DOTALL,
)
_PART = r'(?:[^\s.,=\[\]{}"]+|"")'
_DOTTED = re.compile(rf'(?<![^\s.,=\[\]{{}}"]){_PART}(?:[ \t]*\.[ \t]*{_PART}){{{MOST_LEVELS}}}')


class TomlError(UserError):
    """An error in a text, with the number of its line."""

    def __init__(self, line: int, reason: str) -> None:
        super().__init__(f"line {line}: {reason}")
        self.line = line
        self.reason = reason


def _line_of(text: str, at: int) -> int:
    return text.count("\n", 0, at) + 1


def _check_levels(text: str) -> None:
    """Refuse a text that is nested too deep; strings and comments do not count."""
    # lines keep their numbers
    bare = _TEXT_OR_COMMENT.sub(
        lambda found: ("" if found[0][0] == "#" else '""') + "\n" * found[0].count("\n"), text
    )
    at = len(bare)
    if dotted := _DOTTED.search(bare):
        at = dotted.start()
    level = 0
    for found in re.finditer(r"[\[\]{}]", bare[:at]):
        level += 1 if found[0] in "[{" else -1
        if level > MOST_LEVELS:
            at = found.start()
            break
    if at < len(bare):
        raise TomlError(_line_of(bare, at), f"it is nested deeper than {MOST_LEVELS} levels")


def _advice(line: str) -> str:
    """Return how to correct a line that is not TOML, or an empty text if that is not clear."""
    if quote := re.search("[“”„«»‘’]", line):
        return f'write straight quotes, " instead of {quote[0]}'
    value = line.partition("=")[2].partition("#")[0].strip()
    if re.fullmatch(r"[+-]?\d{4301,}", value):
        return "a number has too many digits"
    if len(value) > 60:
        return ""
    if "," in value and re.fullmatch(NUMBER, value):
        try:
            return f"write a number with a point, {read_number(value):.10g}, not with a comma"
        except UserError as error:
            return f"a number has no comma: {error}"
    if re.fullmatch(rf"(?:{NUMBER})\s*[^\W\d_][^\"'\[\]{{}}]*", value):
        return f'a quantity is a text in quotes: "{value}"'
    if re.fullmatch(r"[^\W\d_][\w -]*", value):
        return f'a name is a text in quotes: "{value}"'
    return ""


def read_toml(text: str) -> dict[str, Any]:
    """Return the tables of a text.

    Parameters
    ----------
    text : str
        Of a bounded length.

    Raises
    ------
    TomlError
        With the line, and the reason as one printable line.
    """
    text = re.sub("\r\n?", "\n", text.removeprefix("\ufeff"))  # lines of any system
    if bad := re.search("[\x00\ufffd]", text):
        raise TomlError(_line_of(text, bad.start()), "the file is not UTF-8 text")
    _check_levels(text)
    lines = text.split("\n")
    try:
        return tomllib.loads(text + "\n\n")  # the last line has a number too
    except tomllib.TOMLDecodeError as error:
        words = str(error)
        found = re.search(r" \(at line (\d+), column \d+\)$", words)
        number = min(int(found[1]), len(lines)) if found else len(lines)
        words = words[: found.start()] if found else words
    except (ValueError, RecursionError, OverflowError):
        # an integer of thousands of digits, a date that is none
        number, words = _unreadable(lines), "a value in it cannot be read"
    raise TomlError(number, _advice(lines[number - 1]) or f"not TOML: {printable(words, 80)}")


def _unreadable(lines: list[str]) -> int:
    """Return the number of the first line that cannot be read by itself."""
    for number, line in enumerate(lines, 1):
        try:
            tomllib.loads(line)
        except tomllib.TOMLDecodeError:
            continue
        except (ValueError, RecursionError, OverflowError):
            return number
    return len(lines)
