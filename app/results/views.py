"""The part of a chart that a zoom shows, as the browser sends it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["FINEST", "NARROWEST", "Frame", "View", "fineness_of", "view_of"]

NARROWEST = 1e-4
"""Least part of the bounds that a view shows: a narrower one shows rounding."""
FINEST = 2
"""Largest fineness of a view: the work of a full map rises with its square."""
_PIXELS = 1080, 600
"""Width and height in pixels of the screen up to which the fineness 1 is enough: three columns of
the finer grid of a full map are then two pixels wide."""
_MOST_PIXELS = 100_000  # of a side: no screen has more


@dataclass(frozen=True)
class View:
    """The seen ranges of both axes of a chart, non-dimensional, and how finely they are computed.

    Parameters
    ----------
    left, right, low, high : float
    fineness : int
        1 to `FINEST`: by this number the rows and columns of a full growth map are multiplied.
    """

    left: float
    right: float
    low: float
    high: float
    fineness: int = 1

    @property
    def x(self) -> tuple[float, float]:
        """The range of the abscissa."""
        return self.left, self.right

    @property
    def y(self) -> tuple[float, float]:
        """The range of the ordinate."""
        return self.low, self.high

    def scaled(self, x: float, y: float) -> View:
        """Return the same ranges in other units, of which one is `x` or `y` of the new ones."""
        return View(self.left * x, self.right * x, self.low * y, self.high * y, self.fineness)


@dataclass(frozen=True)
class Frame:
    """The ranges of a chart that may show a part of itself.

    Parameters
    ----------
    home : View
        What it shows without a zoom.
    bounds : View
        The most that a zoom may show.
    """

    home: View
    bounds: View

    def scaled(self, x: float, y: float) -> Frame:
        """Return the same ranges in other units."""
        return Frame(self.home.scaled(x, y), self.bounds.scaled(x, y))


def view_of(message: Mapping[str, Any], frame: Frame) -> View | None:
    """Return the view that a message tells, within the bounds of the chart.

    Parameters
    ----------
    message : mapping
        With numbers "left", "right", "low" and "high". It may be forged.
    frame : Frame

    Returns
    -------
    View or None
        None where the message tells no range, one outside of the bounds, or all of the chart.
    """
    home, bounds = frame.home, frame.bounds
    ends: list[float] = []
    for names, (low, high), usual in (
        (("left", "right"), bounds.x, home.x),
        (("low", "high"), bounds.y, home.y),
    ):
        values = [message.get(name) for name in names]
        if not all(type(value) in (int, float) for value in values):
            return None
        first, last = (float(value) for value in values)  # type: ignore[arg-type]
        least = NARROWEST * (high - low)
        if not (math.isfinite(first) and math.isfinite(last)):
            return None
        if max(abs(first - usual[0]), abs(last - usual[1])) < least:
            first, last = usual
        first, last = max(first, low), min(last, high)
        if last - first < least:
            return None
        ends += [first, last]
    left, right, low, high = ends
    view = View(left, right, low, high)
    return None if view == home else view


def fineness_of(message: Mapping[str, Any]) -> int | None:
    """Return how finely a chart is computed for the pixels that a message tells.

    Parameters
    ----------
    message : mapping
        With numbers "width" and "height": pixels of the screen between the axes of the chart. It
        may be forged.

    Returns
    -------
    int or None
        1 to `FINEST`; None where the message tells no size that a screen can have.
    """
    needed = 0.0
    for name, usual in zip(("width", "height"), _PIXELS, strict=True):
        size = message.get(name)
        # neither NaN nor a very long whole number passes
        if isinstance(size, bool) or not isinstance(size, int | float):
            return None
        if not 1 <= size <= _MOST_PIXELS:
            return None
        needed = max(needed, size / usual)
    return min(math.ceil(needed), FINEST)
