"""The maximum of a parabola through three points."""

from __future__ import annotations

import numpy as np

from .._types import Array

__all__ = ["parabola_maximum"]


def parabola_maximum(x: Array, y: Array) -> tuple[Array, Array, Array]:
    """Return where parabolas through three points are largest, their values there, and bends.

    Parameters
    ----------
    x, y : (..., 3) float
        Abscissas, all different, and ordinates.

    Returns
    -------
    place, value : (...) float
        NaN where the parabola has no maximum: its bend is 0 or above.
    bend : (...) float
        Half of the second derivative: y = value + bend (x − place)².

    Examples
    --------
    >>> place, value, bend = parabola_maximum(np.array([0.0, 1.0, 3.0]), np.array([1.0, 4.0, 4.0]))
    >>> float(place), float(value), float(bend)
    (2.0, 5.0, -1.0)
    """
    left, right = x[..., 0] - x[..., 1], x[..., 2] - x[..., 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        before, after = (y[..., 0] - y[..., 1]) / left, (y[..., 2] - y[..., 1]) / right
        bend = (after - before) / (right - left)
        slope = before - bend * left  # at the middle point
        shift = np.where(bend < 0, -slope / (2 * bend), np.nan)
        return x[..., 1] + shift, y[..., 1] + slope * shift / 2, bend
