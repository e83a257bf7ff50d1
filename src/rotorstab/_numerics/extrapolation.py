"""Weights of Richardson's extrapolation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._types import Array

__all__ = ["extrapolation_weights"]


def extrapolation_weights(steps: Sequence[int], order: int) -> Array:
    """Return weights of results whose errors are sums of h^order, h^(order + 2), … .

    With k results the first k − 1 of these errors cancel. A symmetric scheme of even order has no
    errors of odd powers.

    Parameters
    ----------
    steps : (k,) int
        Numbers of steps, or of elements, of the results, up to a common factor: h is 1/steps.
    order : int
        Order of the lowest error.

    Returns
    -------
    (k,) float
        Their sum is 1.

    Examples
    --------
    >>> extrapolation_weights((1, 2), 2).round(9).tolist()
    [-0.333333333, 1.333333333]
    """
    sizes = 1 / np.asarray(steps, dtype=np.float64)
    errors = [sizes ** (order + 2 * k) for k in range(len(sizes) - 1)]
    rows = np.array([np.ones_like(sizes), *errors])
    return np.asarray(np.linalg.solve(rows, np.eye(len(sizes))[0]))
