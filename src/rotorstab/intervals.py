"""Unstable intervals of θ̄, row by row of loads, refined on the interpolated polynomial."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .sampler import ChartSampler
from .system import System
from .tongues import bracketed_roots

__all__ = ["SMALLEST_GROWTH", "Interval", "unstable_intervals"]

Array = NDArray[np.float64]
Runs = tuple[NDArray[np.intp], Array, Array]

_PER_OCTAVE = (220, 110)  # columns, even in T: in the upper four octaves, below
_DENSITY = 1.4  # of nodes and steps: the edges of narrow tongues ask for more than a map
SMALLEST_GROWTH = 1e-8
"""σ̄ that counts as growth [√(EI/(ρAL⁴))]."""

_NEAREST = -1.0  # approach below which a pair is too far apart to meet within a column
_SHRINK = (0.3, 0.03)  # half-widths of the parabolas, in columns
_TOUCH = 1e-12
_EDGE = 1e-7  # of T
_OUTSIDE = 1.5  # half-widths from a narrow tongue's centre to a point surely outside
_FAR = 0.05  # of a parabola's bend over a column: error allowed its estimated top


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
        edges.append(_crossings(sampler, index, loads, span, unstable, within))
        if len(span) > 2:
            edges.append(_peaks(sampler, index, loads, span, unstable, approach))
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
    unstable: NDArray[np.bool_],
    within: NDArray[np.bool_],
) -> Runs:
    """Return row, first and last T of every run of columns within a tongue, refined."""
    border = np.zeros((len(loads), 1), dtype=bool)
    change = np.diff(np.hstack([border, within, border]).astype(np.int8), axis=1)
    row, first = np.nonzero(change == 1)
    last = np.nonzero(change == -1)[1] - 1
    # rounding alone may lift the measure above 0
    total = np.hstack([np.zeros((len(loads), 1), dtype=int), unstable.cumsum(axis=1)])
    sure = total[row, last + 1] > total[row, first]
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


def _peaks(
    sampler: ChartSampler,
    panel: int,
    loads: Array,
    span: Array,
    unstable: NDArray[np.bool_],
    approach: Array,
) -> Runs:
    """Return row, first and last T of tongues that pass between two columns."""
    middle = approach[:, 1:-1]
    candidate = (middle >= approach[:, :-2]) & (middle > approach[:, 2:])
    if not sampler.system.is_damped:
        candidate &= middle < 0
    candidate &= (middle > _NEAREST) & ~(unstable[:, :-2] | unstable[:, 1:-1] | unstable[:, 2:])
    # the parabola through three columns tells where there is nothing near 0
    bend = approach[:, :-2] - 2 * middle + approach[:, 2:]
    slope = (approach[:, 2:] - approach[:, :-2]) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        candidate &= middle - slope**2 / (2 * bend) > _FAR * bend
    row, column = np.nonzero(candidate)
    column += 1
    load, before, after = loads[row], span[column - 1], span[column + 1]
    centre, spacing = span[column].copy(), (after - before) / 2
    for shrink in _SHRINK:
        reach = shrink * spacing
        points = np.clip(centre + reach * np.array([[-1.0], [0.0], [1.0]]), span[0], span[-1])
        height = sampler.at_points(panel, np.tile(load, 3), points.ravel(), nearness=True)[2]
        low, mid, high = height.reshape(3, -1)
        bend = low - 2 * mid + high
        with np.errstate(divide="ignore", invalid="ignore"):
            shift = np.where(bend < 0, (low - high) / (2 * bend), np.sign(high - low))
        centre = np.clip(centre + reach * np.clip(shift, -2, 2), before, after)
    growth, error, top = sampler.at_points(panel, load, centre, nearness=True)
    keep = growth > np.maximum(error, SMALLEST_GROWTH)
    # the last parabola is 0 at this distance from its vertex
    with np.errstate(divide="ignore", invalid="ignore"):
        half = reach * np.sqrt(2 * top / -bend)
    row = row[keep]
    load, centre, half, before, after = (one[keep] for one in (load, centre, half, before, after))
    load, centre = np.tile(load, 2), np.tile(centre, 2)
    far = np.concatenate([before, after])
    close = centre + np.concatenate([-half, half]) * _OUTSIDE
    close = np.where(np.abs(close - centre) < np.abs(far - centre), close, far)
    both = _root(sampler, panel, load, centre, close)
    again = np.flatnonzero(np.isnan(both))
    both[again] = _root(sampler, panel, load[again], centre[again], far[again])
    start, stop = np.split(both, 2)
    good = np.isfinite(start) & np.isfinite(stop)
    return row[good], start[good], stop[good]
