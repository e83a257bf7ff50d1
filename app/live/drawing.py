"""Figures that HoloViews draws once in a process; every session gets a copy.

For all charts of a page HoloViews needs seconds of the server's one thread, a copy a fraction of a
second.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import holoviews as hv
from bokeh.core.serialization import Deserializer, Serializer

from rotorstab.charts import Chart, Layer
from rotorstab.drawing import screen

from ..results.caches import shared_cache
from .overlay import TEMPORARY_LAYERS

__all__ = ["Drawing", "draw"]

hv.extension("bokeh")
# WebGL without a GPU costs 7 → 64 ms a paint and draws rough lines
_RENDERER = hv.renderer("bokeh").instance(mode="server", webgl=False)


@dataclass(frozen=True)
class Drawing:
    """One Bokeh figure without data, and its parts by the label of their layer.

    Parameters
    ----------
    figure : bokeh.plotting.figure
    sources, renderers : dict
        By label.
    chart : Chart
        The chart that HoloViews drew; the figure has its ranges, units and names.
    """

    figure: Any
    sources: dict[str, Any]
    renderers: dict[str, Any]
    chart: Chart


@dataclass(frozen=True)
class _Kind:
    """What the parts of a figure depend on; its data, units, names and ranges are patched.

    Two charts of the same structure have a drawing each: a copy keeps the ids of its models, and
    all ids on a page must differ.
    """

    key: str
    layers: tuple[tuple[str, str], ...]
    chart: Chart = field(compare=False)


def _short(layer: Layer) -> Layer:
    """Return a layer with its first rows: HoloViews takes long for many, and its data is not kept.

    Two rows, since HoloViews draws several polygons in another way than one.
    """
    if layer.kind in ("map", "bands", "edges"):
        return layer
    return replace(layer, columns={key: column[:2] for key, column in layer.columns.items()})


@shared_cache(64)
def _drawn(kind: _Kind) -> tuple[Any, Chart]:
    """Return a figure in Bokeh's serial form, and the chart drawn."""
    layers = kind.chart.layers
    short = replace(kind.chart, layers=tuple(map(_short, layers)))
    plot = _RENDERER.get_plot(screen.element(short))
    parts: list[dict[str, Any]] = [subplot.handles for subplot in plot.subplots.values()]
    layer_parts = list(zip(layers, parts, strict=True))
    figure = plot.state
    for layer, part in layer_parts:
        renderer = part["glyph_renderer"]
        renderer.name = layer.label  # by which the browser finds it
        # nothing is ever selected or muted, and every page would be sent these models
        renderer.update(selection_glyph="auto", nonselection_glyph="auto", muted_glyph="auto")
        part["source"].data = {}
    figure.name = kind.key
    text = Serializer().serialize(figure)
    # the plot has joined the session that is being served, but serves all of them
    plot.cleanup()
    return text, kind.chart


def draw(chart: Chart) -> Drawing:
    """Return a new figure for a chart, without data and without `TEMPORARY_LAYERS` layers."""
    fixed = tuple(layer for layer in chart.layers if layer.label not in TEMPORARY_LAYERS)
    layers = tuple((layer.kind, layer.label) for layer in fixed)
    kind = _Kind(chart.key, layers, replace(chart, layers=fixed))
    text, first = _drawn(kind)
    figure = Deserializer().deserialize(text)
    renderers = {renderer.name: renderer for renderer in figure.renderers}
    return Drawing(
        figure,
        {label: renderer.data_source for label, renderer in renderers.items()},
        renderers,
        first,
    )
