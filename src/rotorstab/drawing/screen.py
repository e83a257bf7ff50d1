"""Charts drawn with HoloViews and Bokeh, for the dashboard; `notebook` adds title and legend.

`element` draws any `charts.Chart`; `columns` gives what a drawn layer's data source holds, so
that a live chart is patched and not drawn again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .extra import extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Chart, Layer
from .contours import GROWTH_COLOURS
from .hooks import (
    add_growth_hover,
    apply_dots,
    apply_hatch,
    apply_label_places,
    apply_line_styles,
    as_areas,
    as_patches,
    hover,
    hover_names,
    make_square,
    map_hover,
    style_axes,
    transparent_nan,
)
from .sources import columns, point_look

__all__ = [
    "DISAGREEMENT_COLOURS",
    "columns",
    "element",
    "hover_names",
    "point_look",
]


DISAGREEMENT_COLOURS = ["#8a93a0", "#19b5c9"]
_TOOLS = ["pan", "box_zoom", "wheel_zoom", "save", "reset"]


def _draw_map(chart: Chart, layer: Layer) -> hv.Image:
    """Return a map as an image; growth is not seen, and carries the hover."""
    (left, right), (low, high) = chart.x_range, chart.y_range
    values = np.asarray(layer.columns["image"][0])
    if not np.isfinite(values).any():  # HoloViews warns of a map without a range
        values = np.zeros_like(values)
    # HoloViews wants the first row on top
    image = hv.Image(
        values[::-1], bounds=(left, low, right, high), vdims=["image"], label=layer.label
    )
    growth = layer.label == "growth"
    return image.opts(
        hv.opts.Image(
            cmap=GROWTH_COLOURS if growth else DISAGREEMENT_COLOURS,
            clim=(0.0, 1.0),
            alpha=0.0 if growth else 0.4,
            tools=[map_hover(chart)] if growth else [],
            hooks=[transparent_nan, add_growth_hover] if growth else [transparent_nan],
            backend="bokeh",
        )
    )


def _draw_bands(chart: Chart, layer: Layer) -> hv.Polygons:
    """Return bands of growth as polygons; they carry the colour bar."""
    assert layer.quantity is not None
    (left, right), (low, high) = chart.x_range, chart.y_range
    # a drawing of no polygons has no colours: this one lies beyond the window
    beyond = {"x": [right, 2 * right - left, right], "y": [high, 2 * high - low, high]}
    bands = hv.Polygons([beyond | {"growth": 0.0}], vdims=["growth"], label=layer.label)
    return bands.opts(
        hv.opts.Polygons(
            color="growth",
            cmap=GROWTH_COLOURS,
            clim=(0.0, layer.columns["top"][0]),
            line_alpha=0.0,
            colorbar=True,
            colorbar_position="right",
            clabel=layer.quantity.label(chart.in_si),
            colorbar_opts={"width": 10, "background_fill_alpha": 0.0},
            hooks=[as_patches],
            backend="bokeh",
        )
    )


def _draw_areas(chart: Chart, layer: Layer) -> hv.Polygons:
    """Return polygons filled with the colour of their role."""
    (left, right), (low, high) = chart.x_range, chart.y_range
    # a drawing of no polygons has no source of its own: this one lies beyond the window
    beyond = {"x": [right, 2 * right - left, right], "y": [high, 2 * high - low, high], "name": ""}
    return hv.Polygons([beyond], vdims=["name"], label=layer.label).opts(
        hv.opts.Polygons(tools=[hover(chart)], hooks=[as_areas], backend="bokeh")
    )


def _draw_shapes(_: Chart, layer: Layer) -> hv.Polygons:
    """Return hatched regions, or dotted parts that are not computed."""
    data = columns(layer)
    paths = [
        {"x": xs[0][0], "y": ys[0][0], "name": name}
        for xs, ys, name in zip(*data.values(), strict=True)
    ]
    blank = layer.kind == "blanks"
    return hv.Polygons(paths, vdims=["name"], label=layer.label).opts(
        hv.opts.Polygons(
            color="#8a93a0",
            fill_alpha=0.16 if blank else 0.06,
            line_alpha=0.0,
            hooks=[apply_dots if blank else apply_hatch],
            backend="bokeh",
        )
    )


def _draw_lines(chart: Chart, layer: Layer) -> hv.Contours:
    """Return lines, each in its own look."""
    data = columns(layer)
    rows = [dict(zip(data, row, strict=True)) for row in zip(*data.values(), strict=True)]
    paths = [{"x": row.pop("xs"), "y": row.pop("ys"), **row} for row in rows]
    return hv.Contours(paths, vdims=["name", "color", "dash", "width"], label=layer.label).opts(
        hv.opts.Contours(
            hooks=[apply_line_styles],
            tools=[hover(chart)],
            show_legend=False,
            backend="bokeh",
        )
    )


def _draw_points(chart: Chart, layer: Layer) -> hv.Points:
    """Return points in the look of their role."""
    return hv.Points(_marks(layer), vdims=["name"], label=layer.label).opts(
        hv.opts.Points(**point_look(layer), tools=[hover(chart)], backend="bokeh")
    )


def _draw_labels(_: Chart, layer: Layer) -> hv.Labels:
    """Return texts beside their points."""
    return hv.Labels(_marks(layer), vdims=["name"], label=layer.label).opts(
        hv.opts.Labels(
            # the names of whirls and of critical loads stand close together in a low chart
            text_font_size="8pt" if layer.label in ("mode", "limit") else "9pt",
            text_font_style="bold",
            text_color="#6b7280",
            hooks=[apply_label_places],
            backend="bokeh",
        )
    )


def _marks(layer: Layer) -> tuple[Any, Any, Any]:
    data = columns(layer)
    return data["x"], data["y"], data["name"]


_DRAWERS: Mapping[str, Callable[[Chart, Layer], hv.Element]] = {
    "map": _draw_map,
    "bands": _draw_bands,
    "blanks": _draw_shapes,
    "regions": _draw_shapes,
    "areas": _draw_areas,
    "lines": _draw_lines,
    "outlines": _draw_lines,
    "edges": _draw_lines,
    "points": _draw_points,
    "labels": _draw_labels,
}
"""What draws a layer, by its kind: it returns a HoloViews element, styled for Bokeh."""


def element(chart: Chart) -> hv.Overlay:
    """Return the chart as a HoloViews overlay, one element a layer.

    Parameters
    ----------
    chart : Chart
        From `rotorstab.charts`.

    Returns
    -------
    holoviews.Overlay
        Styled for the Bokeh backend; axis labels are the paper's symbols.
    """
    hv.renderer("bokeh")  # loads it where it is not, and leaves the current one current
    return hv.Overlay([_DRAWERS[layer.kind](chart, layer) for layer in chart.layers]).opts(
        hv.opts.Overlay(
            title="",
            xlabel=chart.x_label,
            ylabel=chart.y_label,
            xlim=chart.x_range,
            ylim=chart.y_range,
            show_legend=False,
            responsive=True,
            min_height=240,
            toolbar="above",
            default_tools=_TOOLS,
            hooks=[style_axes, make_square] if chart.square else [style_axes],
            backend="bokeh",
        )
    )
