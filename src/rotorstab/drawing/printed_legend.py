"""The common legend of a printed figure."""

from __future__ import annotations

from typing import Any

from ..charts import Figure
from ..charts.figure import growth_bands
from ..charts.instability import BOLOTIN
from ..charts.tongues import FLOQUET
from .contours import GROWTH_COLOURS
from .printed_panel import DASHES, FILL, PALE, SHADE, point_look
from .typesetting import mathtext

__all__ = ["add_legend", "legend_rows"]

_LOOK = {"frameon": False, "handlelength": 3.4, "columnspacing": 1.3, "handletextpad": 0.6}
_MOST = 5  # entries in one row


def legend_rows(drawn: Any, figure: Figure, width: float) -> int:
    """Return how many rows the legend of a figure has in a width [in]."""
    handles, names = _legend_entries(figure)
    return -(-len(names) // _entries_per_row(drawn, handles, names, width))


def add_legend(drawn: Any, figure: Figure, width: float, foot: tuple[float, float]) -> None:
    """Draw the legend of a figure.

    Parameters
    ----------
    drawn : matplotlib.figure.Figure
        Of its final size.
    figure : Figure
        Its lines, points and areas have an entry for each group.
    width : float
        That the legend may take, in inches.
    foot : (float, float)
        Middle of the lower end, in inches from the lower left corner of the page.
    """
    handles, names = _legend_entries(figure)
    across, down = drawn.get_size_inches()
    drawn.legend(
        handles=handles,
        labels=names,
        loc="lower center",
        bbox_to_anchor=(foot[0] / across, foot[1] / down),
        ncols=_entries_per_row(drawn, handles, names, width),
        **_LOOK,
    )


def _legend_entries(figure: Figure) -> tuple[list[Any], list[str]]:
    """Return the signs and the names of the common legend, as Matplotlib takes them."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    groups = figure.groups()
    handles: list[Any] = []
    for curve in groups.values():
        sign, color = point_look(curve)
        is_line = curve.x.size > 1
        handles.append(
            Line2D(
                [],
                [],
                color=curve.look.color if is_line else color,
                linestyle=DASHES[curve.style] if is_line else "",
                marker="" if is_line else sign,
            )
        )
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
    if any(growth_bands(panel) is not None for panel in figure.panels):
        bolotin = [(BOLOTIN, regions[0].look.color, 2 * PALE)] if regions else []
        return [*bolotin, (FLOQUET, GROWTH_COLOURS[len(GROWTH_COLOURS) // 2], 1.0)]
    if not figure.has_floquet or not regions:
        return []
    outlines = [outline for panel in figure.panels for outline in panel.unstable]
    found = []
    for name, areas, opacity, grey in (
        (BOLOTIN, regions, PALE, SHADE),
        (FLOQUET, outlines, FILL, 0.5),
    ):
        colors = {area.look.color for area in areas}
        found.append((name, *((colors.pop(), opacity) if len(colors) == 1 else ("#444444", grey))))
    return found


def _entries_per_row(drawn: Any, handles: list[Any], names: list[str], width: float) -> int:
    """Return how many entries of the legend go into one row of a width [in]."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer = FigureCanvasAgg(drawn).get_renderer()
    for entries in range(min(_MOST, len(names)), 1, -1):
        legend = drawn.legend(handles=handles, labels=names, ncols=entries, **_LOOK)
        room = width * drawn.dpi - legend.get_window_extent(renderer).width
        legend.remove()
        if room >= 0:
            return entries
    return 1
