"""Where curves are sampled that are seen at a certain scale: densely, and most densely at bends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .views import View

__all__ = ["samples", "seen_part"]

Floats = NDArray[np.float64]

SAMPLES = 160
"""Samples that are evenly spaced over what is seen."""
TOLERANCE = 5e-4
"""Largest distance of a curve from its chords, in heights of what is seen: a fifth of a pixel."""
_PASSES = 30  # halvings of an interval: at a load of flutter a curve has a vertical tangent
_MOST = 4000  # samples in all


def samples(values: Callable[[Floats], Floats], whole: Floats, seen: View) -> Floats:
    """Return the abscissas at which curves are computed for what is seen of them.

    Parameters
    ----------
    values : callable
        Takes abscissas (m,) and returns the ordinates (m, k) of continuous curves.
    whole : (n,) float
        Ascending abscissas by which the curves are followed outside of what is seen.
    seen : View

    Returns
    -------
    (m,) float
        Ascending, with those of `whole` and both ends of what is seen.
    """
    even = np.linspace(seen.left, seen.right, SAMPLES)
    grid = np.union1d(whole, even)
    height = seen.high - seen.low
    low, high = seen.low - height, seen.high + height
    at = values(even)
    left, right, starts, ends = even[:-1], even[1:], at[:-1], at[1:]
    for _ in range(_PASSES):
        middle = 0.5 * (left + right)
        found = values(middle)
        off = np.abs(found - 0.5 * (starts + ends)) > TOLERANCE * height
        points = np.stack([starts, found, ends])
        visible = (points.max(axis=0) > low) & (points.min(axis=0) < high)
        bent = (off & visible).any(axis=1)
        if not bent.any() or grid.size + bent.sum() > _MOST:
            break
        left, middle, right = left[bent], middle[bent], right[bent]
        starts, found, ends = starts[bent], found[bent], ends[bent]
        grid = np.union1d(grid, middle)
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
        starts, ends = np.concatenate([starts, found]), np.concatenate([found, ends])
    return grid


def seen_part(grid: Floats, seen: View) -> slice:
    """Return the part of ascending abscissas within a width of what is seen, and one beyond.

    A chart that is moved then shows more of its curves before they have been computed anew.
    """
    width = seen.right - seen.left
    first = int(np.searchsorted(grid, seen.left - width)) - 1
    last = int(np.searchsorted(grid, seen.right + width, side="right")) + 1
    return slice(max(first, 0), last)
