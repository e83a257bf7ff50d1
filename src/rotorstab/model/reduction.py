"""Real bases that reduce the finite elements of a rotor to a few coordinates.

The first two coordinates are always the displacement and the slope of the tip. So the disk's
inertia, its gyroscopic moment and the follower term stay exact, and only the inside of the shaft is
approximated.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.linalg import eigvalsh

from .._numerics.companion import companion_matrix
from .._types import Array
from ..rotors.shaft_disk import ShaftDisk
from .timoshenko import rotor_matrices, shaft_matrices

__all__ = ["reduction_basis"]

# Loads and frequencies at which responses of the shaft alone are taken.
_RESPONSES = np.linspace(0.0, 1.0, 5)
_RESPONSE_LOAD = 2.0  # buckling loads, in compression and in tension
_RESPONSE_FREQUENCY = 0.45  # of the first frequency of the shaft clamped at both ends
_SHAFT_SHAPES = 10  # number of shapes of the shaft alone with which every rotor is right to 1e-7
# Loads and speeds at which whirl modes are taken. Larger loads would cost accuracy at smaller ones.
_MODE_LOADS = (-0.95, 0.0, 0.95)  # of the buckling load
_MODE_SPEEDS = (0.0, 4.0)  # Ω̄
_SLOW = 0.5  # of ω_n: errors of slower whirls count relative to this frequency


def _buckling_load(elastic: Array, load: Array) -> float:
    """Return the smallest positive p̄ at which Ka + p̄ Kb is singular."""
    last = len(elastic) - 1
    return float(1 / eigvalsh(-load, elastic, subset_by_index=(last, last))[0])


@lru_cache(maxsize=16)
def _shaft_basis(shear: float, slenderness: float, elements: int, modes: int) -> Array:
    """Return the basis (2n, modes) that serves any disk, spin speed and load of one shaft.

    The first two columns are the static shapes for a unit deflection and a unit slope of the tip.
    The others are the leading directions, in elastic energy, of what the inside of the shaft adds
    to them when the tip moves at other loads and frequencies (proper orthogonal decomposition of
    the exact responses).
    """
    translational, rotational, elastic, load = shaft_matrices(shear, elements)
    mass = translational + slenderness**2 * rotational
    inside, tip = slice(0, -2), slice(-2, None)
    static = -np.linalg.solve(elastic[inside, inside], elastic[inside, tip])
    basis = np.zeros((2 * elements, modes))
    basis[inside, :2], basis[tip, :2] = static, np.eye(2)
    if modes > 2:
        buckling = _buckling_load(elastic, load)
        first = np.sqrt(eigvalsh(elastic[inside, inside], mass[inside, inside])[0])
        added = []
        for steady in _RESPONSE_LOAD * buckling * (2 * _RESPONSES - 1):
            for frequency in _RESPONSE_FREQUENCY * first * _RESPONSES:
                dynamic = elastic + steady * load - frequency**2 * mass
                response = -np.linalg.solve(dynamic[inside, inside], dynamic[inside, tip])
                added.append(response - static)
        factor = np.linalg.cholesky(elastic[inside, inside]).T
        directions = np.linalg.svd(factor @ np.hstack(added))[0][:, : modes - 2]
        basis[inside, 2:] = np.linalg.solve(factor, directions)
    basis.flags.writeable = False
    return basis


def _whirl_shapes(
    mass: Array, gyroscopic: Array, elastic: Array, load: Array, tangency: float
) -> Array:
    """Return the shapes (n, k) of 2B, 1B, 1F, 2F at a few loads and spin speeds.

    Right and left eigenvectors are taken, for under a follower load a projection needs both. Each
    is scaled to qᵀMq = 1/ω², with ω_n/2 in place of slower ω: the elastic energy that a basis
    misses of it is then the relative error of ω².
    """
    n = len(mass)
    slowest = np.sqrt(eigvalsh(elastic, mass, subset_by_index=(0, 0))[0])
    buckling = _buckling_load(elastic, load)
    geometric = load.copy()
    geometric[0, 1] += tangency  # Eq. (A3); the tip comes first here
    shapes = []
    for share in _MODE_LOADS:
        for speed in _MODE_SPEEDS:
            # ω²M q = K q + ω Ω̄H q with the state (q, ω q)
            stiffness = elastic + share * buckling * geometric
            constant, linear = (
                np.linalg.solve(mass, part) for part in (stiffness, speed * gyroscopic)
            )
            frequencies, right = np.linalg.eig(companion_matrix(constant, linear))
            left = np.linalg.solve(mass, np.linalg.inv(right)[:, n:].T)
            order = np.argsort(np.abs(frequencies))
            forward = frequencies.real[order] >= 0
            kept = np.concatenate([order[~forward][:2], order[forward][:2]])
            speeds = np.maximum(np.abs(frequencies[kept]), _SLOW * slowest)
            for side in (right[:n, kept].real, left[:, kept].real):
                size = np.sqrt(np.einsum("ik,ij,jk->k", side, mass, side))
                shapes.append(side / (size * speeds))
    return np.hstack(shapes)


@lru_cache(maxsize=32)
def reduction_basis(rotor: ShaftDisk, tangency: float, elements: int, modes: int) -> Array:
    """Return the real basis of one rotor; its first two coordinates are the tip.

    Parameters
    ----------
    rotor : ShaftDisk
    tangency : float
        μ, in [0, 1].
    elements : int
    modes : int
        2 to 2 `elements`.

    Returns
    -------
    (2 elements, modes) float
        2 columns are the static shapes of the unloaded shaft. 3 to 9 are the leading directions,
        in elastic energy, of the rotor's own whirl modes at a few loads and spin speeds. 10 or
        more serve any disk on this shaft.
    """
    size = max(modes, min(_SHAFT_SHAPES, 2 * elements))
    if modes in (2, size):
        return _shaft_basis(rotor.shear, rotor.slenderness, elements, modes)
    shapes = _shaft_basis(rotor.shear, rotor.slenderness, elements, size)
    mass, gyroscopic, elastic, load = (
        shapes.T @ matrix @ shapes for matrix in rotor_matrices(rotor, elements)
    )
    factor = np.linalg.cholesky(elastic).T
    found = _whirl_shapes(mass, gyroscopic, elastic, load, tangency)
    basis = np.linalg.solve(factor, np.linalg.svd(factor @ found)[0][:, :modes])
    # the same space in other coordinates, so that the first two are the tip
    basis = basis @ np.linalg.qr(basis[:2].T, mode="complete")[0]
    basis[:, :2] = basis[:, :2] @ np.linalg.inv(basis[:2, :2])
    basis = np.asarray(shapes @ basis)
    basis.flags.writeable = False
    return basis
