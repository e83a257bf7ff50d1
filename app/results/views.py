"""The part of a chart that a zoom shows, as the browser sends it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["NARROWEST", "Frame", "View", "view_of"]

NARROWEST = 1e-4
"""Least part of the bounds that a view shows: a narrower one shows rounding."""


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
        return View(self.left * x, self.right * x, self.low * y, self.high * y)


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
    view = View(*ends)
    return None if view == home else view
