"""The companion matrix of a quadratic eigenvalue problem."""

from __future__ import annotations

import numpy as np

from .._types import AnyArray

__all__ = ["companion_matrix"]


def companion_matrix(constant: AnyArray, linear: AnyArray) -> AnyArray:
    """Return [[0, I], [A, B]], whose eigenvalues x are the roots of det(x²I − xB − A) = 0.

    Its eigenvectors are (q, xq) with x²q = Aq + xBq.

    Parameters
    ----------
    constant, linear : (..., n, n) float or complex
        A and B; their shapes broadcast together.

    Returns
    -------
    (..., 2n, 2n) float or complex

    Examples
    --------
    >>> np.linalg.eigvals(companion_matrix(np.array([[6.0]]), np.array([[1.0]]))).round(9).tolist()
    [-2.0, 3.0]
    """
    n = constant.shape[-1]
    shape = np.broadcast_shapes(constant.shape, linear.shape)
    matrix = np.zeros((*shape[:-2], 2 * n, 2 * n), np.result_type(constant, linear))
    matrix[..., :n, n:] = np.eye(n)
    matrix[..., n:, :n] = constant
    matrix[..., n:, n:] = linear
    return matrix
