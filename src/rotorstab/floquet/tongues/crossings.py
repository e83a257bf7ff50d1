"""The smallest load at which each frequency becomes unstable, thin tongues included."""

from __future__ import annotations

import numpy as np

from ..._numerics.roots import bracketed_roots
from ..._tolerances import EDGE
from ..._types import Array, Index
from .approaches import approach_candidates, closest_approaches
from .plane import Plane

__all__ = ["first_crossings"]

# numbers of loads sampled at one frequency, of which the first that is close enough is used
_ROWS = (10, 20, 40, 80)
_TURN = 0.15  # angle by which two multipliers may turn from one load to the next [rad]
_INSIDE = 1.02  # times a first-order threshold


def _loads(plane: Plane, frequency: Array, largest: Array, count: int) -> Array:
    """Return the loads (C, N) to sample: even rows and the first-order crossings of the table."""
    even = largest[:, None] * np.arange(count + 1) / count
    special = [
        # just above the threshold, inside the tongue
        _INSIDE * np.hypot(row.threshold, (frequency - row.centre) / (2 * row.growth_per_load))
        for row in plane.table
        if row.growth_per_load > 0
    ]
    if not special:
        return even
    crossings = np.stack(special, axis=1)
    # crossings beyond the largest load are replaced by rows between the even ones
    between = largest[:, None] * (np.arange(len(special)) + 0.5) / max(count, len(special))
    crossings = np.where(crossings < largest[:, None], crossings, between)
    return np.sort(np.concatenate([even, crossings], axis=1), axis=1)


def first_crossings(plane: Plane, frequency: Array, largest: Array) -> Array:
    """Return the smallest load at which each frequency becomes unstable, inf if none.

    Parameters
    ----------
    plane : Plane
    frequency : (C,) float
        θ̄.
    largest : (C,) float
        Largest p̄_t considered.
    """
    turn = 2 * np.pi * plane.strength * largest / frequency
    rows = np.array(_ROWS)[np.searchsorted(np.array(_ROWS[:-1]) * _TURN, turn)]
    critical = np.empty(len(frequency))
    for count in np.unique(rows):
        mine = np.flatnonzero(rows == count)
        critical[mine] = _crossings(plane, frequency[mine], largest[mine], int(count))
    return critical


def _crossings(plane: Plane, frequency: Array, largest: Array, count: int) -> Array:
    """Return what `first_crossings` does, from a given number of even rows."""
    loads = _loads(plane, frequency, largest, count)
    excess, near = plane.sample(loads, np.broadcast_to(frequency[:, None], loads.shape))
    place, height, line = _between(plane, frequency, loads, excess, near)
    critical = np.full(len(frequency), np.inf)
    inside, outside = np.full((2, len(frequency)), np.nan)
    for c in range(len(frequency)):
        mine = (line == c) & np.isfinite(height)
        at = np.concatenate([loads[c], place[mine]])
        value = np.concatenate([excess[c], height[mine]])
        order = np.argsort(at, kind="stable")
        at, value = at[order], value[order]
        unstable = np.flatnonzero(value > 0)
        if unstable.size and unstable[0] == 0:
            critical[c] = 0.0
        elif unstable.size:
            inside[c], outside[c] = at[unstable[0]], at[unstable[0] - 1]
    cross = np.flatnonzero(np.isfinite(inside))
    root = bracketed_roots(
        lambda load, i: plane.excess(load, frequency[cross[i]]), inside[cross], outside[cross], EDGE
    )
    critical[cross] = np.where(np.isfinite(root), root, inside[cross])
    return critical


def _between(
    plane: Plane, frequency: Array, loads: Array, excess: Array, near: Array
) -> tuple[Array, Array, Index]:
    """Return the loads at which pairs come closest between the sampled ones, excess and line.

    The detuning is nearly linear in the square of the load, which is the coordinate here.
    """
    square = loads**2
    found = approach_candidates(square, near)
    # what begins beyond the first unstable load does not count
    first = np.where((excess > 0).any(axis=1), (excess > 0).argmax(axis=1), -1)
    below = found.place - 0.99 * found.reach < square[found.line, first[found.line]]
    line, rank = found.line[below], found.rank[below]
    place, height = closest_approaches(
        lambda u, i: plane.sample(np.sqrt(np.maximum(u, 0)), frequency[line[i]]),
        found.place[below],
        found.reach[below],
        rank,
        plane.closeness_needed,
    )
    return np.sqrt(np.maximum(place, 0)), height, line
