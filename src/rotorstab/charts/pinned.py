"""The name of a pinned setting at the outline of its unstable tongues."""

from __future__ import annotations

import numpy as np

from .._types import Array
from .columns import label_columns
from .structure import Layer

__all__ = ["outline_name"]

_TOP, _STEP = 0.8, 0.09  # height of the first name and from one to the next, of the chart's
_ROOM = 0.2  # of the chart's width for a name


def outline_name(
    name: str,
    number: int,
    outline: tuple[Array, Array],
    ranges: tuple[tuple[float, float], tuple[float, float]],
) -> Layer:
    """Return the name of a pin at the widest tongue of its outline.

    Parameters
    ----------
    name : str
    number : int
        Of the pin, from 1: each has a height of its own. It also decides the colour.
    outline : ((m,) float, (m,) float)
        Its points, with a NaN between two lines.
    ranges : ((float, float), (float, float))
        Of both axes.

    Returns
    -------
    Layer
        Of labels; empty where the outline does not reach into the chart.
    """
    place = _place(number, outline, ranges)
    rows = []
    if place is not None:
        (left, right), _ = ranges
        side = "right" if place[0] < right - _ROOM * (right - left) else "left"
        rows.append((*place, name, side))
    columns = {**label_columns(rows), "role": [f"pin {number}"] * len(rows)}
    return Layer("labels", "pin name", columns)


def _place(
    number: int,
    outline: tuple[Array, Array],
    ranges: tuple[tuple[float, float], tuple[float, float]],
) -> tuple[float, float] | None:
    """Return a point on the right edge of the widest tongue at the height of the pin's name."""
    x, y = outline
    (left, right), (low, high) = ranges
    level = low + (_TOP - _STEP * (number - 1)) * (high - low)
    with np.errstate(invalid="ignore"):
        crosses = np.flatnonzero((y[:-1] - level) * (y[1:] - level) <= 0)
    rise = y[crosses + 1] - y[crosses]
    share = np.divide(level - y[crosses], rise, out=np.zeros_like(rise), where=rise != 0)
    found = np.sort(x[crosses] + share * (x[crosses + 1] - x[crosses]))
    found = found[(found >= left) & (found <= right)]
    if found.size:
        widest = int(np.diff(found)[::2].argmax()) if found.size > 1 else -1
        return float(found[2 * widest + 1 if widest >= 0 else 0]), level
    inside = np.flatnonzero((x >= left) & (x <= right) & (y >= low) & (y <= high))
    if not inside.size:
        return None
    top = inside[y[inside].argmax()]
    return float(x[top]), float(y[top])
