"""Charts and figures for a notebook: what the dashboard draws, with a title and a legend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .._arguments import extra_is_missing

try:
    import holoviews as hv
    from bokeh.models import Legend, LegendItem
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Chart, Figure
from .screen import element

__all__ = ["notebook_element", "notebook_layout"]

_WIDTH, _HEIGHT = 620, 420  # in pixels


def notebook_element(chart: Chart) -> hv.Overlay:
    """Return a chart as a HoloViews overlay of a fixed size; see `Chart.plot`."""
    title = f"({chart.letter}) {chart.title}" if chart.letter else chart.title
    overlay = element(chart)
    hooks = [*overlay.opts.get("plot", backend="bokeh").kwargs["hooks"], _legend(chart)]
    width = _HEIGHT if chart.square else _WIDTH
    return overlay.opts(
        title=title,
        responsive=False,
        min_height=None,
        width=width,
        height=_HEIGHT,
        hooks=hooks,
        backend="bokeh",
    )


def notebook_layout(figure: Figure) -> hv.Layout:
    """Return a figure as a HoloViews layout; see `Figure.plot`."""
    hv.renderer("bokeh")
    layout = hv.Layout([notebook_element(panel) for panel in figure.panels])
    columns = 2 if len(figure.panels) in (2, 4) else min(3, len(figure.panels))
    return layout.opts(title=figure.heading, shared_axes=False, backend="bokeh").cols(columns)


def _legend(chart: Chart) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that adds a legend with an entry for each group of lines."""

    def draw(plot: Any, _: Any) -> None:
        looks = {line.group: line.look for line in chart.curves("lines", "outlines")}
        items = []
        for group, look in looks.items():
            sample = plot.state.line(
                [],
                [],
                line_color=look.color,
                line_dash=look.dash,
                line_width=look.width,
            )
            items.append(LegendItem(label=group, renderers=[sample]))
        plot.state.add_layout(Legend(items=items, label_text_font_size="11px"), "below")

    return draw
