"""Figures and tables as CSV and JSON.

A CSV file holds exactly the arrays that are drawn, to the last digit, below comment lines
with what made them. Nothing depends on the time or the place of writing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .._types import Array
from ..charts import Chart, Curve, Figure, Layer
from ..charts.figure import growth_bands, growth_layer, growth_of
from ..charts.structure import pixel_centres
from ..charts.tongues import FLOQUET
from ..paper import Table
from .plain_text import comment_lines, csv_rows, json_text, plain_numbers

__all__ = [
    "columns_csv",
    "columns_json",
    "figure_csv",
    "figure_json",
    "table_csv",
    "table_json",
]


def figure_csv(figure: Figure) -> str:
    """Return a figure's plotted arrays as CSV text.

    Parameters
    ----------
    figure : Figure

    Returns
    -------
    str
        Comment lines (title, units, link, parameters), then the columns panel, kind (line, region
        or unstable), name, style, x, y: one row for each point. A gap in a line has an empty y
        or x. A region is Bolotin's, unstable is Floquet's. Where a panel has a map, its pixels
        follow as rows of kind map with their centre and, in one more column, their value.
    """
    details = [figure.caption]
    details += [
        f"panel {panel.letter}: {panel.title}; x = {panel.x.symbol} [{panel.x.unit}], "
        f"y = {panel.y.symbol} [{panel.y.unit}]"
        for panel in figure.panels
    ]
    rows = (
        (panel.letter, kind, curve.name, curve.style, x, y)
        for panel in figure.panels
        for kind, curves in _curves(panel)
        for curve in curves
        for x, y in zip(*_points(curve, kind), strict=True)
    )
    head = comment_lines(figure.heading, details, figure.parameters, figure.link)
    header: tuple[str, ...] = ("panel", "kind", "name", "style", "x", "y")
    maps = [(panel, layer) for panel in figure.panels if (layer := growth_layer(panel))]
    if not maps:
        return head + csv_rows(header, rows)
    pixels = (
        (panel.letter, "map", _growth_name(panel), "", x, y, value)
        for panel, layer in maps
        for (x, y), value in _pixels(layer)
    )
    wider = ((*row, math.nan) for row in rows)
    return head + csv_rows((*header, "value"), (row for part in (wider, pixels) for row in part))


def _curves(panel: Chart) -> tuple[tuple[str, tuple[Curve, ...]], ...]:
    """Return the kinds of curves of a panel, as tables name them."""
    return (
        ("line", panel.series),
        ("region", panel.regions),
        ("unstable", (*panel.unstable, *_edges(panel))),
    )


def _edges(panel: Chart) -> tuple[Curve, ...]:
    """Return the edge of the unstable set, where it is known on a grid."""
    bands = growth_bands(panel)
    if bands is None:
        return ()
    from .contours import outline

    return (Curve("edge of what is unstable", *outline(bands), "edge", FLOQUET),)


def _points(curve: Curve, kind: str) -> tuple[Array, Array]:
    """Return a curve's points; an outline of a tongue is written as a polygon without gaps."""
    return curve.polygon if kind == "unstable" and curve.role != "edge" else (curve.x, curve.y)


def _growth_name(panel: Chart) -> str:
    quantity = growth_of(panel)
    return f"{quantity.label(with_unit=False)} [{quantity.unit}]"


def _pixels(layer: Layer) -> Iterable[tuple[tuple[float, float], float]]:
    """Return centre and growth rate of every pixel of a map, row by row."""
    xs, ys = pixel_centres(layer)
    for y, row in zip(ys, np.asarray(layer.columns["rate"][0], float), strict=True):
        for x, value in zip(xs, row, strict=True):
            yield (x, y), value


def _json_curve(curve: Curve, kind: str) -> dict[str, Any]:
    x, y = _points(curve, kind)
    return {
        "name": curve.name,
        "group": curve.group,
        "style": curve.style,
        "x": plain_numbers(x),
        "y": plain_numbers(y),
    }


def _json_map(panel: Chart, layer: Layer) -> dict[str, Any]:
    quantity = growth_of(panel)
    x, y = pixel_centres(layer)
    return {
        "name": quantity.label(with_unit=False),
        "unit": quantity.unit,
        "x": plain_numbers(x),
        "y": plain_numbers(y),
        "values": [plain_numbers(row) for row in np.asarray(layer.columns["rate"][0], float)],
    }


def _json_panel(panel: Chart) -> dict[str, Any]:
    keys = {"line": "lines", "region": "regions", "unstable": "unstable"}
    growth = growth_layer(panel)
    return {
        "letter": panel.letter,
        "title": panel.title,
        "x": {"label": panel.x.symbol, "unit": panel.x.unit, "range": list(panel.x_range)},
        "y": {"label": panel.y.symbol, "unit": panel.y.unit, "range": list(panel.y_range)},
        **{
            keys[kind]: [_json_curve(curve, kind) for curve in curves]
            for kind, curves in _curves(panel)
        },
        **({} if growth is None else {"map": _json_map(panel, growth)}),
    }


def figure_json(figure: Figure) -> str:
    """Return a figure's parameters, arrays and reading as JSON text; gaps are null."""
    return json_text(
        {
            "figure": figure.number,
            "title": figure.title,
            "caption": figure.caption,
            "parameters": dict(figure.parameters),
            "link": figure.link,
            "panels": [_json_panel(panel) for panel in figure.panels],
            "reading": [
                {
                    "text": statement.text,
                    "ours": statement.ours,
                    "verdict": statement.verdict,
                    "note": statement.note,
                }
                for statement in figure.reading
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
    return comment_lines(table.title, (), {}) + csv_rows(header, rows)


def table_json(table: Table) -> str:
    """Return a table as JSON text."""
    return json_text(
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
    return comment_lines(title, details, parameters) + csv_rows(list(columns), rows)


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
    return json_text(
        {
            "title": title,
            "details": list(details),
            "parameters": dict(parameters),
            "columns": plain,
        }
    )
