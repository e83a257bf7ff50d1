"""Outlines and filled areas of what is unstable, from the layers that hold it on a grid."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._types import Array
from .extra import extra_is_missing

try:
    from bokeh.palettes import Plasma256
    from contourpy import FillType, LineType, contour_generator
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..charts import Layer

__all__ = ["BANDS", "GROWTH_COLOURS", "areas", "outline"]

BANDS = 10
"""Number of equal steps of the growth rate that have a colour each."""
GROWTH_COLOURS: list[str] = [Plasma256[round(place)] for place in np.linspace(112, 240, BANDS)]
"""Their colours, on the screen and in print: without Plasma's darkest part, for dark grounds."""


def outline(layer: Layer) -> tuple[Array, Array]:
    """Return the edge of the unstable set, with a NaN between two lines.

    Parameters
    ----------
    layer : Layer
        Of kind "edges" or "bands".

    Returns
    -------
    x, y : (m,) float
    """
    values = _values(layer, 0.0)
    found: Any = _generator(values).lines(0.0)[0][0]
    if found is None:
        return np.empty(0), np.empty(0)
    return _placed(np.asarray(found, float), layer, values, 0.0)


def areas(layer: Layer) -> list[tuple[float, Array, Array]]:
    """Return where the rotor is unstable and grows faster than each lower end of a band.

    Each area lies within the one before it, to be painted over it: so no ground shows between
    them.

    Parameters
    ----------
    layer : Layer
        Of kind "bands".

    Returns
    -------
    list of (float, (m,) float, (m,) float)
        Growth in the middle of the band, x and y of the rings, with a NaN between two of them. By
        the even-odd rule a ring within another one is a hole.
    """
    step = layer.columns["top"][0] / BANDS
    found = []
    for band in range(BANDS):
        level = (band * step) ** 2
        values = _values(layer, level)
        points, offsets = _generator(values).filled(level, np.inf)
        if points[0] is None:
            break
        x, y = _placed(np.asarray(points[0], float), layer, values, level)
        rings = np.asarray(offsets[0][1:-1], dtype=np.intp)
        found.append(
            ((band + 0.5) * step, np.insert(x, rings, np.nan), np.insert(y, rings, np.nan))
        )
    return found


def _values(layer: Layer, level: float) -> Array:
    """Return values (R, C) whose contour at a level has a point on each interval that it crosses.

    Unstable points have the square of the growth, which is linear at an edge without damping; for
    the edge itself, and on stable points, the sign alone counts.
    """
    columns = layer.columns
    function = columns["edge"][0]
    inside = np.square(columns["growth"][0]) if level > 0 else 1.0
    outside = -level if level > 0 else -1.0
    return np.where(np.isnan(function), np.nan, np.where(function > 0, inside, outside))


def _generator(values: Array) -> Any:
    """Return the contours of values (R, C) over the numbers of columns and rows."""
    return contour_generator(
        z=np.ma.masked_invalid(values),
        line_type=LineType.ChunkCombinedNan,
        fill_type=FillType.ChunkCombinedOffset,
    )


def _placed(points: Array, layer: Layer, values: Array, level: float) -> tuple[Array, Array]:
    """Return the coordinates of points (m, 2) given in numbers of columns and rows.

    On an interval of the grid that the edge crosses, the value is 0 at the crossing and linear from
    there to the unstable end. Where the layer knows no crossing the edge function is linear.
    """
    columns = layer.columns
    place = points.copy()
    known = np.isfinite(points[:, 0])
    index = np.where(known[:, None], np.floor(points), 0).astype(np.intp)
    for axis, name in ((0, "across"), (1, "along")):
        on_line = (points[:, 1 - axis] == index[:, 1 - axis]) & (points[:, axis] != index[:, axis])
        at = np.flatnonzero(known & on_line)
        row, column = index[at, 1], index[at, 0]
        ends = (row, column), (row + axis, column + 1 - axis)
        before, after = (columns["edge"][0][end] for end in ends)
        crosses = (before > 0) != (after > 0)
        at, row, column = at[crosses], row[crosses], column[crosses]
        before, after = before[crosses], after[crosses]
        first, second = (values[end][crosses] for end in ends)
        crossing = columns[name][0][row, column]
        crossing = np.where(np.isnan(crossing), before / (before - after), crossing)
        part = level / np.maximum(first, second)
        moved = np.where(after > before, crossing + part * (1 - crossing), crossing * (1 - part))
        place[at, axis] = index[at, axis] + moved
    x, y = columns["x"][0], columns["y"][0]
    return (
        np.interp(place[:, 0], np.arange(len(x)), x),
        np.interp(place[:, 1], np.arange(len(y)), y),
    )
