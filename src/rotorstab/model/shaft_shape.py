"""The deflected shaft between root and tip, exact for a massless Timoshenko shaft under load."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._arguments import number, numbers, whole_number
from .._types import AnyArray, Array, ArrayLike
from ..rotors.shaft_disk import ShaftDisk
from .stiffness import exact_stiffness

__all__ = ["ShaftShape", "shaft_shape"]

_SERIES_BELOW = 1.0  # |x|ξ² below which the closed forms lose digits and the series are summed
# Taylor coefficients in xξ² of the three functions of the shape
_SERIES = np.array(
    [[(-1.0) ** n / math.factorial(2 * n + k) for n in range(12)] for k in (1, 2, 3)]
)


@dataclass(frozen=True, eq=False)
class ShaftShape:
    """Deflected shaft between root and tip.

    Parameters
    ----------
    position : (k,) float
        x/L from 0 at the root to 1 at the tip.
    displacement, slope : (..., k) float or complex
        Deflection v/L and angle γ of the cross-section there.
    """

    position: Array
    displacement: AnyArray
    slope: AnyArray


def _shape_functions(x: float, xi: Array) -> tuple[Array, Array, Array]:
    """Return sin kξ/k, (1 − cos kξ)/x and (ξ − sin kξ/k)/x, k = √x; entire in x."""
    y = x * xi**2
    small = np.abs(y) < _SERIES_BELOW
    far = np.where(small, 1.0, y)
    k = np.sqrt(np.abs(far))
    with np.errstate(over="ignore"):
        sine = np.where(far > 0, np.sin(k), np.sinh(k)) / k
        cosine = np.where(far > 0, np.cos(k), np.cosh(k))
    closed = sine, (1 - cosine) / far, (1 - sine) / far
    near = np.where(small, y, 0.0)
    series = [np.polynomial.polynomial.polyval(near, row) for row in _SERIES]
    s, c, g = (np.where(small, a, b) for a, b in zip(series, closed, strict=True))
    return xi * s, xi**2 * c, xi**3 * g


def shaft_shape(
    rotor: ShaftDisk, load: float, tip_state: ArrayLike, points: int = 25
) -> ShaftShape:
    """Return the exact shape of the loaded shaft between root and tip, (A4)–(A7).

    With C of (1 − Φp̄)v′ − γ = C and x = p̄/(1 − Φp̄), (A4) is γ″ + xγ + D = 0 with
    D = C/(Φ(1 − Φp̄)), the transverse force over 1 − Φp̄; γ′(0) is the root's moment.

    Parameters
    ----------
    rotor : ShaftDisk
        Only its `shear` Φ is used.
    load : float
        p̄ [EI/L²], compression positive, below `largest_exact_load`.
    tip_state : (..., 2) float or complex
        Displacement and slope of the tip.
    points : int
        Number of points, 2 or more, evenly spaced from root to tip.

    Returns
    -------
    ShaftShape

    Raises
    ------
    ValueError
        If an argument is out of range or the load reaches the pole of the exact stiffness.

    Notes
    -----
    The inertia of the shaft is neglected, as in the lumped model. A follower load changes
    only the force at the tip, not the shape for a given state of the tip. In strong tension,
    √|x| ≫ 1, rounding errors grow like e^√|x|.

    Examples
    --------
    >>> shape = shaft_shape(ShaftDisk(), 0.0, [1.0, 1.5], points=3)
    >>> [float(f"{v:.4f}") for v in shape.displacement]
    [0.0, 0.3125, 1.0]
    """
    p = number("load", load)
    count = whole_number("points", points, 2, 10_000)
    tip = np.asarray(tip_state)
    if tip.shape[-1:] != (2,) or not np.isfinite(tip).all():
        raise ValueError(f"`tip_state` must hold finite pairs (..., 2), got {tip_state!r}")
    shear = rotor.shear
    force, moment = np.moveaxis(tip @ exact_stiffness(p, shear).T, -1, 0)
    softening = 1 - shear * p
    xi = np.linspace(0.0, 1.0, count)
    s, c, g = _shape_functions(p / softening, xi)
    # γ′ integrated over (A4), (A5): root moment = tip moment + force · 1 + p̄ v(1)
    root = (moment + force + p * tip[..., 0])[..., None]
    shift = (force / softening)[..., None]
    return ShaftShape(
        position=numbers("position", xi),
        displacement=(root * c - shift * g) / softening + shear * shift * xi,
        slope=root * s - shift * c,
    )
