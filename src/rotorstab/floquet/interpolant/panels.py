"""Where to sample the characteristic polynomial of a whole chart.

Its coefficients are entire functions of the period T and of p̄_t² (a change of sign of p̄_t only
shifts time by half a period), so a few Chebyshev nodes carry a chart of any size. On an axis even
in θ̄ the long periods are few, but they cost most; they are sampled column by column.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import lgamma, log

import numpy as np

from ..._types import Array

__all__ = ["Panel", "load_nodes", "plan_panels"]

_CALL_OVERHEAD = 80  # nodes whose work takes as long as the overhead of NumPy's calls
_MARGIN = 6.5  # nodes past the turning point of a Bessel function, in its cube root: for 1e-8
_FALL = 4.3  # √ln 1e8
_CUTS_PER_OCTAVE = 1
_MOST_LOAD_NODES = 60


@dataclass(frozen=True)
class Panel:
    """A range of periods sampled together.

    Parameters
    ----------
    columns : slice
        Columns of the chart, in rising order of their period, that lie in the panel.
    low, high : float
        Range of T; `high` is the first column of the next panel.
    period_nodes : int
        Number of Chebyshev nodes in T; 0 where each column is sampled itself.
    load_nodes : int
        Number of Chebyshev nodes in the load.
    steps : int
        Common factor of the step counts of the extrapolation.
    """

    columns: slice
    low: float
    high: float
    period_nodes: int
    load_nodes: int
    steps: int

    @property
    def work(self) -> float:
        """Work of sampling the panel: nodes times steps, with NumPy's overhead."""
        sampled = self.period_nodes or self.columns.stop - self.columns.start
        return (sampled * self.load_nodes + _CALL_OVERHEAD) * self.steps


def load_nodes(phase: float, tolerance: float, even: bool) -> int:
    """Return how many Chebyshev nodes in the load resolve a change of phase by `phase` radians.

    The coefficients fall like those of cos: (phase/4)^{2k}/(2k)! in p̄_t² if the function is
    even, (phase/8)^k/k! in p̄_t if not.
    """
    argument, stride = (phase / 4, 2) if even else (phase / 8, 1)
    count = 2
    while count < _MOST_LOAD_NODES:
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
    least_steps: int = 1,
) -> tuple[Panel, ...]:
    """Return the cheapest division of the sorted periods into panels, at octaves of T.

    Parameters
    ----------
    periods : (C,) float
        Periods of the columns in rising order.
    bandwidth : float
        Largest frequency of the functions to interpolate, as functions of T.
    decay : float
        Their fastest decay rate less the slowest.
    swing : float
        Phase per unit period that the largest load adds.
    rate : float
        Steps per unit period, as a multiple of the step counts of the extrapolation.
    density : float
        1 for the tuned numbers of nodes, less for a coarse, faster chart. Below 1 the numbers of
        nodes fall only with its square root, for the interpolation error rises exponentially.
    tolerance : float
        Interpolation error aimed at.
    even : bool
        Whether the functions are even in the load.
    resolve : float
        Period up to which panels must be interpolable between columns.
    least_steps : int
        Smallest common factor of the step counts: the highest harmonic of the load.

    Returns
    -------
    tuple of Panel
        In rising order of T.
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
        # up to the first column of the next panel, so that no gap is left between panels
        low, high, loads = ends[start], ends[stop], across[stop]
        nodes = int(np.ceil(density * _period_nodes(bandwidth, decay, high - low)))
        columns = stop - start
        steps = max(least_steps, int(np.ceil(rate * high)))
        if columns <= nodes and low >= resolve:
            nodes = 0
        made = Panel(slice(start, stop), low, high, nodes, loads, steps)
        return made.work, made

    # dynamic programming: the cheapest panels up to each cut
    best: list[tuple[float, tuple[Panel, ...]]] = [(0.0, ())]
    for j in range(1, len(cuts)):
        options = []
        for i in range(j):
            cost, made = panel(cuts[i], cuts[j])
            options.append((best[i][0] + cost, (*best[i][1], made)))
        best.append(min(options, key=lambda option: option[0]))
    return best[-1][1]
