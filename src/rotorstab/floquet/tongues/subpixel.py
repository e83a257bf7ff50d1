"""Growth in tongues that are narrower than a pixel, which the columns of a chart miss."""

from __future__ import annotations

from functools import partial

import numpy as np

from ..._tolerances import VISIBLE_GROWTH
from ..._types import Array, Index
from ..interpolant.chart_interpolant import ChartInterpolant
from ..point import floquet_solution
from ..resonance import resonances
from ..resonance_table import Resonance
from .collision_measure import pair_closeness
from .collisions import multiplier_collisions, surely_unstable
from .tracking import tongue_centres

__all__ = ["growth_of_collisions", "growth_of_table"]

_WIDE = 2.0  # columns: the columns themselves see a wider tongue
_BEYOND = 0.8, 1.2  # of the lowest and highest θ̄: tongues that may drift into the chart


def growth_of_collisions(
    interpolant: ChartInterpolant, panel: int, loads: Array, periods: Array
) -> Array:
    """Return the peak growth (R, C) of tongues in the range of one panel, 0 elsewhere.

    Every collision of two multipliers is examined, so tongues of every order of resonance are found
    if they grow faster than 1e-4, and most of those that grow faster than 1e-6.

    Parameters
    ----------
    interpolant : ChartInterpolant
        With a closed form.
    panel : int
        Index of a panel that has nodes in T.
    loads, periods : (R,), (C,) float
        Those of the whole chart, in rising order.
    """
    peak = np.zeros((len(loads), len(periods)))
    row, period, _ = multiplier_collisions(interpolant, panel, loads)
    growth, error, _ = interpolant.at_points(panel, loads[row], period, with_approach=True)
    found = surely_unstable(interpolant, loads[row], period, growth, error, VISIBLE_GROWTH)
    row, period, growth = row[found], period[found], growth[found]
    # the column nearest in frequency, as the pixels of the chart are
    column = np.abs(1 / periods[None, :] - 1 / period[:, None]).argmin(axis=1)
    np.maximum.at(peak, (row, column), growth)
    return peak


def growth_of_table(interpolant: ChartInterpolant, loads: Array, frequencies: Array) -> Array:
    """Return the peak growth (R, C) of narrow tongues of the resonance table, 0 elsewhere.

    Each tongue is followed from its root. This is for systems without a closed form.

    Parameters
    ----------
    interpolant : ChartInterpolant
    loads, frequencies : (R,), (C,) float
        Rising loads, falling frequencies.
    """
    system, static = interpolant.system, interpolant.static_load
    peak = np.zeros((len(loads), len(frequencies)))
    largest = float(loads[-1])
    if len(frequencies) < 2 or largest == 0:
        return peak
    pixel = float(np.abs(np.diff(frequencies)).max())
    low, high = _BEYOND[0] * frequencies[-1], _BEYOND[1] * frequencies[0]
    tongues = resonances(system, static, largest).tongues
    theta, i = _narrow_centres(
        interpolant, loads, tuple(row for row in tongues if low < row.centre < high), _WIDE * pixel
    )
    inside = (theta < frequencies[0] + pixel / 2) & (theta > frequencies[-1] - pixel / 2)
    theta, i = theta[inside], i[inside]
    if not theta.size:
        return peak
    solution = floquet_solution(system, static, loads[i], theta)
    found = solution.unstable
    column = np.abs(frequencies[None, :] - theta[:, None]).argmin(axis=1)
    np.maximum.at(peak, (i[found], column[found]), solution.growth_rate[found])
    return peak


def _narrow_centres(
    interpolant: ChartInterpolant, loads: Array, rows: tuple[Resonance, ...], width: float
) -> tuple[Array, Index]:
    """Return θ̄ and row of the centres of tongues where they are narrower than a width."""
    nothing = np.empty(0), np.empty(0, dtype=np.intp)
    if not rows:
        return nothing
    strength = np.array([2 * row.growth_per_load for row in rows])
    some = np.flatnonzero((loads > 0) & (strength.min() * loads < width))
    if not some.size:
        return nothing
    centres = tongue_centres(partial(_closeness, interpolant), loads[some], rows)
    k, i = np.nonzero(np.isfinite(centres) & (strength[:, None] * loads[some] < width))
    return centres[k, i], some[i]


def _closeness(interpolant: ChartInterpolant, load: Array, theta: Array) -> Array:
    """Return the `pair_closeness` of the closest pair, to the accuracy of the chart.

    That is enough for the centre of a tongue, whose growth is then computed point by point.
    """
    mu = interpolant.single_multipliers(load.ravel(), 2 * np.pi / theta.ravel())
    return np.asarray(pair_closeness(mu).max(axis=-1).reshape(theta.shape))
