"""The smallest compression that buckles a resting rotor."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import LinAlgError, eigvalsh

from .._numerics.roots import is_real
from .._tolerances import RIGID
from .._types import Array
from ..rotors.rotor import Rotor
from .mesh import plane_matrices, rotor_mesh
from .rotor_system import supports

__all__ = ["buckling_load"]

_RESOLVED = 9.0  # EI/h² of an element, a little less than π², where it buckles between its nodes


def buckling_load(rotor: Rotor, elements: int = 6) -> float:
    """Return the smallest p > 0 with det(Ka + p Kb) = 0 of the resting rotor.

    Parameters
    ----------
    rotor : Rotor
    elements : int
        Elements of each section, see `Rotor.system`.

    Returns
    -------
    float
        [N]; inf if there is none: a follower load may never buckle a rotor, which then flutters.

    Raises
    ------
    ValueError
        If nothing holds the rotor or its stiffness is not positive definite.

    Notes
    -----
    Of the cross-coupled stiffness of bearings only the symmetric part, (kxy + kyx)/2 in both
    directions, is taken: the rest comes from rotation and does no work along a closed path at rest.

    References
    ----------
    Eqs. (A2), (A3) of the source paper.
    """
    _refuse_unheld(rotor)
    plane = plane_matrices(rotor, elements)
    largest = _resolved_load(rotor, elements)
    stiffness = supports(rotor, elements, "stiffness")
    crossed = (stiffness[0, 1] + stiffness[1, 0]) / 2
    first, second = (plane.elastic + stiffness[at, at] for at in (0, 1))
    if not crossed.any():
        planes = [first] if np.array_equal(first, second) else [first, second]
        return min(_smallest_load(elastic, plane.geometric, largest) for elastic in planes)
    zero = np.zeros_like(first)
    return _smallest_load(
        np.block([[first, crossed], [crossed, second]]),
        np.block([[plane.geometric, zero], [zero, plane.geometric]]),
        largest,
    )


def _refuse_unheld(rotor: Rotor) -> None:
    """Refuse a rotor that can move as a rigid body without any restoring force."""
    if rotor.clamps:
        return
    held = np.zeros((4, 4))
    for bearing in rotor.bearings:
        # the deflection of a unit translation, and of a turn that moves the far end by one
        motion = np.array([1.0, bearing.position / rotor.length])
        symmetric = (bearing.stiffness + bearing.stiffness.T) / 2
        held += np.kron(symmetric, np.outer(motion, motion))
    values = np.abs(np.linalg.eigvalsh(held))
    if values.min() <= RIGID * values.max():
        raise ValueError(
            "`rotor` must be held by clamps or bearings: it can move as a rigid body, "
            "and then no load is the smallest that buckles it"
        )


def _resolved_load(rotor: Rotor, elements: int) -> float:
    """Return the load at which an element buckles by itself, which its two nodes cannot follow."""
    mesh = rotor_mesh(rotor, elements)
    bending = np.array([rotor.sections[section].properties.bending for section in mesh.sections])
    loads = _RESOLVED * bending / np.diff(mesh.nodes) ** 2
    return float(loads[mesh.loaded].min())


def _smallest_load(elastic: Array, geometric: Array, largest_load: float) -> float:
    """Return the smallest positive p at which Ka + p Kb is singular, inf if there is none.

    Unsymmetric matrices have such loads beyond `largest_load` by their mesh alone.
    """
    last = len(elastic) - 1
    try:
        if np.array_equal(geometric, geometric.T):
            inverses = eigvalsh(-geometric, elastic, subset_by_index=(last, last))
        else:
            np.linalg.cholesky(elastic)
            roots = np.linalg.eigvals(-np.linalg.solve(elastic, geometric))
            inverses = roots.real[is_real(roots) & (roots.real > 1 / largest_load)]
    except LinAlgError:
        raise ValueError(
            "`rotor` must have a positive stiffness at rest, a bearing makes it unstable"
        ) from None
    largest = float(np.max(inverses, initial=0.0))
    return 1 / largest if largest > 0 else math.inf
