"""Multipliers of many points at once: propagators with as few steps as their tolerance needs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .._types import Array, Complex, Index, Mask
from ..model.modal import ModalBasis, splitting_basis
from ..model.system import System
from .integrator import POINT_LEVELS, fastest_rate, fine_and_coarse, propagate
from .schemes import POINT_SCHEME, divisible

__all__ = ["Points", "Results", "solved_points"]

_TOLERANCE = 3e-9  # relative difference of the extrapolants of order 10 and 8 that is accepted
_RADIANS_PER_STEP = 1.5  # turned by the fastest mode in one step of the first attempt
_LARGEST = 1e3  # largest entry of half a period's propagator that may still be inverted
_CHUNK = 1 << 16  # complex entries propagated together: about what a processor's cache holds


@dataclass(frozen=True)
class Points:
    """A flat list of P points to solve.

    Parameters
    ----------
    system : System
        At one spin speed, or at one for each point.
    static, pulsating, period : (P,) float
        p̄₀, p̄_t and T.
    share : float
        Part of a period that is integrated: 0.5 where time reversal gives the rest, 1 with damping.
    basis : ModalBasis
        Of the mean system, shared or one for each point.
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
    ) -> Points:
        """Return the points with their bases; points of one mean system share one basis."""
        shared = system.spin_speed.ndim == 0 and bool((static == static[0]).all())
        basis = splitting_basis(system, static[0] if shared else static)
        return cls(system, static, pulsating, period, share, basis)

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.period)

    def __getitem__(self, index: Index) -> Points:
        """Return some of the points."""
        system, basis = self.system, self.basis
        if system.spin_speed.ndim:
            system = replace(system, spin_speed=system.spin_speed[index])
        if basis.frequencies.ndim > 1:
            arrays = basis.load, basis.frequencies, basis.vectors, basis.inverse, basis.shift
            basis = ModalBasis(*(array[index] for array in arrays))
        static, pulsating, period = self.static[index], self.pulsating[index], self.period[index]
        return Points(system, static, pulsating, period, self.share, basis)

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
class Results:
    """What is known of P points.

    Parameters
    ----------
    multipliers : (P, 2n) complex
        Largest modulus first.
    error : (P,) float
        Error of the growth rate.
    converged : (P,) bool
    """

    multipliers: Complex
    error: Array
    converged: Mask

    @classmethod
    def unknown(cls, count: int, size: int) -> Results:
        """Return results that are NaN and not converged."""
        multipliers = np.full((count, size), np.nan + 0j)
        return cls(multipliers, np.full(count, np.nan), np.zeros(count, dtype=np.bool_))

    def __setitem__(self, index: Index, other: Results) -> None:
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


def _attempt(points: Points, factor: int) -> tuple[Results, Mask]:
    """Return results with a given factor of the step counts, and which points are finite."""
    with np.errstate(over="ignore", invalid="ignore"):
        fine, coarse = points.propagators(factor)
        gap = np.abs(fine - coarse).max(axis=(-2, -1))
        converged = gap <= _TOLERANCE * np.abs(fine).max(axis=(-2, -1))
    multipliers = _multipliers(fine, points.share)
    with np.errstate(invalid="ignore", divide="ignore"):
        largest, other = np.abs(multipliers[:, 0]), np.abs(_multipliers(coarse, points.share)[:, 0])
        error = np.abs(np.log(largest / other)) / points.period
    return Results(multipliers, error, converged), np.isfinite(gap)


def solved_points(points: Points, most_steps: int) -> Results:
    """Return the results of all points; the steps are halved until each has converged.

    Parameters
    ----------
    points : Points
    most_steps : int
        Largest number of steps per integrated span; points that need more are not converged.
    """
    size = 2 * points.system.size
    rate = fastest_rate(points.system, points.basis, (points.static, points.pulsating))
    rate = np.maximum(rate, 2 * np.pi * points.system.pulsation.highest / points.period)
    radians = points.period * rate * points.share
    results = Results.unknown(len(points), size)
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
        results[lost] = solved_points(replace(points[lost], share=1.0), most_steps)
    return results
