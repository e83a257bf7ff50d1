"""Charts that are low on a small screen: the two below the instability chart."""

from __future__ import annotations

from typing import Any

__all__ = ["make_low"]


def make_low(figure: Any) -> None:
    """Leave a Bokeh figure's height to its curves: smaller letters, and the tools on the chart."""
    figure.toolbar_inner = True
    figure.toolbar.autohide = True  # they are shown while the mouse is over the chart
    for axis in figure.axis:
        axis.update(
            axis_label_text_font_size="12px",
            axis_label_standoff=1,
            major_label_text_font_size="11px",
            major_tick_in=2,
            major_tick_out=3,
        )
