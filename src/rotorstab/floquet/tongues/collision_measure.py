"""How close two multipliers are to a collision on the unit circle, where growth starts."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ..._numerics.angles import wrapped
from ..._types import Array, ArrayLike, Complex
from ...model.system import System
from ..point import floquet_solution

__all__ = ["collision_measure", "edge_function", "pair_closeness"]


def pair_closeness(multipliers: Complex) -> Array:
    """Return Re ((ln μ_i − ln μ_j)/2)² of every pair of multipliers.

    For two multipliers on the unit circle this is −(half the difference of their arguments)²; for
    two that have collided and left it, (σT)². It is smooth through the collision.

    Parameters
    ----------
    multipliers : (..., 2n) complex

    Returns
    -------
    (..., n(2n − 1)) float
    """
    logs = np.log(multipliers)
    pairs = []
    for i, j in combinations(range(logs.shape[-1]), 2):
        gap = logs[..., i] - logs[..., j]
        pairs.append((gap.real**2 - wrapped(gap.imag) ** 2) / 4)
    return np.stack(pairs, axis=-1)


def collision_measure(
    system: System, static_load: float, load: ArrayLike, frequency: ArrayLike
) -> tuple[Array, Array]:
    """Return the `pair_closeness` of the closest pair, and the growth rate.

    Parameters
    ----------
    system : System
    static_load : float
        p̄₀ [EI/L²].
    load, frequency : (...) float
        p̄_t and θ̄; they broadcast.

    Returns
    -------
    closeness, growth_rate : (...) float
        Without damping the roots of the closeness are the edges of tongues.
    """
    solution = floquet_solution(system, static_load, load, frequency)
    return pair_closeness(solution.multipliers).max(axis=-1), solution.growth_rate


def edge_function(system: System, static: float, load: Array, theta: Array) -> Array:
    """Return a function that is positive inside a tongue and 0 at its edges.

    This is the growth rate of a damped system, the closeness of an undamped one.
    """
    closeness, growth = collision_measure(system, static, load, theta)
    return np.array(growth if system.is_damped else closeness)
