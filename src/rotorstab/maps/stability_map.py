"""Stability charts over pulsating load and excitation frequency: the fast path."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._arguments import number, numbers
from .._tolerances import NO_VERDICT, SMALLEST_GROWTH, UNCERTAIN_PIXEL
from .._types import Array, ArrayLike, Mask
from ..floquet.interpolant.chart_interpolant import ChartInterpolant
from ..floquet.point import floquet_solution
from ..floquet.tongues.subpixel import growth_of_collisions, growth_of_table
from ..model.system import System, single_speed

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
        σ at the pixel's centre; NaN in rows whose load passes `System.largest_load`, and where
        rounding leaves nothing of it in a pixel that is not computed again.
    error : (R, C) float
        Bound on its error from the method's own estimates: the tolerance of the verdict.
    peak_growth : (R, C) float
        `growth`, or that of a tongue narrower than a pixel which passes through it.
    unstable : (R, C) bool
        Whether `growth` exceeds its error or a narrow tongue passes.
    refined : int
        Pixels computed again one by one.
    seeded : int
        Pixels unstable only for a narrow tongue.
    """

    pulsating_loads: Array
    excitation_frequencies: Array
    growth: Array
    error: Array
    peak_growth: Array
    unstable: Mask
    refined: int
    seeded: int


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
    refine: bool | int = True,
    seed: bool = True,
) -> StabilityChart:
    """Return growth rates on a grid, with errors and the verdict of each pixel.

    Parameters
    ----------
    system : System
        One spin speed; lumped or reduced finite-element, damped or not, any stiffness law.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²], in any order; the sign does not matter.
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0, in any order.
    density : float
        Nodes and steps relative to the tuned numbers, in [0.3, 3]; less is faster and less
        accurate, which the error estimate then says.
    refine : bool or int
        Compute pixels whose error bound exceeds 1e-5 again by `floquet_solution`; at most so
        many of them, those first whose verdict is in doubt, of the fastest loads first: the
        others keep their error.
    seed : bool
        Look for tongues narrower than a pixel and mark the pixels they pass through: with two
        coordinates all that grow faster than 1e-4, of any order, down to the lowest root of the
        resonance table; with more coordinates those of the table.

    Returns
    -------
    StabilityChart

    Raises
    ------
    ValueError
        If an argument is not finite, out of range or not 1-d.

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
    >>> chart = stability_chart(lumped(ShaftDisk(), 1.0), 1.18, [0.0, 0.5], [0.8, 1.0], seed=False)
    >>> chart.unstable.tolist()
    [[False, False], [False, True]]
    """
    static, all_loads, all_frequencies = _checked(
        system, static_load, pulsating_loads, excitation_frequencies
    )
    density = number("density", density, 0.3, 3.0)
    shape = (len(all_loads), len(all_frequencies))
    growth, error, peak = (np.full(shape, np.nan) for _ in range(3))
    refined = 0
    # rising loads below the pole, falling frequencies: rising periods
    columns = np.argsort(-all_frequencies, kind="stable")
    frequencies, magnitude = all_frequencies[columns], np.abs(all_loads)
    valid = np.flatnonzero(static + magnitude < system.largest_load)
    rows = valid[np.argsort(magnitude[valid], kind="stable")]
    if rows.size:
        loads, periods = magnitude[rows], 2 * np.pi / frequencies
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            interpolant = ChartInterpolant(
                system, static, float(loads[-1]), periods, density, between=seed
            )
            part, slack, _ = interpolant.growth(*interpolant.on_grid(loads, periods), periods)
            if refine:
                most = part.size if refine is True else refine
                refined = _refine(system, static, loads, frequencies, part, slack, most)
            part[(np.abs(part) <= slack) & ~(slack * periods < NO_VERDICT)] = np.nan
        highest = _with_subpixel(part, interpolant, loads, frequencies) if seed else part
        target = np.ix_(rows, columns)
        growth[target], peak[target] = part, highest
        error[target] = np.maximum(slack, SMALLEST_GROWTH)
    with np.errstate(invalid="ignore"):
        at_centre = growth > error
        unstable = at_centre | (peak > np.maximum(growth, 0) + SMALLEST_GROWTH)
    for array in (all_loads, all_frequencies, growth, error, peak, unstable):
        array.flags.writeable = False
    seeded = int((unstable & ~at_centre).sum())
    return StabilityChart(
        all_loads, all_frequencies, growth, error, peak, unstable, refined, seeded
    )


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
    most: int,
) -> int:
    """Compute doubtful pixels again, in place; return how many."""
    i, j = np.nonzero(~(error <= UNCERTAIN_PIXEL) | ~np.isfinite(growth))
    decided = np.abs(growth[i, j]) > error[i, j]
    first = np.lexsort((j, decided))[:most]  # frequencies fall
    i, j = i[first], j[first]
    if i.size:
        again = floquet_solution(system, static, loads[i], frequencies[j])
        growth[i, j], error[i, j] = again.growth_rate, again.error
    return len(i)


def stability_map(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
) -> Array:
    """Return growth rates (len(pulsating_loads), len(excitation_frequencies)), to 1e-5.

    The plain numbers of `stability_chart`, which also gives errors, the verdict and tongues
    narrower than a pixel.

    Parameters
    ----------
    system, static_load, pulsating_loads, excitation_frequencies
        See `stability_chart`.

    Returns
    -------
    (R, C) float
        σ = ln max|μ| / T [√(EI/(ρAL⁴))].

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> stability_map(lumped(ShaftDisk(), 1.0), 1.18, [0.0, 0.5], [0.8, 1.0]).shape
    (2, 2)
    """
    return stability_chart(
        system, static_load, pulsating_loads, excitation_frequencies, seed=False
    ).growth.copy()
