"""Growth-rate charts over pulsating load and excitation frequency: the fast path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .characteristic import characteristic_coefficients, largest_modulus, self_inversive_growth
from .checks import number, numbers
from .floquet import floquet_solution
from .modal import ModalBasis, splitting_basis
from .sampling import (
    Panel,
    chebyshev_nodes,
    chebyshev_transform,
    chebyshev_values,
    plan_panels,
)
from .splitting import MAP_SCHEME, propagate
from .system import System

__all__ = ["ChartSampler", "GrowthMap", "growth_map"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_STAGES_PER_RADIAN = 4.5  # of the fastest mode; error 2e-7 or so in the coefficients
_TOLERANCE = 1e-8  # of the interpolation, in the coefficients
_GROWTH_ERROR = 1e-5  # pixels that may be worse are computed again, one by one
_FLOOR = 1e-9  # rounding in a growth rate, times the period's reciprocal
_BLOCK = 8192  # pixels worked on together: what a cache holds


@dataclass(frozen=True)
class GrowthMap:
    """Growth rates on a grid with their error bounds.

    Parameters
    ----------
    growth : (R, C) float
        σ [√(EI/(ρAL⁴))], rows along the load, columns along θ̄.
    error : (R, C) float
        Estimated bound on its error; a pixel is unstable where growth > error.
    refined : int
        How many pixels were computed again one by one.
    """

    growth: Array
    error: Array
    refined: int


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
    """

    def __init__(
        self,
        system: System,
        static_load: float,
        largest_load: float,
        periods: Array,
        density: float = 1.0,
    ) -> None:
        self.system = system
        self.static_load = static_load
        self.largest_load = largest_load
        self.closed_form = system.size == 2
        self.basis: ModalBasis = splitting_basis(system, static_load)
        self.share = 1.0 if system.is_damped else 0.5
        frequencies = self.basis.frequencies
        mean = frequencies.mean()
        # det of the monodromy is e^{jT tr R} (Liouville); its fourth root is taken out
        self.drift = mean
        centred = (frequencies - mean).real
        if self.closed_form:
            sums = centred[:, None] + centred
            bandwidth = max(np.abs(centred).max(), np.abs(sums[~np.eye(4, dtype=bool)]).max())
        else:
            bandwidth = self.share * np.abs(frequencies).max()
        slope = self._load_slope()
        coupling = self.basis.inverse[:, system.size :] @ slope @ self.basis.vectors[: system.size]
        strength = float(np.sqrt(np.abs(coupling * coupling.T).max()))
        drive = float(np.linalg.norm(slope, 2)) * (
            largest_load + abs(static_load - float(self.basis.load))
        )
        fastest = float(np.sqrt(np.abs(frequencies).max() ** 2 + drive))
        self.panels = plan_panels(
            periods,
            bandwidth=1.03 * float(bandwidth),
            swing=1.15 * strength * largest_load,
            rate=density * self.share * fastest * _STAGES_PER_RADIAN / len(MAP_SCHEME.kicks),
            density=density,
            tolerance=_TOLERANCE,
            even=self.closed_form,
        )
        self.periods = periods
        self.data = [self._sample(panel) for panel in self.panels]

    def _load_slope(self) -> Array:
        """Return M⁻¹ times the steepest secant of K(p̄) the load swings over."""
        system, swing = self.system, max(self.largest_load, 1e-3)
        slope = system.geometric
        if not system.is_linear:
            high = system.load_stiffness(self.static_load + self.largest_load)
            low = system.load_stiffness(self.static_load + self.largest_load - swing)
            slope = (high - low) / swing
        return np.asarray(np.linalg.solve(system.mass, slope))

    def _values(self, period: Array, load: Array, steps: int) -> NDArray[Any]:
        """Return what is interpolated, (k, T nodes, load nodes)."""
        y = propagate(
            self.system,
            self.basis,
            (np.full((1, 1), self.static_load), load[None]),
            self.share * period[:, None],
            2 * np.pi * self.share,
            steps,
            MAP_SCHEME,
        )
        if not self.closed_form:
            return y.reshape(-1, len(period), len(load))
        y = np.ascontiguousarray(np.moveaxis(y, (0, 1), (2, 3)))
        if not self.system.is_damped:
            # half a period is enough: by time reversal Y(−t) = conj Y(t)
            y = np.linalg.solve(y.conj(), y)
        scale = np.exp(1j * self.drift * period)[:, None]
        c = characteristic_coefficients(y, np.broadcast_to(scale, y.shape[:2]))
        if self.system.is_damped:
            return c
        return np.array([c[0].real, c[0].imag, c[1].real])

    def _load_variable(self, load: ArrayLike) -> Array:
        """Return the variable in which the load is interpolated."""
        return np.square(load) if self.closed_form else np.abs(load)

    def _sample(self, panel: Panel) -> tuple[NDArray[Any], float, Array]:
        """Return Chebyshev coefficients (k, T, load) of a panel, its interpolation error and its
        step error at the load nodes."""
        period = self.periods[panel.columns]
        if panel.period_nodes:
            period = chebyshev_nodes(panel.period_nodes, panel.low, panel.high)
        top = float(self._load_variable(self.largest_load))
        load = chebyshev_nodes(panel.load_nodes, 0.0, top)
        load = np.sqrt(load) if self.closed_form else load
        values = self._values(period, load, panel.steps)
        # fewer steps at the longest period; the error falls like h⁵ or faster
        worst = int(np.argmax(period))
        fewer = max(1, 3 * panel.steps // 4)
        rough = self._values(period[worst : worst + 1], load, fewer)
        ratio = (panel.steps / fewer) ** 5 - 1
        step_error = np.abs(rough[:, 0] - values[:, worst]).max(axis=0) / ratio
        error = 0.0
        coefficients = values @ chebyshev_transform(len(load)).T
        error += float(np.abs(coefficients[..., -2:]).sum(axis=-1).max())
        if panel.period_nodes:
            coefficients = chebyshev_transform(len(period)) @ coefficients
            error += float(np.abs(coefficients[:, -3:]).sum(axis=(1, 2)).max())
        # rounding in sums of terms of this size
        return coefficients, error + 1e-15 * float(np.abs(values).max()), step_error

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

    def growth(
        self, panel: int, functions: NDArray[Any], loads: Array, periods: Array
    ) -> tuple[Array, Array]:
        """Return growth rates and error bounds from evaluated functions (k, R, C)."""
        plan = self.panels[panel]
        _, error, step_error = self.data[panel]
        nodes = chebyshev_nodes(plan.load_nodes, 0.0, float(self._load_variable(self.largest_load)))
        # rising loads; a bound that never falls
        bound = np.maximum.accumulate(step_error[::-1])
        rows = np.interp(self._load_variable(loads), nodes[::-1], bound)
        error = error + rows[:, None] * (periods / plan.high) ** 4
        if not self.closed_form:
            return self._matrix_growth(functions, periods, error)
        if self.system.is_damped:
            growth, slack = largest_modulus(functions, error)
            growth = growth - self.drift.imag * periods
        else:
            growth, slack = self_inversive_growth(functions, error)
        return growth / periods, slack / periods

    def _matrix_growth(
        self, functions: NDArray[Any], periods: Array, error: Array
    ) -> tuple[Array, Array]:
        """Return growth rates from interpolated propagators, one eigenproblem a pixel."""
        size = 2 * self.system.size
        matrix = np.moveaxis(functions, 0, -1).reshape(*functions.shape[1:], size, size)
        if not self.system.is_damped:
            matrix = np.linalg.solve(matrix.conj(), matrix)
        values = np.linalg.eigvals(matrix)
        modulus = np.abs(values)
        top = modulus.argmax(axis=-1)[..., None]
        largest = np.take_along_axis(values, top, -1)
        gap = np.abs(values - largest)
        np.put_along_axis(gap, top, np.inf, -1)
        gap = gap.min(axis=-1)
        size_of = np.take_along_axis(modulus, top, -1)[..., 0]
        slack = 2 * size * error * size_of
        shift = 2 * slack / (gap + np.sqrt(gap**2 + 4 * slack))
        return np.log(size_of) / periods, shift / size_of / periods


def _evaluate_all(
    sampler: ChartSampler, loads: Array, periods: Array
) -> tuple[Array, Array]:
    """Return growth and error of the whole grid, periods rising."""
    growth = np.empty((len(loads), len(periods)))
    error = np.empty_like(growth)
    for index, panel in enumerate(sampler.panels):
        columns = periods[panel.columns]
        rows = max(1, _BLOCK // len(columns))
        for start in range(0, len(loads), rows):
            part = slice(start, start + rows)
            functions = sampler.evaluate(index, loads[part], columns)
            growth[part, panel.columns], error[part, panel.columns] = sampler.growth(
                index, functions, loads[part], columns
            )
    return growth, error


def growth_map(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
    density: float = 1.0,
    refine: bool = True,
) -> GrowthMap:
    """Return growth rates on a grid, with the error of each.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²]; the sign does not matter.
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], above 0, in any order.
    density : float
        Nodes and steps relative to the tuned numbers, in [0.3, 3].
    refine : bool
        Compute pixels whose error bound exceeds 1e-5 again by `floquet_solution`.

    Returns
    -------
    GrowthMap
        Rows whose load passes the pole of the exact stiffness are NaN.

    Raises
    ------
    ValueError
        If an argument is not finite, out of range or not 1-d.
    """
    if system.spin_speed.ndim:
        raise ValueError(
            f"`system` must have one spin speed, got an array of shape {system.spin_speed.shape}"
        )
    static = number("static_load", static_load)
    loads = np.abs(numbers("pulsating_loads", pulsating_loads))
    frequencies = numbers(
        "excitation_frequencies", excitation_frequencies, 0.0, open_low=True
    )
    density = number("density", density, 0.3, 3.0)
    for name, array in (("pulsating_loads", loads), ("excitation_frequencies", frequencies)):
        if array.ndim != 1 or array.size == 0:
            raise ValueError(f"`{name}` must be a list of numbers, got shape {array.shape}")
    growth = np.full((len(loads), len(frequencies)), np.nan)
    error = np.full_like(growth, np.nan)
    rows = np.flatnonzero(static + loads < system_pole(system))
    if static >= system_pole(system) or not rows.size:
        return _frozen(growth, error, 0)
    order = np.argsort(-frequencies, kind="stable")
    periods = 2 * np.pi / frequencies[order]
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        sampler = ChartSampler(system, static, float(loads[rows].max()), periods, density)
        part, slack = _evaluate_all(sampler, loads[rows], periods)
    refined = 0
    if refine:
        with np.errstate(invalid="ignore"):
            doubtful = np.argwhere(~(slack <= _GROWTH_ERROR) | ~np.isfinite(part))
        refined = len(doubtful)
        if refined:
            i, j = doubtful.T
            again = floquet_solution(
                system, static, loads[rows][i], frequencies[order][j]
            )
            part[i, j], slack[i, j] = again.growth_rate, again.error
    slack = np.maximum(slack, _FLOOR)
    growth[np.ix_(rows, order)] = part
    error[np.ix_(rows, order)] = slack
    return _frozen(growth, error, refined)


def _frozen(growth: Array, error: Array, refined: int) -> GrowthMap:
    """Return the map with read-only arrays."""
    growth.flags.writeable = error.flags.writeable = False
    return GrowthMap(growth, error, refined)


def system_pole(system: System) -> float:
    """Return the load at which the stiffness has a pole, inf for the linear law."""
    if system.exact_shear is None:
        return np.inf
    from .stiffness import largest_exact_load

    return float(largest_exact_load(system.exact_shear))
