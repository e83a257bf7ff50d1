"""The smallest destabilising load of a band of frequencies, over all of its tongues."""

from __future__ import annotations

import numpy as np

from ..._tolerances import SAME_POINT
from ..._types import Array
from .approaches import approach_candidates, closest_approaches
from .crossings import first_crossings
from .plane import Plane
from .thresholds import (
    Threshold,
    descended_thresholds,
    pair_reach,
    refined_thresholds,
    zoomed_threshold,
)

__all__ = ["lowest_threshold"]

Band = tuple[float, float]

_SOUGHT_ORDERS = 6  # number of k of θ̄ = |ω_i − ω_j|/k near which tongues are sought
_COLUMNS = 160  # frequencies of the check
_LEVELS = (0.1, 0.3, 1.0)  # loads of the check, as parts of the smallest one known so far
_SMALL = 0.04  # coupling over frequency below which a load hardly moves the tongues
_SAFETY = 30  # on the estimate of second-order growth
_BELOW = 1 - 1e-3  # part of the smallest load known at which the check starts
_ROUNDS = 12  # of the check, each of which finds a smaller load


def _moves_tongues_little(plane: Plane, low: float, load: float) -> bool:
    """Tell whether a load hardly moves the tongues; order k grows like (coupling/θ̄)^(k−1)."""
    return plane.strength * load < _SMALL * low


def _damping_prevents_higher_orders(plane: Plane, low: float, load: float) -> bool:
    """Tell whether only first-order tongues can overcome the damping up to a load.

    Tongues of order 2 grow at about (coupling)²/θ̄; a factor of safety is applied.
    """
    coupling = plane.strength * load
    return _SAFETY * coupling**2 < low * max(plane.decay, plane.growth_counted)


def _unstable_points(plane: Plane, band: Band, load: float) -> Array:
    """Return frequencies (K,) of a band at which the rotor is unstable at one load.

    These are the most unstable of neighbouring columns, the places near |ω_i − ω_j|/k at which two
    multipliers come closest, and at larger loads such places between any two columns.
    """
    low, high = band
    columns = np.geomspace(low, high, _COLUMNS)
    excess, near = plane.sample(np.full(_COLUMNS, load), columns)
    orders = range(1, _SOUGHT_ORDERS + 1)
    place = np.unique([row.centre / k for row in plane.table for k in orders])
    place = place[(place > 0.9 * low) & (place < 1.1 * high)]
    reach, rank = pair_reach(plane, place), np.zeros(len(place), dtype=np.intp)
    if not _moves_tongues_little(plane, low, load):
        _, middle, step, which = approach_candidates(columns[None], near[None])
        place, reach, rank = np.r_[place, middle], np.r_[reach, step], np.r_[rank, which]
    between, height = closest_approaches(
        lambda x, i: plane.sample(np.full_like(x, load), x),
        place,
        reach,
        rank,
        plane.closeness_needed,
    )
    around = np.pad(excess, 1, constant_values=-np.inf)
    peak = (excess > 0) & (excess >= around[:-2]) & (excess >= around[2:])
    points = np.concatenate([between[height > 0], columns[peak]])
    points = np.unique(points[(points >= low) & (points <= high)])
    return points[np.diff(points, prepend=0.0) > SAME_POINT * points]


def _thresholds(plane: Plane, band: Band, points: Array, load: float) -> list[Threshold]:
    """Return the thresholds of the tongues through unstable frequencies of a band at one load."""
    low, high = band
    theta, lowest = descended_thresholds(plane, points, np.full(points.shape, load))
    inside = np.isfinite(lowest) & (theta >= low) & (theta <= high)
    found = _listed(lowest[inside], theta[inside])
    # the threshold lies outside of the band, or the point belongs to no tongue
    step = (high / low) ** (1 / (_COLUMNS - 1))
    for point in points[~inside]:
        ends = max(low, point / step), min(high, point * step)
        found.append(zoomed_threshold(plane, ends, float(point), load))
    return found


def _listed(loads: Array, frequencies: Array) -> list[Threshold]:
    """Return arrays of loads and frequencies as thresholds."""
    return [Threshold(*pair) for pair in zip(loads.tolist(), frequencies.tolist(), strict=True)]


def _checked(plane: Plane, band: Band, largest: float, best: Threshold) -> Threshold:
    """Return the lowest of a threshold and of what is found below it, load by load."""
    stable = 0.0  # nothing is unstable up to this load
    for _ in range(_ROUNDS):
        if _damping_prevents_higher_orders(plane, band[0], best.load):
            break
        top = min(best.load * _BELOW, largest)
        parts = _LEVELS[-1:] if _moves_tongues_little(plane, band[0], top) else _LEVELS
        for load in (top * part for part in parts):
            if load <= stable * (1 + SAME_POINT):
                continue
            points = _unstable_points(plane, band, load)
            if points.size:
                break
            stable = load
        else:
            break
        # where no tongue can be followed, the unstable point itself is an upper bound
        best = min([*_thresholds(plane, band, points, load), Threshold(load, float(points[0]))])
    return best


def lowest_threshold(plane: Plane, band: Band, largest: float) -> Threshold:
    """Return the smallest load at which a frequency of a band is unstable, and that frequency.

    Parameters
    ----------
    plane : Plane
        With a stable mean rotor.
    band : tuple of float
        Lowest and highest θ̄.
    largest : float
        Largest p̄_t considered.
    """
    low, high = band
    best = Threshold()
    rows = [row for row in plane.table if 0 < row.threshold < 1.5 * largest and row.centre > 0]
    if rows:
        theta = np.array([row.centre for row in rows])
        load = np.array([row.threshold for row in rows])
        if plane.decays:
            theta, load = refined_thresholds(plane, theta, load)
        inside = (theta >= low) & (theta <= high) & (load <= largest)
        best = min(_listed(load[inside], theta[inside]), default=best)
    ends = np.array(band)
    crossing = first_crossings(plane, ends, np.full(2, min(best.load, largest)))
    if crossing.min() < best.load:
        best = Threshold(float(crossing.min()), float(ends[crossing.argmin()]))
    return _checked(plane, band, largest, best)
