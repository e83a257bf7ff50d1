"""Charts as the user sees them: zoomed, and without the layers that are switched off."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from rotorstab.charts import Chart

from ..live.chart import Zoom
from ..pages.base import Page
from ..results.whirl_charts import WHIRL_CHARTS
from ..state import State

__all__ = ["as_seen", "cut", "zooms"]


def zooms(page: Page) -> dict[str, Zoom]:
    """Return the present zoom of each chart of a page that has been drawn, by key."""
    return {key: live.zoom() for key, live in page.charts.items()}


def as_seen(
    charts: Mapping[str, Chart], page: Page, state: State, seen: Mapping[str, Zoom]
) -> dict[str, Chart]:
    """Return the charts of a page in the windows that the user sees, with the layers that are on.

    Parameters
    ----------
    charts : mapping of str to Chart
        From `page.compute(state)`.
    page : Page
    state : State
    seen : mapping of str to Zoom
        From `zooms`; charts without an entry are not zoomed.
    """
    hidden = {label for label, on in page.visible(state).items() if not on}
    return {key: _shown(chart, seen.get(key, Zoom()), hidden) for key, chart in charts.items()}


def cut(chart: Chart) -> Chart:
    """Return a chart of whirl curves with their samples in its window only, for a table.

    The page has some more, so that a chart that is moved shows them at once.
    """
    if chart.key not in WHIRL_CHARTS:
        return chart
    low, high = chart.x_range
    layers = []
    for layer in chart.layers:
        columns = dict(layer.columns)
        if layer.kind == "lines":
            inside = [(x >= low) & (x <= high) for x in columns["xs"]]
            for axis in ("xs", "ys"):
                rows = zip(columns[axis], inside, strict=True)
                columns[axis] = [values[kept] for values, kept in rows]
        layers.append(replace(layer, columns=columns))
    return replace(chart, layers=tuple(layers))


def _shown(chart: Chart, zoom: Zoom, hidden: set[str]) -> Chart:
    return replace(
        chart,
        x_range=_range(zoom.x, chart.x_range),
        y_range=_range(zoom.y, chart.y_range),
        layers=tuple(layer for layer in chart.layers if layer.label not in hidden),
    )


def _range(zoomed: tuple[float, float] | None, own: tuple[float, float]) -> tuple[float, float]:
    """Return the zoomed range; the chart's own one where a browser sent what is none."""
    if zoomed is None or not all(math.isfinite(end) for end in zoomed) or zoomed[0] >= zoomed[1]:
        return own
    return zoomed
