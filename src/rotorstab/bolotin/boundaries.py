"""Bolotin's boundary frequencies, the roots of Eq. (24).

All roots are computed as λ = θ̄²/4: as a real quartic for the paper's rotor, as eigenvalues for
every other system.
"""

from __future__ import annotations

import numpy as np

from .._arguments import numbers
from .._numerics.quartic import quadratic_roots, quartic_roots
from .._numerics.roots import is_real
from .._numerics.two_by_two import determinant, entries, mixed_determinant
from .._tolerances import CLOSE_SQUARES
from .._types import AnyArray, Array, ArrayLike, Complex
from ..model.system import System

__all__ = [
    "boundary_frequencies",
    "boundary_squares",
    "frequencies_of_squares",
    "has_paper_form",
    "mean_and_half_swing",
    "real_squares",
]


def boundary_frequencies(
    system: System, static_load: ArrayLike, pulsating_load: ArrayLike
) -> Array:
    """Return Bolotin's boundary frequencies θ̄, the roots of Eq. (24).

    Parameters
    ----------
    system : System
        Its spin speed broadcasts against the loads.
    static_load, pulsating_load : (...) float
        p̄₀ = α_s p̄_cr and p̄_t = β_d p̄_cr [EI/L²]; the sign of p̄_t does not matter.

    Returns
    -------
    (..., 2n) float
        θ̄ [√(EI/(ρAL⁴))] ascending, NaN (last) where a root is not real and positive.

    Raises
    ------
    ValueError
        If a load is not finite, or past the pole of the stiffness.

    Notes
    -----
    This is the first approximation (one harmonic). At p̄_t = 0 the values are 2|ω|. A damped rotor
    that spins has in general no solution of period 2T at all: every entry is NaN.

    References
    ----------
    Eqs. (21)–(24) of the source paper.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> boundary_frequencies(lumped(ShaftDisk(), 2.0), 0.0, 0.0).round(4).tolist()
    [0.5322, 2.146, 3.4668, 9.8529]
    """
    static = numbers("static_load", static_load)
    pulsating = numbers("pulsating_load", pulsating_load)
    squares = real_squares(boundary_squares(system, static, pulsating))
    return np.sort(frequencies_of_squares(squares), axis=-1)


def boundary_squares(system: System, static_load: Array, pulsating_load: Array) -> Complex:
    """Return λ = θ̄²/4 (..., 2n) of every boundary, real or not."""
    mean, swing, half = mean_and_half_swing(system, static_load, pulsating_load)
    if has_paper_form(system):
        return _quartic_squares(system, mean, swing, half)
    shift = half[..., None, None] * swing
    if not system.is_damped:
        # b → jb keeps an undamped system real
        return _eigenvalue_squares(system, mean - shift, mean + shift, system.spin_matrix())
    mean = mean + system.cross_part()
    return _eigenvalue_squares(system, mean - shift, mean + shift, 1j * system.damping())


def real_squares(squares: Complex) -> Array:
    """Return the real λ (..., 2n), NaN for those that are not."""
    if not squares.imag.any():
        return squares.real
    return np.where(is_real(squares), squares.real, np.nan)


def frequencies_of_squares(squares: Array) -> Array:
    """Return θ̄ = 2√λ, NaN where λ is NaN or negative."""
    with np.errstate(invalid="ignore"):
        return np.asarray(2 * np.sqrt(squares))


def has_paper_form(system: System) -> bool:
    """Return whether Eq. (24) is the quartic of the paper.

    That takes two undamped coordinates, a diagonal mass matrix and no gyroscopic entry but H₂₂.
    """
    if system.size != 2 or system.is_damped:
        return False
    h, m = entries(system.gyroscopic), entries(system.mass)
    return not any((*h[:3], *m[1:3]))


def mean_and_half_swing(
    system: System, static_load: Array, pulsating_load: Array
) -> tuple[Array, Array, Array]:
    """Return K₀, B and y with K∓ = K₀ ∓ yB."""
    if system.is_linear:
        # of any load only the first harmonic enters; a shift of time makes it a cosine
        half = pulsating_load * (abs(system.pulsation.amplitudes[0]) / 2)
        return system.load_stiffness(static_load), system.geometric, half
    mean, first = system.load_harmonics(static_load, pulsating_load)
    return mean, first, np.array(0.5)


def _quartic_squares(system: System, mean: Array, swing: Array, y: Array) -> Complex:
    """Return λ (..., 4) of the paper's rotor, Eq. (24) as a quartic."""
    m, k, b = entries(system.mass), entries(mean), entries(swing)
    # det(K∓ − λM) = e₂λ² + e₁λ + e₀ ∓ (f₁λ + f₀)
    e2, e1, e0 = determinant(m), -mixed_determinant(k, m), determinant(k) + y * y * determinant(b)
    f1, f0 = -y * mixed_determinant(b, m), y * mixed_determinant(k, b)
    gyroscopic = (system.spin_speed * system.gyroscopic[1, 1]) ** 2
    if not gyroscopic.any():
        # two quadratics whose roots cross freely, a column each
        blocks = quadratic_roots(e2, e1 - f1, e0 - f0), quadratic_roots(e2, e1 + f1, e0 + f0)
        shape = (*np.broadcast_shapes(gyroscopic.shape, blocks[0].shape[:-1]), 2)
        return np.concatenate([np.broadcast_to(block, shape) for block in blocks], axis=-1)
    # Eq. (24): D₋D₊ − λ(Ω̄Ī_P)² a₋a₊ with a∓ = k₁₁ ∓ y b₁₁ − λM̄_D
    squares = quartic_roots(
        e2 * e2,
        2 * e2 * e1 - gyroscopic * m[0] ** 2,
        e1 * e1 + 2 * e2 * e0 - f1 * f1 + gyroscopic * (2 * k[0] * m[0]),
        2 * (e1 * e0 - f1 * f0) - gyroscopic * (k[0] ** 2 - (y * b[0]) ** 2),
        (e0 - f0) * (e0 + f0),
    )
    lower, upper = squares.real[..., :-1], squares.real[..., 1:]
    near = (upper - lower < CLOSE_SQUARES * np.abs(upper)).any(axis=-1)
    if near.any():
        shift = y[..., None, None] * swing
        shape = (*near.shape, 2, 2)
        parts = mean - shift, mean + shift, system.spin_matrix()
        rows = [np.broadcast_to(part, shape)[near] for part in parts]
        squares[near] = _eigenvalue_squares(system, *rows)
    return squares


def _eigenvalue_squares(system: System, minus: AnyArray, plus: AnyArray, spin: AnyArray) -> Complex:
    """Return λ (..., 2n) of any system with K₋, K₊ and S = jD, as eigenvalues.

    With s = √λ and b = s b′ Eq. (24) is ([K₋, 0; −S, K₊] − λ [M, S; 0, M]) [a; b′] = 0.
    """
    n = system.size
    inverse = np.linalg.inv(system.mass)
    minus, plus, spin = inverse @ minus, inverse @ plus, inverse @ spin
    if not np.any(spin):
        blocks = [np.sort_complex(np.linalg.eigvals(block)) for block in (minus, plus)]
        return np.concatenate(np.broadcast_arrays(*blocks), axis=-1)
    shape = np.broadcast_shapes(minus.shape, spin.shape)[:-2]
    matrix = np.empty((*shape, 2 * n, 2 * n), np.result_type(minus, spin))
    matrix[..., :n, :n] = minus + spin @ spin
    matrix[..., :n, n:] = -spin @ plus
    matrix[..., n:, :n] = -spin
    matrix[..., n:, n:] = plus
    return np.asarray(np.sort_complex(np.linalg.eigvals(matrix)))
