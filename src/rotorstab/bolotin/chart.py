"""Bolotin's boundaries and regions as curves and polygons over the pulsating load."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from .._arguments import number, whole_number
from .._types import Array, Complex, Index
from ..model.system import System, single_speed
from ..whirl.tracking import track
from .boundaries import boundary_squares, frequencies_of_squares, real_squares
from .boundary_names import boundary_names

__all__ = ["BolotinChart", "bolotin_chart"]

_GRADING = np.linspace(0.0, 1.0, 17)[1:-1] ** 2  # of the rows added where a boundary turns
_PARTS = np.linspace(0.0, 1.0, 257)  # of an interval in which a boundary turns or ends
_NARROWINGS = 3  # by 256 each: 6e-8 of the interval is left


@dataclass(frozen=True, eq=False)
class BolotinChart:
    """Bolotin's boundaries and regions over a range of pulsating loads.

    Parameters
    ----------
    pulsating_load : (m,) float
        Ascending p̄_t [EI/L²]; closer where a boundary turns or ends.
    frequency : (m, 2n) float
        θ̄ of each boundary [√(EI/(ρAL⁴))], a column each, NaN where it is not real.
    names : tuple of str
        The whirl mode that each boundary starts from, θ̄ = 2|ω| at p̄_t = 0.
    regions : tuple of (k, 2) float arrays
        Closed polygons (θ̄, p̄_t) whose union is the Bolotin region {P < 0} of Eq. (24).
    """

    pulsating_load: Array
    frequency: Array
    names: tuple[str, ...]
    regions: tuple[Array, ...]


def bolotin_chart(
    system: System, static_load: float, largest_pulsating_load: float, rows: int = 120
) -> BolotinChart:
    """Return the boundaries by mode and the regions for p̄_t from 0 to a largest value.

    Parameters
    ----------
    system : System
        It has one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    largest_pulsating_load : float
        Above 0 [EI/L²].
    rows : int
        Number of even loads to begin with, 8 to 100 000. More are added where boundaries turn or
        end.

    Returns
    -------
    BolotinChart
        No boundaries (NaN) and no regions for a damped rotor that spins.

    Raises
    ------
    ValueError
        If an argument is out of range, the system has several spin speeds, or the load passes the
        pole of the stiffness.

    References
    ----------
    Eqs. (21)–(24) of the source paper.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> bolotin_chart(lumped(ShaftDisk(), 2.0), 0.0, 1.0).names
    ('1B', '1F', '2B', '2F')
    """
    static = np.array(number("static_load", static_load))
    single_speed(system)
    largest = number("largest_pulsating_load", largest_pulsating_load, 0.0, open_low=True)
    loads, squares = _rows(system, static, largest, whole_number("rows", rows, 8, 100_000))
    names = boundary_names(system, static, squares)
    regions = _polygons(loads, real_squares(squares))
    if system.spin_matrix().any():
        squares = track(squares)
    return BolotinChart(loads, frequencies_of_squares(real_squares(squares)), names, regions)


def _rows(system: System, static: Array, largest: float, rows: int) -> tuple[Array, Complex]:
    """Return loads and their λ, with graded rows on both sides of each end of a boundary."""
    loads = np.linspace(0.0, largest, rows)
    squares = boundary_squares(system, static, loads)
    status = _status(squares)
    changes = np.flatnonzero(status[1:] != status[:-1])
    if not changes.size:
        return loads, squares
    left, right = loads[changes], loads[changes + 1]
    low, high = _narrowed(system, static, left, right, status[changes])
    # θ̄ turns as a square root there: quadratic grading on both sides
    below = low - np.outer(_GRADING, low - left)
    above = high + np.outer(_GRADING, right - high)
    extra = np.concatenate([low, high, *below, *above])
    loads, kept = np.unique(np.concatenate([loads, extra]), return_index=True)
    return loads, np.concatenate([squares, boundary_squares(system, static, extra)])[kept]


def _status(squares: Complex) -> Index:
    """Return a number for each row that changes where a boundary ends.

    It is 100 times the number of real λ plus the number of positive ones.
    """
    values = real_squares(squares)
    if values.min() > 0:  # false with a NaN
        return np.full(len(values), 101 * values.shape[1])
    return np.asarray((~np.isnan(values)).sum(axis=1) * 100 + (values > 0).sum(axis=1))


def _narrowed(
    system: System, static: Array, low: Array, high: Array, status: Index
) -> tuple[Array, Array]:
    """Narrow intervals of loads to the first change from the status at their lower ends."""
    index = np.arange(low.size)
    for _ in range(_NARROWINGS):
        trial = low[:, None] + (high - low)[:, None] * _PARTS
        codes = _status(boundary_squares(system, static, trial.ravel())).reshape(trial.shape)
        # the status at both ends is known
        same = codes[:, 1:-1] == status[:, None]
        first = (~same).argmax(axis=1) + 1
        first[same.all(axis=1)] = _PARTS.size - 1
        low, high = trial[index, first - 1], trial[index, first]
    return low, high


def _polygons(loads: Array, squares: Array) -> tuple[Array, ...]:
    """Return the polygons of {P < 0}: between the 1st and 2nd, 3rd and 4th … real root."""
    squares = np.sort(squares, axis=1)  # NaN last
    frequency = 2 * np.sqrt(np.maximum(squares, 0.0))
    count = (~np.isnan(squares)).sum(axis=1)
    polygons = []
    ends = [0, *(np.flatnonzero(count[1:] != count[:-1]) + 1).tolist(), len(loads)]
    for start, stop in itertools.pairwise(ends):
        rows = stop - start
        for k in range(0, int(count[start]) - 1, 2):
            left, right = frequency[start:stop, k], frequency[start:stop, k + 1]
            if rows > 1 and right.max() > 0:
                polygon = np.empty((2 * rows, 2))
                polygon[:rows, 0], polygon[rows:, 0] = left, right[::-1]
                polygon[:rows, 1], polygon[rows:, 1] = loads[start:stop], loads[start:stop][::-1]
                polygons.append(polygon)
    return tuple(polygons)
