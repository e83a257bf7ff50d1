"""Figures drawn by HoloViews once a process; every session gets a copy.

HoloViews needs seconds of the server's one thread for a page, a copy a fraction of one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import holoviews as hv
from bokeh.core.serialization import Deserializer, Serializer

from rotorstab import plots
from rotorstab.charts import Chart

__all__ = ["Drawing", "draw"]

hv.extension("bokeh")
# WebGL without a GPU costs 7 → 64 ms a paint and draws rough lines
_RENDERER = hv.renderer("bokeh").instance(mode="server", webgl=False)


@dataclass(frozen=True)
class Drawing:
    """One Bokeh figure without data and its parts by the label of their layer.

    `x_range`, `y_range` and `chart` tell how it was drawn.
    """

    figure: Any
    sources: dict[str, Any]
    renderers: dict[str, Any]
    colours: dict[str, Any]  # of maps
    chart: Chart


@dataclass(frozen=True)
class _Kind:
    """What a figure's parts depend on; its data, names and ranges are patched."""

    key: str
    units: str
    layers: tuple[tuple[str, str], ...]
    chart: Chart = field(compare=False)


@lru_cache(maxsize=64)
def _drawn(kind: _Kind) -> tuple[Any, Drawing]:
    """Return a drawing as text of Bokeh's and itself, for the ids of its parts."""
    layers = kind.chart.layers
    plot = _RENDERER.get_plot(plots.element(kind.chart))
    parts: list[dict[str, Any]] = [one.handles for one in plot.subplots.values()]
    named = [(layer, one) for layer, one in zip(layers, parts, strict=True)]
    drawing = Drawing(
        figure=plot.state,
        sources={layer.label: one["source"] for layer, one in named},
        renderers={layer.label: one["glyph_renderer"] for layer, one in named},
        colours={
            layer.label: one["color_mapper"]
            for layer, one in named
            if layer.kind == "map" and "color_mapper" in one
        },
        chart=kind.chart,
    )
    drawing.figure.name = kind.key
    for label, renderer in drawing.renderers.items():
        renderer.name = label  # by which the browser finds it
    for source in drawing.sources.values():
        source.data = {}
    return Serializer().serialize(drawing.figure), drawing


def draw(chart: Chart) -> Drawing:
    """Return a figure of its own for a chart, still without data."""
    layers = tuple((layer.kind, layer.label) for layer in chart.layers)
    text, first = _drawn(_Kind(chart.key, chart.units, layers, chart))
    figure = Deserializer().deserialize(text)
    known = {model.id: model for model in figure.references()}

    def own(parts: dict[str, Any]) -> dict[str, Any]:
        return {label: known[part.id] for label, part in parts.items()}

    return Drawing(
        figure, own(first.sources), own(first.renderers), own(first.colours), first.chart
    )
