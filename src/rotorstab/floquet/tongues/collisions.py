"""Collisions of two multipliers between the columns of a chart, and whether they grow there.

As θ̄ varies, multipliers move along the unit circle and meet. Two that repel each other (of opposite
Krein signature) collide and leave the circle, and the rotor is unstable until they return; two of
the same signature pass. Every meeting is found here; `surely_unstable` tells which of them grow.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np

from ..._numerics.angles import wrapped
from ..._numerics.parabola import parabola_maximum
from ..._types import AnyArray, Array, Complex, Index, Mask
from ..criterion import is_unstable
from ..interpolant.characteristic import quartic_multipliers, self_inversive_multipliers
from ..interpolant.chart_interpolant import ChartInterpolant
from ..point import floquet_solution

__all__ = ["Collisions", "multiplier_collisions", "surely_unstable"]

_FIRST, _SECOND = np.array(list(combinations(range(4), 2))).T
_RADIANS = 0.5  # by which the fastest pair moves from column to column
_REACH = 0.75  # columns: a meeting farther off is nearer to the neighbouring column
_STEP = 1e-4  # of a column: for the derivative in T
_LEAST = 0.05  # columns between the first two points of a secant
_SHORT = 1e-5  # columns: a shorter secant is all rounding
_ROUNDS = 3
_REPELLED = 0.05  # of the squared distance: a pair whose maximum is so far below 0 does not meet
# columns and radians within which two meetings are one, seen from two columns
_TWIN = 0.02, 0.1


class Collisions(NamedTuple):
    """Places where two multipliers meet, (P,) arrays.

    Parameters
    ----------
    row : int
        Index of the load.
    period : float
        T at which the two are closest, or grow most.
    half_width : float
        Half of the range of T in which they leave the unit circle; 0 where they pass.
    """

    row: Index
    period: Array
    half_width: Array


def surely_unstable(
    interpolant: ChartInterpolant,
    load: Array,
    period: Array,
    growth: Array,
    error: Array,
    worth: float,
) -> Mask:
    """Return at which points (P,) the rotor is unstable; doubtful points are solved one by one.

    Parameters
    ----------
    interpolant : ChartInterpolant
    load, period, growth, error : (P,) float
        p̄_t, T, and the interpolated growth rates with their errors.
    worth : float
        A doubtful growth rate below this counts as stable, without a solution.
    """
    sure = is_unstable(growth, error)
    doubt = np.flatnonzero(~sure & (growth > worth))
    if doubt.size:
        sure[doubt] = floquet_solution(
            interpolant.system, interpolant.static_load, load[doubt], 2 * np.pi / period[doubt]
        ).unstable
    return sure


def _distance(log: Complex, other: Complex) -> Complex:
    """Return ln μ_i − ln μ_j with its imaginary part in [−π, π]."""
    gap = log - other
    gap.imag = wrapped(gap.imag)
    return gap


def _motion(
    interpolant: ChartInterpolant, here: AnyArray, ahead: AnyArray, period: Array, step: Array
) -> tuple[Complex, Complex]:
    """Return ln μ (4, ...) and its derivative in T, less the drift that all four share.

    `here` are the interpolated functions at `period`, `ahead` those at `period` + `step`.
    """
    rates = (ahead - here) / step
    if not interpolant.system.is_reversible:
        excess = interpolant.sampler.excess
        last = np.exp(-excess * period)
        roots, *_ = quartic_multipliers(here[:3], last)
        last = -excess * last
        (c1, c2, c3), (d1, d2, d3) = here[:3], rates[:3]
    else:
        roots, last = self_inversive_multipliers(here), np.zeros(1)
        (c1, c2, c3), (d1, d2, d3) = (
            (re + 1j * im, c2, re - 1j * im) for re, im, c2 in (here, rates)
        )
    slope = ((4 * roots - 3 * c1) * roots + 2 * c2) * roots - c3
    return np.log(roots), ((d1 * roots - d2) * roots + d3 - last / roots) / slope


def multiplier_collisions(interpolant: ChartInterpolant, panel: int, loads: Array) -> Collisions:
    """Return where pairs of multipliers meet within one panel.

    Parameters
    ----------
    interpolant : ChartInterpolant
        With a closed form.
    panel : int
        Index of a panel that has nodes in T.
    loads : (R,) float
        p̄_t in rising order.

    Notes
    -----
    On columns that are close enough for the fastest pair, each of the six pairs has a distance
    ln μ_i − ln μ_j and its rate of change. Where these say that the two meet before the next
    column, secants find the maximum of the squared distance, which is smooth through a collision.
    The pairs are distinguished by their place on the circle, so that two multipliers that pass do
    not hide a tongue near them. Peaks of the growth on these columns are added.
    """
    plan, sampler = interpolant.panels[panel], interpolant.sampler
    frequencies = sampler.basis.frequencies[sampler.whirls].real
    fastest = float(frequencies.max() - frequencies.min())
    count = int(np.ceil(fastest * (plan.high - plan.low) / _RADIANS)) + 2
    span = np.linspace(plan.low, plan.high, count)
    width = float(span[1] - span[0])
    step = np.full(count, _STEP * width)
    step[-1] *= -1
    here, ahead = (interpolant.evaluate(panel, loads, x) for x in (span, span + step))
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        log, rate = _motion(interpolant, here, ahead, span, step)
        gap = _distance(log[_FIRST], log[_SECOND])
        relative = rate[_FIRST] - rate[_SECOND]
        move = -(gap * relative.conj()).real / np.abs(relative) ** 2
        at = pair, row, column = np.nonzero(np.abs(move) <= _REACH * width)
        middle = log[_SECOND][at].imag + gap[at].imag / 2
        turn = (rate[_FIRST[pair], row, column] + rate[_SECOND[pair], row, column]).imag / 2
        seen = _Seen(row, loads[row], span[column], middle, turn)
        found = _refined(interpolant, panel, width, seen, move[at], 2 * gap[at] * relative[at])
        shift = sampler.mean_growth(here, span) if interpolant.system.is_damped else 0.0
        peaks = _growth_peaks(log.real.max(axis=0) + shift, span)
    return Collisions._make(np.concatenate(parts) for parts in zip(found, peaks, strict=True))


def _growth_peaks(growth: Array, span: Array) -> Collisions:
    """Return peaks of σT (R, C) on the columns of `span`.

    A tongue may be wider than these columns and still narrower than those of the chart.
    """
    width = float(span[1] - span[0])
    square = np.pad(np.maximum(np.nan_to_num(growth), 0) ** 2, ((0, 0), (1, 1)))
    three = np.stack([square[:, :-2], square[:, 1:-1], square[:, 2:]], axis=-1)
    before, here, after = np.moveaxis(three, -1, 0)
    peak = (here >= before) & (here > after) & is_unstable(growth / span, 0.0)
    row, column = np.nonzero(peak)
    shift, *_ = parabola_maximum(np.array([-1.0, 0.0, 1.0]), three[peak])
    period = np.clip(span[column] + width * shift, span[0], span[-1])
    return Collisions(row, period, np.full(len(row), width))


class _Seen(NamedTuple):
    """Pairs as seen from a column: row, load, T, phase of the pair's middle and its rate."""

    row: Index
    load: Array
    period: Array
    middle: Array
    turn: Array


class _Secant(NamedTuple):
    """Secants of the derivative of the squared distance of pairs.

    `old` and `new` are T of the last point and of the next one, `slope` the derivative at `old`,
    `bend` the last slope of the secant, and `half_width` that of the parabola above 0.
    """

    old: Array
    new: Array
    slope: Complex
    bend: Array
    half_width: Array

    def advanced(self, latest: Complex, square: Complex, width: float) -> tuple[_Secant, Array]:
        """Return the secants with a further point, and the maxima of the squared distances.

        `latest` and `square` are derivative and squared distance at the point `new`.
        """
        latest = np.where(np.isfinite(latest), latest, 0)
        # where a secant has converged its last slope is kept
        long = np.abs(self.new - self.old) > _SHORT * width
        bend = np.where(long, ((latest - self.slope) / (self.new - self.old)).real, self.bend)
        top = (square - latest**2 / (2 * bend)).real
        half_width = np.sqrt(np.maximum(top, 0) * 2 / -bend)
        moved = self.new - (latest / bend).real
        return _Secant(self.new, moved, latest, bend, half_width), top


def _refined(
    interpolant: ChartInterpolant,
    panel: int,
    width: float,
    seen: _Seen,
    move: Array,
    slope: Complex,
) -> Collisions:
    """Return the meetings at T + `move`, refined; `slope` is that of the squared distance at T."""
    plan = interpolant.panels[panel]
    least = _LEAST * width
    first = seen.period + np.where(np.abs(move) < least, np.copysign(least, move), move)
    unknown = np.zeros_like(first)
    secant = _Secant(seen.period, first, slope, unknown, unknown)
    for _ in range(_ROUNDS):
        row, load, period, middle, turn = seen
        new = np.clip(
            secant.new, np.maximum(period - width, plan.low), np.minimum(period + width, plan.high)
        )
        step = np.where(new > (plan.low + plan.high) / 2, -_STEP, _STEP) * width
        both = interpolant.scattered(panel, np.tile(load, 2), np.concatenate([new, new + step]))
        here, ahead = np.split(both, 2, axis=1)
        log, rate = _motion(interpolant, here, ahead, new, step)
        middle = middle + turn * (new - period)
        index = np.arange(len(new))
        # the two multipliers that are nearest to where the middle of the pair should be
        one, two = np.argsort(np.abs(wrapped(log.imag - middle)), axis=0)[:2]
        gap = _distance(log[one, index], log[two, index])
        square, latest = gap**2, 2 * gap * (rate[one, index] - rate[two, index])
        secant, top = secant._replace(new=new).advanced(latest, square, width)
        keep = (top > -_REPELLED * np.abs(square)) & (secant.bend < 0)
        keep &= np.abs(secant.new - period) <= width
        keep &= ~_seen_twice(row, secant.new, middle, width, keep)
        seen = _Seen._make(part[keep] for part in seen)
        secant = _Secant._make(part[keep] for part in secant)
    return Collisions(seen.row, np.clip(secant.new, plan.low, plan.high), secant.half_width)


def _seen_twice(row: Index, period: Array, middle: Array, width: float, keep: Mask) -> Mask:
    """Return which meetings repeat a kept one of their row, for most are seen from both sides."""
    order = np.lexsort((period, row))
    twin = (np.diff(row[order]) == 0) & (np.diff(period[order]) < _TWIN[0] * width)
    twin &= np.abs(wrapped(np.diff(middle[order]))) < _TWIN[1]
    repeated = np.zeros(len(row), dtype=np.bool_)
    repeated[order[1:]] = twin & keep[order[:-1]]
    return repeated
