"""Real bases that reduce the finite elements of a rotor to a few coordinates.

The first two coordinates are always the displacement and the slope of the tip. So the disk's
inertia, its gyroscopic moment and the follower term stay exact, and only the inside of the shaft is
approximated.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np
from scipy.linalg import eigvalsh

from .._types import Array
from ..rotors.shaft_disk import ShaftDisk
from .modal import modal_basis
from .system import System
from .timoshenko import rotor_matrices, shaft_matrices

__all__ = ["reduction_basis", "whirl_shapes"]

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


def whirl_shapes(
    system: System, loads: Iterable[float], speeds: Iterable[float], count: int, slowest: float
) -> Array:
    """Return the shapes of the slowest whirls of a rotor at a few loads and spin speeds.

    Parameters
    ----------
    system : System
        With the linear stiffness law.
    loads, speeds : iterable of float
        Every load is taken with every speed.
    count : int
        How many forward and how many backward whirls are taken.
    slowest : float
        Frequency that stands in place of slower ones in the scale of a shape.

    Returns
    -------
    (n, k) float
        Right and left eigenvectors, for under a follower load a projection needs both: their real
        parts, and their imaginary parts where they have any. Each is scaled to qᴴMq = 1/ω²: the
        elastic energy that a basis misses of it is then the relative error of ω².
    """
    n = system.size
    shapes = []
    for load in loads:
        for speed in speeds:
            # state (q, ω q)
            basis = modal_basis(system.at_speed(speed), load)
            left = np.linalg.solve(system.mass, basis.inverse[:, n:].T)
            order = np.argsort(np.abs(basis.frequencies))
            forward = basis.frequencies.real[order] >= 0
            kept = np.concatenate([order[~forward][:count], order[forward][:count]])
            scale = np.maximum(np.abs(basis.frequencies[kept]), slowest)
            for side in (basis.vectors[:n, kept], left[:, kept]):
                size = np.sqrt(np.einsum("ik,ij,jk->k", side.conj(), system.mass, side).real)
                # a shape that vanishes but for rounding has no scale
                side = side[:, size > 0] / (size * scale)[size > 0]
                shapes += [side.real, side.imag] if np.iscomplexobj(side) else [side]
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
    geometric = load.copy()
    geometric[0, 1] += tangency  # Eq. (A3); the tip comes first here
    none = np.zeros_like(mass)
    buckling = _buckling_load(elastic, load)
    slowest = _SLOW * np.sqrt(eigvalsh(elastic, mass, subset_by_index=(0, 0))[0])
    found = whirl_shapes(
        System(mass, gyroscopic, none, none, elastic, geometric, np.array(0.0)),
        [share * buckling for share in _MODE_LOADS],
        _MODE_SPEEDS,
        2,
        slowest,
    )
    basis = np.linalg.solve(factor, np.linalg.svd(factor @ found)[0][:, :modes])
    # the same space in other coordinates, so that the first two are the tip
    basis = basis @ np.linalg.qr(basis[:2].T, mode="complete")[0]
    basis[:, :2] = basis[:, :2] @ np.linalg.inv(basis[:2, :2])
    basis = np.asarray(shapes @ basis)
    basis.flags.writeable = False
    return basis
