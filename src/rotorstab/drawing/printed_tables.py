"""The tables of a printed page: names at the left of a column, values at its right."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..charts.sheet import Rows
from .text_blocks import LINE, text_width, write_lines
from .typesetting import mathtext

__all__ = ["Box", "settings_height", "write_settings", "write_tables"]

_LARGEST, _SMALLEST = 7.5, 5.0  # font sizes of tables beside charts [pt]
_SETTINGS = 6.5  # font size of the table below them [pt]
_COLUMN_GAP = 0.18  # between the columns of a table, in inches


@dataclass(frozen=True)
class Box:
    """A part of a page: left and right end, lower and upper end, in inches."""

    left: float
    right: float
    low: float
    high: float

    @property
    def width(self) -> float:
        """From the left to the right end."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From the lower to the upper end."""
        return self.high - self.low

    def raised(self, height: float) -> Box:
        """Return the box with an upper end higher by a length."""
        return replace(self, high=self.high + height)


def _settings_columns(rows: Rows, width: float) -> int:
    """Return how many columns of rows stand beside each other."""
    widest = max((text_width("  ".join(row), _SETTINGS) for row in rows), default=width)
    return max(1, int((width + _COLUMN_GAP) / (widest + _COLUMN_GAP)))


def settings_height(settings: tuple[str, Rows], width: float) -> float:
    """Return the height in inches of a table that `write_settings` writes."""
    _, rows = settings
    return LINE * _SETTINGS * (1.2 + math.ceil(len(rows) / _settings_columns(rows, width)))


def write_settings(drawn: Any, settings: tuple[str, Rows], box: Box) -> None:
    """Write a table below its title, in as many columns as there is room for."""
    title, rows = settings
    top = write_lines(drawn, (box.left, box.high), [title], _SETTINGS, fontweight="bold")
    columns = _settings_columns(rows, box.width)
    lines = math.ceil(len(rows) / columns)
    width = (box.width + _COLUMN_GAP) / columns
    for index, row in enumerate(rows):
        column, line = divmod(index, lines)
        left = box.left + column * width
        base = top - LINE * _SETTINGS * (line + 0.78)
        _write_row(drawn, row, (left, left + width - _COLUMN_GAP), base, _SETTINGS)


def write_tables(drawn: Any, tables: Sequence[tuple[str, Rows]], box: Box) -> None:
    """Write tables below each other, as large as there is room for."""
    size = _LARGEST
    while size > _SMALLEST:
        lines = sum(1.5 + len(_paired(rows, box.width, size)) for _, rows in tables)
        if LINE * size * lines <= box.height:
            break
        size -= 0.25
    top = box.high
    for title, rows in tables:
        top = write_lines(drawn, (box.left, top), [title], size + 0.5, fontweight="bold")
        for line in _paired(rows, box.width, size):
            _write_line(drawn, line, box, top - 0.78 * LINE * size, size)
            top -= LINE * size
        top -= 0.4 * LINE * size


def _half(width: float) -> float:
    return 0.5 * (width - _COLUMN_GAP)


def _paired(rows: Rows, width: float, size: float) -> list[Rows]:
    """Return the lines of a table: two rows each, and one where it is too wide for that."""
    lines: list[Rows] = []
    waiting: Rows = ()
    for row in rows:
        if text_width("  ".join(row), size) > _half(width):
            lines.append((row,))
        elif waiting:
            lines.append((*waiting, row))
            waiting = ()
        else:
            waiting = (row,)
    return [*lines, waiting] if waiting else lines


def _write_line(drawn: Any, line: Rows, box: Box, base: float, size: float) -> None:
    """Write the one or two rows of a line."""
    half = _half(box.width)
    whole = len(line) == 1 and text_width("  ".join(line[0]), size) > half
    for index, row in enumerate(line):
        left = box.left + index * (half + _COLUMN_GAP)
        _write_row(drawn, row, (left, box.right if whole else left + half), base, size)


def _write_row(
    drawn: Any, row: tuple[str, str], ends: tuple[float, float], base: float, size: float
) -> None:
    """Write a name at the left end of a column and its value at the right end."""
    across, down = drawn.get_size_inches()
    for x, text, side in zip(ends, row, ("left", "right"), strict=True):
        drawn.text(x / across, base / down, mathtext(text), fontsize=size, ha=side, va="baseline")
