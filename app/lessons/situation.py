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
    System,
    bolotin_chart,
    critical_load,
    critical_speeds,
    fundamental_frequency,
    lumped,
    mean_is_unstable,
    resonances,
    whirl_frequencies,
)
from rotorstab.floquet.point import FloquetSolution, floquet_solution
from rotorstab.whirl.mode_names import mode_names, named_frequencies

from ..results.curves import reference_load
from ..results.model import model_of
from ..state import State

__all__ = ["LARGEST_LOAD", "Situation"]

LARGEST_LOAD = 6.0
"""Largest magnitude of a case's own steady load [EI/L²]."""


class Situation:
    """One set of inputs and what follows from them; every result is computed once, when needed.

    Parameters
    ----------
    inputs : mapping
        Every input of `State`, by name.
    load : float or None
        Steady load p̄₀ instead of α_s times the reference [EI/L²].
    """

    def __init__(self, inputs: Mapping[str, Any], load: float | None = None) -> None:
        state = State(**inputs)
        self.inputs = dict(inputs)
        self.rotor = state.rotor()
        self.spin = state.spin_speed
        self.tangency = state.effective_tangency()
        self.model = model_of(state)
        self._factor = state.static_load_factor
        self._own_load = load
        self._reference = state.reference
        self.at_rest = lumped(self.rotor, 0.0, 1.0)

    @cached_property
    def system(self) -> System:
        """The system of the charts."""
        return self.model.system(self.spin, self.tangency)

    @cached_property
    def undamped(self) -> System:
        """The system without damping, which is what Bolotin's method is for."""
        return self.model.undamped().system(self.spin, self.tangency)

    @cached_property
    def fundamental(self) -> float:
        """ω_n: the charts show θ̄ divided by it."""
        return fundamental_frequency(self.at_rest)

    @cached_property
    def buckling(self) -> float:
        """Static buckling load p̄_cr."""
        return float(critical_load(self.rotor.shear))

    @cached_property
    def reference(self) -> float:
        """The load that the factors α_s and β_d are shares of."""
        return reference_load(self.rotor, self._reference)

    @cached_property
    def static(self) -> float:
        """p̄₀: the case's own load, else α_s times the reference."""
        return self._factor * self.reference if self._own_load is None else self._own_load

    @cached_property
    def pulsating(self) -> float:
        """p̄_t at the marker's β_d."""
        return float(self.inputs["marker_factor"]) * self.reference

    @cached_property
    def frequency(self) -> float:
        """θ̄ at the marker."""
        return float(self.inputs["marker_frequency"]) * self.fundamental

    @cached_property
    def table(self) -> ResonanceTable:
        """Every pair of modes at the marker's β_d."""
        return resonances(self.system, self.static, self.pulsating)

    @cached_property
    def floquet(self) -> FloquetSolution:
        """Floquet's answer at the marker."""
        return floquet_solution(self.system, self.static, self.pulsating, self.frequency)

    @cached_property
    def speeds(self) -> CriticalSpeeds:
        """Critical speeds at p̄₀."""
        return critical_speeds(self.system, self.static)

    def whirl(self, mode: str) -> complex:
        """Return a mode's complex frequency, followed from no load as in the charts."""
        names = mode_names(self.system.size)
        if mode not in names:
            raise ValueError(f"this model has no mode {mode}")
        return complex(named_frequencies(self.system, self.static)[names.index(mode)])

    def pair(self, name: str) -> Resonance:
        """Return the row of a pair of modes."""
        return self.table[name]

    def boundary(self, mode: str) -> float:
        """Return Bolotin's boundary of a mode at the marker's β_d, in θ̄."""
        chart = bolotin_chart(self.undamped, self.static, max(self.pulsating, 1e-6), 24)
        if mode not in chart.names:
            raise ValueError(f"this model has no mode {mode}")
        return float(chart.frequency[-1, chart.names.index(mode)])

    def spin_limit(self) -> float:
        """Return the lowest spin speed at which the steady motion grows; inf if none is found."""
        speeds = np.linspace(0.0, float(State.param.spin_speed.bounds[1]), 401)
        for _ in range(3):
            roots = whirl_frequencies(self.system.at_speed(speeds), self.static)
            grows = np.flatnonzero(mean_is_unstable(roots))
            if not grows.size:
                return math.inf
            first = int(grows[0])
            if first == 0:
                return float(speeds[0])
            speeds = np.linspace(speeds[first - 1], speeds[first], 65)
        return float(speeds[32])
