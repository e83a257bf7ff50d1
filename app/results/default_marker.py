"""Where the marker stands until the user moves it: inside the tongue 1B+1F, by rule."""

from __future__ import annotations

from itertools import product

import numpy as np

from rotorstab import Resonance, floquet_solution, resonances

from ..reading.user_error import UserError
from ..state import State
from .caches import shared_cache
from .marked_point import Point, point_floquet
from .model import Operation
from .operation import operation_of

__all__ = ["default_marker", "place_marker"]

_PAIR = "1B+1F"
_SHARES = (0.5, 0.35, 0.25, 0.15, 0.08)  # of the height of the chart, tried in turn
_MOST_PAIRS = 2  # that are tried
_MOST_STEPS = 1000  # in one period of the load, so that a slider does not wait
_DIGITS = (2, 4)  # of θ/ω_n: two that a student can type, or four where the tongue is thin


def place_marker(state: State) -> None:
    """Move the marker to its place by rule, unless the user has placed it."""
    if not (state.marker and state.marker_follows):
        return
    try:
        frequency, factor = default_marker(state)
    except UserError:  # these inputs have no chart either, and the page says why
        return
    state.param.update(marker_frequency=frequency, marker_factor=factor)


def default_marker(state: State) -> tuple[float, float]:
    """Return θ/ω_n and β_d of a point inside the tongue 1B+1F, or of another tongue.

    The point lies at the centre of the tongue in the resonance table, at half the height of the
    chart, or lower where Floquet's method finds no growth there, since a tongue bends and with
    damping begins above 0. If 1B+1F makes no tongue in the chart, the strongest one that does is
    taken; if there is none, the centre of 1B+1F.

    Raises
    ------
    UserError
        If the rotor has no reference load, or the exact stiffness law ends below the point.
    """
    frequency_range = state.lowest_frequency, state.highest_frequency
    return _place(operation_of(state), frequency_range, state.largest_factor)


@shared_cache(128)
def _place(
    operation: Operation, frequency_range: tuple[float, float], largest_factor: float
) -> tuple[float, float]:
    system, static = operation.system, operation.static_load
    reference, fundamental = operation.reference_load, operation.fundamental_frequency
    factors = np.array([round(share * largest_factor, 3) for share in _SHARES])
    factors = factors[system.in_charts(static + factors * reference)]
    if not factors.size:
        raise UserError("The stiffness law ends below every point of the chart.")
    table = resonances(system, static, float(factors[0]) * reference)
    low, high = frequency_range
    inside = [row for row in table.tongues if low < row.centre / fundamental < high]
    for row, digits in product(sorted(inside, key=_rank)[:_MOST_PAIRS], _DIGITS):
        centre = round(row.centre / fundamental, digits)
        if point_floquet(Point(operation, centre, float(factors[0]))).unstable:
            return centre, float(factors[0])
        unstable = floquet_solution(
            system, static, factors * reference, centre * fundamental, most_steps=_MOST_STEPS
        ).unstable
        if unstable.any():
            return centre, float(factors[unstable.argmax()])
    centre = round(table[_PAIR].centre / fundamental, _DIGITS[0])
    lowest, highest = State.param["marker_frequency"].bounds
    return min(max(centre, low, lowest), high, highest), float(factors[0])


def _rank(row: Resonance) -> tuple[bool, float]:
    """Return what sorts the tongue 1B+1F first, then the strongest ones."""
    return row.name != _PAIR, -row.growth
