"""Time response of the tip from the monodromy.

Within a period the propagator is sampled once; states at later periods come from powers of
the monodromy, so a long response is as accurate as a short one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .._arguments import number, whole_number
from .._tolerances import ON_UNIT_CIRCLE
from .._types import Array, ArrayLike, Complex
from ..model.system import System, single_speed
from .initial_conditions import tip_coordinate
from .sampled_period import SampledPeriod, sampled_period

__all__ = ["TimeResponse", "time_response"]

_MOST_STEPS = 2_000_000  # in one period
_MOST_ROWS = 4_000_000
_LARGEST_LOG = 600.0  # e^600 and its products with states here are still doubles


@dataclass(frozen=True, eq=False)
class TimeResponse:
    """Motion of the tip under p̄(t) = p̄₀ + p̄_t cos θ̄t, sampled evenly.

    Parameters
    ----------
    time : (m,) float
        [√(ρAL⁴/(EI))], from 0.
    displacement : (m,) complex
        U = V + jW of the tip, times e^(−`log_scale`).
    slope : (m,) complex
        Ψ = Γ − jB of the tip, times e^(−`log_scale`).
    load : (m,) float
        p̄ [EI/L²].
    period : float
        T = 2π/θ̄.
    multipliers : (2n,) complex
        Floquet multipliers μ, largest modulus first.
    growth_rate : float
        σ = ln max|μ| / T; exactly 0 where the rotor is undamped and neutral.
    log_scale : float
        0 unless the motion exceeds the range of double precision; the true motion is larger than
        `displacement` and `slope` by the factor e^`log_scale`.
    error : float
        Estimated relative error of one sample interval's propagator.
    """

    time: Array
    displacement: Complex
    slope: Complex
    load: Array
    period: float
    multipliers: Complex
    growth_rate: float
    log_scale: float
    error: float

    @property
    def doubling_time(self) -> float:
        """Time in which the motion doubles, ln 2/σ; inf at σ = 0, minus the half-life at σ < 0."""
        return math.log(2) / self.growth_rate if self.growth_rate else math.inf

    @property
    def envelope(self) -> Array:
        """The multiple of e^(σt) that touches |U| in the second half of the time, (m,).

        There it is never below |U|. At the start the motion may be above it, while the modes that
        grow less are still large.
        """
        # relative to the larger end of the exponential, so that nothing overflows
        shift = self.time[-1] if self.growth_rate > 0 else 0.0
        curve = np.exp(self.growth_rate * (self.time - shift))
        late = slice(len(curve) // 2, None)
        with np.errstate(divide="ignore", invalid="ignore"):
            touch = np.abs(self.displacement[late]) / curve[late]
        return np.asarray(np.nanmax(touch[np.isfinite(touch)], initial=0.0) * curve)

    def until(self, displacement: float) -> TimeResponse:
        """Return the response up to the first sample at which |U| exceeds a displacement.

        Parameters
        ----------
        displacement : float
            In the units of the start.

        Returns
        -------
        TimeResponse
            The same where |U| never exceeds it; at least two rows.
        """
        beyond = np.abs(self.displacement) > displacement * math.exp(-self.log_scale)
        if not beyond.any():
            return self
        end = max(2, int(beyond.argmax()) + 1)
        rows = ("time", "displacement", "slope", "load")
        return replace(self, **{name: getattr(self, name)[:end] for name in rows})


def _orbit_of_periods(monodromy: Complex, start: Complex, periods: int) -> Complex:
    """Return monodromy^k start for k = 0 … periods; each step doubles the number of states."""
    states = start[None, :]
    power = monodromy
    while len(states) <= periods:
        states = np.concatenate([states, states @ power.T])
        power = power @ power
    return states[: periods + 1]


def time_response(
    system: System,
    static_load: float,
    pulsating_load: float,
    excitation_frequency: float,
    initial: ArrayLike,
    periods: int = 40,
    samples_per_period: int = 48,
    tip: tuple[int, int] = (0, 1),
    *,
    most_steps: int = _MOST_STEPS,
) -> TimeResponse:
    """Return the motion of the tip from given initial conditions.

    Parameters
    ----------
    system : System
        At one spin speed; lumped or finite-element, any stiffness law, damped or not.
    static_load, pulsating_load : float
        p̄₀ and p̄_t [EI/L²].
    excitation_frequency : float
        θ̄ [√(EI/(ρAL⁴))], above 0.
    initial : (2n,) complex
        (q, q̇) at t = 0, where the load is at its largest; see `initial_conditions`.
    periods : int
        Length of the response in periods of the load, 1 or more.
    samples_per_period : int
        Number of samples in a period, 4 or more; the accuracy does not depend on it.
    tip : (int, int)
        Indices of the coordinates that are the tip's displacement and slope; (-2, -1) for a
        finite-element system that is not reduced.
    most_steps : int
        Largest number of steps per period, 1 or more. With fewer steps than the tolerance needs,
        `error` is larger.

    Returns
    -------
    TimeResponse
        periods × samples_per_period + 1 rows.

    Raises
    ------
    ValueError
        If an argument is out of range, the load reaches the pole of the stiffness, one
        period takes more than `most_steps` steps, or the motion overflows within one period.

    Notes
    -----
    Each sample interval is integrated by a splitting scheme of order 6, extrapolated to order 10.
    The state after k periods is the k-th power of the monodromy times the initial state; its error
    grows like k times the rounding error.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, initial_conditions, lumped
    >>> system = lumped(ShaftDisk(), 2.0)
    >>> start = initial_conditions(system, 1.0, "mode:1F")
    >>> motion = time_response(system, 1.0, 0.0, 1.3, start, periods=5)
    >>> bool(abs(abs(motion.displacement) - 1).max() < 1e-12)
    True
    """
    single_speed(system)
    static = number("static_load", static_load)
    pulsating = number("pulsating_load", pulsating_load)
    frequency = number("excitation_frequency", excitation_frequency, 0.0, open_low=True)
    length = whole_number("periods", periods, 1)
    samples = whole_number("samples_per_period", samples_per_period, 4)
    most = whole_number("most_steps", most_steps, 1)
    if length * samples > _MOST_ROWS:
        raise ValueError(
            f"`periods` times `samples_per_period` must be at most {_MOST_ROWS}, "
            f"got {length * samples}"
        )
    start = _checked_state(system, initial)
    if len(tip) != 2:
        raise ValueError(f"`tip` must hold two coordinates, got {tip!r}")
    ends = [tip_coordinate(system, index) for index in tip]
    period = 2 * np.pi / frequency
    with np.errstate(over="ignore", invalid="ignore"):
        sampled = sampled_period(system, static, pulsating, period, samples, most)
    if not np.isfinite(sampled.from_start[-1]).all():
        raise ValueError(
            "`excitation_frequency` is so low that the motion overflows within one period, "
            f"got {frequency:g}"
        )
    multipliers, radius = _multipliers(sampled.from_start[-1], system.is_damped)
    rate = math.log(radius)
    log_scale = max(0.0, length * rate - _LARGEST_LOG)
    motion = _motion(sampled, start, ends, length, radius, log_scale)
    load = static + pulsating * system.pulsation.at(np.arange(samples) * (2 * np.pi / samples))
    response = TimeResponse(
        time=np.asarray(np.arange(length * samples + 1) * (period / samples), np.float64),
        displacement=motion[0],
        slope=motion[1],
        load=np.append(np.tile(load, length), load[0]),
        period=period,
        multipliers=multipliers,
        growth_rate=rate / period,
        log_scale=log_scale,
        error=sampled.error,
    )
    for array in (response.time, response.displacement, response.slope, response.load, multipliers):
        array.flags.writeable = False
    return response


def _checked_state(system: System, initial: ArrayLike) -> Complex:
    """Return a state (q, q̇) whose 2n numbers are finite."""
    size = 2 * system.size
    state = np.asarray(initial, dtype=np.complex128)
    if state.shape != (size,) or not np.isfinite(state).all():
        raise ValueError(f"`initial` must hold {size} finite numbers, got {initial!r}")
    return state


def _multipliers(monodromy: Complex, damped: bool) -> tuple[Complex, float]:
    """Return the multipliers, largest modulus first, and that modulus, 1 where it is neutral."""
    multipliers = np.linalg.eigvals(monodromy)
    multipliers = multipliers[np.argsort(-np.abs(multipliers), kind="stable")]
    radius = float(np.abs(multipliers[0]))
    if not damped and abs(radius - 1) < ON_UNIT_CIRCLE:
        radius = 1.0
    return np.asarray(multipliers, np.complex128), radius


def _motion(
    sampled: SampledPeriod,
    start: Complex,
    coordinates: list[int],
    periods: int,
    radius: float,
    log_scale: float,
) -> Complex:
    """Return some coordinates (c, periods · samples + 1) of the motion, times e^(−log_scale)."""
    n = len(start) // 2
    vectors, inverse = (
        np.asarray(part, complex) for part in (sampled.basis.vectors, sampled.basis.inverse)
    )
    # z = (q, −jq̇) = V y
    modal = inverse @ np.concatenate([start[:n], -1j * start[n:]])
    states = _orbit_of_periods(sampled.from_start[-1] / radius, modal, periods)
    with np.errstate(under="ignore"):
        states = states * np.exp(np.arange(periods + 1) * math.log(radius) - log_scale)[:, None]
        rows = vectors[coordinates] @ sampled.from_start[:-1]
        motion = np.einsum("sci,ki->cks", rows, states[:-1]).reshape(len(coordinates), -1)
        last = vectors[coordinates] @ states[-1]
    return np.concatenate([motion, last[:, None]], axis=1)
