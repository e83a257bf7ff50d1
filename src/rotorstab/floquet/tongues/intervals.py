"""Unstable intervals of θ̄, row by row of loads, refined on the interpolated polynomial."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..._numerics.roots import bracketed_roots
from ..._tolerances import DOUBTFUL_IN_OUTLINE, LIVE_EDGE, TOUCHING
from ..._types import Array, Index, Mask
from ...model.system import System
from ..criterion import is_unstable
from ..interpolant.chart_interpolant import ChartInterpolant
from .collisions import multiplier_collisions, surely_unstable

__all__ = ["Interval", "unstable_intervals"]

_PER_OCTAVE = (220, 110)  # columns, evenly spaced in T: in the upper four octaves, below them
_DENSITY = 1.4  # of nodes and steps: the edges of narrow tongues need more of them than a map
_NARROW = 1e-5  # of T: half-width below which the edges of the parabola are right to 1e-6
_BRACKETS = ((0.98, 1.02), (0.0, 1.5), (0.0, np.inf))  # half-widths about an edge


class Interval(NamedTuple):
    """An interval of θ̄ from its left to its right edge."""

    left: float
    right: float

    @property
    def centre(self) -> float:
        """Middle of the interval."""
        return (self.left + self.right) / 2


def _columns(low: float, high: float) -> Array:
    """Return periods, rising, evenly spaced within each octave."""
    shortest, longest = 2 * np.pi / high, 2 * np.pi / low
    octaves = max(1, int(np.ceil(np.log2(longest / shortest))))
    cuts = shortest * (longest / shortest) ** (np.arange(octaves + 1) / octaves)
    parts = [
        np.linspace(a, b, _PER_OCTAVE[k >= 4], endpoint=False)
        for k, (a, b) in enumerate(pairwise(cuts.tolist()))
    ]
    return np.append(np.concatenate(parts), longest)


class _Runs(NamedTuple):
    """Unstable ranges of T, (P,) arrays: index of the load, first and last T."""

    row: Index
    start: Array
    stop: Array


def unstable_intervals(
    system: System, static: float, loads: Array, low: float, high: float
) -> list[list[Interval]]:
    """Return the unstable intervals of θ̄ of each row, from left to right.

    There are none where growth or decay within a period exceeds double precision.

    Parameters
    ----------
    system : System
        Of two coordinates at one spin speed.
    static : float
        p̄₀ [EI/L²].
    loads : (R,) float
        p̄_t of the rows, above 0 and rising.
    low, high : float
        Window of θ̄.
    """
    periods = _columns(low, high)
    runs: list[_Runs] = []
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        interpolant = ChartInterpolant(
            system, static, float(loads[-1]), periods, _DENSITY, resolve=np.inf
        )
        for index, panel in enumerate(interpolant.panels):
            # up to the first column of the next panel, so that they meet
            span = periods[panel.columns.start : panel.columns.stop + 1]
            strip = _Strip(interpolant, index, loads, span)
            wide = strip.wide_tongues()
            runs += [wide, strip.narrow_tongues(wide)]
    row, start, stop = (np.concatenate(parts) for parts in zip(*runs, strict=True))
    return [
        _joined(np.column_stack([2 * np.pi / stop[row == r], 2 * np.pi / start[row == r]]))
        for r in range(len(loads))
    ]


def _joined(pairs: Array) -> list[Interval]:
    """Return sorted intervals; those that touch across the border of a panel become one."""
    out: list[Interval] = []
    for left, right in pairs[np.argsort(pairs[:, 0])]:
        if out and left <= out[-1].right * (1 + TOUCHING):
            out[-1] = Interval(out[-1].left, max(float(right), out[-1].right))
        else:
            out.append(Interval(float(left), float(right)))
    return out


class _Strip(NamedTuple):
    """The rows of one panel: its interpolant and number, the loads and the columns T."""

    interpolant: ChartInterpolant
    panel: int
    loads: Array
    span: Array

    def wide_tongues(self) -> _Runs:
        """Return the runs of columns that lie within tongues, with refined ends."""
        loads, span = self.loads, self.span
        growth, error, within = self._on_columns()
        border = np.zeros((len(loads), 1), dtype=bool)
        change = np.diff(np.hstack([border, within, border]).astype(np.int8), axis=1)
        row, first = np.nonzero(change == 1)
        last = np.nonzero(change == -1)[1] - 1
        # rounding alone may lift the measure above 0: the column that grows most decides
        runs = zip(row, first, last, strict=True)
        top = np.array([i + growth[r, i : j + 1].argmax() for r, i, j in runs], dtype=int)
        sure = self._sure(row, span[top], growth[row, top], error[row, top])
        row, first, last = row[sure], first[sure], last[sure]
        inside = np.concatenate([first, last])
        outside = np.concatenate([first - 1, last + 1])
        there = np.flatnonzero((outside >= 0) & (outside < len(span)))
        end = span[inside]
        a, b = end[there], span[outside[there]]
        root = self._roots(np.tile(loads[row], 2)[there], a, b)
        end[there] = np.where(np.isfinite(root), root, (a + b) / 2)
        return _Runs(row, end[: len(row)], end[len(row) :])

    def narrow_tongues(self, known: _Runs) -> _Runs:
        """Return the tongues that lie between two columns, outside of some known runs."""
        row, centre, half = multiplier_collisions(self.interpolant, self.panel, self.loads)
        new = ~_covered(row, centre, known)
        row, centre, half = row[new], centre[new], half[new]
        growth, error, _ = self.interpolant.at_points(
            self.panel, self.loads[row], centre, with_approach=True
        )
        keep = self._sure(row, centre, growth, error)
        row, centre, half = row[keep], centre[keep], half[keep]
        start, stop = np.split(self._narrow_edges(row, centre, half), 2)
        return _Runs(row, start, stop)

    def _on_columns(self) -> tuple[Array, Array, Mask]:
        """Return growth, its error and whether a point lies within a tongue, (R, C) each."""
        interpolant, loads, span = self.interpolant, self.loads, self.span
        error = interpolant.coefficient_error(self.panel, loads[:, None], span)
        functions = interpolant.evaluate(self.panel, loads, span)
        growth, error, approach = interpolant.growth(functions, error, span, with_approach=True)
        if interpolant.system.is_damped:
            # an outline is the limit of stability: there the growth rate passes 0
            return growth, error, np.asarray(growth > 0)
        return growth, error, is_unstable(growth, error) | (approach > 0)

    def _sure(self, row: Index, period: Array, growth: Array, error: Array) -> Mask:
        """Return where growth is certain, or found so at single points."""
        return surely_unstable(
            self.interpolant, self.loads[row], period, growth, error, DOUBTFUL_IN_OUTLINE
        )

    def _roots(self, load: Array, inside: Array, outside: Array) -> Array:
        """Return T of edges between points inside and outside, NaN where there is none."""

        def value(period: Array, index: Index) -> Array:
            growth, error, approach = self.interpolant.at_points(
                self.panel, load[index], period, with_approach=True
            )
            if self.interpolant.system.is_damped:
                return growth
            # where two pairs grow at once the approach is not that of the pair that grows most
            grows = (approach <= 0) & is_unstable(growth, error)
            return np.where(grows, growth, approach)

        return bracketed_roots(value, inside, outside, LIVE_EDGE)

    def _narrow_edges(self, row: Index, centre: Array, half: Array) -> Array:
        """Return T of the edges of narrow tongues: all left ones, then all right ones.

        The parabola of the collision gives edges centre ± half. These are used as they are where a
        tongue is as narrow as their error allows, and where a neighbouring column lies in another
        tongue; else the edges are roots close to them or, failing that, up to the columns.
        """
        span = self.span
        load, middle = np.tile(self.loads[row], 2), np.tile(centre, 2)
        sides = np.concatenate([-half, half])
        after = np.clip(np.searchsorted(span, centre), 1, len(span) - 1)
        column = np.concatenate([span[after - 1], span[after]])
        of_parabola = np.clip(middle + sides, span[0], span[-1])
        edges = np.where(np.abs(sides) < _NARROW * middle, of_parabola, np.nan)
        for inner, outer in _BRACKETS:
            left = np.flatnonzero(np.isnan(edges))
            near, away = (middle[left] + x * sides[left] for x in (inner, outer))
            past = np.abs(away - middle[left]) > np.abs(column[left] - middle[left])
            away = np.where(past, column[left], away)
            edges[left] = self._roots(load[left], near, away)
        return np.where(np.isfinite(edges), edges, of_parabola)


def _covered(row: Index, period: Array, known: _Runs) -> Mask:
    """Return which points (row, T) lie in one of some known runs."""
    order = np.lexsort((known.start, known.row))
    rows, start, stop = (part[order] for part in known)
    # all rows side by side on one line
    length = 1 + max(period.max(initial=0.0), stop.max(initial=0.0))
    at = np.searchsorted(rows * length + start, row * length + period, side="right") - 1
    inside = (at >= 0) & (rows[at] == row) & (period <= stop[at]) if len(rows) else at >= 0
    return np.asarray(inside)
