"""The panels of a chart: how many nodes and steps its range of loads and periods needs."""

from __future__ import annotations

import numpy as np

from ..._tolerances import NEGLIGIBLE
from ..._types import AnyArray, Array
from ...model.system import System
from .panels import Panel, plan_panels
from .sampling import MAP_LEVELS, NodeSampler
from .slow_whirls import SlowSampler

__all__ = ["chart_panels", "node_sampler"]

# steps of the first level per radian of the fastest mode: with a closed form an error of 1e-7 or so
# in the coefficients, with matrices of 1e-6 in the growth, with the slow whirls of larger systems,
# which the steps of the fast ones follow more closely than these, of 1e-5 in the growth
_STEPS_PER_RADIAN, _STEPS_PER_RADIAN_OF_MATRICES, _STEPS_PER_RADIAN_OF_SLOW = 1.7, 1.2, 0.5
_TOLERANCE = 1e-6  # of the interpolation, in a cautious rule: the error is 1e-9 or so
_BANDWIDTH_MARGIN = 1.03
_SWING_MARGIN = {True: 1.15, False: 1.3}  # of a linear and of the exact stiffness
_DRIFT_MARGIN = 0.75  # part of its centre to which a tongue of the table may drift with the load


def node_sampler(
    system: System, static_load: float, largest_load: float, slow: bool
) -> NodeSampler:
    """Return what samples a chart; `slow` keeps the four slowest whirls of a larger system."""
    kind = SlowSampler.reduced if slow and system.size > 2 else NodeSampler
    return kind(system, static_load, largest_load)


def chart_panels(
    sampler: NodeSampler,
    periods: Array,
    density: float = 1.0,
    between: bool = False,
    resolve: float = 0.0,
) -> tuple[Panel, ...]:
    """Return the panels in which a chart is sampled; see `ChartInterpolant`."""
    system, basis = sampler.system, sampler.basis
    frequencies = basis.frequencies
    coupling = _coupling(sampler)
    drive = float(np.linalg.norm(sampler.load_slope, 2)) * (
        sampler.largest_load * system.pulsation.largest
        + abs(sampler.static_load - float(basis.load))
    )
    fastest = float(np.sqrt(np.abs(frequencies).max() ** 2 + drive + float(basis.shift)))
    if isinstance(sampler, SlowSampler):
        steps = _STEPS_PER_RADIAN_OF_SLOW
    else:
        steps = _STEPS_PER_RADIAN if sampler.closed_form else _STEPS_PER_RADIAN_OF_MATRICES
    strength = float(np.sqrt(np.abs(coupling * coupling.T).max()))
    if between and sampler.closed_form:
        resolve = max(resolve, _longest_tongue(sampler))
    return plan_panels(
        periods,
        bandwidth=_BANDWIDTH_MARGIN * _bandwidth(sampler),
        decay=float(np.ptp(frequencies[sampler.whirls].imag)),
        swing=_SWING_MARGIN[system.is_linear] * strength * sampler.largest_load,
        rate=density * sampler.share * fastest * steps / MAP_LEVELS[0],
        density=density,
        tolerance=_TOLERANCE,
        even=sampler.is_even,
        resolve=resolve,
        least_steps=system.pulsation.highest,
    )


def _coupling(sampler: NodeSampler) -> AnyArray:
    """Return the coupling by the load of the whirls that a chart is of."""
    return np.asarray(sampler.coupling[np.ix_(sampler.whirls, sampler.whirls)])


def _bandwidth(sampler: NodeSampler) -> float:
    """Return the largest frequency of the interpolated functions of T."""
    frequencies = sampler.basis.frequencies[sampler.whirls]
    if not sampler.closed_form:
        return float(sampler.share * np.abs(frequencies).max())
    # c₁ turns with single frequencies, c₂ with sums of two, the mean one taken out
    centred = (frequencies - frequencies.mean()).real
    sums = centred[:, None] + centred
    return float(max(np.abs(centred).max(), np.abs(sums[~np.eye(4, dtype=bool)]).max()))


def _longest_tongue(sampler: NodeSampler) -> float:
    """Return the period up to which the resonance table has tongues, with room to drift."""
    frequencies, coupling = sampler.basis.frequencies[sampler.whirls], _coupling(sampler)
    gap = np.abs(np.subtract.outer(frequencies, frequencies).real)
    strength = -(coupling * coupling.T).real
    centres = gap[(strength > NEGLIGIBLE * np.abs(strength).max()) & (gap > 0)]
    return float(2 * np.pi / (_DRIFT_MARGIN * centres.min())) if centres.size else 0.0
