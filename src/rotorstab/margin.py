"""The smallest pulsating load that destabilises: at a frequency, over a band, overall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import number, numbers
from .floquet import floquet_solution
from .resonance import ResonanceTable, resonances
from .stability import stability_chart
from .system import System
from .tongues import bracketed_roots, edge_function

__all__ = ["CriticalPulsation", "StabilityMargin", "critical_pulsation", "stability_margin"]

Array = NDArray[np.float64]

_ROWS = 160  # loads scanned before the first crossing is refined
_COLUMNS = 161  # frequencies scanned over a band
_ORDERS = 6  # highest θ̄ = |ω_i − ω_j|/k named
_ZOOMS = 4
_REACH = 2.0  # first-order half-widths within which the simple resonance is named


@dataclass(frozen=True)
class CriticalPulsation:
    """Smallest destabilising pulsating load, frequency by frequency.

    Parameters
    ----------
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))].
    pulsating_load : (C,) float
        p̄_t [EI/L²]; inf where none up to the largest load does, 0 where the mean system is
        unstable by itself.
    pairs : tuple of str
        The nearest resonance, such as "1B+1F", or "" where there is none.
    orders : (C,) int
        Its order k in θ̄ = |ω_i − ω_j|/k.
    """

    excitation_frequencies: Array
    pulsating_load: Array
    pairs: tuple[str, ...]
    orders: NDArray[np.intp]


@dataclass(frozen=True)
class StabilityMargin:
    """Smallest destabilising pulsating load over a band, and its place.

    Parameters
    ----------
    pulsating_load : float
        p̄_t [EI/L²]; inf if none up to the largest load.
    excitation_frequency : float
        θ̄ where; NaN if none.
    pair : str
        The mode pair, "" if none.
    order : int
        Its order k.
    """

    pulsating_load: float
    excitation_frequency: float
    pair: str
    order: int


def _nearest(table: ResonanceTable, frequency: float, load: float) -> tuple[str, int]:
    """Return the tongue and order behind an instability at one frequency and load."""
    # by strength without damping: a damped tongue beyond its threshold may still be the cause
    rows = [row for row in table if row.growth_per_load > 0 and row.centre > 0]
    first = [
        (abs(row.centre - frequency) / (2 * row.growth_per_load * load), row.name) for row in rows
    ]
    if first and min(first)[0] < _REACH:
        return min(first)[1], 1
    choices = [
        (abs(np.log(row.centre / k / frequency)) * k, row.name, k)
        for row in rows
        for k in range(1, _ORDERS + 1)
    ]
    if not choices:
        return "", 0
    _, name, order = min(choices)
    return name, order


def _crossings(
    system: System, static: float, frequencies: Array, largest: float, rows: int
) -> Array:
    """Return the first load at which each frequency becomes unstable, inf if none."""
    loads = largest * np.arange(rows + 1) / rows
    chart = stability_chart(system, static, loads, frequencies, seed=False)
    with np.errstate(invalid="ignore"):
        unstable = chart.growth > chart.error
    found = unstable.any(axis=0)
    first = unstable.argmax(axis=0)
    critical = np.where(found, 0.0, np.inf)
    refine = np.flatnonzero(found & (first > 0))
    theta, static_value = frequencies[refine], static
    root = bracketed_roots(
        lambda load, i: edge_function(system, static_value, load, theta[i]),
        loads[first[refine]],
        loads[first[refine] - 1],
    )
    # a sign that the refinement cannot see keeps the row's load
    critical[refine] = np.where(np.isfinite(root), root, loads[first[refine]])
    return critical


def critical_pulsation(
    system: System,
    static_load: float,
    excitation_frequencies: ArrayLike,
    largest_load: float,
) -> CriticalPulsation:
    """Return the smallest pulsating load that destabilises at each excitation frequency.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load : float
        p̄₀ [EI/L²].
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0.
    largest_load : float
        Largest p̄_t looked at [EI/L²], above 0.

    Returns
    -------
    CriticalPulsation

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    Found on 160 loads, then refined to 1e-9. A tongue that a frequency crosses over less than
    a 160th of the largest load may be missed.
    """
    static = number("static_load", static_load)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    theta = np.array(numbers("excitation_frequencies", excitation_frequencies, 0.0, open_low=True))
    critical = _crossings(system, static, theta, largest, _ROWS)
    table = resonances(system, static, largest)
    named = [
        _nearest(table, float(f), float(p) + 1e-12) if np.isfinite(p) else ("", 0)
        for f, p in zip(theta, critical, strict=True)
    ]
    orders = np.array([order for _, order in named], dtype=np.intp)
    for array in (theta, critical, orders):
        array.flags.writeable = False
    return CriticalPulsation(theta, critical, tuple(name for name, _ in named), orders)


def stability_margin(
    system: System,
    static_load: float,
    lowest_frequency: float,
    highest_frequency: float,
    largest_load: float,
) -> StabilityMargin:
    """Return the smallest destabilising pulsating load over a band of excitation frequencies.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load : float
        p̄₀ [EI/L²].
    lowest_frequency, highest_frequency : float
        The band of θ̄ [√(EI/(ρAL⁴))], above 0.
    largest_load : float
        Largest p̄_t looked at [EI/L²].

    Returns
    -------
    StabilityMargin
        Undamped, 0 at the strongest tongue rooted in the band.

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    Undamped tongues of order k ≥ 2 also reach p̄_t = 0, in cusps too thin to matter under any
    damping; they count only as far as the scan of 161 frequencies sees them.
    """
    static = number("static_load", static_load)
    low = number("lowest_frequency", lowest_frequency, 0.0, open_low=True)
    high = number("highest_frequency", highest_frequency, low, open_low=True)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    table = resonances(system, static, largest)
    if float(floquet_solution(system, static, 0.0, high).growth_rate) > 1e-8:
        return StabilityMargin(0.0, low, "", 0)
    roots = [row for row in table.tongues if row.threshold == 0 and low <= row.centre <= high]
    if roots:
        best = max(roots, key=lambda row: row.growth_per_load)
        return StabilityMargin(0.0, best.centre, best.name, 1)
    inside = [row.centre for row in table if low <= row.centre <= high and row.growth_per_load > 0]
    theta = np.unique(np.concatenate([np.linspace(low, high, _COLUMNS), inside]))
    critical = _crossings(system, static, theta, largest, _ROWS)
    for _ in range(_ZOOMS):
        k = int(np.argmin(critical))
        if not np.isfinite(critical[k]):
            return StabilityMargin(np.inf, np.nan, "", 0)
        ends = theta[max(k - 1, 0)], theta[min(k + 1, len(theta) - 1)]
        best_theta, best_load = theta[k], critical[k]
        theta = np.unique(np.append(np.linspace(*ends, 17), best_theta))
        critical = _crossings(system, static, theta, float(best_load) * 1.02, 8)
    k = int(np.argmin(critical))
    name, order = _nearest(table, float(theta[k]), float(critical[k]) + 1e-12)
    return StabilityMargin(float(critical[k]), float(theta[k]), name, order)
