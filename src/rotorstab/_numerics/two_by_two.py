"""Determinants of 2 × 2 matrices as polynomials, for plain numbers and for arrays alike.

A matrix stands as the tuple of its four entries (a₁₁, a₁₂, a₂₁, a₂₂), which are numbers or arrays.
"""

from __future__ import annotations

from typing import Any

from .._types import Array

__all__ = ["determinant", "entries", "mixed_determinant"]


def entries(matrix: Array) -> tuple[Any, ...]:
    """Return the four entries of (..., 2, 2) matrices, as plain numbers for a single matrix.

    Plain numbers keep NumPy out of the arithmetic of a single point, which is many times faster.
    """
    if matrix.ndim == 2:
        return tuple(matrix.ravel().tolist())
    return tuple(matrix[..., i, j] for i in range(2) for j in range(2))


def determinant(a: tuple[Any, ...]) -> Any:
    """Return det a.

    Examples
    --------
    >>> determinant((1.0, 2.0, 3.0, 4.0))
    -2.0
    """
    return a[0] * a[3] - a[1] * a[2]


def mixed_determinant(a: tuple[Any, ...], b: tuple[Any, ...]) -> Any:
    """Return the coefficient of t in det(a + tb) = det a + t mixed(a, b) + t² det b.

    Examples
    --------
    >>> mixed_determinant((1.0, 0.0, 0.0, 1.0), (2.0, 0.0, 0.0, 3.0))
    5.0
    """
    return a[0] * b[3] + b[0] * a[3] - a[1] * b[2] - b[1] * a[2]
