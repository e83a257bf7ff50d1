"""Growth of the multipliers from characteristic polynomials, and bounds on its error."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import numpy as np

from ..._numerics.root_bounds import root_distance
from ..._types import Array, Complex, Mask
from .characteristic import pair_halves, quartic_multipliers

__all__ = ["Measure", "collision_approach", "largest_modulus", "self_inversive_growth"]

Measure = Callable[[Complex], Array]
"""Maps multipliers (m, ...) to a number (...) of each set."""

_BLOCK = 8192  # polynomials computed together: about what a processor's cache holds
_FAR = 0.1  # part of a multiplier; an error that moves it farther is beyond a Taylor series
_LOST = 1e-13  # rounding in the discriminant of the cubic


def self_inversive_growth(
    coefficients: Array, error: Array, with_approach: bool = False
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of self-inversive quartics and a bound on its error.

    Parameters
    ----------
    coefficients : (3, ...) float
        Re c₁, Im c₁, c₂.
    error : (3, ...) float
        Bounds on the errors of the coefficients.
    with_approach : bool
        Whether to compute `approach`.

    Returns
    -------
    growth : (...) float
        σT, exactly 0 where all four lie on the unit circle.
    uncertainty : (...) float
        Bound on the error of `growth`; at a double multiplier the square root of the error of the
        coefficients.
    approach : (...) float
        cos Δψ − 1 of the two multipliers that are closest on the unit circle, cosh 2σT − 1 of two
        that have collided and left it: smooth through the collision. NaN if not asked for.
    """
    if with_approach:
        growth, uncertainty, pairs = _pair_growth(coefficients, error)
        return growth, uncertainty, _approach(*pairs)
    shape = coefficients.shape[1:]
    flat, slack = coefficients.reshape(3, -1), error.reshape(3, -1)
    growth, uncertainty = np.zeros((2, flat.shape[1]))
    doubtful = np.concatenate(
        [
            start + np.flatnonzero(~_surely_on_circle(flat[:, part], slack[:, part].max(axis=0)))
            for start in range(0, flat.shape[1], _BLOCK)
            for part in (slice(start, start + _BLOCK),)
        ]
    )
    if doubtful.size:
        found = _pair_growth(flat[:, doubtful], slack[:, doubtful])
        growth[doubtful], uncertainty[doubtful] = found[:2]
    return growth.reshape(shape), uncertainty.reshape(shape), np.broadcast_to(np.nan, shape)


def _surely_on_circle(coefficients: Array, error: Array | float) -> Mask:
    """Tell where all four multipliers lie on the unit circle for any errors up to the bounds.

    The resolvent cubic of `_pair_sum` has three real roots, q³ > r², and they lie in [−2, 2] as
    its turning points c₂/3 ± √q do. Two of them meet before any leaves, so q³ − r² must fall to
    0 first; its gradient there is below 10 (largest sum of |∂| over the four arguments).
    """
    re, im, c2 = coefficients
    mean = c2 * (1 / 3)
    re2, im2 = re * re, im * im
    third = re2 + im2
    third -= 4
    third *= 1 / 3
    q = mean * mean
    q -= third
    third *= -0.5
    third += q
    third *= mean
    re2 -= im2
    third += re2
    re2 = c2 * 2
    third -= re2
    third *= third
    room = 2 - np.abs(mean)
    inside = (room > 0) & (q < room * room)
    cube = q * q
    cube *= q
    cube -= third
    return np.asarray(inside & (cube > 10 * error + _LOST))


def _pair_growth(
    coefficients: Array, error: Array
) -> tuple[Array, Array, tuple[Array, Array, Array]]:
    """Return growth and uncertainty of `self_inversive_growth`, and y with the sums P.

    With μ = e^{jα/2 + g} the polynomial is μ² (P₁ − 2cosh g)(2cosh(g + jα) − P₂) and an error of
    its coefficients is μ² times 2|cosh(g + jα/2)| δRe c₁ + 2|sinh(g + jα/2)| δIm c₁ + δc₂.
    """
    y, total, difference = pair_halves(*coefficients)
    largest, other = (total + difference) / 2, (total - difference) / 2
    half = np.maximum(largest, 2.0) / 2  # cosh g
    square = half * half - 1
    cos2, sin2 = (2 + y) / 4, (2 - y) / 4
    size = error[2] + 2 * (np.sqrt(square + cos2) * error[0] + np.sqrt(square + sin2) * error[1])
    distance = np.sqrt((half * y - other) ** 2 + 16 * square * cos2 * sin2)
    slack = root_distance(size, distance, 1.0)
    growth = np.arccosh(half)
    near = largest + slack > 2
    uncertainty = np.zeros_like(growth)
    upper, lower = (
        np.arccosh(np.maximum(largest[near] + sign * slack[near], 2.0) / 2) for sign in (1, -1)
    )
    uncertainty[near] = np.maximum(upper - growth[near], growth[near] - lower)
    lost = ~(slack < _FAR * np.maximum(largest, 2))
    if lost.any():
        size = np.array(
            [np.hypot(coefficients[0, lost], coefficients[1, lost]), np.abs(coefficients[2, lost])]
        )
        doubt = np.array([np.hypot(error[0, lost], error[1, lost]), error[2, lost]])
        uncertainty[lost] = _far_off(growth[lost], size, doubt)
    return growth, uncertainty, (y, largest, other)


def _far_off(growth: Array, size: Array, error: Array) -> Array:
    """Return the error of ln max|μ| for errors of |c₁|, |c₂| … that may be large.

    |c_k| is at most binomial(4, k) R^k with R the largest modulus, and R at most 2 max |c_k|^{1/k}
    (Fujiwara), c₄ included.
    """
    order = np.arange(1, len(size) + 1).reshape(-1, *[1] * growth.ndim)
    choices = np.array([4, 6, 4])[: len(size)].reshape(order.shape)
    least = np.maximum((1 - _LOST) * size - error, 0) / choices
    with np.errstate(divide="ignore"):
        low = (np.log(least) / order).max(axis=0)
        high = np.maximum((np.log(size + error) / order).max(axis=0), 0.0) + np.log(2)
    return np.asarray(np.maximum(high - growth, growth - low))


def _approach(y: Array, first: Array, second: Array) -> Array:
    """Return cos Δψ − 1 of the closest two of four multipliers, from y and the sums P.

    The arguments are ±α/2 with ±a₁ and ±a₂ about them, y = 2cos α, P = 2cos a.
    """
    within = np.maximum(first * first, second * second) / 2 - 2
    c0, c1, c2 = y / 2, np.minimum(first / 2, 1.0), np.clip(second / 2, -1.0, 1.0)
    s0, s1, s2 = (np.sqrt(np.maximum(1 - c * c, 0)) for c in (c0, c1, c2))
    cosines, sines = c1 * c2, s1 * s2
    plus = c0 * (cosines - sines) + np.abs(s0 * (s1 * c2 + c1 * s2))
    minus = c0 * (cosines + sines) + np.abs(s0 * (s1 * c2 - c1 * s2))
    across = np.maximum(plus, minus) - 1
    return np.asarray(np.where(first > 2, within, np.maximum(within, across)))


def largest_modulus(
    coefficients: Complex, determinant: Array, error: Array, measure: Measure | None = None
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of general quartics and a bound on its error.

    Parameters
    ----------
    coefficients : (3, ...) complex
        c₁, c₂, c₃.
    determinant : (...) float
        Product of the multipliers; broadcasts.
    error : (3, ...) float
        Bounds on the errors of the coefficients.
    with_approach : bool
        Whether to compute `approach`.

    Returns
    -------
    growth, uncertainty : (...) float
        The error is that of a root, Σ |δc_k| |μ|^{4−k} / |p′(μ)|.
    approach : (...) float
        Largest Re cosh ln(μ_i/μ_j) − 1 of two multipliers, as in `self_inversive_growth`; NaN if
        not asked for.
    """
    roots, value, slope, bend = quartic_multipliers(coefficients, determinant)
    modulus = np.abs(roots)
    size = modulus.max(axis=0)
    slack = value + ((error[0] * modulus + error[1]) * modulus + error[2]) * modulus
    shift = root_distance(slack, slope, bend)
    # any root may be the largest
    high, low = (modulus + shift).max(axis=0), (modulus - shift).max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        growth = np.log(size)
        uncertainty = np.log(np.maximum(high / size, size / np.maximum(low, 0)))
    lost = ~(high - low < _FAR * size)
    if lost.any():
        uncertainty[lost] = _far_off(growth[lost], np.abs(coefficients[:, lost]), error[:, lost])
    measured = np.broadcast_to(np.nan, size.shape) if measure is None else measure(roots)
    return growth, np.asarray(uncertainty), measured


def collision_approach(multipliers: Complex) -> Array:
    """Return the largest Re cosh ln(μ_i/μ_j) − 1 of two of four multipliers (4, ...).

    This is the approach of `self_inversive_growth` for multipliers that decay.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        pairs = [
            ((one - other) ** 2 / (2 * one * other)).real
            for one, other in combinations(multipliers, 2)
        ]
    # a multiplier that has decayed to 0 meets none
    return np.asarray(np.fmax.reduce([np.where(np.isinf(pair), np.nan, pair) for pair in pairs]))
