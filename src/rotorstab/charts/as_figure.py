"""A live chart as a figure: the same arrays, for print and for tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..paper import Figure, Grid, Panel, Region, Series
from .structure import ROLES, Chart, axis_symbol

__all__ = ["chart_figure"]

_POINTS = {
    "critical speeds": ("critical speed", "#0f8a6a"),
    "marker": ("marked point", "#c2255c"),
}
_STYLES = {"solid": "solid", "9 5": "dashed", "2 4": "dotted"}


def _axis(label: str) -> tuple[str, str]:
    """Return an axis label's symbol and unit."""
    symbol, unit = axis_symbol(label)
    units = {"p̄": "EI/L²", "ω̄": "√(EI/ρAL⁴)", "Ω̄": "√(EI/ρAL⁴)"}
    return symbol, unit or units.get(symbol, "-")


def _grid(data: Mapping[str, Any], units: str) -> Grid:
    """Return the growth map's rates with their pixel centres."""
    rates = np.asarray(data["rate"][0], float)
    rows, columns = rates.shape
    x = data["x"][0] + (np.arange(columns) + 0.5) / columns * data["dw"][0]
    y = data["y"][0] + (np.arange(rows) + 0.5) / rows * data["dh"][0]
    name = ("growth rate σ", "1/s") if units == "SI" else ("growth rate σ̄", "√(EI/ρAL⁴)")
    return Grid(*name, x, y, rates)


def chart_figure(chart: Chart, parameters: Mapping[str, Any]) -> Figure:
    """Return a chart as a one-panel `Figure`, number 0.

    Parameters
    ----------
    chart : Chart
    parameters : mapping
        Plain values that made it; written into tables.

    Returns
    -------
    Figure
        Exactly the arrays of the chart's lines and regions.
    """
    series, regions, labels, unstable = [], [], [], []
    grid = None
    for layer in chart.layers:
        data = layer.columns
        if layer.kind == "lines":
            for x, y, name, role in zip(*data.values(), strict=True):
                look = ROLES[role]
                if role == "edge":
                    inside = np.isfinite(x)
                    group = "unstable (Floquet)"
                    unstable.append(Region(name, group, "solid", x[inside], y[inside]))
                    continue
                style: Any = _STYLES.get(look.dash, "dashdot")
                # a pinned curve is called by its pin's own name
                meaning = name.rpartition(": ")[0] if role.startswith("pin ") else look.meaning
                series.append(Series(name, meaning, style, x, y, look.color))
        elif layer.kind == "points":
            for x, y, name in zip(data["x"], data["y"], data["name"], strict=True):
                point = np.array([x]), np.array([y])
                meaning, color = _POINTS.get(layer.label, (layer.label, "#0f8a6a"))
                series.append(Series(name, meaning, "solid", *point, color))
        elif layer.kind == "regions":
            for x, y, name in zip(*data.values(), strict=True):
                regions.append(Region(name, name, "solid", x, y))
        elif layer.kind == "map" and "rate" in data:
            grid = _grid(data, chart.units)
        elif layer.kind == "labels":
            labels += list(zip(data["x"], data["y"], data["name"], strict=True))
    (x_label, x_unit), (y_label, y_unit) = _axis(chart.x_label), _axis(chart.y_label)
    panel = Panel(
        letter="",
        title=chart.title,
        x_label=x_label,
        y_label=y_label,
        x_unit=x_unit,
        y_unit=y_unit,
        series=tuple(series),
        x_range=chart.x_range,
        y_range=chart.y_range,
        regions=tuple(regions),
        labels=tuple(labels),
        unstable=tuple(unstable),
        grid=grid,
    )
    title = chart.title
    if grid is not None and not unstable:
        unit = f" {grid.unit}" if chart.units == "SI" else ""
        title += f". Pixels: {grid.name} up to {grid.values.max():.3g}{unit}"
    return Figure(number=0, title=title, caption="", parameters=dict(parameters), panels=(panel,))
