"""Matrices of a clamped shaft of Timoshenko elements, with and without its disk.

Two-node elements with interdependent interpolation: cubic deflection v, quadratic section
rotation γ, shear strain −Φγ″, so nothing locks and Φ = 0 is the Euler–Bernoulli element.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .._types import Array
from ..rotors.shaft_disk import ShaftDisk

__all__ = ["rotor_matrices", "shaft_matrices"]


def _element_matrices(shear: float, length: float) -> tuple[Array, Array, Array, Array]:
    """Return ∫NvᵀNv, ∫NγᵀNγ, the elastic matrix and −∫Nv′ᵀNv′, each (4, 4), of one element.

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
    return product(deflection), product(rotation), elastic, -product(deflection @ derivative)


@lru_cache(maxsize=16)
def shaft_matrices(shear: float, elements: int) -> tuple[Array, Array, Array, Array]:
    """Return the translational, rotational, elastic and axial load matrices (2n, 2n) of the shaft.

    The two coordinates of the clamped root are removed; the tip's deflection and slope are last.
    """
    size = 2 * elements + 2
    assembled = []
    for block in _element_matrices(shear, 1 / elements):
        matrix = np.zeros((size, size))
        for first in range(0, 2 * elements, 2):
            matrix[first : first + 4, first : first + 4] += block
        matrix = matrix[2:, 2:]
        matrix.flags.writeable = False
        assembled.append(matrix)
    translational, rotational, elastic, load = assembled
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
