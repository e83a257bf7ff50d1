"""The colours of growth in print: the bands of the screen, and their colour bar."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..charts import Chart, Layer
from ..charts.figure import growth_bands
from . import contours
from .contours import GROWTH_COLOURS
from .typesetting import mathtext

__all__ = ["add_colour_bar", "growth_hook"]


def growth_hook(bands: Layer) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that fills what is unstable with the colours of its growth.

    Parameters
    ----------
    bands : Layer
        Of kind "bands".
    """

    def draw(plot: Any, _: Any) -> None:
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        for color, (_growth, x, y) in zip(GROWTH_COLOURS, contours.areas(bands), strict=False):
            points = np.column_stack([x, y])
            parts = np.split(points, np.flatnonzero(np.isnan(x)))
            rings = [Path(part[np.isfinite(part[:, 0])], closed=True) for part in parts]
            area = PathPatch(
                Path.make_compound_path(*rings), facecolor=color, edgecolor="none", zorder=0.5
            )
            plot.handles["axis"].add_patch(area)

    return draw


def add_colour_bar(axes: Any, panel: Chart, width: float) -> None:
    """Draw a titled colour bar at the right of Matplotlib axes, if the panel has bands of growth.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        At its final place.
    panel : Chart
    width : float
        Of the bar in inches, and of the gap beside it.
    """
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, Normalize

    layer = growth_bands(panel)
    if layer is None or layer.quantity is None:
        return
    figure = axes.figure
    share = width / figure.get_size_inches()[0]
    place = axes.get_position()
    bar = figure.add_axes((place.x1 + share, place.y0, share, place.height))
    scale = Normalize(0.0, layer.columns["top"][0])
    figure.colorbar(ScalarMappable(scale, ListedColormap(GROWTH_COLOURS)), cax=bar)
    bar.set_ylabel(mathtext(layer.quantity.label(with_unit=panel.in_si)), labelpad=3)
    bar.tick_params(length=2, pad=2)
