"""The motion and Floquet's answer at one marked point: cached, shared by sessions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rotorstab import (
    TimeResponse,
    initial_conditions,
    time_response,
    whirl_frequencies,
)
from rotorstab.charts import Chart, multiplier_chart, orbit_chart, response_chart
from rotorstab.floquet.point import FloquetSolution, floquet_solution

from ..reading.user_error import UserError
from ..state import INITIAL_CONDITIONS, State
from . import limits
from .caches import shared_cache
from .growth import Motion, motion_of
from .model import Operation
from .operation import check_peak, operation_of

__all__ = [
    "EDGE",
    "Point",
    "PointAnswer",
    "Start",
    "accurate_floquet",
    "marked_point",
    "point_floquet",
    "solve_point",
]

EDGE = 8.0
"""Displacement of the tip, in the units of its start, at which it leaves the picture of the shaft.

A knock gives a whirl of some 0.7: at this fixed scale it is small, and growth can be seen."""
_PERIODS = (24, 40)  # most periods shown if none are wanted: of a stable motion, of one that grows
_FEWEST_PERIODS = 6
_LARGEST_GROWTH = 500.0  # ln of the growth over the time shown, within double precision
_SAMPLES = (24, 600)  # fewest and most samples in one period
_SAMPLES_PER_CYCLE = 10  # of the fastest whirl
_STEPS_PER_SAMPLE = 5  # at least
# errors of ln|μ| and of one sample of the motion above which nothing is shown
_RATE_ERROR, _MOTION_ERROR = 1e-4, 1e-6
_SMALLER_LOAD = "choose a smaller load factor β_d"
_TOO_SLOW = (
    "At this frequency one period needs more steps than the server computes. Choose a higher θ/ωₙ."
)


@dataclass(frozen=True)
class Point:
    """One point of the instability chart of a rotor in operation.

    Parameters
    ----------
    operation : Operation
    ratio, factor : float
        θ/ω_n and β_d.
    """

    operation: Operation
    ratio: float
    factor: float

    @property
    def loads(self) -> tuple[float, float]:
        """Static and pulsating load, p̄₀ and p̄_t [EI/L²]."""
        return self.operation.static_load, self.operation.pulsating_load(self.factor)

    @property
    def excitation(self) -> float:
        """θ̄ [√(EI/(ρAL⁴))]."""
        return self.operation.excitation_frequency(self.ratio)


@dataclass(frozen=True)
class Start:
    """How the motion at a point starts, and for how long it is shown.

    Parameters
    ----------
    initial : str
        As `initial_conditions` names it, such as "knock" or "mode:1F".
    seed : int
        Of the noise; 0 with any other start.
    periods : int
        Periods of the load that are wanted; 0 for as many as the motion needs to reach `EDGE`.
    """

    initial: str
    seed: int
    periods: int


@dataclass(frozen=True, eq=False)
class PointAnswer:
    """What the solver has at a point.

    Parameters
    ----------
    response : TimeResponse
        Until the displacement passes `EDGE` if no number of periods was wanted.
    floquet : FloquetSolution
    samples : int
        Of the response, in one period.
    charts : dict of str to Chart
        Non-dimensional, by key.
    """

    response: TimeResponse
    floquet: FloquetSolution
    samples: int
    charts: dict[str, Chart]


@shared_cache(64)
def solve_point(point: Point, start: Start) -> PointAnswer:
    """Return the response, Floquet's answer and the charts of a point.

    Raises
    ------
    UserError
        Where one period takes more work than the server has time for, and where the load is past
        the end of the stiffness law.
    """
    operation, system = point.operation, point.operation.system
    fastest = _fastest(operation)
    if fastest > limits.MOST_CYCLES * point.excitation:
        raise UserError(
            f"The whirl makes {fastest / point.excitation:.0f} cycles in one period of this load, "
            f"more than the server computes ({limits.MOST_CYCLES}). Choose a higher θ/ωₙ."
        )
    floquet = accurate_floquet(point)
    state = initial_conditions(system, operation.static_load, start.initial, start.seed)
    steps, period = _most_steps(point), float(floquet.period)
    samples = int(np.clip(_SAMPLES_PER_CYCLE * fastest / point.excitation, *_SAMPLES))
    samples = max(_SAMPLES[0], min(samples, steps // _STEPS_PER_SAMPLE))
    neutral = motion_of(floquet) is Motion.NEITHER
    growth = 0.0 if neutral else float(floquet.growth_rate) * period
    periods = max(1, min(_periods(start.periods, growth), limits.MOST_SAMPLES // samples))
    try:
        response = time_response(
            system, *point.loads, point.excitation, state, periods, samples, most_steps=steps
        )
    except ValueError:
        raise UserError(_TOO_SLOW) from None
    if not response.error < _MOTION_ERROR:
        raise UserError(_TOO_SLOW)
    if not start.periods:
        response = response.until(EDGE)
    charts = response_chart(response), multiplier_chart(floquet), orbit_chart(response)
    return PointAnswer(response, floquet, samples, {chart.key: chart for chart in charts})


@shared_cache(64)
def point_floquet(point: Point) -> FloquetSolution:
    """Return Floquet's answer at one point, with as many steps as the server has time for."""
    return floquet_solution(
        point.operation.system, *point.loads, point.excitation, most_steps=_most_steps(point)
    )


def marked_point(state: State) -> tuple[Point, Start]:
    """Return the marked point of the present inputs, and how its motion starts.

    Raises
    ------
    UserError
        Where the rotor has no load that the load factors refer to.
    """
    seed = round(state.seed) if state.initial == "noise" else 0
    return (
        Point(operation_of(state), state.marker_frequency, state.marker_factor),
        Start(INITIAL_CONDITIONS[state.initial], seed, round(state.periods)),
    )


def accurate_floquet(point: Point) -> FloquetSolution:
    """Return Floquet's answer at one point where the steps suffice.

    Raises
    ------
    UserError
        Where they do not, and where the load is past the end of the stiffness law.
    """
    check_peak(point.operation, point.factor, _SMALLER_LOAD)
    found = point_floquet(point)
    if not (found.converged or float(found.error * found.period) < _RATE_ERROR):
        raise UserError(_TOO_SLOW)
    return found


def _periods(wanted: int, growth: float) -> int:
    """Return how many periods of the load are shown; `growth` is σT."""
    stable, growing = _PERIODS
    if not wanted:
        # from half a unit to the edge, or as far down
        needed = math.log(2 * EDGE) / abs(growth) if growth else math.inf
        if growth > 0:
            # more than are needed: the response ends at the edge
            return math.ceil(min(growing, 1.5 * needed + 2))
        return math.ceil(min(stable, max(_FEWEST_PERIODS, needed)))
    return min(wanted, int(_LARGEST_GROWTH / growth)) if growth > 0 else wanted


def _most_steps(point: Point) -> int:
    """Return how many steps of a period the server's one thread has time for."""
    law = point.operation.system.law
    if law is None:
        return limits.MOST_STEPS[point.operation.model.kind]
    harmonics = law.harmonic_count(*np.array(point.loads))
    return int(limits.LAW_STEPS / (1 + harmonics / limits.LAW_HARMONICS))


@shared_cache(64)
def _fastest(operation: Operation) -> float:
    """Return the largest whirl frequency of the first two modes each way."""
    values = whirl_frequencies(operation.system, operation.static_load).real
    half = len(values) // 2
    return float(np.abs(values[max(0, half - 2) : half + 2]).max())
