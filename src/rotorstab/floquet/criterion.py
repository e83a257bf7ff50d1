"""What counts as unstable: the one criterion of points, charts and outlines."""

from __future__ import annotations

import numpy as np

from .._tolerances import SMALLEST_GROWTH
from .._types import Array, Mask

__all__ = ["is_unstable"]


def is_unstable(growth: Array, error: Array) -> Mask:
    """Tell where a growth rate σ̄ exceeds both its own error and `SMALLEST_GROWTH`.

    Parameters
    ----------
    growth, error : (...) float
        σ̄ and the bound on its error [√(EI/(ρAL⁴))]; NaN counts as stable.

    Returns
    -------
    (...) bool
    """
    return np.asarray(growth > np.maximum(error, SMALLEST_GROWTH))
