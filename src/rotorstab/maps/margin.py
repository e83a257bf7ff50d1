"""The smallest pulsating load that destabilises: at a frequency, over a band, overall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._arguments import number, numbers
from ..floquet.resonance import ResonanceTable, resonances
from ..floquet.tongues.crossings import Plane, first_crossings
from ..floquet.tongues.lowest_load import HIGHEST_ORDER, lowest_load
from ..model.system import System

__all__ = ["CriticalPulsation", "StabilityMargin", "critical_pulsation", "stability_margin"]

Array = NDArray[np.float64]

_UNSTABLE = 1e-8  # growth rate above which the mean rotor is unstable by itself
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
        for k in range(1, HIGHEST_ORDER + 1)
    ]
    if not choices:
        return "", 0
    _, name, order = min(choices)
    return name, order


def _plane(system: System, static_load: float, largest_load: float) -> tuple[Plane, float]:
    """Return what both functions look at, from checked arguments."""
    static = number("static_load", static_load)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    system.load_harmonics(static, largest)  # refuses a load past the pole of the exact law
    return Plane(system, static, resonances(system, static, 0.0)), largest


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
    Each frequency is looked at by itself: at 10 to 80 loads, at the first-order crossings of the
    resonance table, and where two multipliers come closest between them, so that a tongue need
    not be open at a scanned load. The crossing is refined to 1e-9 on single points. Without
    damping a growth rate below 1e-6 does not count. A tongue may be missed where more than
    three pairs of multipliers come close at one load, or where multipliers turn by about one
    radian or more from one scanned load to the next: at θ̄ far below the whirl frequencies.
    One that is narrower than the distance of the scanned loads may also be missed where several
    pairs come close between two of them: in 4 of 820 cases of random rotors with little damping
    or none, at θ̄ of 0.5 to 5 fundamental frequencies, against a scan of 80 to 640 loads.
    """
    plane, largest = _plane(system, static_load, largest_load)
    table = plane.table
    theta = np.array(numbers("excitation_frequencies", excitation_frequencies, 0.0, open_low=True))
    if theta.ndim != 1 or theta.size == 0:
        raise ValueError(
            f"`excitation_frequencies` must be a list of numbers, got shape {theta.shape}"
        )
    critical = np.zeros_like(theta)
    if table.mean_growth <= _UNSTABLE:
        critical = first_crossings(plane, theta, np.full(theta.shape, largest))
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
        Undamped, 0 at the strongest first-order tongue rooted in the band; 0 at the lowest
        frequency if the mean system is unstable by itself.

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    The tip of each tongue of the resonance table is refined on single points (growth 0 and
    ∂growth/∂θ̄ = 0), with damping to 1e-6 or better. The ends of the band count with their own
    crossings, so a tongue rooted outside is seen where it enters. What no first-order tongue
    explains is then looked for at loads below, unless they are too small for second-order growth
    to overcome the damping (by an estimate with a factor of 30): in 160 frequencies, and near every
    θ̄ = |ω_i − ω_j|/k up to k = 6, where the place at which two multipliers come closest is
    followed. A tongue of higher order counts as far as the 160 frequencies see it, and a band
    of growth that opens and closes again between the loads looked at may be missed.

    Without damping, or with a decay below 1e-6, tongues of order k ≥ 2 reach down to p̄_t = 0
    in thin cusps: they count from the load at which they grow faster than 1e-6.
    """
    plane, largest = _plane(system, static_load, largest_load)
    table = plane.table
    low = number("lowest_frequency", lowest_frequency, 0.0, open_low=True)
    high = number("highest_frequency", highest_frequency, low, open_low=True)
    if table.mean_growth > _UNSTABLE:
        return StabilityMargin(0.0, low, "", 0)
    roots = [row for row in table.tongues if row.threshold == 0 and low <= row.centre <= high]
    if roots:
        best = max(roots, key=lambda row: row.growth_per_load)
        return StabilityMargin(0.0, best.centre, best.name, 1)
    margin = lowest_load(plane, (low, high), largest)
    if not np.isfinite(margin.load):
        return StabilityMargin(np.inf, np.nan, "", 0)
    name, order = _nearest(table, margin.frequency, margin.load)
    return StabilityMargin(margin.load, margin.frequency, name, order)
