"""Where the edge of the unstable set crosses the lines of a grid of loads and frequencies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .._numerics.roots import bracketed_roots
from .._types import Array, Index
from ..floquet.interpolant.chart_interpolant import ChartInterpolant
from .thin_tongues import ThinTongue, thin_tongues

__all__ = ["GridEdges", "grid_edges"]

_WIDTH = 0.05  # of a cell: by so much the place of a crossing may be wrong


class GridEdges(NamedTuple):
    """The edge of the unstable set on a grid, for a program that draws contours.

    Parameters
    ----------
    pulsating_loads : (R,) float
        p̄_t of the rows [EI/L²], rising.
    excitation_frequencies : (C,) float
        θ̄ of the columns [√(EI/(ρAL⁴))], rising.
    function : (R, C) float
        Above 0 where a point is unstable by its own growth, below 0 where it is stable; its contour
        0 is the edge of the unstable set. Without damping it is σ² where unstable. NaN where the
        growth is.
    across : (R, C − 1) float
        Where the edge crosses a row between two columns, as a part of their distance; else NaN.
    along : (R − 1, C) float
        Where the edge crosses a column between two rows, as a part of their distance; else NaN.
    thin : tuple of ThinTongue
        Lines along the tongues that no column sees.
    """

    pulsating_loads: Array
    excitation_frequencies: Array
    function: Array
    across: Array
    along: Array
    thin: tuple[ThinTongue, ...] = ()

    def from_column(self, first: int) -> GridEdges:
        """Return the part of the grid from one of its columns to the last."""
        frequencies = self.excitation_frequencies[first:]
        thin = []
        for line in self.thin:
            theta = line.excitation_frequencies
            inside = np.where(theta >= frequencies[0], theta, np.nan)
            if np.isfinite(inside).any():
                thin.append(replace(line, excitation_frequencies=inside))
        return self._replace(
            excitation_frequencies=frequencies,
            function=self.function[:, first:],
            across=self.across[:, first:],
            along=self.along[:, first:],
            thin=tuple(thin),
        )


def grid_edges(
    interpolant: ChartInterpolant,
    function: Array,
    loads: Array,
    frequencies: Array,
    follow: bool = False,
) -> GridEdges:
    """Return an edge function (R, C) with its crossings of the grid, to 1/20 of a cell.

    Parameters
    ----------
    interpolant : ChartInterpolant
    function : (R, C) float
    loads, frequencies : (R,), (C,) float
        p̄_t and θ̄ of the grid, rising.
    follow : bool
        As for `thin_tongues`.
    """

    def along(row: Index, column: Index, part: Array) -> Array:
        load = loads[row] + part * (loads[row + 1] - loads[row])
        return interpolant.edge(load, 2 * np.pi / frequencies[column])

    def across(row: Index, column: Index, part: Array) -> Array:
        first, second = frequencies[column], frequencies[column + 1]
        return interpolant.edge(loads[row], 2 * np.pi / (first + part * (second - first)))

    known = interpolant.knows(2 * np.pi / frequencies)
    within = np.where(known, function, np.nan)
    found = GridEdges(
        loads,
        frequencies,
        function,
        _crossings(across, within[:, :-1], within[:, 1:]),
        _crossings(along, within[:-1], within[1:]),
        thin_tongues(interpolant, function, loads, frequencies, follow),
    )
    for array in found[:5]:
        array.flags.writeable = False
    return found


def _crossings(value: Callable[[Index, Index, Array], Array], first: Array, second: Array) -> Array:
    """Return where a function is 0 between grid points where it is `first` and `second`.

    Parameters
    ----------
    value : callable
        Takes row, column and the part of the way from the first point to the second.
    first, second : (...) float

    Returns
    -------
    (...) float
        Parts of the way, NaN where the sign does not change.
    """
    found = np.full(first.shape, np.nan)
    known = np.isfinite(first) & np.isfinite(second)
    row, column = np.nonzero(known & ((first > 0) != (second > 0)))
    if row.size:
        one, other = first[row, column], second[row, column]
        grows = one > 0
        # searched on [1, 2], for the width of the last bracket is relative to the root
        root = bracketed_roots(
            lambda x, i: value(row[i], column[i], x - 1),
            np.where(grows, 1.0, 2.0),
            np.where(grows, 2.0, 1.0),
            _WIDTH,
            values=(np.where(grows, one, other), np.where(grows, other, one)),
        )
        found[row, column] = root - 1
    return found
