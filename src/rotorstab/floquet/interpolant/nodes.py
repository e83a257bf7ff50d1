"""Where to sample the characteristic polynomial of a whole chart, and how to interpolate it.

Its coefficients are entire functions of the period T and of p̄_t² (a change of sign of p̄_t
only shifts time by half a period), so a few Chebyshev nodes carry a chart of any size. Long
periods are few on an axis even in θ̄ but cost most; they are sampled column by column.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import lgamma, log

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Panel",
    "chebyshev_nodes",
    "chebyshev_transform",
    "chebyshev_values",
    "load_nodes",
    "plan_panels",
]

Array = NDArray[np.float64]

_CALL_OVERHEAD = 80  # nodes whose work equals NumPy's overhead of a call
_MARGIN = 6.5  # nodes past the turning point of a Bessel function, for 1e-8
_FALL = 4.3  # √ln 1e8
_CUTS_PER_OCTAVE = 1


@dataclass(frozen=True)
class Panel:
    """A range of periods sampled together.

    Parameters
    ----------
    columns : slice
        Of the chart's columns sorted by period.
    low, high : float
        Range of T; `high` is the next panel's first column.
    period_nodes : int
        Chebyshev nodes in T, or 0 to sample each column itself.
    load_nodes : int
        Chebyshev nodes in the load.
    steps : int
        Common factor of the step counts of the levels.
    """

    columns: slice
    low: float
    high: float
    period_nodes: int
    load_nodes: int
    steps: int

    @property
    def work(self) -> float:
        """Nodes times steps, NumPy's overhead included: what sampling it takes."""
        sampled = self.period_nodes or self.columns.stop - self.columns.start
        return (sampled * self.load_nodes + _CALL_OVERHEAD) * self.steps


@cache
def chebyshev_transform(count: int) -> Array:
    """Return the matrix from values at `count` Chebyshev nodes (cos) to coefficients."""
    angle = (np.arange(count) + 0.5) * np.pi / count
    matrix = np.cos(np.outer(np.arange(count), angle)) * (2 / count)
    matrix[0] /= 2
    matrix.flags.writeable = False
    return np.asarray(matrix)


def chebyshev_nodes(count: int, low: float, high: float) -> Array:
    """Return the Chebyshev–Gauss nodes of [low, high], falling."""
    angle = (np.arange(count) + 0.5) * np.pi / count
    return np.asarray((low + high) / 2 + (high - low) / 2 * np.cos(angle))


def chebyshev_values(points: Array, low: float, high: float, count: int) -> Array:
    """Return T_0 … T_{count−1} at points of [low, high], (..., count)."""
    width = high - low
    x = (2 * points - low - high) / width if width > 0 else np.zeros_like(points)
    x = np.clip(x, -1, 1)
    values = np.empty((count, *x.shape))
    values[0] = 1
    values[1:2] = x
    twice = 2 * x
    # the recurrence is stable here, and cheaper than cosines
    for k in range(2, count):
        np.multiply(twice, values[k - 1], out=values[k])
        values[k] -= values[k - 2]
    return np.moveaxis(values, 0, -1)


def load_nodes(phase: float, tolerance: float, even: bool) -> int:
    """Return how many Chebyshev nodes in the load resolve a swing of `phase` radians.

    The coefficients fall like those of cos: (phase/4)^{2k}/(2k)! in p̄_t² if the function is
    even, (phase/8)^k/k! in p̄_t if not.
    """
    argument, stride = (phase / 4, 2) if even else (phase / 8, 1)
    count = 2
    while count < 60:
        order = stride * count
        if order * log(max(argument, 1e-9)) - lgamma(order + 1) < log(tolerance):
            break
        count += 1
    return count + 1


def _period_nodes(bandwidth: float, decay: float, length: float) -> int:
    """Return how many Chebyshev nodes in T resolve e^{jωT}, |Re ω| ≤ bandwidth, over a length.

    The coefficients of e^{−aT}, 0 ≤ a ≤ decay, fall like exp(−k²/(a length)).
    """
    turning = bandwidth * length / 2
    waves = turning + _MARGIN * turning ** (1 / 3)
    return int(np.ceil(max(waves, _FALL * np.sqrt(decay * length)) + 4))


def plan_panels(
    periods: Array,
    *,
    bandwidth: float,
    decay: float,
    swing: float,
    rate: float,
    density: float,
    tolerance: float,
    even: bool,
    resolve: float = 0.0,
) -> tuple[Panel, ...]:
    """Return the cheapest cut of the sorted periods into panels, at octaves of T.

    Parameters
    ----------
    periods : (C,) float
        Rising.
    bandwidth : float
        Largest frequency of the functions to interpolate, as functions of T.
    decay : float
        Their fastest decay, above that of the slowest.
    swing : float
        Phase per unit period that the largest load adds.
    rate : float
        Steps per unit period, as multiples of the extrapolation's levels.
    density : float
        1 for the tuned numbers of nodes, less for a coarse, faster chart. Below 1 they fall with
        its square root only: the error of the interpolation rises exponentially.
    tolerance : float
        Wanted interpolation error.
    even : bool
        Whether the functions are even in the load.
    resolve : float
        Period up to which panels must be interpolable between columns.

    Returns
    -------
    tuple of Panel
        Rising in T.
    """
    octave = np.floor(np.log2(periods[-1] / periods) * _CUTS_PER_OCTAVE)
    cuts = [0, *(np.flatnonzero(np.diff(octave)) + 1).tolist(), len(periods)]
    ends = {stop: float(periods[min(stop, len(periods) - 1)]) for stop in cuts}
    density = max(density, density**0.5)
    across = {
        stop: max(3, int(np.ceil(density * load_nodes(swing * high, tolerance, even))))
        for stop, high in ends.items()
    }

    def panel(start: int, stop: int) -> tuple[float, Panel]:
        # up to the next panel's first column, to leave no gap between panels
        low, high, loads = ends[start], ends[stop], across[stop]
        nodes = int(np.ceil(density * _period_nodes(bandwidth, decay, high - low)))
        columns = stop - start
        steps = max(1, int(np.ceil(rate * high)))
        if columns <= nodes and low >= resolve:
            nodes = 0
        made = Panel(slice(start, stop), low, high, nodes, loads, steps)
        return made.work, made

    # dynamic programming over the cuts
    best: list[tuple[float, tuple[Panel, ...]]] = [(0.0, ())]
    for j in range(1, len(cuts)):
        options = []
        for i in range(j):
            cost, made = panel(cuts[i], cuts[j])
            options.append((best[i][0] + cost, (*best[i][1], made)))
        best.append(min(options, key=lambda option: option[0]))
    return best[-1][1]
