"""The finite-element mesh of any rotor: where its nodes are, and its matrices in one plane."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from .._arguments import whole_number
from .._tolerances import SAME_POSITION
from .._types import Array, Index, Mask
from ..rotors.rotor import Rotor
from .timoshenko import assembled, element_matrices

__all__ = ["MOST_ELEMENTS", "Mesh", "PlaneMatrices", "plane_matrices", "rotor_mesh"]

MOST_ELEMENTS = 400
"""Largest number of elements of a rotor: full matrices of this size take some seconds."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """The nodes of a rotor, and which section each element belongs to.

    Parameters
    ----------
    nodes : (m + 1,) float
        Positions [m], rising.
    sections : (m,) int
        Index of the section of each element.
    loaded : (m,) bool
        Which elements carry the load.
    free : (n,) int
        The coordinates that no clamp holds, among v and γ of every node in turn.
    """

    nodes: Array
    sections: Index
    loaded: Mask
    free: Index

    def node(self, position: float) -> int:
        """Return the index of the node at a station."""
        return int(np.abs(self.nodes - position).argmin())

    def coordinate(self, position: float) -> int | None:
        """Return the index of v at a station among the free coordinates; None if it is clamped.

        The slope γ there is the next one.
        """
        found = np.flatnonzero(self.free == 2 * self.node(position))
        return int(found[0]) if found.size else None


@dataclass(frozen=True, eq=False)
class PlaneMatrices:
    """Matrices (n, n) of the rotor without its bearings in one plane, read-only.

    Parameters
    ----------
    mass, gyroscopic, elastic, geometric : (n, n) float
        M, H per unit of spin speed, Ka, and Kb per newton of compression.
    """

    mass: Array
    gyroscopic: Array
    elastic: Array
    geometric: Array


def _stations(rotor: Rotor) -> Array:
    """Return the positions [m] where something stands or a section ends, rising, each once."""
    ends = np.cumsum([section.length for section in rotor.sections])
    places = [0.0, *ends[:-1], rotor.length, rotor.load.start, rotor.load_end, *rotor.clamps]
    places += [disk.position for disk in rotor.disks]
    places += [bearing.position for bearing in rotor.bearings]
    rising = np.sort(places)
    # ends of sections come first where two are one, so that no section loses its end
    rising = rising[np.diff(rising, prepend=-math.inf) > SAME_POSITION * rotor.length]
    return np.asarray(rising)


@lru_cache(maxsize=32)
def rotor_mesh(rotor: Rotor, elements: int) -> Mesh:
    """Return the mesh of a rotor.

    Parameters
    ----------
    rotor : Rotor
    elements : int
        Elements of each section, 1 or more. The stations cut a section into pieces; each piece is
        divided evenly, into elements that are no longer than an even division of the section.

    Returns
    -------
    Mesh

    Raises
    ------
    ValueError
        If the rotor would have more than `MOST_ELEMENTS` elements, or every coordinate is clamped.
    """
    elements = whole_number("elements", elements, 1)
    if elements * len(rotor.sections) > MOST_ELEMENTS:
        raise ValueError(_too_many(elements, elements * len(rotor.sections)))
    ends = np.cumsum([section.length for section in rotor.sections])
    stations = _stations(rotor)
    nodes, sections = [0.0], []
    for left, right in pairwise(stations):
        section = min(int(np.searchsorted(ends, (left + right) / 2)), len(ends) - 1)
        share = elements * (right - left) / rotor.sections[section].length
        count = max(1, math.ceil(share * (1 - SAME_POSITION)))
        nodes += list(np.linspace(left, right, count + 1)[1:])
        sections += [section] * count
    if len(sections) > MOST_ELEMENTS:
        raise ValueError(_too_many(elements, len(sections)))
    positions = np.array(nodes)
    clamped = {int(np.abs(positions - place).argmin()) for place in rotor.clamps}
    free = [at for at in range(2 * len(nodes)) if at // 2 not in clamped]
    if not free:
        raise ValueError(f"`elements` must leave a free coordinate, got {elements}")
    low, high = sorted((rotor.load.start, rotor.load_end))
    middle = (positions[:-1] + positions[1:]) / 2
    loaded = (low < middle) & (middle < high)
    return Mesh(positions, np.array(sections), loaded, np.array(free))


def _too_many(elements: int, count: int) -> str:
    most = max(1, elements * MOST_ELEMENTS // count)
    return (
        f"`elements` = {elements} gives {count} elements, more than {MOST_ELEMENTS}: "
        f"take {most} or fewer, or fewer sections"
    )


@lru_cache(maxsize=4)  # up to 20 MB each
def plane_matrices(rotor: Rotor, elements: int) -> PlaneMatrices:
    """Return the matrices of the rotor without its bearings in one plane.

    Parameters
    ----------
    rotor : Rotor
    elements : int
        See `rotor_mesh`.

    Returns
    -------
    PlaneMatrices

    Notes
    -----
    The geometric stiffness is that of the shaft between the two stations of the load alone. With
    tangency μ the force at its end gets a transverse part −μγ per newton, Eq. (A3) of the source
    paper, which makes Kb unsymmetric.
    """
    mesh = rotor_mesh(rotor, elements)
    blocks = []
    for section, length, loaded in zip(
        mesh.sections, np.diff(mesh.nodes), mesh.loaded, strict=True
    ):
        beam = rotor.sections[section].properties
        shear = beam.bending / beam.shear
        translational, rotational, elastic, load = element_matrices(shear, float(length))
        blocks.append(
            np.array(
                [
                    beam.mass * translational + beam.inertia * rotational,
                    2 * beam.inertia * rotational,
                    beam.bending * elastic,
                    load * loaded,
                ]
            )
        )
    mass, gyroscopic, elastic, geometric = assembled(blocks)
    for disk in rotor.disks:
        at = 2 * mesh.node(disk.position)
        mass[at, at] += disk.mass
        mass[at + 1, at + 1] += disk.diametral_inertia
        gyroscopic[at + 1, at + 1] += disk.polar_inertia
    end = 2 * mesh.node(rotor.load_end)
    geometric[end, end + 1] += np.sign(rotor.load_end - rotor.load.start) * rotor.load.tangency
    kept = np.ix_(mesh.free, mesh.free)
    matrices = [matrix[kept] for matrix in (mass, gyroscopic, elastic, geometric)]
    for matrix in matrices:
        matrix.flags.writeable = False
    return PlaneMatrices(*matrices)
