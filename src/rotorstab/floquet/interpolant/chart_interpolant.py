"""The multipliers of one rotor over a whole range of pulsating loads and periods."""

from __future__ import annotations

from functools import partial

import numpy as np

from ..._numerics.chebyshev import chebyshev_values
from ..._types import AnyArray, Array, Complex, Mask
from ...model.system import System
from .chart_panels import chart_panels, node_sampler
from .edge_measure import edge_of_approach, edge_of_multipliers, with_verdict
from .growth import Measure, collision_approach, largest_modulus, self_inversive_growth
from .matrix_growth import matrix_growth, reversed_growth
from .sampling import ERROR_POWER, PanelSamples

__all__ = ["ChartInterpolant"]

_MOST_STEPS = 200  # of a panel, up to which single points between its columns are integrated


class ChartInterpolant:
    """Interpolated multipliers of one system over a range of loads and periods.

    It holds the Chebyshev coefficients of each panel. Evaluating them takes two small matrix
    products, whatever the resolution of the chart.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    largest_load : float
        Largest |p̄_t| [EI/L²].
    periods : (C,) float
        T of the columns, in rising order.
    density : float
        1, or less for fewer nodes and steps: faster and less accurate, with error bounds that say
        so.
    between : bool
        Whether points between columns will be evaluated, up to the longest period at which the
        resonance table has a tongue.
    resolve : float
        Period up to which points between columns will be evaluated in any case.
    slow : bool
        Whether to keep the four slowest whirls only, of a system of more than two coordinates.

    Raises
    ------
    InseparableWhirls
        If `slow` and these have tongues together with faster ones.
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
        slow: bool = False,
    ) -> None:
        self.system = system
        self.sampler = sampler = node_sampler(system, static_load, largest_load, slow)
        self.panels = chart_panels(sampler, periods, density, between, resolve)
        self._samples: list[PanelSamples] = [
            sampler.sample(panel, periods) for panel in self.panels
        ]

    @property
    def static_load(self) -> float:
        """The static load p̄₀ [EI/L²]."""
        return self.sampler.static_load

    @property
    def closed_form(self) -> bool:
        """Whether multipliers are found in closed form: those of two coordinates or four whirls."""
        return self.sampler.closed_form

    def _load_values(self, loads: Array, count: int) -> Array:
        """Return the Chebyshev polynomials (..., count) of the load variable."""
        variable = self.sampler.load_variable(loads)
        return chebyshev_values(variable, 0.0, self.sampler.largest_variable, count)

    def evaluate(self, panel: int, loads: Array, periods: Array) -> AnyArray:
        """Return the functions (k, R, C) on a grid of loads and, inside one panel, periods.

        A panel without nodes in T can be evaluated only at its own columns.
        """
        plan, along = self.panels[panel], self._samples[panel].coefficients
        across = self._load_values(loads, plan.load_nodes)
        if plan.period_nodes:
            along = chebyshev_values(periods, plan.low, plan.high, plan.period_nodes) @ along
        return np.asarray(across @ np.swapaxes(along, 1, 2))

    def scattered(self, panel: int, loads: Array, periods: Array) -> AnyArray:
        """Return the functions (k, P) at P single points inside one panel that has nodes in T."""
        plan, coefficients = self.panels[panel], self._samples[panel].coefficients
        across = self._load_values(loads, plan.load_nodes)
        along = chebyshev_values(periods, plan.low, plan.high, plan.period_nodes)
        return np.asarray(((along @ coefficients) * across).sum(axis=-1))

    def coefficient_error(self, panel: int, loads: Array, periods: Array) -> Array:
        """Return bounds on the errors (k, ...) of the functions at loads and periods (...)."""
        plan, samples = self.panels[panel], self._samples[panel]
        nodes = self.sampler.variable_nodes(plan.load_nodes)
        # at rising loads, a bound that never falls
        bounds = np.maximum.accumulate(samples.step_error[:, ::-1], axis=1)
        variable = self.sampler.load_variable(loads)
        rows = np.array([np.interp(variable, nodes[::-1], bound) for bound in bounds])
        error = samples.interpolation_error.reshape(-1, *[1] * (rows.ndim - 1))
        return np.asarray(error + rows * (periods / plan.high) ** ERROR_POWER)

    def on_grid(self, loads: Array, periods: Array) -> tuple[AnyArray, Array]:
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
        self, functions: AnyArray, error: Array, periods: Array, with_approach: bool = False
    ) -> tuple[Array, Array, Array]:
        """Return growth rates, bounds on their errors and the approach to a collision.

        Parameters
        ----------
        functions : (k, ...)
            From `on_grid`, `evaluate` or `scattered`.
        error : (k, ...) float
            From `on_grid` or `coefficient_error`.
        periods : (...) float
            Broadcast to the shape of the functions.
        with_approach : bool
            Whether to compute `approach`.

        Returns
        -------
        growth, error, approach : (...) float
            `approach` as in `self_inversive_growth`, NaN without a closed form.
        """
        if self.closed_form and self.system.is_reversible:
            growth, slack, approach = self_inversive_growth(functions, error, with_approach)
            return growth / periods, slack / periods, approach
        measure = collision_approach if with_approach and self.closed_form else None
        return self._solve(functions, error, periods, measure)

    def growth_and_edge(
        self, functions: AnyArray, error: Array, periods: Array
    ) -> tuple[Array, Array, Array]:
        """Return growth rates, bounds on their errors and the edge function.

        It is positive where a point is unstable, else negative, and smooth through the edge: see
        `edge_of_multipliers`, divided by T².
        """
        damped = self.system.is_damped
        if self.closed_form and self.system.is_reversible:
            growth, slack, approach = self_inversive_growth(functions, error, with_approach=True)
            growth, slack, smooth = growth / periods, slack / periods, edge_of_approach(approach)
        else:
            shift = self.sampler.mean_growth(functions, periods) if self.closed_form else 0.0
            measure = partial(edge_of_multipliers, shift=shift, damped=damped)
            growth, slack, smooth = self._solve(functions, error, periods, measure)
        return growth, slack, with_verdict(smooth / periods**2, growth, slack, damped)

    def _solve(
        self, functions: AnyArray, error: Array, periods: Array, measure: Measure | None
    ) -> tuple[Array, Array, Array]:
        """Return growth rates, bounds on their errors and a function of the multipliers."""
        if self.closed_form:
            last = np.exp(-self.sampler.excess * periods)
            growth, slack, measured = largest_modulus(functions[:3], last, error[:3], measure)
            growth = growth + self.sampler.mean_growth(functions, periods)
        else:
            size = 2 * self.system.size
            shape = (*functions.shape[1:], size, size)
            solver = reversed_growth if self.system.is_reversible else matrix_growth
            growth, slack, measured = solver(
                np.moveaxis(functions, 0, -1).reshape(shape),
                np.moveaxis(error, 0, -1).reshape(shape),
                measure,
            )
        return growth / periods, slack / periods, measured

    def at_points(
        self, panel: int, loads: Array, periods: Array, with_approach: bool = False
    ) -> tuple[Array, Array, Array]:
        """Return what `growth` does, at single points (P,) inside one panel that has nodes in T."""
        functions = self.scattered(panel, loads, periods)
        error = self.coefficient_error(panel, loads, periods)
        return self.growth(functions, error, periods, with_approach)

    def knows(self, periods: Array) -> Mask:
        """Tell at which periods points between columns can be evaluated by `edge`.

        The columns of other panels are sampled one by one: they are too few for what changes
        between them, and with more than two coordinates other points take too long there.
        """
        found = np.zeros(periods.shape, dtype=np.bool_)
        for panel in self.panels:
            if panel.period_nodes or (not self.closed_form and panel.steps <= _MOST_STEPS):
                found |= (periods >= panel.low) & (periods <= panel.high)
        return found

    def edge(self, loads: Array, periods: Array) -> Array:
        """Return the edge function at single points (P,), NaN where `knows` says no."""
        found = np.full(periods.shape, np.nan)
        for index, panel in enumerate(self.panels):
            at = np.flatnonzero((periods >= panel.low) & (periods <= panel.high))
            if not at.size:
                continue
            load, period = loads[at], periods[at]
            if panel.period_nodes:
                functions = self.scattered(index, load, period)
            elif not self.closed_form and panel.steps <= _MOST_STEPS:
                functions = self.sampler.single_points(panel, period, load)
            else:
                continue
            error = self.coefficient_error(index, load, period)
            found[at] = self.growth_and_edge(functions, error, period)[2]
        return found

    def single_multipliers(self, loads: Array, periods: Array) -> Complex:
        """Return all multipliers (P, 2n) at P single points, each integrated as a node is.

        This is for more than two coordinates. Periods beyond the chart take the steps of its end.
        """
        size = 2 * self.system.size
        found = np.full((len(periods), size), np.nan, dtype=np.complex128)
        ends = [panel.high for panel in self.panels[:-1]]
        for index, panel in enumerate(self.panels):
            at = np.flatnonzero(np.searchsorted(ends, periods) == index)
            if not at.size:
                continue
            entries = self.sampler.single_points(panel, periods[at], loads[at])
            y = entries.T.reshape(-1, size, size)
            if self.system.is_reversible:
                y = np.linalg.solve(y.conj(), y)
            found[at] = np.linalg.eigvals(y)
        return found
