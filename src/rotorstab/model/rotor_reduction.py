"""A real basis that reduces the finite elements of any rotor to a few coordinates of each plane."""

from __future__ import annotations

import numpy as np
from scipy.linalg import block_diag, eigh, eigvalsh

from .._arguments import LARGEST, LARGEST_LOAD
from .._types import Array, Index
from .reduction import whirl_shapes
from .system import System

__all__ = ["whirl_basis"]

_FREE_MODES = 24  # from which whirl shapes are taken, or four times as many as are kept
# Loads and speeds at which whirl shapes are taken
_LOADS = (-0.95, 0.0, 0.95)  # of the load that buckles the resting rotor
_SPEEDS = (0.0, 0.25)  # of the highest natural frequency at rest that is kept
_SLOW = 1e-3  # of that frequency: errors of slower whirls count relative to this part of it


def whirl_basis(system: System, modes: int) -> Array:
    """Return a basis of the leading directions of a rotor's own whirl modes.

    Parameters
    ----------
    system : System
        With one spin speed and the linear stiffness law.
    modes : int
        Number of coordinates that each plane keeps.

    Returns
    -------
    (n, modes) float, (n, 2 modes) with two planes
        The first columns of each plane are close to its natural modes at rest.

    Notes
    -----
    The `modes` slowest whirls, with damping and cross coupling, are taken at spin speed 0 and at
    the highest natural frequency that is kept, and under three loads between ±0.95 of the buckling
    load: right and left eigenvectors, for under a follower load a projection needs both. The basis
    holds their leading directions in elastic energy. Every spin speed and load has the same basis.
    """
    planes = 2 if system.planes else 1
    size = system.size // planes
    count = min(size, max(_FREE_MODES, 4 * modes))
    forced = _forced(system, planes)
    modes_at_rest = [_modes_at_rest(system, part, count, forced) for part in _parts(size, planes)]
    squares = np.array([squares for squares, _ in modes_at_rest])
    free = [shapes for _, shapes in modes_at_rest]
    small = system.projected(block_diag(*free))
    # the first two may be rigid motions
    highest = float(np.sqrt(np.abs(squares[:, : max(modes, 3)]).max()))
    slowest = _SLOW * highest
    energies = squares.ravel().clip(min=slowest**2)
    load = min(_reference_load(small.geometric, energies, slowest), LARGEST_LOAD)
    shapes = whirl_shapes(
        small,
        [share * load for share in _LOADS],
        [min(share * highest, LARGEST) for share in _SPEEDS],
        max(1, (modes * planes + 1) // 2),
        slowest,
    )
    bases = []
    for part, vectors in zip(_parts(squares.shape[1], planes), free, strict=True):
        weights = np.sqrt(energies[part])
        directions = np.linalg.svd(weights[:, None] * shapes[part])[0][:, :modes]
        basis = vectors @ (directions / weights[:, None])
        bases.append(basis)
    return np.asarray(block_diag(*bases))


def _parts(size: int, planes: int) -> list[slice]:
    """Return the coordinates of each plane."""
    return [slice(at * size, (at + 1) * size) for at in range(planes)]


def _forced(system: System, planes: int) -> Index:
    """Return the coordinates of each plane where dampers and cross-coupled springs act."""
    acting = [system.external_damping, system.cross_stiffness, system.cross_damping]
    rows = np.any([matrix.any(axis=1) for matrix in acting if matrix is not None], axis=0)
    return np.flatnonzero(rows.reshape(planes, -1).any(axis=0))


def _modes_at_rest(system: System, part: slice, count: int, forced: Index) -> tuple[Array, Array]:
    """Return ω² (k,) and shapes (n, k) of one plane at rest.

    The shapes span the slowest free modes and the static response to a force at each of the
    `forced` coordinates: free modes alone converge slowly to a shape with a kink there.
    """
    elastic, mass = system.elastic[part, part], system.mass[part, part]
    squares, free = eigh(elastic, mass, subset_by_index=(0, count - 1))
    held = elastic + abs(squares[-1]) * mass  # a rigid motion has no static response
    static = np.linalg.solve(held, np.eye(len(mass))[:, forced])
    factor = np.linalg.cholesky(mass).T
    span = np.linalg.solve(factor, np.linalg.qr(factor @ np.hstack([free, static]))[0])
    squares, inner = eigh(span.T @ elastic @ span)
    return squares, span @ inner


def _reference_load(geometric: Array, energies: Array, slowest: float) -> float:
    """Return the load that buckles the rotor, if its rigid motions are left out."""
    kept = energies > slowest**2
    scale = 1 / np.sqrt(energies[kept])
    symmetric = -(geometric + geometric.T)[np.ix_(kept, kept)] / 2
    largest = float(np.abs(eigvalsh(scale[:, None] * symmetric * scale)).max(initial=0.0))
    return 1 / largest if largest > 0 else 0.0
