"""One set of inputs, and the results that a quantity needs, computed when it is evaluated."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from rotorstab import (
    CriticalSpeeds,
    Resonance,
    ResonanceTable,
    ShaftDisk,
    bolotin_chart,
    critical_speeds,
    mean_is_unstable,
    resonances,
    whirl_frequencies,
)
from rotorstab.floquet.point import FloquetSolution
from rotorstab.whirl.mode_names import mode_names, named_frequencies

from ..reading.user_error import UserError
from ..results.marked_point import Point, accurate_floquet
from ..results.model import Operation
from ..results.operation import operation_of
from ..state import State

__all__ = ["LARGEST_LOAD", "Situation"]

LARGEST_LOAD = 6.0
"""Largest magnitude of a case's own static load [EI/L²]."""
_LEAST_PULSATION = 1e-6  # p̄_t [EI/L²]: Bolotin's boundaries are followed from 0 up to a load
_BOUNDARY_POINTS = 24  # of each of them
_SPEEDS = 401  # of the first search for the spin limit, over the slider's range
_FINER_SPEEDS = 65  # of each search after it, between two of the speeds before
_SEARCHES = 3


class Situation:
    """One set of inputs and what follows from them; every result is computed once, when needed.

    Parameters
    ----------
    inputs : mapping
        Every input of `State`, by name.
    load : float or None
        Static load p̄₀ instead of α_s times the reference [EI/L²].
    """

    def __init__(self, inputs: Mapping[str, Any], load: float | None = None) -> None:
        self.inputs = dict(inputs)
        self._state, self._load = State(**inputs), load

    @property
    def rotor(self) -> ShaftDisk:
        """The rotor."""
        return self._state.rotor()

    @property
    def spin(self) -> float:
        """Ω̄."""
        return float(self._state.spin_speed)

    @cached_property
    def operation(self) -> Operation:
        """The rotor in operation; UserError where it has no load that the factors refer to."""
        return operation_of(self._state, self._load)

    @property
    def point(self) -> Point:
        """The marked point."""
        state = self._state
        return Point(self.operation, state.marker_frequency, state.marker_factor)

    @property
    def fundamental(self) -> float:
        """ω_n: the charts show θ̄ divided by it."""
        return self.operation.fundamental_frequency

    @property
    def reference(self) -> float:
        """The load that the factors α_s and β_d are shares of."""
        return self.operation.reference_load

    @property
    def static(self) -> float:
        """p̄₀: the case's own load, else α_s times the reference."""
        return self.operation.static_load

    @property
    def pulsating(self) -> float:
        """p̄_t at β_d of the marked point."""
        return self.point.loads[1]

    @property
    def frequency(self) -> float:
        """θ̄ at the marked point."""
        return self.point.excitation

    @cached_property
    def table(self) -> ResonanceTable:
        """Every pair of modes at β_d of the marked point."""
        return resonances(self.operation.system, self.static, self.pulsating)

    @cached_property
    def floquet(self) -> FloquetSolution:
        """Floquet's answer at the marked point, the same that the page shows."""
        return accurate_floquet(self.point)

    @cached_property
    def speeds(self) -> CriticalSpeeds:
        """Critical speeds at p̄₀."""
        return critical_speeds(self.operation.system, self.static)

    def whirl(self, mode: str) -> complex:
        """Return a mode's complex frequency, followed from no load as in the charts."""
        names = mode_names(self.operation.system.size)
        if mode not in names:
            raise UserError(f"this model has no mode {mode}")
        return complex(named_frequencies(self.operation.system, self.static)[names.index(mode)])

    def pair(self, name: str) -> Resonance:
        """Return the row of a pair of modes."""
        return self.table[name]

    def boundary(self, mode: str) -> float:
        """Return Bolotin's boundary of a mode at β_d of the marked point, in θ̄."""
        largest = max(self.pulsating, _LEAST_PULSATION)
        chart = bolotin_chart(self.operation.undamped, self.static, largest, _BOUNDARY_POINTS)
        if mode not in chart.names:
            raise UserError(f"this model has no mode {mode}")
        return float(chart.frequency[-1, chart.names.index(mode)])

    def spin_limit(self) -> float:
        """Return the lowest spin speed at which a whirl grows by itself; inf if none is found."""
        speeds = np.linspace(0.0, float(State.param.spin_speed.bounds[1]), _SPEEDS)
        for _ in range(_SEARCHES):
            roots = whirl_frequencies(self.operation.system.at_speed(speeds), self.static)
            grows = np.flatnonzero(mean_is_unstable(roots))
            if not grows.size:
                return math.inf
            first = int(grows[0])
            if first == 0:
                return float(speeds[0])
            speeds = np.linspace(speeds[first - 1], speeds[first], _FINER_SPEEDS)
        return float(speeds[_FINER_SPEEDS // 2])
