"""Floquet multipliers and growth rates at single points, to 1e-9 or better."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .._arguments import numbers, whole_number
from .._types import Array, ArrayLike, Complex, Index, Mask
from ..model.modal import ModalBasis, splitting_basis
from ..model.system import System
from .criterion import is_unstable
from .integrator import POINT_LEVELS, fastest_rate, fine_and_coarse, propagate
from .schemes import POINT_SCHEME, divisible

__all__ = ["FloquetSolution", "floquet_multipliers", "floquet_solution", "growth_rate"]

_TOLERANCE = 3e-9  # relative difference of the extrapolants of order 10 and 8 that is accepted
_RADIANS_PER_STEP = 1.5  # turned by the fastest mode in one step of the first attempt
_MOST_STEPS = 200_000
_LARGEST = 1e3  # largest entry of half a period's propagator that may still be inverted
_CHUNK = 1 << 16  # complex entries propagated together: about what a processor's cache holds


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
        Estimated error of `growth_rate`. At a double multiplier, that is at the edge of a tongue,
        an error ε of the propagator becomes √ε.
    converged : (...) bool
        Whether the propagator met its tolerance, with no more steps than were allowed.
    """

    multipliers: Complex
    growth_rate: Array
    error: Array
    converged: Mask

    @property
    def unstable(self) -> Mask:
        """Where the growth rate exceeds both its error and 1e-8, (...) bool."""
        return is_unstable(self.growth_rate, self.error)


@dataclass(frozen=True)
class _Points:
    """A flat list of P points to solve, with the modal basis of the mean system at each of them.

    `share` is the part of a period that is integrated: half of it where time reversal gives the
    rest, all of it with damping.
    """

    system: System
    static: Array
    pulsating: Array
    period: Array
    share: float
    basis: ModalBasis

    @classmethod
    def of(
        cls, system: System, static: Array, pulsating: Array, period: Array, share: float
    ) -> _Points:
        """Return the points with their bases; points of one mean system share one basis."""
        shared = system.spin_speed.ndim == 0 and bool((static == static[0]).all())
        basis = splitting_basis(system, static[0] if shared else static)
        return cls(system, static, pulsating, period, share, basis)

    def __len__(self) -> int:
        return len(self.period)

    def __getitem__(self, index: Index) -> _Points:
        """Return some of the points."""
        system, basis = self.system, self.basis
        if system.spin_speed.ndim:
            system = replace(system, spin_speed=system.spin_speed[index])
        if basis.frequencies.ndim > 1:
            arrays = basis.load, basis.frequencies, basis.vectors, basis.inverse
            basis = ModalBasis(*(array[index] for array in arrays))
        static, pulsating, period = self.static[index], self.pulsating[index], self.period[index]
        return _Points(system, static, pulsating, period, self.share, basis)

    def propagators(self, factor: int) -> tuple[Complex, Complex]:
        """Return the fine and the coarse extrapolant of Y (P, 2n, 2n) over the share."""
        span, turn = self.share * self.period, 2 * np.pi * self.share
        loads = self.static, self.pulsating
        fine, coarse = fine_and_coarse(
            lambda steps: propagate(
                self.system, self.basis, loads, span, turn, steps, POINT_SCHEME
            ),
            factor,
        )
        return np.moveaxis(fine, -1, 0), np.moveaxis(coarse, -1, 0)


@dataclass(frozen=True)
class _Results:
    """What is known of P points: multipliers (P, 2n), error of the growth and convergence (P,)."""

    multipliers: Complex
    error: Array
    converged: Mask

    @classmethod
    def unknown(cls, count: int, size: int) -> _Results:
        """Return results that are NaN and not converged."""
        multipliers = np.full((count, size), np.nan + 0j)
        return cls(multipliers, np.full(count, np.nan), np.zeros(count, dtype=np.bool_))

    def __setitem__(self, index: Index, other: _Results) -> None:
        """Take over the results of some points."""
        self.multipliers[index] = other.multipliers
        self.error[index] = other.error
        self.converged[index] = other.converged


def _multipliers(propagator: Complex, share: float) -> Complex:
    """Return the eigenvalues of the monodromy, largest modulus first; NaN where not finite."""
    finite = np.asarray(np.isfinite(propagator).all(axis=(-2, -1)))
    if share < 1:
        # entries too large to invert: the caller integrates these points over the whole period
        finite &= np.abs(propagator).max(axis=(-2, -1)) < _LARGEST
    safe = np.where(finite[:, None, None], propagator, np.eye(propagator.shape[-1]))
    if share < 1:
        # half a period is enough: by time reversal Y(−t) = conj Y(t)
        safe = np.linalg.solve(safe.conj(), safe)
    values = np.linalg.eigvals(safe)
    values[~finite] = np.nan
    order = np.argsort(-np.abs(values), axis=-1, kind="stable")
    return np.asarray(np.take_along_axis(values, order, -1))


def _batches(radians: Array, size: int) -> Iterator[Index]:
    """Yield groups of points that need about the same number of steps."""
    octave = np.ceil(2 * np.log2(np.maximum(radians, 1.0))).astype(int)
    length = max(1, _CHUNK // size**2)
    for value in np.unique(octave):
        index = np.flatnonzero(octave == value)
        for start in range(0, len(index), length):
            yield index[start : start + length]


def _attempt(points: _Points, factor: int) -> tuple[_Results, Mask]:
    """Return results with a given factor of the step counts, and which points are finite."""
    with np.errstate(over="ignore", invalid="ignore"):
        fine, coarse = points.propagators(factor)
        gap = np.abs(fine - coarse).max(axis=(-2, -1))
        converged = gap <= _TOLERANCE * np.abs(fine).max(axis=(-2, -1))
    multipliers = _multipliers(fine, points.share)
    with np.errstate(invalid="ignore", divide="ignore"):
        largest, other = np.abs(multipliers[:, 0]), np.abs(_multipliers(coarse, points.share)[:, 0])
        error = np.abs(np.log(largest / other)) / points.period
    return _Results(multipliers, error, converged), np.isfinite(gap)


def _solve(points: _Points, most_steps: int) -> _Results:
    """Return the results of all points, halving the steps where they have not converged."""
    size = 2 * points.system.size
    rate = fastest_rate(points.system, points.basis, (points.static, points.pulsating))
    radians = points.period * rate * points.share
    results = _Results.unknown(len(points), size)
    for batch in _batches(radians, size):
        factor = int(np.ceil(radians[batch].max() / _RADIANS_PER_STEP / POINT_LEVELS[-1])) + 1
        factor = divisible(factor)
        pending = batch
        while len(pending) and factor * POINT_LEVELS[-1] <= most_steps:
            attempt, finite = _attempt(points[pending], factor)
            results[pending] = attempt
            pending = pending[~attempt.converged & finite]
            factor *= 2
    lost = np.flatnonzero(np.isnan(results.multipliers[:, 0]))
    if points.share < 1 and lost.size:
        results[lost] = _solve(replace(points[lost], share=1.0), most_steps)
    return results


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
        Largest number of steps per period, 1 or more. Points that would need more are returned as
        not converged; their growth rate is NaN if even the first attempt needs more.

    Returns
    -------
    FloquetSolution

    Raises
    ------
    ValueError
        If an argument is not finite or out of range, or if the peak load p̄₀ + |p̄_t| reaches the
        pole of the exact stiffness.

    Notes
    -----
    The propagator is computed in the modal basis of the mean system by a splitting scheme of
    order 6, extrapolated to order 10. The steps are halved until the extrapolant of order 8 agrees
    to 3e-9; that of order 10 is then right to about 1e-11. The cost grows with the frequency of
    the fastest mode times the period: it is high for low θ̄ and many finite-element modes.

    References
    ----------
    S. Blanes, P. C. Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström
    methods, Journal of Computational and Applied Mathematics 142 (2002) 313–330,
    doi 10.1016/S0377-0427(01)00492-7.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> solution = floquet_solution(lumped(ShaftDisk(), 1.0), 1.178, 0.1178, [0.9, 0.99244])
    >>> solution.unstable.tolist()
    [False, True]
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
    points = _Points.of(system, static.ravel(), pulsating.ravel(), period, share)
    found = _solve(points, most)
    with np.errstate(divide="ignore"):
        growth = np.log(np.abs(found.multipliers[:, 0])) / period
    solution = FloquetSolution(
        found.multipliers.reshape(*shape, -1),
        growth.reshape(shape),
        found.error.reshape(shape),
        found.converged.reshape(shape),
    )
    for array in vars(solution).values():
        array.flags.writeable = False
    return solution


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
