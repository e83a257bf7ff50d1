"""Monodromies at the nodes of a panel, and from them the functions that a chart interpolates."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._numerics.chebyshev import chebyshev_nodes, chebyshev_transform
from ..._numerics.extrapolation import extrapolation_weights
from ..._types import AnyArray, Array, Complex, Index
from ...model.modal import ModalBasis, splitting_basis
from ...model.system import System
from ..integrator import propagate
from ..schemes import MAP_SCHEME
from .characteristic import characteristic_coefficients, reversed_coefficients
from .panels import Panel

__all__ = ["ERROR_POWER", "MAP_LEVELS", "NodeSampler", "PanelSamples", "probes"]

MAP_LEVELS = (4, 3, 2)
"""Step counts of the extrapolation of order 4 on charts, times a common factor."""

ERROR_POWER = 4
"""Power of T with which the error of the integrator grows at least."""

_TWO, _THREE = (extrapolation_weights(MAP_LEVELS[:count], 4) for count in (2, 3))
_ROUNDING = 1e-14  # relative, in the coefficients
_SAFETY = 4  # factor on the measured error
_SUM_ROUNDING = 1e-15  # relative to the largest term of a sum
_PROBES = (0.0, 0.15, 0.3, 0.5)  # parts of a panel, longest period first, where steps are checked
_COLUMNS_PER_PROBE = 12  # with matrices: one period in so many is checked
_SMALLEST_SWING = 1e-3  # p̄_t over which the slope of K(p̄) is taken at least


def probes(period: Array) -> list[int]:
    """Return which of some nodes in T have their error measured, most of them long periods."""
    count, longest_first = len(period), period[0] > period[-1]
    return sorted({round((count - 1) * (x if longest_first else 1 - x)) for x in _PROBES})


class PanelSamples(NamedTuple):
    """What is known of the interpolated functions in one panel.

    Parameters
    ----------
    coefficients : (k, T, load)
        Chebyshev coefficients in the load and, where the panel has nodes in T, in T; else values
        at its columns.
    interpolation_error : (k,) float
        Bound on the error of the interpolation and of rounding.
    step_error : (k, load) float
        Bound on the error of the integrator at the longest period, at the nodes in the load.
    """

    coefficients: AnyArray
    interpolation_error: Array
    step_error: Array


class NodeSampler:
    """Computes the functions of a chart at nodes in period and load.

    With two coordinates these are the coefficients of the characteristic polynomial, of which the
    multipliers are found in closed form: Re c₁, Im c₁, c₂ without damping, else c₁, c₂, c₃. With
    more coordinates they are the entries of the propagator.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    largest_load : float
        Largest |p̄_t| [EI/L²].
    """

    def __init__(self, system: System, static_load: float, largest_load: float) -> None:
        self.system = system
        self.static_load = static_load
        self.largest_load = largest_load
        self.closed_form = system.size == 2
        self.basis: ModalBasis = splitting_basis(system, static_load)
        # the part of a period that is integrated; without damping time reversal gives the rest
        self.share = 0.5 if system.is_reversible else 1.0
        frequencies = self.basis.frequencies
        # The mean phase of the multipliers and the slowest decay of the mean system are divided
        # out, so that no coefficient is large against that of the multiplier that grows. By
        # Liouville's formula det of the monodromy is then e^{−T·excess}.
        self.drift = frequencies.mean().real + 1j * frequencies.imag.min()
        self.excess = float((frequencies.imag - self.drift.imag).sum())
        n = system.size
        # the whirls whose multipliers a chart is of
        self.whirls: Index = np.arange(2 * n)
        self.load_slope = self._load_slope()
        to_momentum, displacement = self.basis.inverse[:, n:], self.basis.vectors[:n]
        self.coupling = to_momentum @ self.load_slope @ displacement
        self.shift = self.basis.shift * (to_momentum @ displacement)

    def _load_slope(self) -> Array:
        """Return M⁻¹ times the steepest secant of K(p̄) over the loads of the chart."""
        system, swing = self.system, max(self.largest_load, _SMALLEST_SWING)
        slope = system.geometric
        if not system.is_linear:
            high = system.load_stiffness(self.static_load + self.largest_load)
            low = system.load_stiffness(self.static_load + self.largest_load - swing)
            slope = (high - low) / swing
        return np.asarray(np.linalg.solve(system.mass, slope))

    @property
    def is_even(self) -> bool:
        """Whether the functions are even in p̄_t: −p̄_t is p̄_t half a period later."""
        return self.closed_form and self.system.pulsation.is_antiperiodic

    def load_variable(self, load: Array) -> Array:
        """Return the variable in which the load is interpolated: p̄_t² where that is enough."""
        return np.square(load) if self.is_even else np.abs(load)

    @property
    def largest_variable(self) -> float:
        """The `load_variable` of the largest load."""
        return float(self.load_variable(np.asarray(self.largest_load)))

    def mean_growth(self, functions: AnyArray, periods: Array) -> Array | float:
        """Return what was divided out of the multipliers of a closed form, as ln|μ| (...)."""
        return np.asarray(-self.drift.imag * periods)

    def variable_nodes(self, count: int) -> Array:
        """Return `count` Chebyshev nodes in the `load_variable`, in falling order."""
        return chebyshev_nodes(count, 0.0, self.largest_variable)

    def sample(self, panel: Panel, periods: Array) -> PanelSamples:
        """Return the functions in one panel; `periods` are those of all columns of the chart."""
        period = periods[panel.columns]
        if panel.period_nodes:
            period = chebyshev_nodes(panel.period_nodes, panel.low, panel.high)
        load = self.variable_nodes(panel.load_nodes)
        load = np.sqrt(load) if self.is_even else load
        evaluate = self._coefficients if self.closed_form else self._entries
        values, step_error = evaluate(period, load, panel.steps)
        coefficients = values @ chebyshev_transform(len(load)).T
        error = np.abs(coefficients[..., -1]).max(axis=1)
        if panel.period_nodes:
            coefficients = chebyshev_transform(len(period)) @ coefficients
            error += np.abs(coefficients[:, -2:]).sum(axis=(1, 2))
        error += _SUM_ROUNDING * len(load) * np.abs(values).max(axis=(1, 2))
        return PanelSamples(coefficients, error, step_error)

    def single_points(self, panel: Panel, period: Array, load: Array) -> AnyArray:
        """Return the entries of the propagator (4n², P) at P points of one panel, each integrated.

        This is for more than two coordinates.
        """
        values = self._processed(period, load[:, None], MAP_LEVELS[0] * panel.steps)
        return values.reshape(len(period), -1).T

    def _propagators(self, period: Array, load: Array, steps: int) -> Complex:
        """Return Y (2n, 2n, T nodes, load nodes) over the part of a period that is integrated.

        `load` is (load nodes,) or, where each T has loads of its own, (T nodes, load nodes).
        """
        return propagate(
            self.system,
            self.basis,
            (np.full((1, 1), self.static_load), np.atleast_2d(load)),
            self.share * period[:, None],
            2 * np.pi * self.share,
            steps,
            MAP_SCHEME,
        )

    def _coefficients(self, period: Array, load: Array, steps: int) -> tuple[AnyArray, Array]:
        """Return polynomial coefficients (3, T nodes, load nodes) and their errors (3, load).

        They are extrapolated from two levels of steps. A third level at some of the longer periods
        measures the errors, which grow with T and oscillate with the phases of the modes.
        """
        whole, count = self.share == 1, len(period)
        at = probes(period)
        spans = [period, period, period[at]]
        y = np.concatenate(
            [
                self._propagators(span, load, level * steps)
                for span, level in zip(spans, MAP_LEVELS, strict=True)
            ],
            axis=2,
        )
        scale = np.exp(1j * self.drift * np.concatenate(spans))[:, None]
        found = (characteristic_coefficients if whole else reversed_coefficients)(y, scale)
        fine, medium, coarse = found[:, :count], found[:, count : 2 * count], found[:, 2 * count :]
        values = _TWO[0] * fine + _TWO[1] * medium
        better = _THREE[0] * fine[:, at] + _THREE[1] * medium[:, at] + _THREE[2] * coarse
        gap = np.abs(better - values[:, at])
        stretch = max(period[0], period[-1]) / period[at, None]
        error = _SAFETY * (gap * stretch**ERROR_POWER).max(axis=1)
        # the coefficients are sums of products of so many entries: in strong growth rounding shows
        factors = np.array([1, 2, 3] if whole else [4, 4, 4])[:, None]
        largest = np.abs(y / scale if whole else y).max(axis=(0, 1))
        return values, error + _ROUNDING * largest.max(axis=0) ** factors

    def _entries(self, period: Array, load: Array, steps: int) -> tuple[AnyArray, Array]:
        """Return the entries (4n², T nodes, load nodes) of Y and their errors (4n², load)."""
        fine = self._processed(period, load, MAP_LEVELS[0] * steps)
        # the error is largest at the longest periods
        at = np.argsort(-period)[: max(1, len(period) // _COLUMNS_PER_PROBE)]
        rough = self._processed(period[at], load, MAP_LEVELS[1] * steps)
        gap = np.abs(rough - fine[at]).max(axis=0) / ((MAP_LEVELS[0] / MAP_LEVELS[1]) ** 4 - 1)
        # off the diagonal errors oscillate with T, and a single period may show none
        phase = np.einsum("lii->li", gap)
        gap = np.maximum(gap, np.sqrt(phase[:, :, None] * phase[:, None]))
        values = np.moveaxis(fine.reshape(*fine.shape[:2], -1), -1, 0)
        return values, _SAFETY * gap.reshape(len(gap), -1).T

    def _processed(self, period: Array, load: Array, steps: int) -> Complex:
        """Return Y (T nodes, load nodes, 2n, 2n) with an error of order h⁴, as its eigenvalues.

        The change of variables of `MAP_SCHEME` is undone: exp X with X = (h²/24) [kick, drift], at
        the end and, inverted, at the start.
        """
        y = np.moveaxis(self._propagators(period, load, steps), (0, 1), (2, 3))
        frequencies = self.basis.frequencies
        bracket = np.subtract.outer(frequencies, frequencies) / 24
        steady = float(self.static_load - self.basis.load)
        first, last = self.system.pulsation.at(np.array([0.0, 2 * np.pi * self.share]))
        kicks = [
            (steady + part * np.atleast_2d(load))[..., None, None] * self.coupling - self.shift
            for part in (last, first)
        ]
        change = np.array([kicks[0], -kicks[1]]) * bracket
        change = change * np.square(self.share * period / steps)[:, None, None, None]
        square = change @ change / 2
        left, right = np.eye(len(frequencies)) + change + square + square @ change / 3
        return np.asarray(left @ y @ right)
