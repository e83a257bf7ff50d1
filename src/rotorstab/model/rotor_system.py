"""The system of any rotor: in complex coordinates, or in two planes where its bearings differ."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import block_diag

from .._arguments import LARGEST, numbers, whole_number
from .._types import Array, ArrayLike
from ..rotors.rotor import Rotor
from .mesh import plane_matrices, rotor_mesh
from .rotor_reduction import whirl_basis
from .system import System

__all__ = ["RotorShapes", "rotor_shapes", "rotor_system", "supports"]


@dataclass(frozen=True, eq=False)
class RotorShapes:
    """How the shaft is bent by each coordinate of a rotor's system, read-only.

    Parameters
    ----------
    positions : (m,) float
        Of the stations of the mesh [m], rising.
    deflection, slope : (m, n) float
        Of the shaft at each station, per unit of each coordinate. With complex coordinates q the
        deflection is U = V + jW = `deflection` @ q. With two planes the first half of the columns
        gives V and the second jW, each from its half of q.
    """

    positions: Array
    deflection: Array
    slope: Array


def rotor_shapes(rotor: Rotor, elements: int = 6, modes: int | None = None) -> RotorShapes:
    """Return how each coordinate of `rotor_system` with the same arguments bends the shaft.

    Parameters
    ----------
    rotor : Rotor
    elements : int
    modes : int, optional

    Returns
    -------
    RotorShapes

    Raises
    ------
    ValueError
        As `rotor_system`.
    """
    size = rotor_system(rotor, 0.0, elements, modes).size
    mesh = rotor_mesh(rotor, elements)
    plane = np.zeros((2 * len(mesh.nodes), len(mesh.free)))
    plane[mesh.free, np.arange(len(mesh.free))] = 1.0
    shapes = plane if rotor.is_isotropic else np.hstack([plane, plane])
    if modes is not None:
        basis = _reduced_system(rotor, elements, modes)[1]
        half = len(mesh.free)
        parts = [basis] if rotor.is_isotropic else [basis[:half], basis[half:]]
        shapes = sum((plane @ part for part in parts), np.zeros((len(plane), size)))
    arrays = mesh.nodes.copy(), shapes[0::2].copy(), shapes[1::2].copy()
    for array in arrays:
        array.flags.writeable = False
    return RotorShapes(*arrays)


def rotor_system(
    rotor: Rotor, spin_speed: ArrayLike, elements: int = 6, modes: int | None = None
) -> System:
    """Return the matrices of a rotor by Timoshenko finite elements.

    Parameters
    ----------
    rotor : Rotor
    spin_speed : (...) float
        Ω [rad/s].
    elements : int
        Elements of each section, see `Rotor.system`.
    modes : int, optional
        Coordinates of each plane to which the system is reduced, 1 to n.

    Returns
    -------
    System
        In SI units. With isotropic bearings it has n complex coordinates, else the 2n coordinates
        of two planes; n is the number of free deflections and slopes, or `modes`.

    Raises
    ------
    ValueError
        If an argument is out of range, the rotor would have more than 400 elements, no coordinate
        is free, or its parts differ so much in size that its matrices are singular but for
        rounding.

    Notes
    -----
    A bearing is isotropic if kxx = kyy, kxy = −kyx, cxx = cyy and cxy = −cyx.

    The reduction is an approximation, see `whirl_basis` of `rotorstab.model.rotor_reduction`. Its
    largest errors of the `modes` slowest whirls, over five rotors with one and two disks, on equal,
    unequal and oil-film bearings, at loads to ±0.9 of the buckling load and at spin speeds to three
    times the first natural frequency, relative to the frequency or to a tenth of the first:

    ======  =======
    modes   largest
    ======  =======
    4       5e-3
    6       3e-3
    8       5e-4
    10      5e-5
    ======  =======

    Take 4 or more. Under a follower load take 6 or more: near flutter a small error of the
    matrices is a larger one of the frequencies. A compressor on oil films with a dozen seals, whose
    whirls are strongly damped, needs 8 for an error of 1e-3: its complex shapes count twice in a
    real basis.

    References
    ----------
    Z. Friedman, J. B. Kosmatka, An improved two-node Timoshenko beam finite element,
    Computers & Structures 47 (1993) 473–481. M. I. Friswell, J. E. T. Penny, S. D. Garvey,
    A. W. Lees, Dynamics of Rotating Machines, Cambridge University Press, 2010, chapter 5.
    """
    spin_speed = numbers("spin_speed", spin_speed, -LARGEST, LARGEST)
    if modes is not None:
        modes = whole_number("modes", modes, 1, len(rotor_mesh(rotor, elements).free))
    try:
        if modes is None:
            return _resting_system(rotor, elements).at_speed(spin_speed)
        return _reduced_system(rotor, elements, modes)[0].at_speed(spin_speed)
    except np.linalg.LinAlgError:
        raise ValueError(
            "`rotor` must have lengths, diameters, masses and stiffnesses of a like size: "
            "its matrices are singular, but for rounding"
        ) from None


def supports(rotor: Rotor, elements: int, name: str) -> Array:
    """Return the coefficients of all bearings, (2, 2, n, n) from plane to plane.

    Parameters
    ----------
    rotor : Rotor
    elements : int
    name : str
        "stiffness" or "damping".
    """
    mesh = rotor_mesh(rotor, elements)
    matrices = np.zeros((2, 2, len(mesh.free), len(mesh.free)))
    for bearing in rotor.bearings:
        at = mesh.coordinate(bearing.position)
        if at is not None:
            matrices[:, :, at, at] += getattr(bearing, name)
    return matrices


@lru_cache(maxsize=64)
def _reduced_system(rotor: Rotor, elements: int, modes: int) -> tuple[System, Array]:
    """Return the system of the rotor at rest in a few coordinates, and their basis.

    The full system is not kept.
    """
    system = _resting_system(rotor, elements)
    basis = whirl_basis(system, modes)
    return system.projected(basis), basis


def _resting_system(rotor: Rotor, elements: int) -> System:
    """Return the system of the rotor at rest in all its coordinates."""
    plane = plane_matrices(rotor, elements)
    np.linalg.cholesky(plane.mass)  # raises LinAlgError
    stiffness, damping = (supports(rotor, elements, name) for name in ("stiffness", "damping"))
    if rotor.is_isotropic:
        matrices = {
            "mass": plane.mass,
            "gyroscopic": plane.gyroscopic,
            "external_damping": damping[0, 0],
            "elastic": plane.elastic + stiffness[0, 0],
            "geometric": plane.geometric,
        }
        crossed = {"cross_stiffness": stiffness[0, 1], "cross_damping": damping[0, 1]}
    else:
        zero = np.zeros_like(plane.mass)
        matrices = {
            "mass": block_diag(plane.mass, plane.mass),
            "gyroscopic": np.block([[zero, plane.gyroscopic], [plane.gyroscopic, zero]]),
            "external_damping": block_diag(damping[0, 0], damping[1, 1]),
            "elastic": block_diag(plane.elastic + stiffness[0, 0], plane.elastic + stiffness[1, 1]),
            "geometric": block_diag(plane.geometric, plane.geometric),
        }
        crossed = {
            f"cross_{name}": np.block([[zero, one[0, 1]], [-one[1, 0], zero]])
            for name, one in (("stiffness", stiffness), ("damping", damping))
        }
    return System(
        **matrices,
        internal_damping=np.zeros_like(matrices["mass"]),
        spin_speed=np.array(0.0),
        tangency=rotor.load.tangency,
        planes=not rotor.is_isotropic,
        **{name: matrix for name, matrix in crossed.items() if matrix.any()},
    )
