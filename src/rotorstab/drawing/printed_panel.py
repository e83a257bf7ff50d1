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

from ..charts import Chart, Curve
from ..charts.figure import growth_layer, growth_of
from ..charts.structure import pixel_centres
from .typesetting import mathtext

__all__ = ["DASHES", "FILL", "PALE", "PANEL_INCHES", "SHADE", "marker", "panel_overlay"]

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


def marker(point: Curve) -> str:
    """Return the sign of a point: a circle for a marked one, else a diamond."""
    return "o" if point.role == "marker" else "D"


def _fill_hook(outlines: Sequence[Curve]) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that fills and outlines what is unstable.

    A panel has a hundred thin polygons; as HoloViews elements they would take half a minute.
    """

    def draw(plot: Any, _: Any) -> None:
        from matplotlib.collections import LineCollection, PolyCollection

        axes = plot.handles["axis"]
        for group in dict.fromkeys(curve.group for curve in outlines):
            curves = [curve for curve in outlines if curve.group == group]
            color, style = curves[0].look.print_color, curves[0].style
            shapes = [np.column_stack(curve.polygon) for curve in curves]
            edges = [half for shape in shapes for half in np.split(shape, [len(shape) // 2])]
            axes.add_collection(
                PolyCollection(
                    shapes,
                    facecolor=color,
                    edgecolor="none",
                    alpha=FILL,
                    zorder=1,
                    label=group,
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


def _areas(panel: Chart, opacity: float) -> list[hv.Element]:
    """Return the map of growth, where no outline says more than its pixels, and the regions."""
    areas = [
        hv.Polygons([{"x": region.x, "y": region.y}], ["x", "y"]).opts(
            facecolor=hv.Cycle([region.look.print_color]),
            edgecolor="none",
            alpha=opacity,
            backend="matplotlib",
        )
        for region in panel.regions
    ]
    growth = growth_layer(panel)
    if growth is not None and not panel.unstable:
        rates = np.asarray(growth.columns["rate"][0], float)
        values = np.where(rates > 0, rates, np.nan)
        name = growth_of(panel).label(with_unit=False)
        image = hv.Image((*pixel_centres(growth), values), ["x", "y"], name)
        areas.insert(0, image.opts(cmap="plasma", backend="matplotlib"))
    return areas


def panel_overlay(panel: Chart) -> hv.Overlay:
    """Return one panel: shaded regions below, lines above, points on top."""
    thin = bool(panel.unstable and panel.regions)  # Bolotin's part steps back
    lines = [
        hv.Curve((line.x, line.y), "x", "y", label=line.group).opts(
            linestyle=DASHES[line.style],
            linewidth=0.7 if thin else 1.3,
            color=line.look.print_color,
            alpha=0.5 if thin else 1.0,
            backend="matplotlib",
        )
        for line in panel.curves("lines")
    ]
    points = [
        hv.Points((point.x, point.y), ["x", "y"]).opts(
            s=22, marker=marker(point), color=point.look.print_color, backend="matplotlib"
        )
        for point in panel.curves("points")
    ]
    return hv.Overlay([*_areas(panel, PALE if thin else SHADE), *lines, *points]).opts(
        hv.opts.Overlay(
            title=f"({panel.letter}) {panel.title}" if panel.letter else panel.title,
            xlabel=mathtext(panel.x.name(with_unit=True)),
            ylabel=mathtext(panel.y.name(with_unit=True)),
            xlim=panel.x_range,
            ylim=panel.y_range,
            hooks=[_fill_hook(panel.unstable)] if panel.unstable else [],
            show_legend=False,
            aspect=PANEL_INCHES[0] / PANEL_INCHES[1],
            backend="matplotlib",
        )
    )
