"""Figures drawn in print quality: HoloViews and Matplotlib make PDF, SVG and PNG.

No browser is needed. `typesetting` writes the texts; tables of the same figures are in `tables`.
"""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from typing import Any

from .._arguments import choice
from .extra import extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Figure
from ..charts.instability import BOLOTIN
from ..charts.tongues import FLOQUET
from .formats import PICTURE_FORMATS
from .printed_panel import DASHES, FILL, PALE, PANEL_INCHES, SHADE, marker, panel_overlay
from .typesetting import finish_panel, mathtext

__all__ = ["figure_files", "paper_layout"]

_SINGLE_INCHES = (5.6, 3.8)
_WIDE_INCHES = (7.2, 2.75)  # with Floquet: a panel a row, for narrow tongues
_LEGEND = {"frameon": False, "handlelength": 3.4}
_SETTINGS = {
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
    for name in formats:
        choice("file format", name, tuple(PICTURE_FORMATS))
    try:
        import matplotlib
        from matplotlib import pyplot
    except ImportError as error:
        raise extra_is_missing(__name__, error) from error

    files = {}
    # the calling process may have its own settings: they are put back
    with matplotlib.rc_context(_SETTINGS):
        drawn = hv.render(paper_layout(figure), backend="matplotlib")
        _arrange(drawn, figure)
        for name in formats:
            stream = BytesIO()
            metadata = PICTURE_FORMATS[name].metadata(figure.heading)
            drawn.savefig(stream, format=name, dpi=300, metadata=metadata)
            files[name] = stream.getvalue()
        pyplot.close(drawn)
    return files


def _arrange(drawn: Any, figure: Figure) -> None:
    """Place the panels, the common legend and the heading of a rendered layout."""
    columns = _columns(figure)
    rows = -(-len(figure.panels) // columns)
    across, down = PANEL_INCHES if columns > 1 else _SINGLE_INCHES
    if figure.has_floquet:
        across, down = _WIDE_INCHES
    handles, names = _legend_entries(figure)
    entries = _entries_per_row(drawn, handles, names, columns * across)
    lower = 0.35 + 0.18 * -(-len(names) // entries)
    width, height = columns * across, rows * down + lower
    drawn.set_size_inches(width, height)
    axes = [part for part in drawn.axes if part.get_title()]
    for index, (part, panel) in enumerate(zip(axes, figure.panels, strict=True)):
        row, column = divmod(index, columns)
        part.set_position(
            (
                (column * across + 0.62) / width,
                (height - (row + 1) * down + 0.42) / height,
                (across - 0.82) / width,
                (down - 0.8) / height,
            )
        )
        finish_panel(part, panel)
    drawn.legend(
        handles=handles,
        labels=names,
        loc="lower center",
        bbox_to_anchor=(0.5, 0.24 / height),
        ncols=entries,
        **_LEGEND,
    )
    heading = mathtext(figure.heading)
    drawn.text(0.5, 0.1 / height, heading, ha="center", va="bottom", fontsize=9.0)


def _legend_entries(figure: Figure) -> tuple[list[Any], list[str]]:
    """Return the signs and the names of the common legend."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    groups = figure.groups()
    handles: list[Any] = [
        Line2D(
            [],
            [],
            color=curve.look.print_color,
            linestyle=DASHES[curve.style] if curve.x.size > 1 else "",
            marker="" if curve.x.size > 1 else marker(curve),
        )
        for curve in groups.values()
    ]
    names = [mathtext(group) for group in groups]
    for name, color, alpha in _area_entries(figure):
        handles.append(Patch(facecolor=color, alpha=alpha, edgecolor="none"))
        names.append(name)
    return handles, names


def _area_entries(figure: Figure) -> list[tuple[str, str, float]]:
    """Return name, colour and opacity of the legend's filled areas, where there are two kinds.

    Areas of one colour have it in the legend; those of several, told apart by lines, are grey.
    """
    regions = [region for panel in figure.panels for region in panel.regions]
    if not figure.has_floquet or not regions:
        return []
    outlines = [outline for panel in figure.panels for outline in panel.unstable]
    found = []
    for name, areas, opacity, grey in (
        (BOLOTIN, regions, PALE, SHADE),
        (FLOQUET, outlines, FILL, 0.5),
    ):
        colors = {area.look.print_color for area in areas}
        found.append((name, *((colors.pop(), opacity) if len(colors) == 1 else ("#444444", grey))))
    return found


def _entries_per_row(drawn: Any, handles: list[Any], names: list[str], width: float) -> int:
    """Return how many entries of the legend go into one row of a width [in]."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer = FigureCanvasAgg(drawn).get_renderer()
    for entries in range(min(5, len(names)), 1, -1):
        legend = drawn.legend(handles=handles, labels=names, ncols=entries, **_LEGEND)
        room = width * drawn.dpi - legend.get_window_extent(renderer).width
        legend.remove()
        if room >= 0:
            return entries
    return 1
