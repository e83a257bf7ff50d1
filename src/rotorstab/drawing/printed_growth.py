"""The colours of growth in print: smooth inside the outlines of tongues, pixels elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.ndimage import binary_dilation, distance_transform_edt

from .._types import Array, Mask
from .extra import extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Chart, Layer
from ..charts.figure import growth_bands, growth_layer
from ..charts.structure import pixel_centres
from . import contours
from .typesetting import mathtext

__all__ = ["add_colour_bar", "growth_colours", "growth_images"]

_SHARE = 98  # percentile of the growth at the top of the scale: few slow pixels grow much faster
_NEAR = 2  # pixels round the inside of an outline that its smooth colours replace
_PALETTE = slice(30, 236)  # of 256 colours, those of the screen


def growth_colours() -> list[str]:
    """Return the colours of growth, from slow to fast, as hexadecimal RGB."""
    from matplotlib import colormaps
    from matplotlib.colors import to_hex

    return [to_hex(color) for color in colormaps["plasma"](np.arange(256))[_PALETTE]]


def growth_images(panel: Chart) -> list[hv.Image]:
    """Return the map of growth of a panel as HoloViews images, empty where it has none.

    Inside the outlines of the tongues the growth between pixels is interpolated, up to the exact
    edge. Where no outline is known, as for very slow loads, the pixels themselves are drawn.
    """
    layer = growth_layer(panel)
    if layer is None:
        return []
    growth = np.asarray(layer.columns["image"][0], float)
    if not np.isfinite(growth).any():
        return []
    xs, ys = pixel_centres(layer)
    options = {"cmap": growth_colours(), "clim": (0.0, _top(growth)), "backend": "matplotlib"}
    pixels = (
        np.where(_near_outlines(panel, layer), np.nan, growth) if panel.shows_floquet else growth
    )
    images = []
    if np.isfinite(pixels).any():
        images.append(hv.Image((xs, ys, pixels), ["x", "y"], "growth").opts(**options))
    if panel.shows_floquet:
        smooth = hv.Image((xs, ys, _extended(growth)), ["x", "y"], "growth inside")
        images.append(
            smooth.opts(interpolation="bilinear", hooks=[_clip_to_outlines(panel)], **options)
        )
    return images


def _top(growth: Array) -> float:
    """Return the upper end of the colour scale, rounded up to half a step of one digit."""
    largest = float(np.nanpercentile(growth, _SHARE))
    step = 0.5 * 10.0 ** np.floor(np.log10(largest)) if largest > 0 else 1.0
    return float(np.ceil(largest / step) * step) or 1.0


def _extended(growth: Array) -> Array:
    """Return a map whose empty pixels have the value of the nearest filled one."""
    nearest = distance_transform_edt(np.isnan(growth), return_distances=False, return_indices=True)
    return np.asarray(growth[tuple(nearest)])


def _polygons(panel: Chart) -> list[Array]:
    """Return the outlines as closed polygons (m, 2)."""
    shapes = [np.column_stack(curve.polygon) for curve in panel.unstable]
    bands = growth_bands(panel)
    for _, x, y in contours.areas(bands)[:1] if bands is not None else ():
        points = np.column_stack([x, y])
        rings = np.split(points, np.flatnonzero(np.isnan(x)))
        shapes += [ring[np.isfinite(ring[:, 0])] for ring in rings]
    return [np.concatenate([shape, shape[:1]]) for shape in shapes]


def _outline_path(panel: Chart) -> Any:
    """Return the outlines as one path of Matplotlib."""
    from matplotlib.path import Path

    return Path.make_compound_path(*(Path(shape, closed=True) for shape in _polygons(panel)))


def _near_outlines(panel: Chart, layer: Layer) -> Mask:
    """Return which pixels lie inside an outline or within `_NEAR` pixels of it."""
    xs, ys = pixel_centres(layer)
    places = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
    near = _outline_path(panel).contains_points(places).reshape(ys.size, xs.size)
    corner = layer.columns["x"][0], layer.columns["y"][0]
    size = layer.columns["dw"][0] / xs.size, layer.columns["dh"][0] / ys.size
    for shape in _polygons(panel):  # a thin tongue may hold no centre
        column, row = ((shape - corner) / size).astype(int).T
        near[np.clip(row, 0, ys.size - 1), np.clip(column, 0, xs.size - 1)] = True
    return np.asarray(binary_dilation(near, iterations=_NEAR))


def _clip_to_outlines(panel: Chart) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that shows an image inside the outlines only."""

    def clip(plot: Any, _: Any) -> None:
        plot.handles["artist"].set_clip_path(_outline_path(panel), plot.handles["axis"].transData)

    return clip


def add_colour_bar(axes: Any, panel: Chart, width: float) -> None:
    """Draw a titled colour bar at the right of Matplotlib axes, if the panel has a map of growth.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        At its final place.
    panel : Chart
    width : float
        Of the bar in inches, and of the gap beside it.
    """
    layer = growth_layer(panel)
    if layer is None or layer.quantity is None or not axes.images:
        return
    figure = axes.figure
    share = width / figure.get_size_inches()[0]
    place = axes.get_position()
    bar = figure.add_axes((place.x1 + share, place.y0, share, place.height))
    figure.colorbar(axes.images[-1], cax=bar)
    bar.set_ylabel(mathtext(layer.quantity.label(with_unit=panel.in_si)), labelpad=3)
    bar.tick_params(length=2, pad=2)
