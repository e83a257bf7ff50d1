"""The characteristic polynomial of one rotor over a whole range of loads and periods."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...model.modal import ModalBasis, splitting_basis
from ...model.system import System
from ..integrator import MAP_SCHEME, propagate
from .characteristic import characteristic_coefficients, reversed_coefficients
from .growth import largest_modulus, matrix_growth, reversed_growth, self_inversive_growth
from .nodes import Panel, chebyshev_nodes, chebyshev_transform, chebyshev_values, plan_panels

__all__ = ["ChartSampler"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_LEVELS = (4, 3, 2)  # step counts of the extrapolation, times a common factor
# of the fastest mode, first level: 1e-7 or so in the coefficients, 1e-6 in growth without them
_STEPS_PER_RADIAN, _STEPS_WITHOUT = 1.7, 1.2
_TOLERANCE = 1e-6  # of the interpolation, by a rule that is cautious: 1e-9 comes out
_ROUNDING = 1e-14
_PROBES = (0.0, 0.15, 0.3, 0.5)  # of a panel's periods, longest first: where steps are checked
_GROWS = 4  # power of T with which they grow at least
_SAFETY = 4
_COLUMNS_A_PROBE = 12  # without a closed form, where a period's error is measured


def _weights(levels: tuple[int, ...]) -> Array:
    """Return weights that remove the errors h⁴, h⁶ … from values at these step counts."""
    powers = [[float(n) ** -(2 + 2 * k) if k else 1.0 for n in levels] for k in range(len(levels))]
    return np.asarray(np.linalg.solve(powers, np.eye(len(levels))[0]))


_TWO, _THREE = _weights(_LEVELS[:2]), _weights(_LEVELS)


class ChartSampler:
    """The characteristic polynomial of one system over a range of loads and periods.

    Holds the Chebyshev coefficients of each panel; evaluating them costs two small matrix
    products whatever the resolution.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load : float
        p̄₀ [EI/L²].
    largest_load : float
        Largest |p̄_t| [EI/L²].
    periods : (C,) float
        T of the columns, rising.
    density : float
        1, or less for fewer nodes and steps: faster, less accurate, with error bounds to match.
    between : bool
        Whether points between columns will be wanted, down to the resonance table's lowest root.
    resolve : float
        Period up to which they will be wanted in any case.
    sample : bool
        False only plans: `panels` tell the work.
    """

    def __init__(
        self,
        system: System,
        static_load: float,
        largest_load: float,
        periods: Array,
        density: float = 1.0,
        between: bool = False,
        resolve: float = 0.0,
        sample: bool = True,
    ) -> None:
        self.system = system
        self.static_load = static_load
        self.largest_load = largest_load
        self.closed_form = system.size == 2
        self.basis: ModalBasis = splitting_basis(system, static_load)
        self.share = 1.0 if system.is_damped else 0.5
        frequencies = self.basis.frequencies
        mean = frequencies.mean()
        # the multipliers' mean phase and the slowest decay of the mean system are taken out, so
        # that no coefficient swamps the multiplier that grows; then det of the monodromy is
        # e^{−T·excess} (Liouville)
        self.drift = mean.real + 1j * frequencies.imag.min()
        self.excess = float((frequencies.imag - self.drift.imag).sum())
        centred = (frequencies - mean).real
        if self.closed_form:
            sums = centred[:, None] + centred
            bandwidth = max(np.abs(centred).max(), np.abs(sums[~np.eye(4, dtype=bool)]).max())
        else:
            bandwidth = self.share * np.abs(frequencies).max()
        slope = self._load_slope()
        self.coupling = coupling = (
            self.basis.inverse[:, system.size :] @ slope @ self.basis.vectors[: system.size]
        )
        strength = float(np.sqrt(np.abs(coupling * coupling.T).max()))
        drive = float(np.linalg.norm(slope, 2)) * (
            largest_load + abs(static_load - float(self.basis.load))
        )
        fastest = float(np.sqrt(np.abs(frequencies).max() ** 2 + drive))
        self.panels = plan_panels(
            periods,
            bandwidth=1.03 * float(bandwidth),
            decay=float(np.ptp(frequencies.imag)),
            swing=(1.15 if system.is_linear else 1.3) * strength * largest_load,
            rate=density
            * self.share
            * fastest
            * (_STEPS_PER_RADIAN if self.closed_form else _STEPS_WITHOUT)
            / _LEVELS[0],
            density=density,
            tolerance=_TOLERANCE,
            even=self.closed_form,
            resolve=max(
                resolve, self._longest_tongue(coupling) if between and self.closed_form else 0.0
            ),
        )
        self.periods = periods
        self.data = [self._sample(panel) for panel in self.panels] if sample else []

    def _longest_tongue(self, coupling: NDArray[Any]) -> float:
        """Return the period up to which the resonance table has tongues, with room to drift."""
        gap = np.abs(np.subtract.outer(self.basis.frequencies, self.basis.frequencies).real)
        strength = -(coupling * coupling.T).real
        centres = gap[(strength > 1e-12 * np.abs(strength).max()) & (gap > 0)]
        return float(2 * np.pi / (0.75 * centres.min())) if centres.size else 0.0

    def _load_slope(self) -> Array:
        """Return M⁻¹ times the steepest secant of K(p̄) the load swings over."""
        system, swing = self.system, max(self.largest_load, 1e-3)
        slope = system.geometric
        if not system.is_linear:
            high = system.load_stiffness(self.static_load + self.largest_load)
            low = system.load_stiffness(self.static_load + self.largest_load - swing)
            slope = (high - low) / swing
        return np.asarray(np.linalg.solve(system.mass, slope))

    def _propagators(self, period: Array, load: Array, steps: int) -> Complex:
        """Return Y (2n, 2n, T nodes, load nodes) over the share of a period that is needed."""
        return propagate(
            self.system,
            self.basis,
            (np.full((1, 1), self.static_load), load[None]),
            self.share * period[:, None],
            2 * np.pi * self.share,
            steps,
            MAP_SCHEME,
        )

    def _processed(self, period: Array, load: Array, steps: int) -> Complex:
        """Return Y (T nodes, load nodes, 2n, 2n) to the order of its eigenvalues.

        The change of variables that hides the integrator's error h² from them (`MAP_SCHEME`) is
        undone: exp X with X = (h²/24) [kick, drift], at the end and, inverted, at the start.
        """
        y = np.moveaxis(self._propagators(period, load, steps), (0, 1), (2, 3))
        frequencies = self.basis.frequencies
        bracket = np.subtract.outer(frequencies, frequencies) * self.coupling / 24
        start = float(self.static_load - self.basis.load) + load
        end = start if self.share == 1 else start - 2 * load
        change = np.array([end, -start])[:, None, :, None, None] * bracket
        change = change * np.square(self.share * period / steps)[:, None, None, None]
        square = change @ change / 2
        left, right = np.eye(len(frequencies)) + change + square + square @ change / 3
        return np.asarray(left @ y @ right)

    def _extrapolated(self, period: Array, load: Array, steps: int) -> tuple[NDArray[Any], Array]:
        """Return the coefficients (3, T nodes, load nodes) and their errors by load.

        A third level at some of the longer periods measures the errors, which grow with T and
        swing with the phases of the modes.
        """
        last = len(period) - 1
        longest_first = period[0] > period[-1]
        at = sorted({round(last * (x if longest_first else 1 - x)) for x in _PROBES})
        spans = [period, period, period[at]]
        y = np.concatenate(
            [
                self._propagators(span, load, level * steps)
                for span, level in zip(spans, _LEVELS, strict=True)
            ],
            axis=2,
        )
        scale = np.exp(1j * self.drift * np.concatenate(spans))[:, None]
        make = characteristic_coefficients if self.system.is_damped else reversed_coefficients
        found, count = make(y, scale), len(period)
        one, two, least = found[:, :count], found[:, count : 2 * count], found[:, 2 * count :]
        values = _TWO[0] * one + _TWO[1] * two
        three = _THREE[0] * one[:, at] + _THREE[1] * two[:, at] + _THREE[2] * least
        gap = np.abs(three - values[:, at])
        error = _SAFETY * (gap * (max(period[0], period[-1]) / period[at, None]) ** _GROWS).max(
            axis=1
        )
        # sums of products of so many entries: in strong growth rounding shows
        factors = np.array([1, 2, 3] if self.system.is_damped else [4, 4, 4])[:, None]
        largest = np.abs(y / scale if self.system.is_damped else y).max(axis=(0, 1))
        return values, error + _ROUNDING * largest.max(axis=0) ** factors

    def _load_variable(self, load: ArrayLike) -> Array:
        """Return the variable in which the load is interpolated."""
        return np.square(load) if self.closed_form else np.abs(load)

    def _sample(self, panel: Panel) -> tuple[NDArray[Any], Array, Array]:
        """Return Chebyshev coefficients (k, T, load) and errors: interpolation, steps by load."""
        period = self.periods[panel.columns]
        if panel.period_nodes:
            period = chebyshev_nodes(panel.period_nodes, panel.low, panel.high)
        top = float(self._load_variable(self.largest_load))
        load = chebyshev_nodes(panel.load_nodes, 0.0, top)
        load = np.sqrt(load) if self.closed_form else load
        if self.closed_form:
            values, step_error = self._extrapolated(period, load, panel.steps)
        else:
            fine = self._processed(period, load, _LEVELS[0] * panel.steps)
            # the error is largest at the longest periods
            at = np.argsort(-period)[: max(1, len(period) // _COLUMNS_A_PROBE)]
            rough = self._processed(period[at], load, _LEVELS[1] * panel.steps)
            gap = np.abs(rough - fine[at]).max(axis=0) / ((_LEVELS[0] / _LEVELS[1]) ** 4 - 1)
            # off the diagonal errors swing with T, and one period may show none
            phase = np.einsum("lii->li", gap)
            gap = np.maximum(gap, np.sqrt(phase[:, :, None] * phase[:, None]))
            values = np.moveaxis(fine.reshape(*fine.shape[:2], -1), -1, 0)
            step_error = _SAFETY * gap.reshape(len(gap), -1).T
        coefficients = values @ chebyshev_transform(len(load)).T
        error = np.abs(coefficients[..., -1]).max(axis=1)
        if panel.period_nodes:
            coefficients = chebyshev_transform(len(period)) @ coefficients
            error += np.abs(coefficients[:, -2:]).sum(axis=(1, 2))
        # rounding in sums of terms of this size
        error += 1e-15 * len(load) * np.abs(values).max(axis=(1, 2))
        return coefficients, error, step_error

    def evaluate(self, panel: int, loads: Array, periods: Array) -> NDArray[Any]:
        """Return the functions (k, R, C) on a grid of loads and, inside one panel, periods.

        A panel without nodes in T can only be evaluated at its own columns.
        """
        plan, coefficients = self.panels[panel], self.data[panel][0]
        top = float(self._load_variable(self.largest_load))
        across = chebyshev_values(self._load_variable(loads), 0.0, top, plan.load_nodes)
        along = coefficients
        if plan.period_nodes:
            along = chebyshev_values(periods, plan.low, plan.high, plan.period_nodes) @ along
        return np.asarray(across @ np.swapaxes(along, 1, 2))

    def scattered(self, panel: int, loads: Array, periods: Array) -> NDArray[Any]:
        """Return the functions (k, P) at P single points inside one panel that has nodes in T."""
        plan, coefficients = self.panels[panel], self.data[panel][0]
        top = float(self._load_variable(self.largest_load))
        across = chebyshev_values(self._load_variable(loads), 0.0, top, plan.load_nodes)
        along = chebyshev_values(periods, plan.low, plan.high, plan.period_nodes)
        return np.asarray(((along @ coefficients) * across).sum(axis=-1))

    def coefficient_error(self, panel: int, loads: Array, periods: Array) -> Array:
        """Return the errors of the functions at loads and periods that broadcast.

        Returns
        -------
        (k, ...) float
            Of c₁, c₂, c₃ (undamped Re c₁, Im c₁, c₂) in closed form, else of the entries of Y.
        """
        plan = self.panels[panel]
        _, error, step_error = self.data[panel]
        nodes = chebyshev_nodes(plan.load_nodes, 0.0, float(self._load_variable(self.largest_load)))
        # rising loads; a bound that never falls
        bound = np.maximum.accumulate(step_error[:, ::-1], axis=1)
        variable = self._load_variable(loads)
        rows = np.array([np.interp(variable, nodes[::-1], one) for one in bound])
        error = error.reshape(-1, *[1] * (rows.ndim - 1))
        return np.asarray(error + rows * (periods / plan.high) ** _GROWS)

    def on_grid(self, loads: Array, periods: Array) -> tuple[NDArray[Any], Array]:
        """Return the functions (k, R, C) and their errors at rising loads and all columns."""
        parts = [
            self.evaluate(index, loads, periods[panel.columns])
            for index, panel in enumerate(self.panels)
        ]
        errors = [
            self.coefficient_error(index, loads[:, None], periods[panel.columns])
            for index, panel in enumerate(self.panels)
        ]
        return np.concatenate(parts, axis=-1), np.concatenate(errors, axis=-1)

    def growth(
        self, functions: NDArray[Any], error: Array, periods: Array, nearness: bool = False
    ) -> tuple[Array, Array, Array]:
        """Return growth rates, error bounds and the approach to a collision.

        Parameters
        ----------
        functions : (k, ...)
            From `on_grid`, `evaluate` or `scattered`.
        error : (k, ...) float
            From `on_grid` or `coefficient_error`.
        periods : (...) float
            Broadcast to the functions' shape.
        nearness : bool
            Whether to fill `approach`.

        Returns
        -------
        growth, error, approach : (...) float
            `approach` as in `self_inversive_growth`, NaN without a closed form.
        """
        damped = self.system.is_damped
        if self.closed_form and not damped:
            growth, slack, approach = self_inversive_growth(functions, error, nearness)
        elif self.closed_form:
            last = np.exp(-self.excess * periods)
            growth, slack, approach = largest_modulus(functions, last, error, nearness)
            growth = growth - self.drift.imag * periods
        else:
            size = 2 * self.system.size
            shape = (*functions.shape[1:], size, size)
            solver = matrix_growth if damped else reversed_growth
            growth, slack = solver(
                np.moveaxis(functions, 0, -1).reshape(shape),
                np.moveaxis(error, 0, -1).reshape(shape),
            )
            approach = np.broadcast_to(np.nan, growth.shape)
        return growth / periods, slack / periods, approach

    def at_points(
        self, panel: int, loads: Array, periods: Array, nearness: bool = False
    ) -> tuple[Array, Array, Array]:
        """Return what `growth` does, at single points (P,) inside one panel that has nodes in T."""
        functions = self.scattered(panel, loads, periods)
        error = self.coefficient_error(panel, loads, periods)
        return self.growth(functions, error, periods, nearness)
