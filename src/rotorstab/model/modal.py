"""The modal form of the mean system, z' = jRz with z = (q, −jq̇).

In these coordinates R is real without damping, its eigenvalues are the whirl frequencies
(solution exp(jωt), ω > 0 forward), and time reversal is complex conjugation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .._arguments import numbers
from .._numerics.companion import companion_matrix
from .._numerics.roots import is_real
from .._tolerances import NEGLIGIBLE
from .._types import AnyArray, Array, ArrayLike, Mask
from .system import System

__all__ = ["ModalBasis", "modal_basis", "splitting_basis", "state_matrix"]

_FRACTIONS = (1.0, 0.9, 0.7, 0.4, 0.0)  # of the static load, tried in turn
_GOOD_CONDITION = 1e3  # ‖V‖‖V⁻¹‖/2n below which a basis costs at most three digits


@dataclass(frozen=True)
class ModalBasis:
    """Eigenvalues and eigenvectors of R at one mean load.

    Parameters
    ----------
    load : (...) float
        The load p̄ at which R is taken [EI/L²].
    frequencies : (..., 2n) float or complex
        ω sorted by real part [√(EI/(ρAL⁴))]; a real array if the system is undamped and stable.
    vectors, inverse : (..., 2n, 2n) float or complex
        V, columns in the order of `frequencies`, and V⁻¹.
    shift : (...) float
        A number s: R has the stiffness K(p̄) + sM. It is 0 unless the rotor without load is free,
        or pushed out of its rest position by a negative stiffness.
    """

    load: Array
    frequencies: AnyArray
    vectors: AnyArray
    inverse: AnyArray
    shift: Array


def state_matrix(system: System, stiffness: ArrayLike) -> AnyArray:
    """Return R = [[0, I], [M⁻¹K, jM⁻¹D]] of z' = jRz, z = (q, −jq̇).

    Parameters
    ----------
    system : System
    stiffness : (..., n, n) float or complex
        K(p̄) as `System.stiffness` returns it, with the part of the rotating damping.

    Returns
    -------
    (..., 2n, 2n) float, or complex with damping
        Its eigenvalues are the whirl frequencies ω.
    """
    rate = 1j * system.damping() if system.is_damped else system.spin_matrix()
    inverse = np.linalg.inv(system.mass)
    return companion_matrix(inverse @ np.asarray(stiffness), inverse @ rate)


def modal_basis(system: System, load: ArrayLike, stiffness: ArrayLike | None = None) -> ModalBasis:
    """Return the modal basis of the mean system.

    Parameters
    ----------
    system : System
    load : (...) float
        p̄ [EI/L²]; broadcasts against the spin speed.
    stiffness : (..., n, n), optional
        K to use in place of `system.stiffness(load)`.

    Returns
    -------
    ModalBasis

    Notes
    -----
    At a coalescence of two frequencies (flutter, buckling) V is singular or nearly so. The entries
    of V⁻¹ are then large or NaN: the caller must check the condition of V.
    """
    load = numbers("load", load)
    matrix = state_matrix(system, system.stiffness(load) if stiffness is None else stiffness)
    values, vectors = np.linalg.eig(matrix)
    order = np.argsort(values.real, axis=-1, kind="stable")
    values = np.take_along_axis(values, order, -1)
    vectors = np.take_along_axis(vectors, order[..., None, :], -1)
    if np.iscomplexobj(values) and np.isrealobj(matrix) and not values.imag.any():
        values, vectors = values.real, vectors.real
    try:
        inverse = np.linalg.inv(vectors)
    except np.linalg.LinAlgError:
        inverse = np.linalg.pinv(vectors)
    load = np.broadcast_to(load, values.shape[:-1])
    return ModalBasis(load, values, vectors, inverse, np.zeros_like(load))


def _is_good(basis: ModalBasis, damped: bool) -> Mask:
    """Return where V is well conditioned and, without damping, every frequency is real."""
    norms = np.linalg.norm(basis.vectors, axis=(-2, -1)) * np.linalg.norm(
        basis.inverse, axis=(-2, -1)
    )
    good = norms < _GOOD_CONDITION * basis.vectors.shape[-1]
    if not damped:
        good &= is_real(basis.frequencies).all(axis=-1)
    return np.asarray(good)


def splitting_basis(system: System, static_load: ArrayLike) -> ModalBasis:
    """Return a well-conditioned modal basis at the mean load, or at a part of it.

    An integrator that splits R(t) into a constant and a remainder may choose the constant freely.
    Near flutter or buckling of the mean system it takes R at a fraction of p̄₀. The fraction 0
    serves where K(0) is symmetric and positive definite; else a multiple of M is added to it.

    Parameters
    ----------
    system : System
    static_load : (...) float
        p̄₀ [EI/L²]; broadcasts against the spin speed.

    Returns
    -------
    ModalBasis
        All its arrays are real if the system is undamped.
    """
    static = np.broadcast_to(
        numbers("static_load", static_load),
        np.broadcast_shapes(np.shape(static_load), system.spin_speed.shape),
    )
    load = static.copy()
    basis = modal_basis(system, load)
    for fraction in _FRACTIONS[1:]:
        bad = ~_is_good(basis, system.is_damped)
        if not bad.any():
            break
        load = np.where(bad, fraction * static, load)
        basis = modal_basis(system, load)
    if not _is_good(basis, system.is_damped).all():
        return _shifted_basis(system, basis.load)
    if system.is_damped or np.isrealobj(basis.frequencies):
        return basis
    real = basis.vectors.real
    return replace(
        basis, frequencies=basis.frequencies.real, vectors=real, inverse=np.linalg.inv(real)
    )


def _shifted_basis(system: System, load: Array) -> ModalBasis:
    """Return the modal basis with the stiffness K(0) + sM, s so large that it is positive."""
    elastic = system.load_stiffness(0.0)
    symmetric = (elastic + np.swapaxes(elastic, -1, -2)) / 2
    squares = np.linalg.eigvals(np.linalg.solve(system.mass, symmetric)).real
    positive = squares[squares > NEGLIGIBLE * np.abs(squares).max()]
    shift = -2 * float(min(squares.min(), 0.0)) + (float(positive.min()) if positive.size else 1.0)
    rest = np.zeros_like(load)
    stiffness = system.stiffness(rest) + shift * system.mass
    return replace(modal_basis(system, rest, stiffness), shift=np.full_like(load, shift))
