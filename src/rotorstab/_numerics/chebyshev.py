"""Chebyshev interpolation on an interval."""

from __future__ import annotations

from functools import cache

import numpy as np

from .._types import Array

__all__ = ["chebyshev_nodes", "chebyshev_transform", "chebyshev_values"]


@cache
def chebyshev_transform(count: int) -> Array:
    """Return the matrix (count, count) from values at `chebyshev_nodes` to coefficients."""
    angle = (np.arange(count) + 0.5) * np.pi / count
    matrix = np.cos(np.outer(np.arange(count), angle)) * (2 / count)
    matrix[0] /= 2
    matrix.flags.writeable = False
    return np.asarray(matrix)


def chebyshev_nodes(count: int, low: float, high: float) -> Array:
    """Return the Chebyshev–Gauss nodes of [low, high] in falling order."""
    angle = (np.arange(count) + 0.5) * np.pi / count
    return np.asarray((low + high) / 2 + (high - low) / 2 * np.cos(angle))


def chebyshev_values(points: Array, low: float, high: float, count: int) -> Array:
    """Return T_0 … T_{count−1} at points of [low, high], (..., count)."""
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
