"""Numbers and texts as cells of CSV and values of JSON, so that they read back exactly."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from io import StringIO
from typing import Any

import numpy as np

__all__ = ["comment_lines", "csv_rows", "json_text", "parameter_words", "plain_numbers"]

# what a formula or a command of a spreadsheet begins with, at full width too
_COMPUTED = frozenset("=+-@|%＝＋－＠")


def comment_lines(
    title: str, details: Iterable[str], parameters: Mapping[str, Any], link: str = ""
) -> str:
    """Return the comment lines that open a CSV file."""
    lines = [title, *details]
    if link:
        lines.append(f"link: {link}")
    if parameters:
        lines.append("parameters, non-dimensional unless a unit is given:")
        lines += [f"  {name} = {_plain(value)}" for name, value in parameters.items()]
    return "".join(f"# {line}\n" for line in lines)


def parameter_words(parameters: Mapping[str, Any]) -> str:
    """Return parameters in one line, as `name = value` separated by semicolons."""
    return "; ".join(f"{name} = {_plain(value)}" for name, value in parameters.items())


def _plain(value: Any) -> str:
    """Write a parameter so that it reads back exactly."""
    return json.dumps(value, ensure_ascii=False)


def _cell(value: Any) -> Any:
    """Write a number so that it reads back exactly; NaN is an empty cell.

    A text that a spreadsheet would compute, such as a pin's name that begins with "=", is quoted.
    """
    if isinstance(value, float | np.floating):
        return "" if math.isnan(value) else repr(float(value))
    if isinstance(value, str):
        line = "".join(letter if letter.isprintable() else " " for letter in value)
        return f"'{line}" if line.lstrip()[:1] in _COMPUTED and not _is_number(line) else line
    return value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def csv_rows(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a header and rows as CSV text."""
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return stream.getvalue()


def json_text(value: Any) -> str:
    """Return plain values as JSON text; NaN and infinities are refused."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def plain_numbers(values: Iterable[float]) -> list[float | None]:
    """Return plain numbers, None for NaN and infinities."""
    return [float(value) if math.isfinite(value) else None for value in values]
