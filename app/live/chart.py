"""A HoloViews chart that is built once and then patched.

Rebuilding HoloViews objects costs some ten times the redraw itself; replacing the columns
of the Bokeh data sources behind them does not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from bokeh.models import ColorBar, HoverTool, Range1d

from rotorstab.charts import Chart, Layer
from rotorstab.drawing import screen

from ..results.views import NARROWEST, View
from .drawing import draw
from .overlay import overlay

__all__ = ["LiveChart", "Zoom"]


def _same(new: Any, old: Any) -> bool:
    """Whether two columns hold the same values; nested lists of arrays included."""
    if new is old:
        return True
    if isinstance(new, np.ndarray):
        return isinstance(old, np.ndarray) and np.array_equal(new, old, equal_nan=True)
    if isinstance(new, list):
        return isinstance(old, list) and len(new) == len(old) and all(map(_same, new, old))
    return bool(new == old)


def _labels(chart: Chart) -> tuple[str, ...]:
    """Return the units and names of a chart: those of a thicker shaft may be kN instead of N."""
    return chart.units, chart.x_label, chart.y_label


@dataclass(frozen=True)
class Zoom:
    """The ranges of a chart's axes that the user has zoomed to, None where they are its own."""

    x: tuple[float, float] | None = None
    y: tuple[float, float] | None = None


class LiveChart:
    """One Bokeh figure, drawn by HoloViews, that follows a sequence of charts."""

    def __init__(self, chart: Chart) -> None:
        drawing = draw(chart)
        self.figure = drawing.figure
        self.sources, self.renderers = drawing.sources, drawing.renderers
        self._chart = drawing.chart
        self._drawn: dict[str, dict[str, Any]] = {}
        self._added: set[str] = set()
        self._ranges = {
            "x": (self.figure.x_range, drawing.chart.x_range),
            "y": (self.figure.y_range, drawing.chart.y_range),
        }
        self.show(chart)

    def show(self, chart: Chart) -> None:
        """Patch the sources that differ, and the ranges unless the user has zoomed."""
        labels = {layer.label for layer in chart.layers}
        for label in self._added - labels:
            self._clear(label)
        for layer in chart.layers:
            if layer.label not in self.sources:
                self._add(layer)
            columns, drawn = screen.columns(layer), self._drawn.get(layer.label, {})
            # mostly only the ordinates of curves move; a column is replaced as a whole
            moved = {
                name: column
                for name, column in columns.items()
                if name not in drawn or not _same(column, drawn[name])
            }
            if moved:
                self.sources[layer.label].data.update(moved)
                self._drawn[layer.label] = columns
            if layer.kind == "bands":
                self._set_scale(layer, chart.in_si)
        if _labels(chart) != _labels(self._chart):
            self._rename(self._chart, chart)
        self._chart = chart
        for axis, wanted in (("x", chart.x_range), ("y", chart.y_range)):
            bokeh_range, last = self._ranges[axis]
            self._move(bokeh_range, last, wanted)
            self._ranges[axis] = (bokeh_range, wanted)

    def _rename(self, old: Chart, new: Chart) -> None:
        """Name axes and hovers in new units, and undo a zoom, which was in the old ones."""
        names = dict(zip(screen.hover_names(old), screen.hover_names(new), strict=True))
        for axis, label in ((self.figure.xaxis, new.x_label), (self.figure.yaxis, new.y_label)):
            axis.axis_label = label
        for tool in self.figure.tools:
            if isinstance(tool, HoverTool):
                tool.tooltips = [(names.get(name, name), value) for name, value in tool.tooltips]
        self.reset_view()

    def _add(self, layer: Layer) -> None:
        """Draw a layer that the chart did not start with, such as a marker."""
        self.sources[layer.label], self.renderers[layer.label] = overlay(self.figure, layer)
        self._added.add(layer.label)

    def _clear(self, label: str) -> None:
        """Empty a layer that the chart no longer has."""
        if any(len(column) for column in self._drawn.get(label, {}).values()):
            self._drawn[label] = {name: [] for name in self._drawn[label]}
            self.sources[label].data = dict(self._drawn[label])

    def _set_scale(self, layer: Layer, in_si: bool) -> None:
        """Give the colours of growth their scale and its title."""
        colours = self.renderers[layer.label].glyph.fill_color.transform
        top = layer.columns["top"][0]
        if colours.high != top:
            colours.high = top
        assert layer.quantity is not None
        title = layer.quantity.label(in_si)
        for bar in self.figure.right:
            if isinstance(bar, ColorBar) and bar.title != title:
                bar.title = title

    def set_visible(self, shown: Mapping[str, bool]) -> None:
        """Show or hide layers by label."""
        for label, visible in shown.items():
            if label in self.renderers:
                self.renderers[label].visible = visible

    def zoom(self) -> Zoom:
        """Return the ranges that the user has zoomed to."""
        zoomed = {}
        for axis, (bokeh_range, wanted) in self._ranges.items():
            ends = bokeh_range.start, bokeh_range.end
            zoomed[axis] = None if ends == wanted else ends
        return Zoom(**zoomed)

    def move_with(self, other: LiveChart) -> None:
        """Share the ranges of another chart, so that both show the same part."""
        self.figure.update(x_range=other.figure.x_range, y_range=other.figure.y_range)
        self._ranges = {
            axis: (bokeh_range, self._ranges[axis][1])
            for axis, (bokeh_range, _) in other._ranges.items()
        }

    def keep_within(self, bounds: View) -> None:
        """Let a zoom show no more than the bounds, and no less than what has meaning."""
        for axis, (low, high) in (("x", bounds.x), ("y", bounds.y)):
            bokeh_range = self._ranges[axis][0]
            if bokeh_range.bounds != (low, high):
                # a little more than the least: a zoom to the limit is a view, too
                bokeh_range.update(bounds=(low, high), min_interval=2 * NARROWEST * (high - low))

    def reset_view(self) -> None:
        """Return to the chart's own ranges."""
        for bokeh_range, wanted in self._ranges.values():
            bokeh_range.update(start=wanted[0], end=wanted[1])

    @staticmethod
    def _move(bokeh_range: Range1d, last: tuple[float, float], wanted: tuple[float, float]) -> None:
        if bokeh_range.reset_start != wanted[0] or bokeh_range.reset_end != wanted[1]:
            bokeh_range.update(reset_start=wanted[0], reset_end=wanted[1])
        if last != wanted and (bokeh_range.start, bokeh_range.end) == last:
            bokeh_range.update(start=wanted[0], end=wanted[1])
