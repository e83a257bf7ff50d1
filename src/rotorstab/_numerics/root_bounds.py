"""How far a root of a function may lie from a point where the function is small."""

from __future__ import annotations

import numpy as np

from .._types import Array

__all__ = ["root_distance"]


def root_distance(value: Array, slope: Array, bend: Array | float) -> Array:
    """Return a bound of the distance to the nearest root of a function.

    With b = |f″|/2 the nearest root of v + f′h + bh² is at most 2v/|f′| and √(v/b) away, whatever
    the phases of the coefficients are. Twice the second leaves room for slope and curvature that
    belong to a nearby point.

    Parameters
    ----------
    value, slope : (...) float
        Bounds of |v| and of |f′|.
    bend : (...) float
        b.

    Examples
    --------
    >>> float(root_distance(np.array(1e-6), np.array(1.0), 0.0))
    2e-06
    """
    least = np.sqrt(value * bend)
    return np.asarray(2 * value / np.maximum(slope - least, least + 1e-300))
