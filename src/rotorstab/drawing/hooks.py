"""What HoloViews has no option for: hover tools, and hooks that complete its Bokeh figures."""

from __future__ import annotations

import json
from typing import Any

from .extra import extra_is_missing

try:
    from bokeh.models import CustomJSHover, CustomJSTickFormatter, HoverTool, Patches
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Chart
from ..charts.agreement import Agreement

__all__ = [
    "add_growth_hover",
    "apply_dots",
    "apply_hatch",
    "apply_label_places",
    "apply_line_styles",
    "as_areas",
    "as_patches",
    "hover",
    "hover_names",
    "make_square",
    "map_hover",
    "style_axes",
    "transparent_nan",
]

_SHORT_TICKS = """
const value = Number(tick.toPrecision(4)), size = Math.abs(value)
const far = size >= 1e4 || (size > 0 && size < 1e-3)
return (far ? value.toExponential().replace("e+", "e") : String(value)).replaceAll("-", "−")
"""


def _growth_name(chart: Chart) -> str:
    return "growth σ [1/s]" if chart.in_si else "growth σ̄"


def hover_names(chart: Chart) -> list[str]:
    """Return the hover's names of abscissa, ordinate and growth, in the chart's units."""
    return [chart.x.name(chart.in_si), chart.y.name(chart.in_si), _growth_name(chart)]


def hover(chart: Chart) -> HoverTool:
    """Return a hover tool that names the mark and gives the point in the chart's symbols."""
    x, y, _ = hover_names(chart)
    return HoverTool(
        tooltips=[("", "@name"), (x, "$x{0.000}"), (y, "$y{0.000}")],
        line_policy="nearest",
        visible=False,
    )


def map_hover(chart: Chart) -> HoverTool:
    """Return a hover tool that gives the place, the growth and the verdicts."""
    verdicts = [answer.words for answer in Agreement]
    if all(layer.label != "disagreement" for layer in chart.layers):
        verdicts = ["stable", "unstable", "", "", Agreement.NOT_COMPUTED.words]
    words = CustomJSHover(code=f"return {json.dumps(verdicts)}[value]")
    x, y, growth = hover_names(chart)
    return HoverTool(
        tooltips=[
            (x, "$x{0.000}"),
            (y, "$y{0.000}"),
            (growth, "@rate{custom}"),
            ("verdict", "@verdict{custom}"),
        ],
        formatters={"@verdict": words},
        visible=False,
    )


def apply_line_styles(plot: Any, _: Any) -> None:
    """Let every line of a layer take its own colour, dash and width from the source."""
    glyph = plot.handles["glyph"]
    glyph.line_color, glyph.line_dash, glyph.line_width = (
        {"field": name} for name in ("color", "dash", "width")
    )
    glyph.line_cap = "butt"


def apply_hatch(plot: Any, _: Any) -> None:
    """Hatch the regions: shading alone is too faint a sign."""
    plot.handles["glyph"].update(
        hatch_pattern="right_diagonal_line",
        hatch_color="#8a93a0",
        hatch_alpha=0.3,
        hatch_scale=9,
        hatch_weight=0.8,
    )


def apply_dots(plot: Any, _: Any) -> None:
    """Dot what is not computed, so that it is taken neither for stable nor for a region."""
    plot.handles["glyph"].update(
        hatch_pattern="dot", hatch_color="#6b7280", hatch_alpha=0.35, hatch_scale=8
    )


def apply_label_places(plot: Any, _: Any) -> None:
    """Let every label stand on its own side of its point, upright where its side says so."""
    plot.handles["glyph"].update(
        text_align={"field": "align"},
        text_baseline={"field": "baseline"},
        x_offset={"field": "dx"},
        y_offset={"field": "dy"},
        angle={"field": "angle"},
        background_fill_color="white",
        background_fill_alpha=0.7,
    )


def as_patches(plot: Any, _: Any) -> None:
    """Draw polygons as patches, whose rings, also holes, are one array with a NaN between two.

    HoloViews' own polygons need an array for each ring, and every array costs as much to send as a
    thousand points.
    """
    renderer = plot.handles["glyph_renderer"]
    mapper = next(part for key, part in plot.handles.items() if key.endswith("color_mapper"))
    colours = {"field": "growth", "transform": mapper}
    renderer.glyph = Patches(xs="xs", ys="ys", fill_color=colours, line_color=None)
    states = dict.fromkeys(("selection_glyph", "nonselection_glyph", "muted_glyph"), "auto")
    renderer.update(hover_glyph=None, **states)


def as_areas(plot: Any, _: Any) -> None:
    """Draw polygons as patches without an outline that take their colour from the source."""
    renderer = plot.handles["glyph_renderer"]
    renderer.glyph = Patches(
        xs="xs",
        ys="ys",
        fill_color={"field": "color"},
        fill_alpha=0.4,
        line_color=None,
    )
    states = dict.fromkeys(("selection_glyph", "nonselection_glyph", "muted_glyph"), "auto")
    renderer.update(hover_glyph=None, **states)


def style_axes(plot: Any, _: Any) -> None:
    """Set the toolbar, the grounds and the axes, for which HoloViews has no option."""
    figure = plot.state
    figure.toolbar.logo = None
    figure.toolbar.active_drag = next(
        tool for tool in figure.toolbar.tools if type(tool).__name__ == "BoxZoomTool"
    )
    figure.toolbar.active_scroll = None
    # the page's own ground shows through, light or dark
    figure.update(background_fill_color=None, border_fill_color=None, outline_line_color=None)
    for axis in figure.xaxis:
        axis.ticker.desired_num_ticks = 5  # numbers of five digits do not touch in a narrow chart
    for axis in figure.axis:
        # plain digits as far as they fit
        axis.formatter.update(power_limit_high=7)
        axis.update(
            axis_label_text_font_style="normal",
            axis_label_text_font_size="14px",
            major_label_text_font_size="12px",
            minor_tick_line_color=None,
        )


def make_square(plot: Any, _: Any) -> None:
    """Give the frame borders of one size, so that a square place makes equal scales."""
    # no toolbar: it would take its height from the frame
    plot.state.update(
        toolbar_location=None,
        min_border_left=64,
        min_border_right=14,
        min_border_top=14,
        min_border_bottom=64,
    )
    for axis in plot.state.axis:
        # few and short, so that they stay apart at any size of the motion
        axis.ticker.desired_num_ticks = 4
        axis.formatter = CustomJSTickFormatter(code=_SHORT_TICKS)


def transparent_nan(plot: Any, _: Any) -> None:
    """Leave pixels that are not a number transparent."""
    plot.handles["color_mapper"].update(nan_color="rgba(0, 0, 0, 0)")


def add_growth_hover(plot: Any, _: Any) -> None:
    """Let the hover give the growth, per unit of time and per period of the load."""
    words = CustomJSHover(
        args={"source": plot.handles["source"]},
        code="""
        const period = 2 * Math.PI / (special_vars.x * source.data.frequency[0])
        return value ? `${value.toFixed(4)}, ${(value * period).toFixed(3)} a period` : "none"
        """,
    )
    plot.handles["hover"].formatters |= {"@rate": words}
