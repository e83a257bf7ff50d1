"""Tongues narrower than a pixel: found between the columns of a chart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .floquet import floquet_solution
from .resonance import resonances
from .sampler import ChartSampler
from .tongues import collision
from .tracking import tongue_centres

__all__ = ["hidden_by_table", "hidden_on_panel"]

Array = NDArray[np.float64]

_NEAREST = -1.5  # approach below which a pair is too far apart to meet within a column
_SHRINK = (0.5, 0.1, 0.02)  # half-widths of the parabolas, in columns
_GROWTH = 1e-8  # smallest peak that counts
_WIDE = 2.0  # columns: a wider tongue is seen by the columns themselves


def hidden_on_panel(
    sampler: ChartSampler, panel: int, loads: Array, periods: Array, approach: Array
) -> Array:
    """Return the peak growth (R, C) of tongues between columns in one panel's range, 0 elsewhere.

    The approach to a collision is smooth in T, so each local maximum that stays below 0 on the
    columns is followed to its vertex on the interpolant; above 0 there, a tongue passes. Every
    order of resonance is found this way, not only those of the table.

    Parameters
    ----------
    sampler : ChartSampler
    panel : int
        One with nodes in T.
    loads, periods : (R,), (C,) float
        Of the whole chart, rising.
    approach : (R, C) float
        Of the whole chart, from `ChartSampler.growth`, without damping.
    """
    peak = np.zeros_like(approach)
    plan = sampler.panels[panel]
    first, last = plan.columns.start, min(plan.columns.stop + 1, len(periods))
    middle = approach[:, first:last]
    left, right = (
        np.pad(approach, ((0, 0), (1, 1)), constant_values=-np.inf)[:, first + s : last + s]
        for s in (0, 2)
    )
    # a column on a panel's border is looked at from both sides
    candidate = (middle < 0) & (middle >= left) & (middle >= right) & (middle > _NEAREST)
    i, j = np.nonzero(candidate)
    if not i.size or plan.high == plan.low:
        return peak
    j = j + first
    load, start = loads[i], periods[j]
    before = np.maximum(periods[np.maximum(j - 1, 0)], plan.low)
    after = np.minimum(periods[np.minimum(j + 1, len(periods) - 1)], plan.high)
    spacing = (after - before) / 2
    centre = start.copy()
    for shrink in _SHRINK:
        reach = shrink * spacing
        points = np.clip(centre + reach * np.array([[-1.0], [0.0], [1.0]]), plan.low, plan.high)
        _, _, height = sampler.at_points(panel, np.tile(load, 3), points.ravel(), nearness=True)
        low, mid, high = height.reshape(3, -1)
        bend = low - 2 * mid + high
        with np.errstate(divide="ignore", invalid="ignore"):
            shift = np.where(bend < 0, (low - high) / (2 * bend), np.sign(high - low))
        centre = centre + reach * np.clip(shift, -2, 2)
        centre = np.clip(centre, before, after)
    growth, error, _ = sampler.at_points(panel, load, centre)
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


def hidden_by_table(sampler: ChartSampler, loads: Array, frequencies: Array) -> Array:
    """Return the peak growth (R, C) of the resonance table's tongues where narrow, 0 elsewhere.

    Each tongue is followed from its root, on the interpolant where there is one.

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
    centres = tongue_centres(lambda load, theta: _measure(sampler, load, theta), loads[some], rows)
    narrow = np.array([2 * row.growth_per_load for row in rows])[:, None] * loads[some]
    k, i = np.nonzero(np.isfinite(centres) & (narrow < _WIDE * pixel))
    theta, load = centres[k, i], loads[some][i]
    inside = (theta < frequencies[0] + pixel / 2) & (theta > frequencies[-1] - pixel / 2)
    theta, load, i = theta[inside], load[inside], some[i[inside]]
    if not theta.size:
        return peak
    solution = floquet_solution(system, static, load, theta)
    found = solution.growth_rate > np.maximum(solution.error, _GROWTH)
    column = np.abs(frequencies[None, :] - theta[:, None]).argmin(axis=1)
    np.maximum.at(peak, (i[found], column[found]), solution.growth_rate[found])
    return peak


def _measure(sampler: ChartSampler, load: Array, theta: Array) -> Array:
    """Return how close two multipliers are, from the interpolant where there is one."""
    periods, loads = (2 * np.pi / theta).ravel(), load.ravel()
    height = np.full(periods.shape, np.nan)
    if sampler.closed_form and not sampler.system.is_damped:
        for index, plan in enumerate(sampler.panels):
            here = (periods >= plan.low) & (periods <= plan.high)
            if plan.period_nodes and here.any():
                _, _, near = sampler.at_points(index, loads[here], periods[here], nearness=True)
                # cos Δψ − 1 to −(Δψ/2)², the scale of single points
                height[here] = near / 2
    rest = np.isnan(height)
    if rest.any():
        height[rest], _ = collision(
            sampler.system, sampler.static_load, loads[rest], 2 * np.pi / periods[rest]
        )
    return height.reshape(theta.shape)
