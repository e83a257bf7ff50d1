"""Timoshenko elements, and the matrices of a clamped shaft of them, with and without its disk.

Two-node elements with interdependent interpolation: cubic deflection v, quadratic section
rotation γ, shear strain −Φγ″, so there is no shear locking, and Φ = 0 is the Euler–Bernoulli
element.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from .._types import Array
from ..rotors.shaft_disk import ShaftDisk

__all__ = ["assembled", "element_matrices", "rotor_matrices", "shaft_matrices"]


@lru_cache(maxsize=1024)
def element_matrices(shear: float, length: float) -> Array:
    """Return ∫NvᵀNv, ∫NγᵀNγ, the elastic matrix and −∫Nv′ᵀNv′ of one element with EI = 1.

    Parameters
    ----------
    shear : float
        EI/(κGA), in the square of the unit of `length`; of a shaft of length 1 it is Φ.
    length : float
        h.

    Returns
    -------
    (4, 4, 4) float
        The four matrices of the degrees of freedom v₁, γ₁, v₂, γ₂. Times ρA, ρI, EI and 1 they
        are those of mass, rotary inertia, stiffness and a unit compression.

    Notes
    -----
    Each row of the arrays `deflection` and `rotation` holds the coefficients of 1, ξ, ξ², ξ³
    (ξ = x/h) in the shape function of one degree of freedom: v₁, γ₁, v₂, γ₂ in turn.
    """
    h = length
    s = 12 * shear / h**2
    deflection = np.array(
        [
            [1 + s, -s, -3, 2],
            [0, h * (1 + s / 2), -h * (2 + s / 2), h],
            [0, s, 3, -2],
            [0, -h * s / 2, -h * (1 - s / 2), h],
        ]
    ) / (1 + s)
    rotation = np.array(
        [
            [0, -6 / h, 6 / h, 0],
            [1 + s, -(4 + s), 3, 0],
            [0, 6 / h, -6 / h, 0],
            [0, -(2 - s), 3, 0],
        ]
    ) / (1 + s)
    derivative = np.diag([1.0, 2.0, 3.0], -1) / h
    powers = np.arange(4)
    moments = h / (powers[:, None] + powers + 1)

    def product(shapes: Array) -> Array:
        return np.asarray(shapes @ moments @ shapes.T)

    curvature = rotation @ derivative
    # Eq. (A2): ½EI γ′² + ½κGA (v′ − γ)² − ½p v′², with v′ − γ = −Φγ″
    elastic = product(curvature) + shear * product(curvature @ derivative)
    load = -product(deflection @ derivative)
    matrices = np.array([product(deflection), product(rotation), elastic, load])
    matrices.flags.writeable = False
    return matrices


def assembled(blocks: Iterable[Array]) -> Array:
    """Return the matrices of elements in a row, each joined to the next.

    Parameters
    ----------
    blocks : iterable of (k, 4, 4) float
        The matrices of each element, from left to right.

    Returns
    -------
    (k, 2m + 2, 2m + 2) float
        Of m elements; the coordinates are v and γ of every node in turn.
    """
    parts = np.array(list(blocks))
    size = 2 * len(parts) + 2
    matrices = np.zeros((parts.shape[1], size, size))
    for number, block in enumerate(parts):
        at = slice(2 * number, 2 * number + 4)
        matrices[:, at, at] += block
    return matrices


@lru_cache(maxsize=16)
def shaft_matrices(shear: float, elements: int) -> tuple[Array, Array, Array, Array]:
    """Return the translational, rotational, elastic and axial load matrices (2n, 2n) of the shaft.

    The two coordinates of the clamped root are removed; the tip's deflection and slope are last.
    """
    matrices = assembled([element_matrices(shear, 1 / elements)] * elements)[:, 2:, 2:]
    matrices.flags.writeable = False
    translational, rotational, elastic, load = matrices
    return translational, rotational, elastic, load


def rotor_matrices(rotor: ShaftDisk, elements: int) -> tuple[Array, Array, Array, Array]:
    """Return mass, gyroscopic, elastic and axial load matrices (2n, 2n) of shaft and disk."""
    translational, rotational, elastic, load = shaft_matrices(rotor.shear, elements)
    inertia = rotor.slenderness**2
    mass = translational + inertia * rotational
    mass[-2, -2] += rotor.disk_mass
    mass[-1, -1] += rotor.diametral_inertia
    gyroscopic = 2 * inertia * rotational
    gyroscopic[-1, -1] += rotor.polar_inertia
    return mass, gyroscopic, elastic, load
