"""Growth-rate charts over pulsating load and excitation frequency: the fast path."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import number, numbers
from .floquet import floquet_solution
from .sampler import ChartSampler
from .system import System

__all__ = ["GrowthMap", "growth_map"]

Array = NDArray[np.float64]

_GROWTH_ERROR = 1e-5  # pixels that may be worse are computed again, one by one
_FLOOR = 1e-9  # rounding in a growth rate
_BLOCK = 8192  # pixels worked on together: what a cache holds


@dataclass(frozen=True)
class GrowthMap:
    """Growth rates on a grid with their error bounds.

    Parameters
    ----------
    growth : (R, C) float
        σ [√(EI/(ρAL⁴))], rows along the load, columns along θ̄.
    error : (R, C) float
        Estimated bound on its error; a pixel is unstable where growth > error.
    refined : int
        How many pixels were computed again one by one.
    """

    growth: Array
    error: Array
    refined: int


def _evaluate_all(sampler: ChartSampler, loads: Array, periods: Array) -> tuple[Array, Array]:
    """Return growth and error of the whole grid, periods rising."""
    growth = np.empty((len(loads), len(periods)))
    error = np.empty_like(growth)
    for index, panel in enumerate(sampler.panels):
        columns = periods[panel.columns]
        rows = max(1, _BLOCK // len(columns))
        for start in range(0, len(loads), rows):
            part = slice(start, start + rows)
            functions = sampler.evaluate(index, loads[part], columns)
            growth[part, panel.columns], error[part, panel.columns] = sampler.growth(
                index, functions, loads[part], columns
            )
    return growth, error


def growth_map(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
    density: float = 1.0,
    refine: bool = True,
) -> GrowthMap:
    """Return growth rates on a grid, with the error of each.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²]; the sign does not matter.
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0, in any order.
    density : float
        Nodes and steps relative to the tuned numbers, in [0.3, 3].
    refine : bool
        Compute pixels whose error bound exceeds 1e-5 again by `floquet_solution`.

    Returns
    -------
    GrowthMap
        Rows whose load passes the pole of the exact stiffness are NaN.

    Raises
    ------
    ValueError
        If an argument is not finite, out of range or not 1-d.
    """
    if system.spin_speed.ndim:
        raise ValueError(
            f"`system` must have one spin speed, got an array of shape {system.spin_speed.shape}"
        )
    static = number("static_load", static_load)
    loads = np.abs(numbers("pulsating_loads", pulsating_loads))
    frequencies = numbers("excitation_frequencies", excitation_frequencies, 0.0, open_low=True)
    density = number("density", density, 0.3, 3.0)
    for name, array in (("pulsating_loads", loads), ("excitation_frequencies", frequencies)):
        if array.ndim != 1 or array.size == 0:
            raise ValueError(f"`{name}` must be a list of numbers, got shape {array.shape}")
    growth = np.full((len(loads), len(frequencies)), np.nan)
    error = np.full_like(growth, np.nan)
    rows = np.flatnonzero(static + loads < system_pole(system))
    if static >= system_pole(system) or not rows.size:
        return _frozen(growth, error, 0)
    order = np.argsort(-frequencies, kind="stable")
    periods = 2 * np.pi / frequencies[order]
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        sampler = ChartSampler(system, static, float(loads[rows].max()), periods, density)
        part, slack = _evaluate_all(sampler, loads[rows], periods)
    refined = 0
    if refine:
        with np.errstate(invalid="ignore"):
            doubtful = np.argwhere(~(slack <= _GROWTH_ERROR) | ~np.isfinite(part))
        refined = len(doubtful)
        if refined:
            i, j = doubtful.T
            again = floquet_solution(system, static, loads[rows][i], frequencies[order][j])
            part[i, j], slack[i, j] = again.growth_rate, again.error
    slack = np.maximum(slack, _FLOOR)
    growth[np.ix_(rows, order)] = part
    error[np.ix_(rows, order)] = slack
    return _frozen(growth, error, refined)


def _frozen(growth: Array, error: Array, refined: int) -> GrowthMap:
    """Return the map with read-only arrays."""
    growth.flags.writeable = error.flags.writeable = False
    return GrowthMap(growth, error, refined)


def system_pole(system: System) -> float:
    """Return the load at which the stiffness has a pole, inf for the linear law."""
    if system.exact_shear is None:
        return np.inf
    from .stiffness import largest_exact_load

    return float(largest_exact_load(system.exact_shear))
