"""One panel in print: what HoloViews draws of a chart with Matplotlib."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .extra import extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Chart, Curve, Layer
from ..charts.figure import growth_bands
from ..charts.roles import UNSTABLE, Shape
from . import contours
from .printed_growth import growth_hook
from .typesetting import mathtext

__all__ = ["DASHES", "FILL", "PALE", "PANEL_INCHES", "SHADE", "panel_overlay", "point_look"]

DASHES: dict[str, Any] = {
    "solid": "-",
    "dashed": (0, (6, 2.5)),
    "dashdot": (0, (7, 2, 1.4, 2)),
    "dotted": (0, (1.2, 1.4)),
}
FILL = 0.38
"""Opacity of what is unstable."""
SHADE, PALE = 0.14, 0.09
"""Opacities of a Bolotin region that stands alone, and of one beside what is unstable."""
PANEL_INCHES = (3.2, 2.6)


_SIGNS: dict[Shape, str] = {
    "diamond": "D",
    "circle": "o",
    "ring": "o",
    "triangle": "^",
    "square": "s",
    "cross": "X",
}


def point_look(point: Curve) -> tuple[str, str]:
    """Return the sign of Matplotlib and the colour of a point."""
    return _SIGNS[point.look.shape], point.look.color


def _fill_hook(outlines: Sequence[Curve]) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that outlines and fills what is unstable.

    A panel has a hundred thin polygons; as HoloViews elements they would take half a minute.
    """

    def draw(plot: Any, _: Any) -> None:
        from matplotlib.collections import LineCollection, PolyCollection

        axes = plot.handles["axis"]
        for group in dict.fromkeys(curve.group for curve in outlines):
            curves = [curve for curve in outlines if curve.group == group]
            color, style = curves[0].look.color, curves[0].style
            shapes = [np.column_stack(curve.polygon) for curve in curves]
            edges = [half for shape in shapes for half in np.split(shape, [len(shape) // 2])]
            axes.add_collection(
                PolyCollection(
                    shapes, facecolor=color, edgecolor="none", alpha=FILL, zorder=1, label=group
                ),
                autolim=False,
            )
            # the thinnest tongue is seen by its outline
            axes.add_collection(
                LineCollection(
                    edges, colors=color, linestyles=[DASHES[style]], linewidths=0.8, zorder=1.5
                ),
                autolim=False,
            )

    return draw


def _regions(panel: Chart, opacity: float) -> list[hv.Element]:
    """Return Bolotin's regions."""
    return [
        hv.Polygons([{"x": region.x, "y": region.y}], ["x", "y"]).opts(
            facecolor=hv.Cycle([region.look.color]),
            edgecolor="none",
            alpha=opacity,
            backend="matplotlib",
        )
        for region in panel.regions
    ]


def _blanks(panel: Chart) -> list[hv.Element]:
    """Return what is not computed, dotted."""
    return [
        hv.Polygons([{"x": x, "y": y}], ["x", "y"]).opts(
            facecolor="#e3e5e8",
            edgecolor="#9aa1ab",
            linewidth=0.0,
            hatch="....",
            backend="matplotlib",
        )
        for layer in panel.of_kind("blanks")
        for x, y in zip(layer.columns["xs"], layer.columns["ys"], strict=True)
    ]


def _edge_hook(bands: Layer) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that draws the edge of what is unstable."""

    def draw(plot: Any, _: Any) -> None:
        from matplotlib.collections import LineCollection

        points = np.column_stack(contours.outline(bands))
        parts = np.split(points, np.flatnonzero(np.isnan(points[:, 0])))
        lines = [part[np.isfinite(part[:, 0])] for part in parts]
        color = UNSTABLE
        plot.handles["axis"].add_collection(
            LineCollection(lines, colors=color, linewidths=0.8, zorder=1.5), autolim=False
        )

    return draw


def panel_overlay(panel: Chart) -> hv.Overlay:
    """Return one panel: growth and regions below, lines above, points on top."""
    thin = bool(panel.shows_floquet and panel.regions)  # Bolotin's part is drawn pale
    lines = [
        hv.Curve((line.x, line.y), "x", "y", label=line.group).opts(
            linestyle=DASHES[line.style],
            linewidth=0.7 if thin else 1.3,
            color=line.look.color,
            alpha=0.5 if thin else 1.0,
            backend="matplotlib",
        )
        for line in panel.curves("lines")
    ]
    points = [
        hv.Points((point.x, point.y), ["x", "y"]).opts(
            s=30, marker=sign, color=color, edgecolors="white", linewidth=0.7, backend="matplotlib"
        )
        for point in panel.curves("points")
        for sign, color in [point_look(point)]
    ]
    bands = growth_bands(panel)
    hooks = [_fill_hook(panel.unstable)] if panel.unstable else []
    if bands is not None:
        hooks += [growth_hook(bands), _edge_hook(bands)]
    regions = _regions(panel, PALE if thin else SHADE)
    return hv.Overlay([*_blanks(panel), *regions, *lines, *points]).opts(
        hv.opts.Overlay(
            title=f"({panel.letter}) {panel.title}" if panel.letter else panel.title,
            xlabel=mathtext(panel.x.name(with_unit=True)),
            ylabel=mathtext(panel.y.name(with_unit=True)),
            xlim=panel.x_range,
            ylim=panel.y_range,
            hooks=hooks,
            show_legend=False,
            aspect=PANEL_INCHES[0] / PANEL_INCHES[1],
            backend="matplotlib",
        )
    )
