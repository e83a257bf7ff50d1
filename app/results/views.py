"""The part of a chart that a zoom shows, as the browser tells it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["View", "view_of"]

_NARROWEST = 1e-4  # part of the bounds: a narrower view shows rounding


@dataclass(frozen=True)
class View:
    """The seen ranges of both axes of a chart, non-dimensional.

    Parameters
    ----------
    left, right, low, high : float
    """

    left: float
    right: float
    low: float
    high: float


def view_of(
    message: Mapping[str, Any], bounds: tuple[float, float, float, float], home: View
) -> View | None:
    """Return the view that a message tells, within some bounds.

    Parameters
    ----------
    message : mapping
        With numbers "left", "right", "low" and "high". It may be forged.
    bounds : (float, float, float, float)
        Smallest and largest abscissa, smallest and largest ordinate.
    home : View
        What the chart shows without a zoom.

    Returns
    -------
    View or None
        None where the message tells no range, one outside of the bounds, or all of `home`.
    """
    ends = []
    for names, (low, high), usual in (
        (("left", "right"), bounds[:2], (home.left, home.right)),
        (("low", "high"), bounds[2:], (home.low, home.high)),
    ):
        values = [message.get(name) for name in names]
        if not all(type(value) in (int, float) for value in values):
            return None
        first, last = (float(value) for value in values)  # type: ignore[arg-type]
        least = _NARROWEST * (high - low)
        if not (math.isfinite(first) and math.isfinite(last)):
            return None
        if max(abs(first - usual[0]), abs(last - usual[1])) < least:
            first, last = usual
        first, last = max(first, low), min(last, high)
        if last - first < least:
            return None
        ends += [first, last]
    view = View(*ends)
    return None if view == home else view
