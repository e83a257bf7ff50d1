"""Floquet multipliers and growth rates at single points, to 1e-9 or better."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._arguments import numbers, whole_number
from ..model.modal import ModalBasis, splitting_basis
from ..model.system import System
from .integrator import POINT_SCHEME, divisible, propagate

__all__ = ["FloquetSolution", "floquet_multipliers", "floquet_solution", "growth_rate"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_LEVELS = (3, 4, 5)  # step counts in each extrapolation, times a common factor
_TOLERANCE = 3e-9  # relative, on the next-to-last extrapolant of the propagator
_RADIANS_PER_STEP = 1.5  # of the fastest mode, first attempt
_MOST_STEPS = 200_000
_LARGEST = 1e3  # entry of half a period's propagator that may still be inverted
_CHUNK = 1 << 16  # complex entries propagated together: what a cache holds


@dataclass(frozen=True)
class FloquetSolution:
    """Floquet multipliers of one period, point by point.

    Parameters
    ----------
    multipliers : (..., 2n) complex
        μ, largest modulus first; NaN where the numbers overflow.
    growth_rate : (...) float
        σ = ln max|μ| / T [√(EI/(ρAL⁴))], T = 2π/θ̄.
    error : (...) float
        Estimated error of `growth_rate`. It rises like √ε at a double multiplier.
    converged : (...) bool
        Whether the propagator met the tolerance.
    """

    multipliers: Complex
    growth_rate: Array
    error: Array
    converged: NDArray[np.bool_]


def extrapolation_weights(levels: tuple[int, ...]) -> Array:
    """Return weights that remove the errors h⁶, h⁸ … of a symmetric scheme of order 6."""
    count = len(levels)
    powers = [[float(n) ** -(4 + 2 * k) if k else 1.0 for n in levels] for k in range(count)]
    target = np.zeros(count)
    target[0] = 1
    return np.asarray(np.linalg.solve(np.array(powers), target))


_FINE = extrapolation_weights(_LEVELS)
_COARSE = np.concatenate([[0.0], extrapolation_weights(_LEVELS[1:])])


def _take(basis: ModalBasis, index: NDArray[np.intp]) -> ModalBasis:
    """Return the bases of some points; a shared one stays shared."""
    if basis.frequencies.ndim == 1:
        return basis
    return ModalBasis(
        basis.load[index], basis.frequencies[index], basis.vectors[index], basis.inverse[index]
    )


def _propagators(
    system: System,
    basis: ModalBasis,
    loads: tuple[Array, Array],
    period: Array,
    factor: int,
    share: float,
) -> tuple[Complex, Complex]:
    """Return the fine and the coarse extrapolant of Y (P, 2n, 2n) over a share of the period."""
    fine = coarse = np.complex128(0)
    for level, better, worse in zip(_LEVELS, _FINE, _COARSE, strict=True):
        steps = level * factor
        y = propagate(system, basis, loads, share * period, 2 * np.pi * share, steps, POINT_SCHEME)
        fine, coarse = fine + better * y, coarse + worse * y
    return np.moveaxis(np.asarray(fine), -1, 0), np.moveaxis(np.asarray(coarse), -1, 0)


def _multipliers(propagator: Complex, share: float) -> Complex:
    """Return the eigenvalues of the monodromy, largest modulus first; NaN where not finite."""
    finite = np.asarray(np.isfinite(propagator).all(axis=(-2, -1)))
    if share < 1:
        # too large to invert: these points take the whole period
        finite &= np.abs(propagator).max(axis=(-2, -1)) < _LARGEST
    safe = np.where(finite[:, None, None], propagator, np.eye(propagator.shape[-1]))
    if share < 1:
        # half a period is enough: by time reversal Y(−t) = conj Y(t)
        safe = np.linalg.solve(safe.conj(), safe)
    values = np.linalg.eigvals(safe)
    values[~finite] = np.nan
    order = np.argsort(-np.abs(values), axis=-1, kind="stable")
    return np.asarray(np.take_along_axis(values, order, -1))


def _batches(radians: Array, size: int) -> Iterator[NDArray[np.intp]]:
    """Yield groups of points that need about the same number of steps."""
    octave = np.ceil(2 * np.log2(np.maximum(radians, 1.0))).astype(int)
    length = max(1, _CHUNK // size**2)
    for value in np.unique(octave):
        index = np.flatnonzero(octave == value)
        for start in range(0, len(index), length):
            yield index[start : start + length]


def _solve(
    system: System, static: Array, pulsating: Array, period: Array, share: float, most_steps: int
) -> tuple[Complex, Array, NDArray[np.bool_]]:
    """Return multipliers, growth error and convergence of a flat list of points."""
    size = 2 * system.size
    shared = system.spin_speed.ndim == 0 and bool((static == static[0]).all())
    basis = splitting_basis(system, static[0] if shared else static)
    # the load's own rate, so that a strong pulsation takes smaller steps
    drive = np.linalg.norm(np.linalg.solve(system.mass, system.geometric), 2)
    swing = np.abs(static - basis.load) + np.abs(pulsating)
    radians = period * np.sqrt(np.abs(basis.frequencies).max(axis=-1) ** 2 + drive * swing)
    radians = radians * share
    multipliers = np.full((len(period), size), np.nan + 0j)
    error = np.full(len(period), np.nan)
    converged = np.zeros(len(period), dtype=np.bool_)
    for batch in _batches(radians, size):
        factor = int(np.ceil(radians[batch].max() / _RADIANS_PER_STEP / _LEVELS[-1])) + 1
        factor = divisible(factor)
        pending = batch
        while len(pending) and factor * _LEVELS[-1] <= most_steps:
            part = system
            if system.spin_speed.ndim:
                part = replace(system, spin_speed=system.spin_speed[pending])
            with np.errstate(over="ignore", invalid="ignore"):
                fine, coarse = _propagators(
                    part,
                    _take(basis, pending),
                    (static[pending], pulsating[pending]),
                    period[pending],
                    factor,
                    share,
                )
                gap = np.abs(fine - coarse).max(axis=(-2, -1))
                good = gap <= _TOLERANCE * np.abs(fine).max(axis=(-2, -1))
            finite = np.isfinite(gap)
            multipliers[pending] = _multipliers(fine, share)
            other = np.abs(_multipliers(coarse, share)[:, 0])
            with np.errstate(invalid="ignore", divide="ignore"):
                largest = np.abs(multipliers[pending, 0])
                error[pending] = np.abs(np.log(largest / other)) / period[pending]
            converged[pending] = good
            pending = pending[~good & finite]
            factor *= 2
    lost = np.flatnonzero(np.isnan(multipliers[:, 0]))
    if share < 1 and lost.size:
        if system.spin_speed.ndim:
            system = replace(system, spin_speed=system.spin_speed[lost])
        multipliers[lost], error[lost], converged[lost] = _solve(
            system, static[lost], pulsating[lost], period[lost], 1.0, most_steps
        )
    return multipliers, error, converged


def floquet_solution(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    excitation_frequency: ArrayLike,
    *,
    most_steps: int = _MOST_STEPS,
) -> FloquetSolution:
    """Return Floquet multipliers, growth rate and its estimated error.

    Parameters
    ----------
    system : System
        Lumped or finite-element, any stiffness law, damped or not.
    static_load, pulsating_load : (...) float
        p̄₀ and p̄_t [EI/L²] of p̄(t) = p̄₀ + p̄_t cos θ̄t.
    excitation_frequency : (...) float
        θ̄ [√(EI/(ρAL⁴))], above 0. All broadcast together and with the spin speed.
    most_steps : int
        Of one period, 1 or more: bounds the work. What would take more is not converged, or NaN.

    Returns
    -------
    FloquetSolution

    Raises
    ------
    ValueError
        If an argument is not finite or out of range, or the peak load p̄₀ + |p̄_t| is at or past
        the pole of the exact stiffness.

    Notes
    -----
    Splitting in the modal basis of the mean system, of order 6, extrapolated to order 10;
    the steps are halved until the order-8 value agrees to 3e-9, the order-10 value then to
    1e-11 or so. The cost grows with the fastest mode kept times the period, so with low θ̄
    and many finite-element modes.

    References
    ----------
    S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313.
    """
    static, pulsating, frequency, _ = np.broadcast_arrays(
        numbers("static_load", static_load),
        numbers("pulsating_load", pulsating_load),
        numbers("excitation_frequency", excitation_frequency, 0.0, open_low=True),
        system.spin_speed,
    )
    shape = static.shape
    if system.spin_speed.ndim:
        system = replace(system, spin_speed=np.broadcast_to(system.spin_speed, shape).ravel())
    if static.size == 0:
        empty = np.empty(shape)
        return FloquetSolution(
            np.empty((*shape, 2 * system.size), complex), empty, empty, empty.astype(bool)
        )
    period = 2 * np.pi / frequency.ravel()
    share = 1.0 if system.is_damped else 0.5
    most = whole_number("most_steps", most_steps, 1)
    multipliers, error, converged = _solve(
        system, static.ravel(), pulsating.ravel(), period, share, most
    )
    with np.errstate(divide="ignore"):
        growth = np.log(np.abs(multipliers[:, 0])) / period
    result: tuple[NDArray[Any], ...] = (
        multipliers.reshape(*shape, -1),
        growth.reshape(shape),
        error.reshape(shape),
        converged.reshape(shape),
    )
    for array in result:
        array.flags.writeable = False
    return FloquetSolution(*result)


def floquet_multipliers(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    excitation_frequency: ArrayLike,
) -> Complex:
    """Return the Floquet multipliers μ, largest modulus first; see `floquet_solution`.

    Returns
    -------
    (..., 2n) complex
        Undamped, they come in pairs μ, 1/μ̄.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> mu = floquet_multipliers(lumped(ShaftDisk(), 2.0), 1.0, 0.0, 1.3)
    >>> bool(abs(abs(mu) - 1).max() < 1e-12)
    True
    """
    return floquet_solution(
        system, static_load, pulsating_load, excitation_frequency
    ).multipliers.copy()


def growth_rate(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    excitation_frequency: ArrayLike,
) -> Array:
    """Return σ = ln max|μ| / T, above 0 where the rotor is unstable; see `floquet_solution`.

    Returns
    -------
    (...) float
        [√(EI/(ρAL⁴))]; to 1e-9, save within about 1e-9 of a tongue's edge, where a double
        multiplier turns an error ε into √ε.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> sigma = growth_rate(lumped(ShaftDisk(), 1.0), 1.1779, 0.1178, 0.99244)
    >>> round(float(sigma), 5)
    0.00924
    """
    return floquet_solution(
        system, static_load, pulsating_load, excitation_frequency
    ).growth_rate.copy()
