"""Charts and figures for a notebook: what the dashboard draws, with a title and a legend."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from .extra import extra_is_missing

try:
    import holoviews as hv
    from bokeh.models import Legend, LegendItem
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import ROLES, Chart, Figure
from ..charts.figure import growth_bands
from ..charts.tongues import FLOQUET
from .screen import columns, element

__all__ = ["notebook_element", "notebook_layout"]

_WIDTH, _HEIGHT = 620, 420  # in pixels


def notebook_element(chart: Chart) -> hv.Overlay:
    """Return a chart as a HoloViews overlay of a fixed size; see `Chart.plot`."""
    title = f"({chart.letter}) {chart.title}" if chart.letter else chart.title
    overlay = element(chart)
    own = overlay.opts.get("plot", backend="bokeh").kwargs["hooks"]
    hooks = [*own, _fill(chart), _legend(chart)]
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


def _fill(chart: Chart) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that gives every layer the columns that the live page gives it.

    HoloViews leaves out some of them, such as the sides of labels.
    """

    def draw(plot: Any, _: Any) -> None:
        for layer, part in zip(chart.layers, plot.subplots.values(), strict=True):
            part.handles["source"].data = columns(layer)

    return draw


def _legend(chart: Chart) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that adds a legend with an entry for each group of lines."""

    def draw(plot: Any, _: Any) -> None:
        looks = {line.group: line.look for line in chart.curves("lines", "outlines")}
        if growth_bands(chart) is not None:
            looks[FLOQUET] = ROLES["edge"]
        items = []
        for group, look in looks.items():
            sample = plot.state.line(
                [math.nan],
                [math.nan],
                line_color=look.color,
                line_dash=look.dash,
                line_width=look.width,
            )
            items.append(LegendItem(label=group, renderers=[sample]))
        legend = Legend(
            items=items,
            ncols=3,
            location="center",
            border_line_color=None,
            label_text_font_size="11px",
        )
        plot.state.add_layout(legend, "below")

    return draw
