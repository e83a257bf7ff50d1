"""Time response of the tip from the monodromy, and the shaft's shape between root and tip.

Within a period the propagator is sampled once; states at later periods come from powers of
the monodromy, so a long response costs no more accuracy than a short one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._arguments import number, numbers, whole_number
from ..model.modal import modal_basis, splitting_basis
from ..model.stiffness import exact_stiffness
from ..model.system import System, fundamental_frequency
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.mode_names import names_of
from .integrator import POINT_SCHEME, segment_propagators
from .point import extrapolation_weights

__all__ = ["ShaftShape", "TimeResponse", "initial_conditions", "shaft_shape", "time_response"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_LEVELS = (3, 4, 5)  # steps in one sample interval, times a common factor
_TOLERANCE = 1e-11  # relative, on the next-to-last extrapolant of each interval
_MOST_STEPS = 2_000_000  # in one period
_MOST_ROWS = 4_000_000
_LARGEST_LOG = 600.0  # e^600 is still a double, and so are its products here
_SERIES_BELOW = 1.0  # closed forms lose digits for smaller |x|ξ²
# Taylor coefficients in xξ² of the three functions of the shape
_SERIES = np.array(
    [[(-1.0) ** n / math.factorial(2 * n + k) for n in range(12)] for k in (1, 2, 3)]
)
_NEUTRAL = 1e-10  # undamped multipliers this near to the unit circle lie on it


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
        Of the monodromy, largest modulus first.
    growth_rate : float
        σ = ln max|μ| / T; exactly 0 where the rotor is undamped and neutral.
    log_scale : float
        0 unless the motion outgrows double precision; the true motion is e^`log_scale` larger.
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
        """Time in which the motion doubles, ln 2/σ; below 0 it is the time of halving."""
        return math.log(2) / self.growth_rate if self.growth_rate else math.inf

    @property
    def envelope(self) -> Array:
        """The smallest multiple of e^(σt) that is never below |U|, (m,)."""
        # relative to the end that is larger, so that nothing overflows
        shift = self.time[-1] if self.growth_rate > 0 else 0.0
        curve = np.exp(self.growth_rate * (self.time - shift))
        with np.errstate(divide="ignore", invalid="ignore"):
            touch = np.abs(self.displacement) / curve
        return np.asarray(np.nanmax(touch[np.isfinite(touch)], initial=0.0) * curve)


@dataclass(frozen=True, eq=False)
class ShaftShape:
    """Deflected shaft between root and tip.

    Parameters
    ----------
    position : (k,) float
        x/L from 0 to 1.
    displacement, slope : (..., k) float or complex
        v and γ there.
    """

    position: Array
    displacement: NDArray[np.float64] | Complex
    slope: NDArray[np.float64] | Complex


def _coordinate(system: System, index: int) -> int:
    """Return a coordinate of the tip, counted from the first."""
    return whole_number("tip", index, -system.size, system.size - 1) % system.size


def initial_conditions(
    system: System,
    static_load: float,
    kind: str = "knock",
    seed: int = 0,
    tip: tuple[int, int] = (0, 1),
) -> Complex:
    """Return a state (q, q̇) to start from.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²], at which the whirl modes are taken.
    kind : str
        "mode:1F" and its like, a whirl mode with unit tip displacement in V; "knock", an
        impulse on the tip along V that gives it the speed ω_n; "noise", every whirl mode with
        a random complex amplitude.
    seed : int
        Of the noise, 0 or more.
    tip : (int, int)
        Which coordinates are the tip's displacement and slope; (-2, -1) for a finite-element
        system that is not reduced.

    Returns
    -------
    (2n,) complex

    Raises
    ------
    ValueError
        If there is no such kind, mode or coordinate.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> start = initial_conditions(lumped(ShaftDisk(), 2.0), 1.0, "mode:1F")
    >>> complex(start[0])
    (1+0j)
    """
    n = system.size
    if system.spin_speed.ndim:
        raise ValueError(
            f"`system` must have one spin speed, got an array of shape {system.spin_speed.shape}"
        )
    end = _coordinate(system, tip[0])
    if kind == "knock":
        impulse = np.linalg.solve(system.mass, np.eye(n)[end])
        speed = fundamental_frequency(system) * impulse / impulse[end]
        return np.concatenate([np.zeros(n), speed]).astype(complex)
    basis = modal_basis(system, number("static_load", static_load))
    names = names_of(system, float(static_load), basis.frequencies)
    modes = basis.vectors.astype(complex)
    # z = (q, −jq̇)
    modes[n:] *= 1j
    if kind == "noise":
        generator = np.random.default_rng(whole_number("seed", seed, 0))
        pairs = generator.standard_normal((2, 2 * n))
        amplitudes = (pairs[0] + 1j * pairs[1]) / math.sqrt(4 * n)
        sizes = np.einsum("ik,ij,jk->k", modes[:n].conj(), system.mass, modes[:n]).real
        modes = modes * np.sqrt(system.mass[end, end] / sizes)
        return np.asarray(modes @ amplitudes)
    chosen = kind.removeprefix("mode:") if isinstance(kind, str) else kind
    if not isinstance(kind, str) or not kind.startswith("mode:") or chosen not in names:
        known = ", ".join(repr(f"mode:{name}") for name in sorted(names))
        raise ValueError(f"`kind` must be 'knock', 'noise' or one of {known}, got {kind!r}")
    mode = modes[:, names.index(chosen)]
    return np.asarray(mode / mode[end])


def _sample_propagators(
    system: System, static: float, pulsating: float, period: float, samples: int, most_steps: int
) -> tuple[Complex, Complex, Complex, float]:
    """Return V, V⁻¹, Y(0 → t_s) for s = 0 … samples, (samples + 1, 2n, 2n), and the error."""
    basis = splitting_basis(system, static)
    loads = np.array([static]), np.array([pulsating])
    drive = np.linalg.norm(np.linalg.solve(system.mass, system.geometric), 2)
    fastest = np.abs(basis.frequencies).max() ** 2
    fastest += drive * (abs(static - float(basis.load)) + abs(pulsating))
    factor = int(np.sqrt(fastest) * period / samples / _LEVELS[-1]) + 1
    if factor * _LEVELS[-1] * samples > most_steps:
        raise ValueError(
            "`excitation_frequency` is so low that one period takes "
            f"{factor * _LEVELS[-1] * samples} steps, more than `most_steps`, {most_steps}"
        )
    while True:
        fine = coarse = np.complex128(0)
        weights = extrapolation_weights(_LEVELS), extrapolation_weights(_LEVELS[1:])
        for index, level in enumerate(_LEVELS):
            y = segment_propagators(
                system,
                basis,
                loads,
                np.array([period]),
                2 * np.pi,
                level * factor,
                POINT_SCHEME,
                samples,
            )[..., 0]
            fine = fine + weights[0][index] * y
            if index:
                coarse = coarse + weights[1][index - 1] * y
        gap = float(np.abs(fine - coarse).max() / np.abs(fine).max())
        if not gap > _TOLERANCE or 2 * factor * _LEVELS[-1] * samples > most_steps:
            break
        factor *= 2
    parts = np.moveaxis(np.asarray(fine), -1, 0)
    from_start = np.empty((samples + 1, *parts.shape[1:]), complex)
    from_start[0] = np.eye(parts.shape[-1])
    for index, part in enumerate(parts):
        from_start[index + 1] = part @ from_start[index]
    vectors = np.asarray(basis.vectors, complex)
    return vectors, np.asarray(basis.inverse, complex), from_start, gap


def _orbit_of_periods(monodromy: Complex, start: Complex, periods: int) -> Complex:
    """Return monodromy^k start for k = 0 … periods, by doubling."""
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
        Length in periods of the load, 1 or more.
    samples_per_period : int
        4 or more; accuracy does not depend on it.
    tip : (int, int)
        Which coordinates are the tip's displacement and slope; (-2, -1) for a finite-element
        system that is not reduced.
    most_steps : int
        Of one period, 1 or more: bounds the work; fewer steps than are wanted leave a larger
        `error`.

    Returns
    -------
    TimeResponse
        periods × samples_per_period + 1 rows.

    Raises
    ------
    ValueError
        If an argument is out of range, the load passes the pole of the exact stiffness, one
        period takes more than `most_steps` steps, or the motion overflows within it.

    Notes
    -----
    Splitting of order 6 extrapolated to order 10 within each sample interval. The state after k
    periods is the k-th power of the monodromy; its error grows like k times the rounding error.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> system = lumped(ShaftDisk(), 2.0)
    >>> start = initial_conditions(system, 1.0, "mode:1F")
    >>> motion = time_response(system, 1.0, 0.0, 1.3, start, periods=5)
    >>> bool(abs(abs(motion.displacement) - 1).max() < 1e-12)
    True
    """
    if system.spin_speed.ndim:
        raise ValueError(
            f"`system` must have one spin speed, got an array of shape {system.spin_speed.shape}"
        )
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
    n = system.size
    start = np.asarray(initial, dtype=np.complex128)
    if start.shape != (2 * n,) or not np.isfinite(start).all():
        raise ValueError(f"`initial` must hold {2 * n} finite numbers, got {initial!r}")
    period = 2 * np.pi / frequency
    if len(tip) != 2:
        raise ValueError(f"`tip` must hold two coordinates, got {tip!r}")
    ends = [_coordinate(system, index) for index in tip]
    with np.errstate(over="ignore", invalid="ignore"):
        vectors, inverse, from_start, error = _sample_propagators(
            system, static, pulsating, period, samples, most
        )
    monodromy = from_start[-1]
    if not np.isfinite(monodromy).all():
        raise ValueError(
            "`excitation_frequency` is so low that the motion overflows within one period, "
            f"got {frequency:g}"
        )
    multipliers = np.linalg.eigvals(monodromy)
    multipliers = multipliers[np.argsort(-np.abs(multipliers), kind="stable")]
    radius = float(np.abs(multipliers[0]))
    if not system.is_damped and abs(radius - 1) < _NEUTRAL:
        radius = 1.0
    # z = (q, −jq̇) = V y
    modal = inverse @ np.concatenate([start[:n], -1j * start[n:]])
    states = _orbit_of_periods(monodromy / radius, modal, length)
    rate = math.log(radius)
    log_scale = max(0.0, length * rate - _LARGEST_LOG)
    with np.errstate(under="ignore"):
        states = states * np.exp(np.arange(length + 1) * rate - log_scale)[:, None]
        rows = vectors[ends] @ from_start[:-1]
        motion = np.einsum("sci,ki->cks", rows, states[:-1]).reshape(2, -1)
        last = vectors[ends] @ states[-1]
    displacement, slope = np.concatenate([motion, last[:, None]], axis=1)
    time = np.arange(length * samples + 1) * (period / samples)
    load = static + pulsating * np.cos(np.arange(samples) * (2 * np.pi / samples))
    result = TimeResponse(
        time=numbers("time", time),
        displacement=displacement,
        slope=slope,
        load=np.append(np.tile(load, length), load[0]),
        period=period,
        multipliers=multipliers,
        growth_rate=rate / period,
        log_scale=log_scale,
        error=error,
    )
    for array in (result.time, result.displacement, result.slope, result.load, multipliers):
        array.flags.writeable = False
    return result


def _shape_functions(x: float, xi: Array) -> tuple[Array, Array, Array]:
    """Return sin kξ/k, (1 − cos kξ)/x and (ξ − sin kξ/k)/x, k = √x; entire in x."""
    y = x * xi**2
    small = np.abs(y) < _SERIES_BELOW
    far = np.where(small, 1.0, y)
    k = np.sqrt(np.abs(far))
    with np.errstate(over="ignore"):
        sine = np.where(far > 0, np.sin(k), np.sinh(k)) / k
        cosine = np.where(far > 0, np.cos(k), np.cosh(k))
    closed = sine, (1 - cosine) / far, (1 - sine) / far
    near = np.where(small, y, 0.0)
    series = [np.polynomial.polynomial.polyval(near, row) for row in _SERIES]
    s, c, g = (np.where(small, a, b) for a, b in zip(series, closed, strict=True))
    return xi * s, xi**2 * c, xi**3 * g


def shaft_shape(
    rotor: ShaftDisk, load: float, tip_state: ArrayLike, points: int = 25
) -> ShaftShape:
    """Return the exact shape of the loaded shaft between root and tip, (A4)–(A7).

    With C of (1 − Φp̄)v′ − γ = C and x = p̄/(1 − Φp̄), (A4) is γ″ + xγ + D = 0 with
    D = C/(Φ(1 − Φp̄)), the transverse force over 1 − Φp̄; γ′(0) is the root's moment.

    Parameters
    ----------
    rotor : ShaftDisk
        Its `shear` Φ matters.
    load : float
        p̄ [EI/L²], compression positive, below `largest_exact_load`.
    tip_state : (..., 2) float or complex
        Displacement and slope of the tip.
    points : int
        2 or more, evenly from root to tip.

    Returns
    -------
    ShaftShape

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    The inertia of the shaft is neglected, as in the lumped model. A follower load only
    changes the force at the tip, not the shape for a given tip. In strong tension, √|x| ≫ 1,
    rounding errors grow like e^√|x|.

    Examples
    --------
    >>> shape = shaft_shape(ShaftDisk(), 0.0, [1.0, 1.5], points=3)
    >>> [float(f"{v:.4f}") for v in shape.displacement]
    [0.0, 0.3125, 1.0]
    """
    p = number("load", load)
    count = whole_number("points", points, 2, 10_000)
    tip = np.asarray(tip_state)
    if tip.shape[-1:] != (2,) or not np.isfinite(tip).all():
        raise ValueError(f"`tip_state` must hold finite pairs (..., 2), got {tip_state!r}")
    shear = rotor.shear
    force, moment = np.moveaxis(tip @ exact_stiffness(p, shear).T, -1, 0)
    softening = 1 - shear * p
    xi = np.linspace(0.0, 1.0, count)
    s, c, g = _shape_functions(p / softening, xi)
    # γ′ integrated over (A4), (A5): root moment = tip moment + force · 1 + p̄ v(1)
    root = (moment + force + p * tip[..., 0])[..., None]
    shift = (force / softening)[..., None]
    return ShaftShape(
        position=numbers("position", xi),
        displacement=(root * c - shift * g) / softening + shear * shift * xi,
        slope=root * s - shift * c,
    )
