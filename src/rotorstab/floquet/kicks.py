"""The kicks of the pulsating load in modal coordinates, for the linear and for other laws.

In these coordinates a kick is left · diag or block(factors) · right: `right` maps modal coordinates
to forces, the factors vary with time and load, and `left` maps forces back.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .._types import AnyArray, Array, Complex
from ..model.modal import ModalBasis
from ..model.stiffness_law import StiffnessLaw
from ..model.system import System

__all__ = ["Kicks", "Loads", "law_kicks", "linear_kicks"]

_MOST_HARMONICS = 400  # with more of them K(p̄) itself is no slower than its cosine series
_WORST_CONDITION = 1e3  # of the eigenvectors of M⁻¹Kb that may be used

Loads = tuple[Array, Array]
"""p̄₀ and p̄_t of the grid of points."""


class Kicks(NamedTuple):
    """The kicks of one system on one grid of points.

    Parameters
    ----------
    left : (2n, f), or (P, 2n, f) complex or float
        Maps forces to modal coordinates.
    right : (f, 2n), or (P, f, 2n) complex or float
        Maps modal coordinates to forces.
    factors : callable
        Takes phases φ of the load, (stages, segments, ...); returns the factors
        (stages, f, segments, *grid) that multiply each force, or with a `StiffnessLaw` the
        matrices (stages, n, n, segments, *grid) that multiply all of them.
    """

    left: AnyArray
    right: AnyArray
    factors: Callable[[Array], Complex]


@lru_cache(maxsize=64)
def _load_modes(system: System) -> tuple[AnyArray, AnyArray, AnyArray] | None:
    """Return eigenvalues, eigenvectors and their inverse of A = M⁻¹Kb, None if nearly defective."""
    values, modes = np.linalg.eig(np.linalg.solve(system.mass, system.geometric))
    if np.linalg.cond(modes) > _WORST_CONDITION:
        return None
    return values, modes, np.linalg.inv(modes)


def linear_kicks(
    system: System, basis: ModalBasis, loads: Loads, step: Array, gradient: float
) -> Kicks:
    """Return the kicks for K linear in the load, ΔK = (p̄ − p̄_ref) Kb − sM, s the basis' shift.

    ΔK and ΔK M⁻¹ ΔK are polynomials of one constant operator, A = M⁻¹Kb. In the basis of its
    eigenvectors a kick therefore is one number for each of them.
    """
    n = system.size
    right, left = basis.vectors[..., :n, :], basis.inverse[..., :, n:]
    load_modes = _load_modes(system)
    if load_modes is None:
        operator = np.linalg.solve(system.mass, system.geometric)
        powers = [operator @ right, operator @ operator @ right, right]
        right = np.concatenate(powers, axis=-2)
        left = np.concatenate([left, left, left], axis=-1)
    else:
        right, left = load_modes[2] @ right, left @ load_modes[1]

    def factors(phase: Array) -> Complex:
        impulse = step * (loads[0] - basis.load + loads[1] * system.pulsation.at(phase))
        back = step * basis.shift
        weight = gradient * step
        if load_modes is None:
            linear = impulse - 2 * weight * back * impulse
            constant = np.broadcast_to(weight * back * back - back, impulse.shape)
            parts = [linear, weight * impulse * impulse, constant]
            return np.repeat(1j * np.stack(parts, axis=1), n, axis=1)
        values = load_modes[0].reshape(n, *[1] * (impulse.ndim - 1))
        kick = values * impulse[:, None] - back
        return np.asarray(1j * (kick + weight * kick * kick))

    return Kicks(left, right, factors)


def law_kicks(
    law: StiffnessLaw,
    system: System,
    basis: ModalBasis,
    loads: Loads,
    step: Array,
    gradient: float,
) -> Kicks:
    """Return the kicks, whole matrices ΔK, for the K(p̄) of a law that is not linear."""
    law.refuse_peaks(*loads)
    inverse = np.linalg.inv(system.mass)
    reference = law.stiffness(basis.load)
    count = law.harmonic_count(*loads)

    def direct(phase: Array) -> Array:
        """Return M⁻¹ΔK (stages, n, n, segments, *grid) from K(p̄) itself."""
        load = loads[0] + loads[1] * np.cos(phase)
        change = inverse @ (law.stiffness(load) - reference)
        return np.moveaxis(change, (-2, -1), (1, 2))

    series = count <= _MOST_HARMONICS
    change_at = _series(law, loads, inverse, reference, count) if series else direct

    def factors(phase: Array) -> Complex:
        change = change_at(phase)
        table: Complex = np.asarray((1j * step) * change)
        if gradient:
            square = np.einsum("sik...,skj...->sij...", change, change)
            table += (1j * gradient) * step**3 * square
        return table

    n = system.size
    return Kicks(basis.inverse[..., :, n:], basis.vectors[..., :n, :], factors)


def _series(
    law: StiffnessLaw, loads: Loads, inverse: AnyArray, reference: Array, count: int
) -> Callable[[Array], Array]:
    """Return the function of phases that gives M⁻¹ΔK (stages, n, n, segments, *grid).

    It sums a cosine series, for K itself is slow to compute. The part that is infinite at the pole
    has no short series, and is added in closed form.
    """
    n = len(inverse)
    static, pulsating = np.broadcast_arrays(*loads)
    harmonics = law.smooth_harmonics(static, pulsating, count)
    harmonics[0] -= reference
    harmonics = np.moveaxis(inverse @ harmonics, (-2, -1), (1, 2)).reshape(count + 1, -1)

    def change_at(phase: Array) -> Array:
        load = loads[0] + loads[1] * np.cos(phase)
        lead = phase.shape[: phase.ndim - loads[1].ndim]
        change = np.cos(phase.reshape(-1, 1) * np.arange(count + 1)) @ harmonics
        change = np.moveaxis(change.reshape(*lead, n, n, *load.shape[len(lead) :]), 1, 3)
        pole = law.pole_term(load)[:, None]
        change[:, :, 1] += inverse[:, 1].reshape(-1, *[1] * (load.ndim - 1)) * pole
        return change

    return change_at
