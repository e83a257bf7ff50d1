"""Stability charts over pulsating load and excitation frequency, by interpolation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._arguments import number, numbers, whole_number
from .._types import Array, ArrayLike, Mask
from ..floquet.criterion import is_unstable
from ..model.system import System, single_speed
from .grid_edges import GridEdges
from .solved_grid import GridOptions, SolvedGrid, solved_grid

__all__ = ["StabilityChart", "stability_chart", "stability_map"]


@dataclass(frozen=True)
class StabilityChart:
    """Growth rates on a grid, their errors and the verdict of each pixel.

    Parameters
    ----------
    pulsating_loads : (R,) float
        p̄_t of the rows [EI/L²].
    excitation_frequencies : (C,) float
        θ̄ of the columns [√(EI/(ρAL⁴))].
    growth : (R, C) float
        σ at the centre of the pixel [√(EI/(ρAL⁴))]. NaN in rows whose load passes
        `System.largest_load`, and in pixels that are not computed again although rounding exceeds
        their growth.
    error : (R, C) float
        Bound on the error of `growth`, which it must exceed for the pixel to be unstable.
    peak_growth : (R, C) float
        `growth`, or the larger growth in a tongue narrower than a pixel that passes through.
    unstable : (R, C) bool
        Whether `growth` exceeds its error, or a narrow tongue passes through the pixel.
    refined : int
        Number of pixels that were computed again one by one.
    narrow_only : int
        Number of pixels that are unstable only because of a narrow tongue.
    edges : GridEdges or None
        The edge of the unstable set, on the rows below `System.largest_load`; None where it was
        not asked for, and where there are no such rows.
    """

    pulsating_loads: Array
    excitation_frequencies: Array
    growth: Array
    error: Array
    peak_growth: Array
    unstable: Mask
    refined: int
    narrow_only: int
    edges: GridEdges | None = None


def _checked(
    system: System, static_load: float, loads: ArrayLike, frequencies: ArrayLike
) -> tuple[float, Array, Array]:
    """Return the arguments of a chart as numbers and arrays."""
    single_speed(system)
    rows = np.array(numbers("pulsating_loads", loads))
    columns = np.array(numbers("excitation_frequencies", frequencies, 0.0, open_low=True))
    for name, array in (("pulsating_loads", rows), ("excitation_frequencies", columns)):
        if array.ndim != 1 or array.size == 0:
            raise ValueError(f"`{name}` must be a list of numbers, got shape {array.shape}")
    return number("static_load", static_load), rows, columns


def stability_chart(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
    *,
    density: float = 1.0,
    refine: bool = True,
    most_refined: int | None = None,
    refine_from: float = 0.0,
    find_narrow: bool = True,
    edges: bool = False,
    resolve: float = math.inf,
    slow_whirls: bool = False,
) -> StabilityChart:
    """Return growth rates on a grid, with errors and the verdict of each pixel.

    Parameters
    ----------
    system : System
        At one spin speed; lumped or reduced finite-element, damped or not, any stiffness law.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²], in any order; the sign does not matter.
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0, in any order.
    density : float
        Numbers of nodes and steps relative to the tuned ones, in [0.3, 3]. A smaller value is
        faster and less accurate, and the error bounds say so.
    refine : bool
        Whether pixels whose error bound exceeds 1e-5 are computed again by `floquet_solution`.
    most_refined : int, optional
        Largest number of pixels that are computed again; by default there is no limit. Pixels
        whose verdict is in doubt come first, those of the fastest loads before others; the rest
        keep their error.
    refine_from : float
        θ̄ below which no pixel is computed again, for its time rises with the period of the load;
        those that are not right to 1e-5 or to 1 % are NaN.
    find_narrow : bool
        Whether to search for tongues narrower than a pixel, and mark the pixels through which they
        pass. With two coordinates all tongues that grow faster than 1e-4 are found, of any order,
        down to the lowest root of the resonance table; with more coordinates those of the table.
    edges : bool
        Whether to find the edge of the unstable set between the points of the grid, whose loads,
        0 or more, and frequencies must then rise.
    resolve : float
        θ̄ down to which the edge is found between the columns, also where that takes longer than
        the columns themselves.
    slow_whirls : bool
        Whether a system of more than two coordinates is represented by its four slowest whirls,
        which takes a tenth to a hundredth of the time and finds their tongues of any order. It is
        first reduced to the shapes of these whirls under the loads of the chart, and the errors
        hold an estimate of what that leaves out. What faster whirls do to them as their
        multipliers pass is left out.

    Returns
    -------
    StabilityChart

    Raises
    ------
    ValueError
        If an argument is not finite, out of range or not 1-d, or `refine` is a number; of the kind
        `InseparableWhirls` if `slow_whirls` and these have wide tongues together with faster ones.

    Notes
    -----
    The coefficients of the characteristic polynomial are entire in T = 2π/θ̄ and, since a
    change of sign only shifts time, in p̄_t². They are sampled at Chebyshev nodes by a
    splitting integrator with a gradient kick, extrapolated in its step, and interpolated to
    the pixels, where the multipliers follow in closed form (n = 2; else by eigenvalues).

    References
    ----------
    M. Takahashi, M. Imada, J. Phys. Soc. Jpn 53 (1984) 3765 (the kick); L. N. Trefethen,
    Approximation Theory and Approximation Practice (the interpolation).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> system = lumped(ShaftDisk(), 1.0)
    >>> chart = stability_chart(system, 1.18, [0.0, 0.5], [0.8, 1.0], find_narrow=False)
    >>> chart.unstable.tolist()
    [[False, False], [False, True]]
    """
    static, all_loads, all_frequencies = _checked(
        system, static_load, pulsating_loads, excitation_frequencies
    )
    options = GridOptions(
        number("density", density, 0.3, 3.0),
        _checked_refine(refine),
        None if most_refined is None else whole_number("most_refined", most_refined, 0),
        number("refine_from", refine_from, 0.0),
        find_narrow,
        edges,
        resolve,
        slow_whirls,
    )
    if edges and not all((np.diff(x, prepend=0) >= 0).all() for x in (all_loads, all_frequencies)):
        raise ValueError("`edges` needs loads of 0 or more and frequencies in rising order")
    columns = np.argsort(-all_frequencies, kind="stable")
    magnitude = np.abs(all_loads)
    valid = np.flatnonzero(system.in_charts(static + magnitude))
    rows = valid[np.argsort(magnitude[valid], kind="stable")]
    growth, error, peak = np.full((3, len(all_loads), len(all_frequencies)), np.nan)
    found = SolvedGrid.nothing()
    if rows.size:
        found = solved_grid(system, static, magnitude[rows], all_frequencies[columns], options)
        target = np.ix_(rows, columns)
        growth[target], error[target], peak[target] = found.growth, found.error, found.peak
    with np.errstate(invalid="ignore"):
        at_centre = is_unstable(growth, error)
        unstable = at_centre | is_unstable(peak - np.maximum(growth, 0), 0.0)
    for array in (all_loads, all_frequencies, growth, error, peak, unstable):
        array.flags.writeable = False
    narrow_only = int((unstable & ~at_centre).sum())
    return StabilityChart(
        all_loads,
        all_frequencies,
        growth,
        error,
        peak,
        unstable,
        found.refined,
        narrow_only,
        found.edges,
    )


def _checked_refine(refine: bool) -> bool:
    if not isinstance(refine, (bool, np.bool_)):
        raise ValueError(
            f"`refine` must be True or False, got {refine!r}; `most_refined` bounds the number "
            "of pixels"
        )
    return bool(refine)


def stability_map(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
) -> Array:
    """Return growth rates on a grid, right to 1e-5.

    These are the growth rates of `stability_chart`, which also returns their errors, the verdict
    of each pixel and tongues narrower than a pixel.

    Parameters
    ----------
    system : System
        At one spin speed; lumped or reduced finite-element, damped or not, any stiffness law.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²], in any order; the sign does not matter.
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0, in any order.

    Returns
    -------
    (R, C) float
        σ = ln max|μ| / T [√(EI/(ρAL⁴))].

    Raises
    ------
    ValueError
        If an argument is not finite, out of range or not 1-d.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> stability_map(lumped(ShaftDisk(), 1.0), 1.18, [0.0, 0.5], [0.8, 1.0]).shape
    (2, 2)
    """
    return stability_chart(
        system, static_load, pulsating_loads, excitation_frequencies, find_narrow=False
    ).growth.copy()
