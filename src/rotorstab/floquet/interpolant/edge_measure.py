"""A function of the multipliers that is smooth through the edge of what is unstable.

The growth rate itself is not: where two multipliers collide it rises like a square root.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ..._numerics.angles import wrapped
from ..._types import Array, Complex
from ..criterion import is_unstable_on_chart

__all__ = ["edge_of_approach", "edge_of_multipliers", "with_verdict"]

_SMALLEST = 1e-280  # modulus that stands for a multiplier that has decayed to 0


def edge_of_approach(approach: Array) -> Array:
    """Return (σT)² of two multipliers that have collided, −(Δψ/2)² of two that have not.

    Parameters
    ----------
    approach : (...) float
        cosh 2σT − 1 or cos Δψ − 1, as `self_inversive_growth` returns it.

    Returns
    -------
    (...) float
    """
    inside = np.arccosh(1 + np.maximum(approach, 0))
    outside = np.arccos(np.clip(1 + approach, -1, 1))
    return np.asarray((inside**2 - outside**2) / 4)


def edge_of_multipliers(multipliers: Complex, shift: Array | float, damped: bool) -> Array:
    """Return a function that is positive where the largest multiplier grows, else negative.

    With ln μ = λ + jψ of two multipliers, a = (λ_i − λ_j)/2, b = (ψ_i − ψ_j)/2 and
    m = (λ_i + λ_j)/2 < 0, the larger one grows where |a| > |m|. Through their collision a and b are
    no smooth functions, but a² − b² and ab are, and so is

        (a² − m²)(b² + m²)/m² = a² − b² − m² + (ab/m)².

    For two that have collided (b = 0) and grow like σT this is σT(σT + 2|m|).

    Parameters
    ----------
    multipliers : (m, ...) complex
    shift : (...) float
        Added to ln |μ|; broadcasts.
    damped : bool
        Whether multipliers decay. Without damping, m = 0, the function is a² − b².

    Returns
    -------
    (...) float
        Of the pair that is nearest to the edge.
    """
    size = np.log(np.maximum(np.abs(multipliers), _SMALLEST)) + shift
    angle = np.angle(multipliers)
    grows = size.max(axis=0) > 0
    below = np.full(grows.shape, -np.inf)
    above = np.full(grows.shape, np.inf)
    for i, j in combinations(range(len(size)), 2):
        a2 = (size[i] - size[j]) ** 2 / 4
        b2 = wrapped(angle[i] - angle[j]) ** 2 / 4
        if not damped:
            below = np.maximum(below, a2 - b2)
            continue
        middle = (size[i] + size[j]) / 2
        m2 = middle * middle
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            value = (a2 - m2) * (1 + b2 / m2)
        below = np.fmax(below, value)
        smaller = (middle < 0) & (value > 0) & (value < above)
        above = np.where(smaller, value, above)
    if not damped:
        return below
    # where no pair decays as a whole, its largest growth stands for it
    above = np.where(np.isinf(above), size.max(axis=0) ** 2, above)
    return np.asarray(np.where(grows, above, below))


def with_verdict(smooth: Array, growth: Array, error: Array, damped: bool) -> Array:
    """Return an edge function with the sign of the verdict; NaN where the growth is.

    Without damping rounding may lift it above 0 where two multipliers only pass each other.
    """
    grows = is_unstable_on_chart(growth, error, damped)
    inside = np.where(smooth > 0, smooth, growth * growth)
    edge = np.where(grows, inside, -np.abs(smooth))
    return np.where(np.isfinite(growth), edge, np.nan)
