"""Tongues narrower than a pixel: found between the columns of a chart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..interpolant.polynomial import ChartSampler
from ..point import floquet_solution
from ..resonance import resonances
from .collisions import SMALLEST_GROWTH, passes, surely_unstable
from .edges import collision
from .tracking import tongue_centres

__all__ = ["hidden_by_table", "hidden_on_panel"]

Array = NDArray[np.float64]

_WORTH = 1e-6  # σ̄ of a peak that is computed again where in doubt
_WIDE = 2.0  # columns: a wider tongue is seen by the columns themselves


def hidden_on_panel(sampler: ChartSampler, panel: int, loads: Array, periods: Array) -> Array:
    """Return the peak growth (R, C) of tongues in one panel's range, 0 elsewhere.

    Every pass of two multipliers is looked at (`passing.passes`), so every order of resonance
    is found, not only those of the table, if it grows faster than 1e-4; slower ones, down to
    1e-6, mostly.

    Parameters
    ----------
    sampler : ChartSampler
        With a closed form.
    panel : int
        One with nodes in T.
    loads, periods : (R,), (C,) float
        Of the whole chart, rising.
    """
    peak = np.zeros((len(loads), len(periods)))
    row, period, _ = passes(sampler, panel, loads)
    growth, error, _ = sampler.at_points(panel, loads[row], period, nearness=True)
    found = surely_unstable(sampler, loads[row], period, growth, error, _WORTH)
    row, period, growth = row[found], period[found], growth[found]
    # nearest in frequency, as the chart's pixels are
    column = np.abs(1 / periods[None, :] - 1 / period[:, None]).argmin(axis=1)
    np.maximum.at(peak, (row, column), growth)
    return peak


def hidden_by_table(sampler: ChartSampler, loads: Array, frequencies: Array) -> Array:
    """Return the peak growth (R, C) of the resonance table's tongues where narrow, 0 elsewhere.

    Each tongue is followed from its root: for systems without a closed form.

    Parameters
    ----------
    sampler : ChartSampler
    loads, frequencies : (R,), (C,) float
        Rising loads, falling frequencies.
    """
    system, static = sampler.system, sampler.static_load
    peak = np.zeros((len(loads), len(frequencies)))
    largest = float(loads[-1])
    if len(frequencies) < 2 or largest == 0:
        return peak
    pixel = float(np.abs(np.diff(frequencies)).max())
    rows = tuple(
        row
        for row in resonances(system, static, largest).tongues
        if 0.8 * frequencies[-1] < row.centre < 1.2 * frequencies[0]
    )
    if not rows:
        return peak
    weakest = min(row.growth_per_load for row in rows)
    some = np.flatnonzero((loads > 0) & (2 * weakest * loads < _WIDE * pixel))
    if not some.size:
        return peak
    centres = tongue_centres(
        lambda load, theta: collision(system, static, load, theta)[0], loads[some], rows
    )
    narrow = np.array([2 * row.growth_per_load for row in rows])[:, None] * loads[some]
    k, i = np.nonzero(np.isfinite(centres) & (narrow < _WIDE * pixel))
    theta, load = centres[k, i], loads[some][i]
    inside = (theta < frequencies[0] + pixel / 2) & (theta > frequencies[-1] - pixel / 2)
    theta, load, i = theta[inside], load[inside], some[i[inside]]
    if not theta.size:
        return peak
    solution = floquet_solution(system, static, load, theta)
    found = solution.growth_rate > np.maximum(solution.error, SMALLEST_GROWTH)
    column = np.abs(frequencies[None, :] - theta[:, None]).argmin(axis=1)
    np.maximum.at(peak, (i[found], column[found]), solution.growth_rate[found])
    return peak
