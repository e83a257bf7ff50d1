"""Figures drawn by HoloViews once a process; every session gets a copy.

HoloViews needs seconds of the server's one thread for a page, a copy a fraction of one.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import holoviews as hv
from bokeh.core.serialization import Deserializer, Serializer

from rotorstab.charts import Chart
from rotorstab.drawing import screen

from ..results.caches import shared_cache
from .overlay import COMING_AND_GOING

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
    """What a figure's parts depend on; its data, units, names and ranges are patched.

    Charts of one structure have a drawing each, for a copy keeps its models' ids, and those of one
    page must differ.
    """

    key: str
    layers: tuple[tuple[str, str], ...]
    chart: Chart = field(compare=False)


@shared_cache(64)
def _drawn(kind: _Kind) -> tuple[Any, frozenset[str], Chart]:
    """Return a figure in Bokeh's serial form, which layers have colours, and what was drawn."""
    layers = kind.chart.layers
    plot = _RENDERER.get_plot(screen.element(kind.chart))
    parts: list[dict[str, Any]] = [one.handles for one in plot.subplots.values()]
    named = [(layer, one) for layer, one in zip(layers, parts, strict=True)]
    figure = plot.state
    for layer, one in named:
        renderer = one["glyph_renderer"]
        renderer.name = layer.label  # by which the browser finds it
        # nothing is ever selected or muted; each of these models is paid for with every page
        renderer.update(selection_glyph="auto", nonselection_glyph="auto", muted_glyph="auto")
        one["source"].data = {}
    figure.name = kind.key
    coloured = frozenset(
        layer.label for layer, one in named if layer.kind == "map" and "color_mapper" in one
    )
    text = Serializer().serialize(figure)
    # the plot has joined the session that is being served, but serves all of them
    plot.cleanup()
    return text, coloured, kind.chart


def draw(chart: Chart) -> Drawing:
    """Return a figure of its own for a chart, without data and what comes and goes."""
    fixed = tuple(layer for layer in chart.layers if layer.label not in COMING_AND_GOING)
    layers = tuple((layer.kind, layer.label) for layer in fixed)
    kind = _Kind(chart.key, layers, replace(chart, layers=fixed))
    text, coloured, first = _drawn(kind)
    figure = Deserializer().deserialize(text)
    renderers = {one.name: one for one in figure.renderers}
    return Drawing(
        figure,
        {label: one.data_source for label, one in renderers.items()},
        renderers,
        {label: renderers[label].glyph.color_mapper for label in coloured},
        first,
    )
