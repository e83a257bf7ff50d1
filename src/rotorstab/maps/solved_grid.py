"""Growth rates at rising loads and falling frequencies: interpolated, and doubtful ones solved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .._tolerances import NO_VERDICT, ROUGH_PART, SMALLEST_GROWTH, UNCERTAIN_PIXEL
from .._types import Array, Mask
from ..floquet.interpolant.chart_interpolant import ChartInterpolant
from ..floquet.point import floquet_solution
from ..floquet.tongues.subpixel import growth_of_collisions, growth_of_table
from ..model.system import System
from .grid_edges import GridEdges, grid_edges

__all__ = ["GridOptions", "SolvedGrid", "solved_grid"]


@dataclass(frozen=True)
class GridOptions:
    """The keyword arguments of `stability_chart`, checked."""

    density: float
    refine: bool
    most_refined: int | None
    refine_from: float
    find_narrow: bool
    edges: bool
    resolve: float
    slow_whirls: bool


class SolvedGrid(NamedTuple):
    """The arrays (R, C) of a chart at rising loads and falling frequencies, and its edges."""

    growth: Array
    error: Array
    peak: Array
    edges: GridEdges | None
    refined: int

    @classmethod
    def nothing(cls) -> SolvedGrid:
        """Return what a chart without rows has."""
        empty = np.empty((0, 0))
        return cls(empty, empty, empty, None, 0)


def solved_grid(
    system: System, static: float, loads: Array, frequencies: Array, options: GridOptions
) -> SolvedGrid:
    """Return growth, errors and edges at rising loads below the pole and falling frequencies."""
    periods = 2 * np.pi / frequencies
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        interpolant = ChartInterpolant(
            system,
            static,
            float(loads[-1]),
            periods,
            options.density,
            between=options.find_narrow,
            resolve=2 * np.pi / options.resolve,
            slow=options.slow_whirls,
        )
        solve = interpolant.growth_and_edge if options.edges else interpolant.growth
        growth, error, smooth = solve(*interpolant.on_grid(loads, periods), periods)
        refined = 0
        if options.refine:
            fast, most = frequencies >= options.refine_from, options.most_refined
            refined = _refine(system, static, loads, frequencies, growth, error, fast, most)
            rough = error > np.maximum(UNCERTAIN_PIXEL, ROUGH_PART * np.abs(growth))
            # where growth in one period is beyond all bounds, so is its error
            growth[(rough | ~(error * periods < NO_VERDICT)) & ~fast] = np.nan
        growth[(np.abs(growth) <= error) & ~(error * periods < NO_VERDICT)] = np.nan
    peak = growth
    if options.find_narrow:
        peak = _with_subpixel(growth, interpolant, loads, frequencies)
    edges: GridEdges | None = None
    if options.edges:
        rising = np.where(np.isnan(growth), np.nan, smooth)[:, ::-1]
        edges = grid_edges(interpolant, rising, loads, frequencies[::-1].copy(), options.refine)
    return SolvedGrid(growth, np.maximum(error, SMALLEST_GROWTH), peak, edges, refined)


def _with_subpixel(
    growth: Array, interpolant: ChartInterpolant, loads: Array, frequencies: Array
) -> Array:
    """Return the growth (R, C), or that of a tongue narrower than a pixel where it is larger."""
    highest = growth.copy()
    if not interpolant.closed_form:
        return np.fmax(highest, growth_of_table(interpolant, loads, frequencies))
    periods = 2 * np.pi / frequencies
    for index, panel in enumerate(interpolant.panels):
        if panel.period_nodes and panel.high > panel.low:
            highest = np.fmax(highest, growth_of_collisions(interpolant, index, loads, periods))
    return highest


def _refine(
    system: System,
    static: float,
    loads: Array,
    frequencies: Array,
    growth: Array,
    error: Array,
    columns: Mask,
    most: int | None,
) -> int:
    """Compute the pixels with large errors in some columns again, in place; return their number."""
    i, j = np.nonzero((~(error <= UNCERTAIN_PIXEL) | ~np.isfinite(growth)) & columns)
    decided = np.abs(growth[i, j]) > error[i, j]
    # the frequencies fall
    first = np.lexsort((j, decided))[:most]
    i, j = i[first], j[first]
    if i.size:
        again = floquet_solution(system, static, loads[i], frequencies[j])
        growth[i, j], error[i, j] = again.growth_rate, again.error
    return len(i)
