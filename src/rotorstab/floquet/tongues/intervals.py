"""Unstable intervals of θ̄, row by row of loads, refined on the interpolated polynomial."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.system import System
from ..interpolant.polynomial import ChartSampler
from .collisions import SMALLEST_GROWTH, passes, surely_unstable
from .edges import bracketed_roots

__all__ = ["Interval", "unstable_intervals"]

Array = NDArray[np.float64]
Runs = tuple[NDArray[np.intp], Array, Array]

_PER_OCTAVE = (220, 110)  # columns, even in T: in the upper four octaves, below
_DENSITY = 1.4  # of nodes and steps: the edges of narrow tongues ask for more than a map
_TOUCH = 1e-12
_EDGE = 1e-7  # of T
_NARROW = 1e-5  # of T: half-width below which the parabola's edges are right to 1e-6
_BRACKETS = ((0.98, 1.02), (0.0, 1.5), (0.0, np.inf))  # half-widths about an edge


class Interval(NamedTuple):
    """An interval of θ̄."""

    left: float
    right: float

    @property
    def centre(self) -> float:
        """Its middle."""
        return (self.left + self.right) / 2


def _columns(low: float, high: float) -> Array:
    """Return periods, rising, even within each octave."""
    shortest, longest = 2 * np.pi / high, 2 * np.pi / low
    octaves = max(1, int(np.ceil(np.log2(longest / shortest))))
    cuts = shortest * (longest / shortest) ** (np.arange(octaves + 1) / octaves)
    parts = [
        np.linspace(a, b, _PER_OCTAVE[k >= 4], endpoint=False)
        for k, (a, b) in enumerate(pairwise(cuts.tolist()))
    ]
    return np.append(np.concatenate(parts), longest)


def unstable_intervals(
    system: System, static: float, loads: Array, low: float, high: float
) -> list[list[Interval]]:
    """Return the unstable intervals of θ̄ of each row, from left to right.

    None where growth or decay within a period leaves double precision: nothing is sure there.
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return _unstable_intervals(system, static, loads, low, high)


def _unstable_intervals(
    system: System, static: float, loads: Array, low: float, high: float
) -> list[list[Interval]]:
    periods = _columns(low, high)
    sampler = ChartSampler(system, static, float(loads[-1]), periods, _DENSITY, resolve=np.inf)
    edges: list[Runs] = []
    for index, panel in enumerate(sampler.panels):
        # up to the next panel's first column, so that they meet
        span = periods[panel.columns.start : panel.columns.stop + 1]
        error = sampler.coefficient_error(index, loads[:, None], span)
        growth, error, approach = sampler.growth(
            sampler.evaluate(index, loads, span), error, span, nearness=True
        )
        unstable = growth > np.maximum(error, SMALLEST_GROWTH)
        within = growth > 0 if system.is_damped else unstable | (approach > 0)
        wide = _crossings(sampler, index, loads, span, growth, error, within)
        edges += [wide, _peaks(sampler, index, loads, span, wide)]
    row, start, stop = (np.concatenate(parts) for parts in zip(*edges, strict=True))
    return [
        _joined(np.column_stack([2 * np.pi / stop[row == r], 2 * np.pi / start[row == r]]))
        for r in range(len(loads))
    ]


def _joined(pairs: Array) -> list[Interval]:
    """Return sorted intervals, those that touch across the border of a panel as one."""
    out: list[Interval] = []
    for left, right in pairs[np.argsort(pairs[:, 0])]:
        if out and left <= out[-1].right * (1 + _TOUCH):
            out[-1] = Interval(out[-1].left, max(float(right), out[-1].right))
        else:
            out.append(Interval(float(left), float(right)))
    return out


def _crossings(
    sampler: ChartSampler,
    panel: int,
    loads: Array,
    span: Array,
    growth: Array,
    error: Array,
    within: NDArray[np.bool_],
) -> Runs:
    """Return row, first and last T of every run of columns within a tongue, refined."""
    border = np.zeros((len(loads), 1), dtype=bool)
    change = np.diff(np.hstack([border, within, border]).astype(np.int8), axis=1)
    row, first = np.nonzero(change == 1)
    last = np.nonzero(change == -1)[1] - 1
    # rounding alone may lift the measure above 0: look at the column that grows most
    runs = zip(row, first, last, strict=True)
    top = np.array([i + growth[r, i : j + 1].argmax() for r, i, j in runs], dtype=int)
    sure = surely_unstable(sampler, loads[row], span[top], growth[row, top], error[row, top])
    row, first, last = row[sure], first[sure], last[sure]
    inside = np.concatenate([first, last])
    outside = np.concatenate([first - 1, last + 1])
    there = np.flatnonzero((outside >= 0) & (outside < len(span)))
    end = span[inside]
    a, b = end[there], span[outside[there]]
    root = _root(sampler, panel, np.tile(loads[row], 2)[there], a, b)
    end[there] = np.where(np.isfinite(root), root, (a + b) / 2)
    return row, end[: len(row)], end[len(row) :]


def _root(sampler: ChartSampler, panel: int, load: Array, inside: Array, outside: Array) -> Array:
    """Return T between points inside and outside at the edge, NaN where it is not between."""

    def value(period: Array, index: NDArray[np.intp]) -> Array:
        growth, error, approach = sampler.at_points(panel, load[index], period, nearness=True)
        if sampler.system.is_damped:
            return growth
        # where two pairs grow at once the approach may tell nothing
        grows = (approach <= 0) & (growth > np.maximum(error, SMALLEST_GROWTH))
        return np.where(grows, growth, approach)

    return bracketed_roots(value, inside, outside, _EDGE)


def _peaks(sampler: ChartSampler, panel: int, loads: Array, span: Array, known: Runs) -> Runs:
    """Return row, first and last T of tongues that pass between two columns."""
    row, centre, half = passes(sampler, panel, loads)
    new = ~_covered(row, centre, known)
    row, centre, half = row[new], centre[new], half[new]
    growth, error, _ = sampler.at_points(panel, loads[row], centre, nearness=True)
    keep = surely_unstable(sampler, loads[row], centre, growth, error)
    row, centre, half = row[keep], centre[keep], half[keep]
    load, middle = np.tile(loads[row], 2), np.tile(centre, 2)
    sides = np.concatenate([-half, half])
    after = np.clip(np.searchsorted(span, centre), 1, len(span) - 1)
    far = np.concatenate([span[after - 1], span[after]])
    # the parabola's edges do where a tongue is as narrow as their error allows
    own = np.clip(middle + sides, span[0], span[-1])
    both = np.where(np.abs(sides) < _NARROW * middle, own, np.nan)
    # close about the parabola's edges, else up to the columns
    for inner, outer in _BRACKETS:
        again = np.flatnonzero(np.isnan(both))
        near, away = (middle[again] + x * sides[again] for x in (inner, outer))
        past = np.abs(away - middle[again]) > np.abs(far[again] - middle[again])
        away = np.where(past, far[again], away)
        both[again] = _root(sampler, panel, load[again], near, away)
    # between columns of which one is in another tongue: the parabola's own edges
    both = np.where(np.isfinite(both), both, own)
    start, stop = np.split(both, 2)
    return row, start, stop


def _covered(row: NDArray[np.intp], period: Array, known: Runs) -> NDArray[np.bool_]:
    """Return which points (row, T) lie in one of known runs."""
    order = np.lexsort((known[1], known[0]))
    rows, start, stop = (part[order] for part in known)
    # rows side by side on one line
    length = 1 + max(period.max(initial=0.0), stop.max(initial=0.0))
    at = np.searchsorted(rows * length + start, row * length + period, side="right") - 1
    inside = (at >= 0) & (rows[at] == row) & (period <= stop[at]) if len(rows) else at >= 0
    return np.asarray(inside)
