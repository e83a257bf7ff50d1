"""One view of the dashboard on one page of A4, across: charts, words, tables and the link."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .extra import extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Chart
from ..charts.figure import growth_bands
from ..charts.sheet import Sheet
from .formats import Origin
from .printed import DOTS, drawn_files, rendered
from .printed_growth import add_colour_bar
from .printed_legend import add_legend, legend_rows
from .printed_panel import DASHES, panel_overlay
from .printed_tables import Box, settings_height, write_settings, write_tables
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

__all__ = ["draw_sheet", "sheet_files"]

_WIDTH, _HEIGHT = 11.69, 8.27  # A4, in inches like all lengths here
_MARGIN = 0.4
_GAP = 0.3  # between the two columns
_SIDE, _NARROW_SIDE = 3.65, 2.4  # width of the right column, with a marked point and without
_LEFT, _BELOW, _ABOVE, _RIGHT = 0.52, 0.4, 0.24, 0.1  # room of axes for labels and title
_SMALL_LEFT = 0.46  # the same at the left of a square chart
_MAIN_SHARE = 0.58  # of the left column's height for the first chart
_RESPONSE, _SQUARE = 0.85, 1.15  # heights of the response's axes and of the square ones
_BAR, _BAR_ROOM = 0.1, 0.62
_HEADING, _SENTENCE, _WORDS, _LINK = 12.0, 8.5, 7.0, 5.5  # font sizes [pt]
_LEGEND_ROW = 0.17
_OWN_LEGEND = 0.14  # height of the legend above the response
_FONTS = {
    "axes.labelsize": 8.0,
    "axes.titlesize": 8.5,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
}


def sheet_files(sheet: Sheet, formats: Sequence[str]) -> dict[str, bytes]:
    """Return a sheet as the bytes of PDF, SVG and PNG files of A4 size.

    Parameters
    ----------
    sheet : Sheet
    formats : sequence of {"pdf", "svg", "png"}
        PNG has 300 dots per inch.

    Returns
    -------
    dict of str to bytes
        By format. The same for the same sheet and library versions.

    Raises
    ------
    ValueError
        For another format.
    """
    origin = Origin(sheet.heading, sheet.parameters, sheet.link)
    return drawn_files(lambda: draw_sheet(sheet), origin, formats)


def draw_sheet(sheet: Sheet) -> Any:
    """Return a sheet as a figure of Matplotlib, whose caller closes it."""
    import matplotlib

    hv.renderer("matplotlib")
    matplotlib.rcParams.update(_FONTS)  # `drawn_files` puts the settings back
    panels = (*sheet.charts, *sheet.point_charts)
    layout = hv.Layout([panel_overlay(panel) for panel in panels]).opts(
        shared_axes=False, sublabel_format="", tight=False, backend="matplotlib"
    )
    drawn = rendered(layout.cols(len(panels)))
    drawn.set_size_inches(_WIDTH, _HEIGHT)
    drawn.set_dpi(DOTS)  # labels are kept apart as they are printed
    axes = [part for part in drawn.axes if part.get_title()]
    body = _write_words(drawn, sheet)
    split = body.right - (_SIDE if sheet.point_charts else _NARROW_SIDE)
    left = Box(body.left, split - _GAP, body.low, body.high)
    right = Box(split, body.right, body.low, body.high)
    main = len(sheet.charts)
    _place_charts(drawn, sheet, axes[:main], left)
    right = _place_point_charts(sheet.point_charts, axes[main:], right)
    write_tables(drawn, sheet.tables, right)
    return drawn


def _write_words(drawn: Any, sheet: Sheet) -> Box:
    """Write heading, words, settings and link; return the part of the page between them."""
    room = _WIDTH - 2 * _MARGIN
    top = _HEIGHT - _MARGIN
    top = write_lines(drawn, (_MARGIN, top), [sheet.heading], _HEADING, fontweight="bold")
    words = [(sheet.sentence, _SENTENCE), *((text, _WORDS) for text in sheet.paragraphs)]
    for text, size in words:
        lines = wrapped(text, room, size)
        top = write_lines(drawn, (_MARGIN, top - 0.03), lines, size)
    address = link_lines(sheet.link, room, _LINK)
    foot = _MARGIN + LINE * _LINK * len(address)
    write_lines(drawn, (_MARGIN, foot), address, _LINK, color=GREY, url=followed(sheet.link))
    strip = Box(_MARGIN, _WIDTH - _MARGIN, foot + 0.05, foot + 0.05)
    strip = strip.raised(settings_height(sheet.settings, strip.width))
    write_settings(drawn, sheet.settings, strip)
    return Box(strip.left, strip.right, strip.high + 0.05, top - 0.04)


def _place(axes: Any, chart: Chart, box: Box, left: float = _LEFT, legend: float = 0.0) -> None:
    """Put axes with their labels and their title into a part of the page.

    `left` is the room for labels at the left, `legend` that of a legend below the title.
    """
    bar = _BAR_ROOM if growth_bands(chart) is not None else 0.0
    axes.set_position(
        (
            (box.left + left) / _WIDTH,
            (box.low + _BELOW) / _HEIGHT,
            (box.width - left - _RIGHT - bar) / _WIDTH,
            (box.height - _BELOW - _ABOVE - legend) / _HEIGHT,
        )
    )
    finish_panel(axes, chart)
    axes.set_title(chart.title, loc="left", pad=4 + 72 * legend, fontweight="bold")
    add_colour_bar(axes, chart, _BAR)
    separate_labels(axes)


def _place_charts(drawn: Any, sheet: Sheet, axes: Sequence[Any], box: Box) -> None:
    """Draw the first chart, the others below it, and their common legend."""
    figure = sheet.main_figure
    low = box.low + _LEGEND_ROW * legend_rows(drawn, figure, box.width)
    add_legend(drawn, figure, box.width, (0.5 * (box.left + box.right), box.low))
    split = low + (1 - _MAIN_SHARE) * (box.high - low)
    _place(axes[0], sheet.charts[0], Box(box.left, box.right, split, box.high))
    others = sheet.charts[1:]
    width = box.width / max(1, len(others))
    for index, (part, chart) in enumerate(zip(axes[1:], others, strict=True)):
        left = box.left + index * width
        _place(part, chart, Box(left, left + width, low, split))


def _place_point_charts(charts: Sequence[Chart], axes: Sequence[Any], box: Box) -> Box:
    """Draw the charts of the marked point; return the room below them."""
    if not charts:
        return box
    low = box.high - _RESPONSE - _ABOVE - _BELOW - _OWN_LEGEND
    _place(axes[0], charts[0], Box(box.left, box.right, low, box.high), legend=_OWN_LEGEND)
    _add_own_legend(axes[0], charts[0])
    squares = charts[1:]
    half = box.width / max(1, len(squares))
    width = _SMALL_LEFT + _SQUARE + _RIGHT
    foot = low - (_SQUARE + _ABOVE + _BELOW)
    for index, (part, chart) in enumerate(zip(axes[1:], squares, strict=True)):
        left = box.left + index * half
        _place(part, chart, Box(left, left + width, foot, low), _SMALL_LEFT)
        part.locator_params(nbins=4)
    return Box(box.left, box.right, box.low, foot)


def _add_own_legend(axes: Any, chart: Chart) -> None:
    """Name the lines of a chart between it and its title."""
    from matplotlib.lines import Line2D

    looks = {line.group: line for line in chart.curves("lines")}
    handles = [
        Line2D([], [], color=line.look.color, linestyle=DASHES[line.style])
        for line in looks.values()
    ]
    axes.legend(
        handles,
        [mathtext(group) for group in looks],
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=len(looks),
        frameon=False,
        fontsize=6.5,
        handlelength=2.8,
        columnspacing=1.2,
        handletextpad=0.5,
        borderaxespad=0.1,
        borderpad=0.1,
    )
