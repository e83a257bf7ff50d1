"""Marks that come and go on a chart that HoloViews has drawn: markers, rulers, pinned curves.

If every chart had these layers from the start, each first paint would take some 15 ms longer.
"""

from __future__ import annotations

from typing import Any

from bokeh.models import ColumnDataSource, GlyphRenderer, MultiLine, Scatter, Text

from rotorstab.charts import Layer
from rotorstab.drawing import screen

__all__ = ["TEMPORARY_LAYERS", "overlay"]

TEMPORARY_LAYERS = frozenset(
    {"marker", "marker ruler", "pins", "pinned boundary", "pinned edge", "pin name"}
)
"""Labels of the layers that are drawn here and not by HoloViews."""


def overlay(figure: Any, layer: Layer) -> tuple[ColumnDataSource, GlyphRenderer]:
    """Add lines, points or labels on top; return their empty source and their renderer."""
    source = ColumnDataSource({name: [] for name in screen.columns(layer)})
    if layer.kind == "lines":
        glyph: Any = MultiLine(
            xs="xs",
            ys="ys",
            line_color={"field": "color"},
            line_dash={"field": "dash"},
            # Bolotin's boundaries of a pin step back behind its outlines
            line_width=0.7 if layer.label == "pinned boundary" else {"field": "width"},
        )
    elif layer.kind == "labels":
        glyph = Text(
            x="x",
            y="y",
            text="name",
            text_color={"field": "color"},
            text_align={"field": "align"},
            text_baseline={"field": "baseline"},
            x_offset={"field": "dx"},
            y_offset={"field": "dy"},
            text_font_size="9pt",
            text_font_style="bold",
            background_fill_color="white",
            background_fill_alpha=0.7,
        )
    else:
        look = screen.point_look(layer)
        glyph = Scatter(x="x", y="y", fill_color=look.pop("color"), **look)
    return source, figure.add_glyph(source, glyph)
