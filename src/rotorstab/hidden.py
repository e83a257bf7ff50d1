"""Tongues narrower than a pixel: found between the columns of a chart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .floquet import floquet_solution
from .resonance import resonances
from .sampler import ChartSampler
from .system import System
from .tongues import tongue_centres

__all__ = ["hidden_by_table", "hidden_on_panel"]

Array = NDArray[np.float64]

_NEAREST = -1.0  # approach below which a pair is too far apart to meet within a column
_SHRINK = (0.5, 0.1, 0.02)  # half-widths of the parabolas, in columns
_GROWTH = 1e-8  # smallest peak that counts
_WIDE = 2.0  # columns: a wider tongue is seen by the columns themselves


def hidden_on_panel(
    sampler: ChartSampler, panel: int, loads: Array, periods: Array, approach: Array
) -> Array:
    """Return the peak growth (R, C) of tongues between the columns of one panel, 0 elsewhere.

    The approach to a collision is smooth in T, so each local maximum that stays below 0 on the
    columns is followed to its vertex on the interpolant; above 0 there, a tongue passes. Every
    order of resonance is found this way, not only those of the table.

    Parameters
    ----------
    sampler : ChartSampler
    panel : int
        One with nodes in T.
    loads, periods : (R,), (C,) float
        Rising.
    approach : (R, C) float
        From `ChartSampler.growth`, without damping.
    """
    peak = np.zeros_like(approach)
    if len(periods) < 3:
        return peak
    left, middle, right = approach[:, :-2], approach[:, 1:-1], approach[:, 2:]
    candidate = (middle < 0) & (middle >= left) & (middle > right) & (middle > _NEAREST)
    i, j = np.nonzero(candidate)
    if not i.size:
        return peak
    j = j + 1
    load, start = loads[i], periods[j]
    spacing = (periods[j + 1] - periods[j - 1]) / 2
    centre = start.copy()
    for shrink in _SHRINK:
        reach = shrink * spacing
        points = np.clip(centre + reach * np.array([[-1.0], [0.0], [1.0]]), periods[0], periods[-1])
        functions = sampler.scattered(panel, np.tile(load, 3), points.ravel())
        _, _, height = sampler.growth(panel, functions, np.tile(load, 3), points.ravel())
        low, mid, high = height.reshape(3, -1)
        bend = low - 2 * mid + high
        with np.errstate(divide="ignore", invalid="ignore"):
            shift = np.where(bend < 0, (low - high) / (2 * bend), np.sign(high - low))
        centre = centre + reach * np.clip(shift, -2, 2)
        centre = np.clip(centre, periods[j - 1], periods[j + 1])
    functions = sampler.scattered(panel, load, centre)
    growth, error, _ = sampler.growth(panel, functions, load, centre)
    found = growth > np.maximum(error, _GROWTH)
    doubt = np.flatnonzero((growth > _GROWTH) & ~found)
    if doubt.size:
        exact = floquet_solution(
            sampler.system, sampler.static_load, load[doubt], 2 * np.pi / centre[doubt]
        )
        growth[doubt] = exact.growth_rate
        found[doubt] = exact.growth_rate > np.maximum(exact.error, _GROWTH)
    i, centre, growth = i[found], centre[found], growth[found]
    # nearest in frequency, as the chart's pixels are
    column = np.abs(1 / periods[None, :] - 1 / centre[:, None]).argmin(axis=1)
    np.maximum.at(peak, (i, column), growth)
    return peak


def hidden_by_table(
    system: System, static: float, loads: Array, frequencies: Array, low: float, high: float
) -> Array:
    """Return the peak growth (R, C) of the table's tongues where they are narrow, 0 elsewhere.

    For systems without a closed form: each tongue of the resonance table is followed by single
    points from its root, between the frequencies `low` and `high`.

    Parameters
    ----------
    system : System
    static : float
    loads, frequencies : (R,), (C,) float
        Rising loads, falling frequencies.
    low, high : float
    """
    peak = np.zeros((len(loads), len(frequencies)))
    largest = float(loads[-1])
    if len(frequencies) < 2 or largest == 0:
        return peak
    pixel = np.abs(np.diff(frequencies)).max()
    rows = tuple(
        row
        for row in resonances(system, static, largest).tongues
        if low * 0.9 < row.centre < high * 1.1
        and 2 * row.growth_per_load * loads[loads > 0].min() < _WIDE * pixel
    )
    if not rows:
        return peak
    weakest = min(2 * row.growth_per_load for row in rows)
    loads = loads[weakest * loads < _WIDE * pixel]
    centres = tongue_centres(system, static, loads, rows)
    k, i = np.nonzero(np.isfinite(centres) & (centres >= low) & (centres <= high) & (loads > 0))
    if not k.size:
        return peak
    theta = centres[k, i]
    solution = floquet_solution(system, static, loads[i], theta)
    found = solution.growth_rate > np.maximum(solution.error, _GROWTH)
    column = np.abs(frequencies[None, :] - theta[:, None]).argmin(axis=1)
    np.maximum.at(peak, (i[found], column[found]), solution.growth_rate[found])
    return peak
