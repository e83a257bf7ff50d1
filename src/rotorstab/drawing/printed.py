"""Figures drawn in print quality: HoloViews and Matplotlib make PDF, SVG and PNG.

No browser is needed. `typesetting` writes the texts; tables of the same figures are in `tables`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from io import BytesIO
from typing import Any

from .._arguments import choice
from .extra import extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Figure
from ..charts.figure import growth_bands
from .formats import PICTURE_FORMATS, Origin
from .printed_growth import add_colour_bar
from .printed_legend import add_legend, legend_rows
from .printed_panel import PANEL_INCHES, panel_overlay
from .text_blocks import (
    GREY,
    LINE,
    followed,
    link_lines,
    separate_labels,
    wrapped,
    write_lines,
)
from .typesetting import finish_panel, mathtext

__all__ = ["DOTS", "SETTINGS", "drawn_files", "figure_files", "paper_layout", "rendered"]

_SINGLE_INCHES = (5.6, 3.8)
_SQUARE_INCHES = (4.6, 4.6)
_LIVE_INCHES = (7.2, 3.7)  # a live chart with Floquet and its colour bar
_WIDE_INCHES = (7.2, 2.75)  # with Floquet: a panel a row, for narrow tongues
_BAR_ROOM = 0.62  # inches at the right of a panel for its colour bar
_SMALL = 5.5  # font size of the footer [pt]
DOTS = 300
"""Dots per inch of PNG."""
SETTINGS = {
    "font.size": 9.0,
    "font.family": "DejaVu Sans",
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.5,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.5,
    "pdf.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "rotorstab",  # the same ids in every run
}
"""Matplotlib's settings for everything that is printed."""


def _columns(figure: Figure) -> int:
    """Return how many panels stand side by side."""
    if figure.has_floquet:
        return 1
    return 2 if len(figure.panels) in (2, 4) else min(3, len(figure.panels))


def paper_layout(figure: Figure) -> hv.Layout:
    """Return a figure as a HoloViews layout for Matplotlib, panels side by side.

    Parameters
    ----------
    figure : Figure
        From `rotorstab.paper` or `rotorstab.charts.chart_figure`.

    Returns
    -------
    holoviews.Layout
        HoloViews' Matplotlib backend is loaded; the current backend stays what it was.
    """
    hv.renderer("matplotlib")  # loads it where it is not, and leaves the current one current
    layout = hv.Layout([panel_overlay(panel) for panel in figure.panels])
    return layout.opts(
        shared_axes=False, sublabel_format="", tight=False, backend="matplotlib"
    ).cols(_columns(figure))


def figure_files(figure: Figure, formats: Sequence[str]) -> dict[str, bytes]:
    """Return a figure as the bytes of PDF, SVG and PNG files.

    Parameters
    ----------
    figure : Figure
        From `rotorstab.paper` or `rotorstab.charts.chart_figure`.
    formats : sequence of {"pdf", "svg", "png"}
        Names in `formats.PICTURE_FORMATS`. PNG has 300 dots per inch.

    Returns
    -------
    dict of str to bytes
        By format. The same for the same figure and library versions: no date, no random ids.

    Raises
    ------
    ValueError
        For another format.
    """

    def draw() -> Any:
        drawn = rendered(paper_layout(figure))
        _arrange(drawn, figure)
        return drawn

    return drawn_files(draw, Origin(figure.heading, figure.parameters, figure.link), formats)


def rendered(layout: hv.Layout) -> Any:
    """Return a layout as a figure of Matplotlib; `holoviews.render` would draw it twice."""
    return hv.renderer("matplotlib").get_plot(layout).state


def drawn_files(
    draw: Callable[[], Any], origin: Origin, formats: Sequence[str]
) -> dict[str, bytes]:
    """Return what a function draws as the bytes of files, by format.

    Parameters
    ----------
    draw : callable
        Returns a figure of Matplotlib, drawn with `SETTINGS`.
    origin : Origin
        What the files say of themselves.
    formats : sequence of {"pdf", "svg", "png"}

    Raises
    ------
    ValueError
        For another format.
    """
    for name in formats:
        choice("file format", name, tuple(PICTURE_FORMATS))
    try:
        import matplotlib
        from matplotlib import pyplot
    except ImportError as error:
        raise extra_is_missing(__name__, error) from error

    files = {}
    # the calling process may have its own settings: they are put back
    with matplotlib.rc_context(SETTINGS):
        drawn = draw()
        for name in formats:
            stream = BytesIO()
            metadata = PICTURE_FORMATS[name].metadata(origin)
            drawn.savefig(stream, format=name, dpi=DOTS, metadata=metadata)
            files[name] = stream.getvalue()
        pyplot.close(drawn)
    return files


def _panel_inches(figure: Figure) -> tuple[float, float]:
    """Return the width and the height of a panel with its labels."""
    if _columns(figure) > 1:
        return PANEL_INCHES
    if figure.number is None and len(figure.panels) == 1:
        (panel,) = figure.panels
        if growth_bands(panel) is not None:
            return _LIVE_INCHES
        return _SQUARE_INCHES if panel.square else _SINGLE_INCHES
    return _WIDE_INCHES if figure.has_floquet else _SINGLE_INCHES


def _arrange(drawn: Any, figure: Figure) -> None:
    """Place the panels, the common legend, the heading and the footer of a rendered layout."""
    columns = _columns(figure)
    rows = -(-len(figure.panels) // columns)
    across, down = _panel_inches(figure)
    width = columns * across
    footer = _footer_lines(figure, width)
    foot = LINE * _SMALL * len(footer)
    lower = foot + 0.35 + 0.18 * legend_rows(drawn, figure, width)
    height = rows * down + lower
    drawn.set_size_inches(width, height)
    axes = [part for part in drawn.axes if part.get_title()]
    for index, (part, panel) in enumerate(zip(axes, figure.panels, strict=True)):
        row, column = divmod(index, columns)
        bar = _BAR_ROOM if growth_bands(panel) is not None else 0.0
        part.set_position(
            (
                (column * across + 0.62) / width,
                (height - (row + 1) * down + 0.42) / height,
                (across - 0.82 - bar) / width,
                (down - 0.8) / height,
            )
        )
        finish_panel(part, panel)
        add_colour_bar(part, panel, 0.1)
        if figure.number is None:  # labels of the paper's figures have places of their own
            separate_labels(part)
    add_legend(drawn, figure, width, (0.5 * width, foot + 0.24))
    heading = mathtext(figure.heading)
    drawn.text(0.5, (foot + 0.1) / height, heading, ha="center", va="bottom", fontsize=9.0)
    write_lines(drawn, (0.1, foot + 0.05), footer, _SMALL, color=GREY, url=followed(figure.link))


def _footer_lines(figure: Figure, width: float) -> list[str]:
    """Return the parameters in words and the link, in lines of a page [in]."""
    room = width - 0.2
    lines = wrapped(figure.footer, room, _SMALL)
    return lines + link_lines(figure.link, room, _SMALL)
