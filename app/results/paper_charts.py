"""The panels of a figure of the paper as live charts, all with the same layers.

A chart of the page is drawn once and then patched; so a panel of one figure can follow one of
another figure in its place.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rotorstab.charts import Chart, Layer
from rotorstab.paper import Figure

__all__ = ["PANEL_KEYS", "floquet_charts", "paper_charts"]

_LETTERS = "abcd"
_FLOQUET = "-floquet"
PANEL_KEYS = tuple(f"figure-{letter}{kind}" for letter in _LETTERS for kind in ("", _FLOQUET))
"""Keys of all places for charts: for each panel the paper's own, then Floquet's."""
_COLUMNS = ("xs", "ys", "name", "role", "group")
_LABELS = ("x", "y", "name", "side")
_LETTER = 0.024  # of an axis: width of a letter in a narrow chart
_FOOT = 0.015  # of an axis: where the lowest names stand
_LEVEL = 0.09  # of an axis: height of a line of names
_ROOM = 0.04  # of an axis: room for the name of a boundary at its right end


def paper_charts(figure: Figure, hidden: Collection[str] = ()) -> dict[str, Chart]:
    """Return the charts of a figure without Floquet, by their keys.

    Parameters
    ----------
    figure : Figure
        Without Floquet's part.
    hidden : collection of str
        Groups of curves that are left out.
    """
    return {
        f"figure-{panel.letter}": _chart(
            panel,
            f"figure-{panel.letter}",
            (
                Layer("regions", "Bolotin region", _rows(panel, ("regions",), hidden)),
                Layer("lines", "lines", _rows(panel, ("lines",), hidden)),
                Layer("labels", "names", _labels(panel.of_kind("labels"), panel)),
            ),
        )
        for panel in figure.panels
    }


def floquet_charts(figure: Figure, hidden: Collection[str] = ()) -> dict[str, Chart]:
    """Return the charts of what Floquet finds in a figure, by their keys.

    Bolotin's regions and their boundaries are left out: the paper's own chart beside it has them.

    Parameters
    ----------
    figure : Figure
        With Floquet's part.
    hidden : collection of str
        Groups of curves that are left out.
    """
    charts = {}
    for panel in figure.panels:
        key = f"figure-{panel.letter}{_FLOQUET}"
        bolotin = ("boundary", "boundary name") if panel.regions else ()
        kept = replace(
            panel, layers=tuple(layer for layer in panel.layers if layer.label not in bolotin)
        )
        areas = _rows(kept, ("outlines",), hidden)
        areas["xs"], areas["ys"] = _closed(areas["xs"], areas["ys"])
        layers = (
            Layer("areas", "unstable", areas),
            Layer("outlines", "tongue edge", _rows(kept, ("outlines",), hidden)),
            Layer("lines", "lines", _rows(kept, ("lines",), hidden)),
            Layer("labels", "names", _labels(kept.of_kind("labels"), panel)),
        )
        charts[key] = _chart(panel, key, layers)
    return charts


def _chart(panel: Chart, key: str, layers: tuple[Layer, ...]) -> Chart:
    left, right = panel.x_range
    room = _ROOM * (right - left) if left == 0 else 0.0
    return replace(panel, key=key, layers=layers, x_range=(left, right + room))


def _rows(panel: Chart, kinds: Sequence[str], hidden: Collection[str]) -> dict[str, list[Any]]:
    """Return the rows of all layers of some kinds, but for hidden groups."""
    found: dict[str, list[Any]] = {key: [] for key in _COLUMNS}
    for layer in panel.of_kind(*kinds):
        for row in zip(*(layer.columns[key] for key in _COLUMNS), strict=True):
            if row[-1] not in hidden:
                for key, value in zip(_COLUMNS, row, strict=True):
                    found[key].append(value)
    return found


def _closed(xs: Sequence[Any], ys: Sequence[Any]) -> tuple[list[Any], list[Any]]:
    """Return outlines as polygons, without the gaps along the border of the chart."""
    inside = [np.isfinite(x) for x in xs]
    return tuple(  # type: ignore[return-value]
        [np.asarray(values)[mask] for values, mask in zip(axis, inside, strict=True)]
        for axis in (xs, ys)
    )


def _labels(layers: Sequence[Layer], chart: Chart) -> dict[str, Any]:
    """Return the labels of some layers as those of one; names of tongues stand clear of others."""
    columns = {key: [one for layer in layers for one in layer.columns[key]] for key in _LABELS}
    (left, right), (low, high) = chart.x_range, chart.y_range
    taken: list[tuple[float, float, int]] = []  # where each name begins and ends, and its level
    for place in np.argsort(columns["x"], kind="stable"):
        if not chart.regions or columns["side"][place] != "foot":
            continue
        width = _LETTER * len(columns["name"][place]) * (right - left)
        begin = min(columns["x"][place], right - width)
        level = 0
        while any(
            level == at and begin < end and start < begin + width for start, end, at in taken
        ):
            level += 1
        taken.append((begin, begin + width, level))
        columns["x"][place] = begin
        columns["y"][place] = low + (_FOOT + _LEVEL * level) * (high - low)
    return columns | {axis: np.array(columns[axis], float) for axis in ("x", "y")}
