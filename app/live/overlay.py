"""Marks that come and go on a chart that HoloViews has drawn: markers, rulers, pinned curves.

If every chart had these layers from the start, each first paint would take some 15 ms longer.
"""

from __future__ import annotations

from typing import Any

from bokeh.models import ColumnDataSource, GlyphRenderer, MultiLine, Scatter

from rotorstab.charts import Layer
from rotorstab.drawing import screen

__all__ = ["COMING_AND_GOING", "overlay"]

COMING_AND_GOING = frozenset({"marker", "marker ruler", "pins"})
"""Labels of the layers that are drawn here and not by HoloViews."""


def overlay(figure: Any, layer: Layer) -> tuple[ColumnDataSource, GlyphRenderer]:
    """Add a "lines" or "points" layer on top; return its empty source and its renderer."""
    source = ColumnDataSource({name: [] for name in screen.columns(layer)})
    if layer.kind == "lines":
        glyph: Any = MultiLine(
            xs="xs",
            ys="ys",
            line_color={"field": "color"},
            line_dash={"field": "dash"},
            line_width={"field": "width"},
        )
    else:
        look = dict(screen.POINT_LOOKS[layer.label])
        glyph = Scatter(x="x", y="y", fill_color=look.pop("color"), **look)
    return source, figure.add_glyph(source, glyph)
