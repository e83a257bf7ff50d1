"""Chebyshev interpolation on an interval."""

from __future__ import annotations

from functools import cache

import numpy as np

from .._types import Array

__all__ = [
    "chebyshev_angles",
    "chebyshev_nodes",
    "chebyshev_transform",
    "chebyshev_values",
    "coefficient_weights",
]


def chebyshev_angles(nodes: int) -> Array:
    """Return the angles (k + ½)π/nodes whose cosines are the Chebyshev–Gauss nodes of [−1, 1]."""
    return np.asarray((np.arange(nodes) + 0.5) * np.pi / nodes)


def chebyshev_nodes(count: int, low: float, high: float) -> Array:
    """Return the Chebyshev–Gauss nodes (count,) of [low, high] in falling order."""
    return np.asarray((low + high) / 2 + (high - low) / 2 * np.cos(chebyshev_angles(count)))


def coefficient_weights(count: int, nodes: int) -> Array:
    """Return the matrix (count, nodes) from values at the nodes to Chebyshev coefficients.

    The coefficients are also those of cos 0, cos φ, cos 2φ … for values at `chebyshev_angles`.
    """
    matrix = np.cos(np.outer(np.arange(count), chebyshev_angles(nodes))) * (2 / nodes)
    matrix[0] /= 2
    return np.asarray(matrix)


@cache
def chebyshev_transform(count: int) -> Array:
    """Return the matrix (count, count) from values at `chebyshev_nodes` to all coefficients."""
    matrix = coefficient_weights(count, count)
    matrix.flags.writeable = False
    return matrix


def chebyshev_values(points: Array, low: float, high: float, count: int) -> Array:
    """Return T_0 … T_{count−1} (..., count) at points (...) of [low, high]."""
    width = high - low
    x = (2 * points - low - high) / width if width > 0 else np.zeros_like(points)
    x = np.clip(x, -1, 1)
    values = np.empty((count, *x.shape))
    values[0] = 1
    values[1:2] = x
    twice = 2 * x
    # the recurrence is stable here, and cheaper than cosines
    for k in range(2, count):
        np.multiply(twice, values[k - 1], out=values[k])
        values[k] -= values[k - 2]
    return np.moveaxis(values, 0, -1)
