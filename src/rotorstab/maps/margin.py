"""The smallest pulsating load that destabilises: at a frequency, over a band, overall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._arguments import number, numbers
from .._types import Array, ArrayLike, Index
from ..floquet.resonance import resonances
from ..floquet.resonance_table import ResonanceTable
from ..floquet.tongues.band_threshold import lowest_threshold
from ..floquet.tongues.crossings import first_crossings
from ..floquet.tongues.plane import Plane
from ..model.system import System

__all__ = ["CriticalPulsation", "StabilityMargin", "critical_pulsation", "stability_margin"]

_REACH = 2.0  # first-order half-widths within which a tongue of order 1 is named
_SMALLEST_LOAD = 1e-12  # p̄_t added to a load of 0, by which half-widths are divided


@dataclass(frozen=True)
class CriticalPulsation:
    """Smallest destabilising pulsating load, frequency by frequency.

    Parameters
    ----------
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))].
    pulsating_load : (C,) float
        p̄_t [EI/L²]; inf where no load up to the largest destabilises, 0 where the mean system is
        unstable by itself.
    pairs : tuple of str
        Mode pair of the nearest resonance, such as "1B+1F"; "" where the load is inf.
    orders : (C,) int
        Its order k in θ̄ = |ω_i − ω_j|/k.
    """

    excitation_frequencies: Array
    pulsating_load: Array
    pairs: tuple[str, ...]
    orders: Index


@dataclass(frozen=True)
class StabilityMargin:
    """Smallest destabilising pulsating load over a band of frequencies, and where it lies.

    Parameters
    ----------
    pulsating_load : float
        p̄_t [EI/L²]; inf if no load up to the largest destabilises.
    excitation_frequency : float
        θ̄ of that load [√(EI/(ρAL⁴))]; NaN if there is none.
    pair : str
        Mode pair of the tongue, such as "1B+1F"; "" if there is none, and where the mean system is
        unstable by itself.
    order : int
        Order k of the tongue in θ̄ = |ω_i − ω_j|/k.
    """

    pulsating_load: float
    excitation_frequency: float
    pair: str
    order: int


def _nearest(table: ResonanceTable, frequency: float, load: float) -> tuple[str, int]:
    """Return pair and order of the tongue that explains an instability at a frequency and load."""
    # by the strength without damping: a damped tongue beyond its threshold may still be the cause
    first = [
        (abs(row.centre - frequency) / (2 * row.growth_per_load * load), row.name)
        for row in table
        if row.growth_per_load > 0 and row.centre > 0
    ]
    if first and min(first)[0] < _REACH:
        return min(first)[1], 1
    nearest = table.nearest(frequency)
    return (nearest[0].name, nearest[1]) if nearest else ("", 0)


def _plane(system: System, static_load: float, largest_load: float) -> tuple[Plane, float]:
    """Return the load–frequency plane and the largest load, from checked arguments."""
    static = number("static_load", static_load)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    if system.law is not None:
        system.law.refuse_peaks(np.asarray(static), np.asarray(largest))
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
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0.
    largest_load : float
        Largest p̄_t considered [EI/L²], above 0.

    Returns
    -------
    CriticalPulsation

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    Each frequency is searched by itself: at 10 to 80 loads, at the first-order crossings of the
    resonance table, and where two multipliers come closest between them, so that a tongue is found
    even if it is open at none of these loads. The crossing is refined to 1e-9 on single points.
    Without damping a growth rate below 1e-6 does not count.

    A tongue may be missed where more than three pairs of multipliers come close at one load; where
    multipliers turn by about one radian or more from one load to the next, that is at θ̄ far below
    the whirl frequencies; and where it is narrower than the distance of the loads and several
    pairs come close between two of them. The last happened in 4 of 820 cases of random rotors with
    little damping or none, at θ̄ of 0.5 to 5 fundamental frequencies, against a scan of 80 to 640
    loads.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> found = critical_pulsation(lumped(ShaftDisk(), 2.0), 1.178, [1.0, 3.2], 2.0)
    >>> found.pulsating_load.round(4).tolist(), found.pairs
    ([0.7012, inf], ('1B+1F', ''))
    """
    plane, largest = _plane(system, static_load, largest_load)
    table = plane.table
    theta = np.array(numbers("excitation_frequencies", excitation_frequencies, 0.0, open_low=True))
    if theta.ndim != 1 or theta.size == 0:
        raise ValueError(
            f"`excitation_frequencies` must be a list of numbers, got shape {theta.shape}"
        )
    critical = np.zeros_like(theta)
    if not table.mean_is_unstable:
        critical = first_crossings(plane, theta, np.full(theta.shape, largest))
    named = [
        _nearest(table, float(f), float(p) + _SMALLEST_LOAD) if np.isfinite(p) else ("", 0)
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
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    lowest_frequency, highest_frequency : float
        The band of θ̄ [√(EI/(ρAL⁴))], above 0.
    largest_load : float
        Largest p̄_t considered [EI/L²], above 0.

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
    The lowest point of each tongue of the resonance table is refined on single points (growth 0 and
    ∂growth/∂θ̄ = 0), with damping to 1e-6 or better. The ends of the band count with their own
    crossings, so a tongue with its root outside is found where it enters the band.

    Smaller loads are then searched for what no first-order tongue explains, unless they are too
    small for second-order growth to overcome the damping (by an estimate with a factor of 30). The
    search covers 160 frequencies and the places near θ̄ = |ω_i − ω_j|/k, up to k = 6, at which two
    multipliers come closest. Tongues of higher order are found only where one of the 160
    frequencies lies in them; unstable ground that opens and closes again between the searched loads
    may be missed.

    Without damping, or with a decay below 1e-6, tongues of order k ≥ 2 reach down to p̄_t = 0 as
    thin cusps: they count from the load at which they grow faster than 1e-6.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> system = lumped(ShaftDisk(), 2.0, external_damping=0.01)
    >>> margin = stability_margin(system, 1.178, 0.8, 2.0, 2.0)
    >>> round(margin.pulsating_load, 4), margin.pair
    (0.0561, '1B+1F')
    """
    plane, largest = _plane(system, static_load, largest_load)
    table = plane.table
    low = number("lowest_frequency", lowest_frequency, 0.0, open_low=True)
    high = number("highest_frequency", highest_frequency, low, open_low=True)
    if table.mean_is_unstable:
        return StabilityMargin(0.0, low, "", 0)
    roots = [row for row in table.tongues if row.threshold == 0 and low <= row.centre <= high]
    if roots:
        best = max(roots, key=lambda row: row.growth_per_load)
        return StabilityMargin(0.0, best.centre, best.name, 1)
    lowest = lowest_threshold(plane, (low, high), largest)
    if not np.isfinite(lowest.load):
        return StabilityMargin(np.inf, np.nan, "", 0)
    name, order = _nearest(table, lowest.frequency, lowest.load)
    return StabilityMargin(lowest.load, lowest.frequency, name, order)
