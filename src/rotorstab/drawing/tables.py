"""Figures and tables as CSV and JSON, and files that are written whole or not at all.

A CSV file holds exactly the arrays that are drawn, to the last digit, below comment lines
with what made them. Nothing depends on the time or the place of writing.
"""

from __future__ import annotations

import csv
import json
import math
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from ..paper import Figure, Grid, Panel, Region, Series, Table

__all__ = [
    "columns_csv",
    "columns_json",
    "figure_csv",
    "figure_json",
    "table_csv",
    "table_json",
    "write_file",
]


# what a formula or a command of a spreadsheet begins with, at full width too
_COMPUTED = frozenset("=+-@|%＝＋－＠")


def write_file(path: str | Path, data: bytes | str, overwrite: bool = False) -> Path:
    """Write a whole file or none.

    Parameters
    ----------
    path : path
        Its directory must exist.
    data : bytes or str
        Text is written as UTF-8.
    overwrite : bool
        Whether an existing file may be replaced.

    Returns
    -------
    Path

    Raises
    ------
    FileExistsError
        If the file exists and `overwrite` is False; it is left as it was.
    OSError
        If it cannot be written; nothing is left behind.
    """
    target = Path(path)
    if target.exists() and not overwrite:
        raise FileExistsError(f"{target} exists and is not overwritten")
    content = data.encode() if isinstance(data, str) else data
    try:
        handle, temporary = tempfile.mkstemp(prefix=".rotorstab-", dir=target.parent)
    except OSError as error:
        # under the name that was asked for, not the temporary one
        raise OSError(error.errno, error.strerror, str(target)) from None
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        mask = os.umask(0)
        os.umask(mask)
        Path(temporary).chmod(0o666 & ~mask)
        os.replace(temporary, target)
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise OSError(error.errno, error.strerror, str(target)) from None
        raise
    return target


def _comments(title: str, details: Iterable[str], parameters: Mapping[str, Any]) -> str:
    """Return the comment lines that open a CSV file."""
    lines = [title, *details]
    if parameters:
        lines.append("parameters, non-dimensional unless a unit is given:")
        lines += [f"  {name} = {_plain(value)}" for name, value in parameters.items()]
    return "".join(f"# {line}\n" for line in lines)


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


def _csv_rows(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return stream.getvalue()


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def _numbers(values: Iterable[float]) -> list[float | None]:
    """Return plain numbers, None for NaN and infinities."""
    return [float(value) if math.isfinite(value) else None for value in values]


def _heading(figure: Figure) -> str:
    return f"Figure {figure.number}. {figure.title}" if figure.number else figure.title


def figure_csv(figure: Figure) -> str:
    """Return a figure's plotted arrays as CSV text.

    Parameters
    ----------
    figure : Figure

    Returns
    -------
    str
        Comment lines (title, units, parameters), then the columns panel, kind (line, region
        or unstable), name, style, x, y: one row a point. A gap in a line has an empty y or x.
        A region is Bolotin's, unstable is Floquet's. Where a panel has a map, its pixels
        follow as rows of kind map with their centre and, in one more column, their value.
    """
    details = [figure.caption]
    details += [
        f"panel {panel.letter}: {panel.title}; x = {panel.x_label} [{panel.x_unit}], "
        f"y = {panel.y_label} [{panel.y_unit}]"
        for panel in figure.panels
    ]
    rows = (
        (panel.letter, kind, one.name, one.style, x, y)
        for panel in figure.panels
        for kind, ones in (
            ("line", panel.series),
            ("region", panel.regions),
            ("unstable", panel.unstable),
        )
        for one in ones
        for x, y in zip(one.x, one.y, strict=True)
    )
    head = _comments(_heading(figure), details, figure.parameters)
    header: tuple[str, ...] = ("panel", "kind", "name", "style", "x", "y")
    grids = [(panel.letter, panel.grid) for panel in figure.panels if panel.grid is not None]
    if not grids:
        return head + _csv_rows(header, rows)
    pixels = (
        (letter, "map", f"{grid.name} [{grid.unit}]", "", x, y, value)
        for letter, grid in grids
        for y, row in zip(grid.y, grid.values, strict=True)
        for x, value in zip(grid.x, row, strict=True)
    )
    wider = ((*row, math.nan) for row in rows)
    return head + _csv_rows((*header, "value"), (row for part in (wider, pixels) for row in part))


def _curve(one: Series | Region) -> dict[str, Any]:
    return {
        "name": one.name,
        "group": one.group,
        "style": one.style,
        "x": _numbers(one.x),
        "y": _numbers(one.y),
    }


def _grid(grid: Grid) -> dict[str, Any]:
    return {
        "name": grid.name,
        "unit": grid.unit,
        "x": _numbers(grid.x),
        "y": _numbers(grid.y),
        "values": [_numbers(row) for row in grid.values],
    }


def _panel(panel: Panel) -> dict[str, Any]:
    return {
        "letter": panel.letter,
        "title": panel.title,
        "x": {"label": panel.x_label, "unit": panel.x_unit, "range": list(panel.x_range)},
        "y": {"label": panel.y_label, "unit": panel.y_unit, "range": list(panel.y_range)},
        "lines": [_curve(one) for one in panel.series],
        "regions": [_curve(one) for one in panel.regions],
        "unstable": [_curve(one) for one in panel.unstable],
        **({} if panel.grid is None else {"map": _grid(panel.grid)}),
    }


def figure_json(figure: Figure) -> str:
    """Return a figure's parameters, arrays and reading as JSON text; gaps are null."""
    return _json(
        {
            "figure": figure.number,
            "title": figure.title,
            "caption": figure.caption,
            "parameters": dict(figure.parameters),
            "panels": [_panel(panel) for panel in figure.panels],
            "reading": [
                {"text": one.text, "ours": one.ours, "verdict": one.verdict, "note": one.note}
                for one in figure.reading
            ],
        }
    )


def table_csv(table: Table) -> str:
    """Return a table as CSV text; a cell is empty where the paper has no value."""
    rows = (
        (
            row.name,
            row.symbol,
            row.unit,
            "" if row.text is None else row.text,
            row.ours,
            "given" if row.given else "computed",
        )
        for row in table.rows
    )
    header = ("quantity", "symbol", "unit", "paper", "rotorstab", "kind")
    return _comments(table.title, (), {}) + _csv_rows(header, rows)


def table_json(table: Table) -> str:
    """Return a table as JSON text."""
    return _json(
        {
            "title": table.title,
            "rows": [
                {
                    "quantity": row.name,
                    "symbol": row.symbol,
                    "unit": row.unit,
                    "paper": row.text,
                    "rotorstab": row.ours,
                    "kind": "given" if row.given else "computed",
                }
                for row in table.rows
            ],
        }
    )


def columns_csv(
    title: str,
    details: Sequence[str],
    parameters: Mapping[str, Any],
    columns: Mapping[str, Sequence[Any]],
) -> str:
    """Return named columns of equal length as CSV text with its comment lines."""
    rows = zip(*columns.values(), strict=True)
    return _comments(title, details, parameters) + _csv_rows(list(columns), rows)


def columns_json(
    title: str,
    details: Sequence[str],
    parameters: Mapping[str, Any],
    columns: Mapping[str, Sequence[Any]],
) -> str:
    """Return named columns of equal length as JSON text; NaN is null."""
    plain = {
        name: [
            (None if not math.isfinite(value) else float(value))
            if isinstance(value, float | np.floating)
            else value
            for value in values
        ]
        for name, values in columns.items()
    }
    return _json(
        {
            "title": title,
            "details": list(details),
            "parameters": dict(parameters),
            "columns": plain,
        }
    )
