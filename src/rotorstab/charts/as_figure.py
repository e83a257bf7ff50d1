"""A live chart as a figure: the same arrays, for print and for tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .figure import Figure, Grid, Label, Panel, Region, Series
from .quantities import GROWTH, Quantity
from .roles import ROLES
from .structure import Chart

__all__ = ["chart_figure"]

_POINTS = {
    "critical speeds": ("critical speed", "#0f8a6a"),
    "marker": ("marked point", "#c2255c"),
}


def _grid(data: Mapping[str, Any], in_si: bool) -> Grid:
    """Return the growth map's rates with their pixel centres."""
    rates = np.asarray(data["rate"][0], float)
    rows, columns = rates.shape
    x = data["x"][0] + (np.arange(columns) + 0.5) / columns * data["dw"][0]
    y = data["y"][0] + (np.arange(rows) + 0.5) / rows * data["dh"][0]
    quantity = Quantity("growth rate", "σ", "1/s") if in_si else GROWTH
    return Grid(quantity.label(with_unit=False), quantity.unit, x, y, rates)


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
            keys = ("xs", "ys", "name", "role", "group")
            for x, y, name, role, group in zip(*(data[key] for key in keys), strict=True):
                if role == "edge":
                    inside = np.isfinite(x)
                    floquet = "unstable (Floquet)"
                    unstable.append(Region(name, floquet, "solid", x[inside], y[inside]))
                    continue
                look = ROLES[role]
                series.append(Series(name, group, look.style, x, y, look.color))
        elif layer.kind == "points":
            for x, y, name in zip(data["x"], data["y"], data["name"], strict=True):
                point = np.array([x]), np.array([y])
                meaning, color = _POINTS.get(layer.label, (layer.label, "#0f8a6a"))
                series.append(Series(name, meaning, "solid", *point, color))
        elif layer.kind == "regions":
            for x, y, name in zip(*data.values(), strict=True):
                regions.append(Region(name, name, "solid", x, y))
        elif layer.kind == "map" and "rate" in data:
            grid = _grid(data, chart.in_si)
        elif layer.kind == "labels":
            labels += [
                Label(x, y, name, low=name.endswith("B"))
                for x, y, name in zip(data["x"], data["y"], data["name"], strict=True)
            ]
    panel = Panel(
        letter="",
        title=chart.title,
        x_label=chart.x.symbol,
        y_label=chart.y.symbol,
        x_unit=chart.x.unit,
        y_unit=chart.y.unit,
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
        unit = f" {grid.unit}" if chart.in_si else ""
        title += f". Pixels: {grid.name} up to {grid.values.max():.3g}{unit}"
    return Figure(number=0, title=title, caption="", parameters=dict(parameters), panels=(panel,))
