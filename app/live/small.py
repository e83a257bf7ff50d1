"""Small charts of one point, beside the animation of the shaft."""

from __future__ import annotations

from typing import Any

__all__ = ["make_small"]


def make_small(figure: Any) -> None:
    """Let a Bokeh figure be small: no toolbar, small letters, and a drag scrolls the page."""
    figure.update(
        min_height=None,  # the page gives each chart its height
        toolbar_location=None,
        min_border_left=48,
        min_border_right=8,
        min_border_top=6,
        min_border_bottom=42,
    )
    figure.toolbar.active_drag = None
    for axis in figure.axis:
        axis.update(
            axis_label_text_font_size="12px",
            major_label_text_font_size="11px",
            axis_label_standoff=2,
            major_tick_in=2,
            major_tick_out=3,
        )
