"""Where pairs of multipliers come closest along lines of the load–frequency plane.

A tongue that is narrower than the distance of the sampled points is found at such a place.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..._numerics.parabola import parabola_maximum
from ..._types import Array, Index, Mask

__all__ = ["SHRINKS", "Candidates", "approach_candidates", "closest_approaches"]

SHRINKS = (0.5, 0.1, 0.02, 0.004)
"""Half-widths of the successive parabolas, as parts of the searched half interval."""

_PASSED = 0.5  # part of a detuning: a forecast below it means that the sign has changed
_SLACK = 0.2  # of a parabola's fall over its half-width: by how much its maximum may be too low


class Candidates(NamedTuple):
    """Places along lines where pairs of multipliers may come closest, (K,) arrays.

    Parameters
    ----------
    line : int
        Index of the line.
    place, reach : float
        Coordinate along it, and half the interval in which the closest approach is to be sought.
    rank : int
        Which of the closest pairs, 0 for the closest.
    """

    line: Index
    place: Array
    reach: Array
    rank: Index


def closest_approaches(
    measure: Callable[[Array, Index], tuple[Array, Array]],
    place: Array,
    reach: Array,
    rank: Index,
    needed: float,
    shrinks: tuple[float, ...] = SHRINKS,
) -> tuple[Array, Array]:
    """Return where pairs of multipliers come closest near some places, and the excess there.

    Parameters
    ----------
    measure : callable
        `Plane.sample` along lines; takes coordinates and the indices of the places.
    place, reach : (K,) float
        Coordinate along each line, and half the interval in which the maximum is sought.
    rank : (K,) int
        Which of the closest pairs is followed, 0 for the closest.
    needed : float
        Least closeness at which a pair can grow; pairs that stay below are given up early.
    shrinks : tuple of float
        Half-widths of the successive parabolas, as parts of `reach`.

    Returns
    -------
    place, excess : (K,) float
        NaN where given up.
    """
    low, high = place - reach, place + reach
    centre, measured, excess = place.copy(), place.copy(), np.full_like(place, np.nan)
    live = np.arange(len(place))
    for shrink in shrinks:
        if not live.size:
            break
        step = shrink * reach[live]
        points = centre[live][:, None] + step[:, None] * np.array([-1.0, 0.0, 1.0])
        line = np.repeat(live, 3)
        value, near = measure(points.ravel(), line)
        measured[live], excess[live] = points[:, 1], value[1::3]
        height = near[np.arange(len(line)), rank[line]].reshape(-1, 3)
        top_at, top, bend = parabola_maximum(points, height)
        uphill = points[:, 1] + np.sign(height[:, 2] - height[:, 0]) * step
        moved = np.where(np.isfinite(top_at), top_at, uphill)
        moved = np.clip(moved, points[:, 0] - step, points[:, 2] + step)
        centre[live] = np.clip(moved, low[live], high[live])
        hopeless = (bend < 0) & (top + _SLACK * np.abs(bend) * step**2 < needed)
        centre[live[hopeless]] = excess[live[hopeless]] = np.nan
        live = live[~hopeless]
    if live.size:
        # the last move counts where it led higher, so that place and excess belong together
        value, _ = measure(centre[live], live)
        centre[live] = np.where(value > excess[live], centre[live], measured[live])
        excess[live] = np.maximum(value, excess[live])
    return centre, excess


def approach_candidates(x: Array, near: Array) -> Candidates:
    """Return where pairs may come closest along lines of samples.

    These are the local maxima of the closeness, and the intervals in which a pair seems to come
    and go between two samples: its detuning, nearly linear, would change sign there.

    Parameters
    ----------
    x : (L, N) float
        Rising coordinates along L lines.
    near : (L, N, R) float
        Closeness of the R closest pairs, from `Plane.sample`.
    """
    rise = np.diff(near, axis=1)
    top = np.ones(near.shape, dtype=bool)
    top[:, 1:] &= rise >= 0
    top[:, :-1] &= rise <= 0
    maxima, between = _maxima(x, near, top), _sign_changes(x, near, top)
    return Candidates._make(np.concatenate(parts) for parts in zip(maxima, between, strict=True))


def _maxima(x: Array, near: Array, top: Mask) -> Candidates:
    """Return the vertices of parabolas through the local maxima `top` and their neighbours."""
    line, at, rank = np.nonzero(top)
    # at an end the maximum may lie within the last interval
    triple = np.clip(at, 1, x.shape[1] - 2)[:, None] + np.array([-1, 0, 1])
    places, heights = x[line[:, None], triple], near[line[:, None], triple, rank[:, None]]
    place, _, _ = parabola_maximum(places, heights)
    keep = (place >= places[:, 0]) & (place <= places[:, 2])
    reach = (places[:, 2] - places[:, 0]) / 2
    return Candidates(line[keep], place[keep], reach[keep], rank[keep])


def _sign_changes(x: Array, near: Array, top: Mask) -> Candidates:
    """Return intervals in which the detuning changes sign by the slope before or after them."""
    step = np.diff(x, axis=1)[..., None]
    detuning = np.sqrt(np.maximum(-near, 0))
    middle, change = detuning[:, 1:-1], np.diff(detuning, axis=1)
    passed = np.zeros(change.shape, dtype=bool)
    # products with the steps, some of which may be 0
    later, earlier = step[:, 1:], step[:, :-1]
    passed[:, 1:] = earlier * (_PASSED * detuning[:, 2:] - middle) > later * change[:, :-1]
    passed[:, :-1] |= later * (_PASSED * detuning[:, :-2] - middle) > -earlier * change[:, 1:]
    passed &= ~(top[:, 1:] | top[:, :-1]) & (detuning[:, 1:] + detuning[:, :-1] > 0)
    line, first, rank = np.nonzero(passed)
    before, after = detuning[line, first, rank], detuning[line, first + 1, rank]
    # inside a tongue the pair at that end is another one
    part = np.where((before > 0) & (after > 0), before / (before + after), 0.5)
    width = step[line, first, 0]
    return Candidates(line, x[line, first] + part * width, width / 2, rank)
