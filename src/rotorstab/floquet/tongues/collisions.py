"""Where two multipliers pass each other between the columns of a chart, and whether they grow."""

from __future__ import annotations

from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..interpolant.characteristic import quartic_multipliers, self_inversive_multipliers
from ..interpolant.polynomial import ChartSampler
from ..point import floquet_solution

__all__ = ["SMALLEST_GROWTH", "Passes", "passes", "surely_unstable"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

SMALLEST_GROWTH = 1e-8
"""σ̄ that counts as growth [√(EI/(ρAL⁴))]."""

_FIRST, _SECOND = np.array(list(combinations(range(4), 2))).T
_RADIANS = 0.5  # by which the fastest pair moves from column to column
_REACH = 0.75  # columns: a pass farther off is nearer to the neighbour
_STEP = 1e-4  # of a column: for the derivative in T
_LEAST = 0.05  # columns between the first two points of a secant
_SHORT = 1e-5  # columns: a shorter secant is all rounding
_ROUNDS = 3
_REPELLED = 0.05  # of the squared distance: a pair whose vertex is so far below 0 does not meet
_TWIN = 0.02, 0.1  # columns and radians within which two passes are one, seen from two columns


class Passes(NamedTuple):
    """Places where two multipliers pass each other, (P,) arrays.

    Parameters
    ----------
    row : int
        Index of the load.
    period : float
        T at which the two are closest, or grow most.
    half_width : float
        Half of the range of T in which they leave the unit circle, 0 where they do not.
    """

    row: NDArray[np.intp]
    period: Array
    half_width: Array


def surely_unstable(
    sampler: ChartSampler,
    load: Array,
    period: Array,
    growth: Array,
    error: Array,
    worth: float = 3e-5,
) -> NDArray[np.bool_]:
    """Return where the rotor is unstable; points in doubt are computed one by one.

    Parameters
    ----------
    sampler : ChartSampler
    load, period, growth, error : (P,) float
        p̄_t, T, and what the sampler says of them.
    worth : float
        A doubtful growth below this counts as stable.
    """
    sure = growth > np.maximum(error, SMALLEST_GROWTH)
    doubt = np.flatnonzero(~sure & (growth > worth))
    if doubt.size:
        exact = floquet_solution(
            sampler.system, sampler.static_load, load[doubt], 2 * np.pi / period[doubt]
        )
        sure[doubt] = exact.growth_rate > np.maximum(exact.error, SMALLEST_GROWTH)
    return np.asarray(sure)


def _wrapped(angle: Array) -> Array:
    """Return angles in [−π, π]."""
    return angle - 2 * np.pi * np.round(angle / (2 * np.pi))


def _distance(log: Complex, other: Complex) -> Complex:
    """Return ln μ_i − ln μ_j with its imaginary part in [−π, π]."""
    gap = log - other
    gap.imag = _wrapped(gap.imag)
    return gap


def _motion(
    sampler: ChartSampler, functions: NDArray[Any], ahead: NDArray[Any], period: Array, step: Array
) -> tuple[Complex, Complex]:
    """Return ln μ (4, ...) and its derivative in T, less the drift that all four share.

    `functions` are the sampler's at `period`, `ahead` at `period` + `step`.
    """
    rates = (ahead - functions) / step
    if sampler.system.is_damped:
        last = np.exp(-sampler.excess * period)
        roots, *_ = quartic_multipliers(functions, last)
        last = -sampler.excess * last
        (c1, c2, c3), (d1, d2, d3) = functions, rates
    else:
        roots, last = self_inversive_multipliers(functions), np.zeros(1)
        (c1, c2, c3), (d1, d2, d3) = (
            (re + 1j * im, c2, re - 1j * im) for re, im, c2 in (functions, rates)
        )
    slope = ((4 * roots - 3 * c1) * roots + 2 * c2) * roots - c3
    return np.log(roots), ((d1 * roots - d2) * roots + d3 - last / roots) / slope


def passes(sampler: ChartSampler, panel: int, loads: Array) -> Passes:
    """Return where pairs of multipliers pass each other within one panel.

    Parameters
    ----------
    sampler : ChartSampler
        With a closed form.
    panel : int
        One with nodes in T.
    loads : (R,) float
        Rising p̄_t.

    Notes
    -----
    On columns close enough for the fastest pair, each of six pairs has a distance
    ln μ_i − ln μ_j and a rate of change. Where these say that the two meet before the next
    column, secants find the vertex of the squared distance, which is smooth through a
    collision. The pairs are told apart by their place on the circle, so that a harmless pass
    does not hide a tongue beside it. Peaks of the growth on these columns are added.
    """
    plan = sampler.panels[panel]
    frequencies = sampler.basis.frequencies.real
    fastest = float(frequencies.max() - frequencies.min())
    count = int(np.ceil(fastest * (plan.high - plan.low) / _RADIANS)) + 2
    span = np.linspace(plan.low, plan.high, count)
    width = float(span[1] - span[0])
    step = np.full(count, _STEP * width)
    step[-1] *= -1
    here, ahead = (sampler.evaluate(panel, loads, x) for x in (span, span + step))
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        log, rate = _motion(sampler, here, ahead, span, step)
        gap = _distance(log[_FIRST], log[_SECOND])
        relative = rate[_FIRST] - rate[_SECOND]
        move = -(gap * relative.conj()).real / np.abs(relative) ** 2
        at = pair, row, column = np.nonzero(np.abs(move) <= _REACH * width)
        middle = log[_SECOND][at].imag + gap[at].imag / 2
        turn = (rate[_FIRST[pair], row, column] + rate[_SECOND[pair], row, column]).imag / 2
        start = _Start(row, loads[row], span[column], middle, turn)
        found = _refined(sampler, panel, width, start, move[at], 2 * gap[at] * relative[at])
        drift = sampler.drift.imag * span if sampler.system.is_damped else 0.0
        own = _tops(log.real.max(axis=0) - drift, span)
    return Passes._make(np.concatenate(parts) for parts in zip(found, own, strict=True))


def _tops(growth: Array, span: Array) -> Passes:
    """Return peaks of σT (R, C) on the columns: a tongue may be wider than these, yet hidden."""
    width = float(span[1] - span[0])
    square = np.pad(np.maximum(np.nan_to_num(growth), 0) ** 2, ((0, 0), (1, 1)))
    before, here, after = square[:, :-2], square[:, 1:-1], square[:, 2:]
    peak = (here >= before) & (here > after) & (here > (SMALLEST_GROWTH * span) ** 2)
    row, column = np.nonzero(peak)
    before, here, after = before[peak], here[peak], after[peak]
    shift = (before - after) / (2 * (before - 2 * here + after))
    period = np.clip(span[column] + width * shift, span[0], span[-1])
    return Passes(row, period, np.full(len(row), width))


class _Start(NamedTuple):
    """Where a pair is seen: row, load, T, phase of its middle and the rate of that."""

    row: NDArray[np.intp]
    load: Array
    period: Array
    middle: Array
    turn: Array


def _refined(
    sampler: ChartSampler, panel: int, width: float, start: _Start, move: Array, slope: Array
) -> Passes:
    """Return the passes at T + `move`, refined; `slope` is that of the squared distance at T."""
    plan = sampler.panels[panel]
    least = _LEAST * width
    old = start.period
    new = old + np.where(np.abs(move) < least, np.copysign(least, move), move)
    half, bend = np.zeros((2, len(old)))
    for _ in range(_ROUNDS):
        row, load, period, middle, turn = start
        new = np.clip(
            new, np.maximum(period - width, plan.low), np.minimum(period + width, plan.high)
        )
        step = np.where(new > (plan.low + plan.high) / 2, -_STEP, _STEP) * width
        both = sampler.scattered(panel, np.tile(load, 2), np.concatenate([new, new + step]))
        here, ahead = np.split(both, 2, axis=1)
        log, rate = _motion(sampler, here, ahead, new, step)
        middle = middle + turn * (new - period)
        index = np.arange(len(new))
        # the two multipliers nearest to where the pair's middle should be
        one, two = np.argsort(np.abs(_wrapped(log.imag - middle)), axis=0)[:2]
        gap = _distance(log[one, index], log[two, index])
        square, latest = gap**2, 2 * gap * (rate[one, index] - rate[two, index])
        latest = np.where(np.isfinite(latest), latest, 0)
        # where the secants have converged the last one stays
        long = np.abs(new - old) > _SHORT * width
        bend = np.where(long, ((latest - slope) / (new - old)).real, bend)
        vertex = (square - latest**2 / (2 * bend)).real
        half = np.sqrt(np.maximum(vertex, 0) * 2 / -bend)
        old, slope, new = new, latest, new - (latest / bend).real
        keep = (vertex > -_REPELLED * np.abs(square)) & (bend < 0) & (np.abs(new - period) <= width)
        # most passes are seen from both sides
        order = np.lexsort((new, row))
        apart = np.diff(new[order]), _wrapped(np.diff(middle[order]))
        twin = (np.diff(row[order]) == 0) & (apart[0] < _TWIN[0] * width)
        keep[order[1:]] &= ~(twin & (np.abs(apart[1]) < _TWIN[1]) & keep[order[:-1]])
        start = _Start._make(part[keep] for part in start)
        old, slope, bend, new, half = (part[keep] for part in (old, slope, bend, new, half))
    return Passes(start.row, np.clip(new, plan.low, plan.high), half)
