"""Growth rates from characteristic polynomials or monodromies, and how far they may be wrong."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from .characteristic import NEAR_END, pair_halves, quartic_multipliers, slopes

__all__ = ["largest_modulus", "matrix_growth", "self_inversive_growth"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_BLOCK = 8192  # polynomials worked on together: what a cache holds
_LOST = 1e-13  # rounding in the cubic's discriminant


def self_inversive_growth(
    coefficients: Array, error: Array | float = 0.0, nearness: bool = False
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of self-inversive quartics and how far it may be wrong.

    Parameters
    ----------
    coefficients : (3, ...) float
        Re c₁, Im c₁, c₂.
    error : (...) float
        Bound on the errors of the coefficients.
    nearness : bool
        Whether to fill `approach`.

    Returns
    -------
    growth : (...) float
        σT, exactly 0 where all four lie on the unit circle.
    uncertainty : (...) float
        Bound on its error, √ of the coefficients' at a double multiplier.
    approach : (...) float
        cos Δψ − 1 of the two multipliers closest on the circle, cosh 2σT − 1 once they have
        collided: smooth through the collision. NaN if not asked for.
    """
    if nearness:
        growth, uncertainty, pairs = _pair_growth(coefficients, error)
        return growth, uncertainty, _approach(*pairs)
    shape = coefficients.shape[1:]
    flat, slack = coefficients.reshape(3, -1), np.broadcast_to(error, shape).reshape(-1)
    growth, uncertainty = np.zeros((2, flat.shape[1]))
    doubtful = np.concatenate(
        [
            start + np.flatnonzero(~_surely_on_circle(flat[:, part], slack[part]))
            for start in range(0, flat.shape[1], _BLOCK)
            for part in (slice(start, start + _BLOCK),)
        ]
    )
    if doubtful.size:
        found = _pair_growth(flat[:, doubtful], slack[doubtful])
        growth[doubtful], uncertainty[doubtful] = found[:2]
    return growth.reshape(shape), uncertainty.reshape(shape), np.broadcast_to(np.nan, shape)


def _surely_on_circle(coefficients: Array, error: Array | float) -> NDArray[np.bool_]:
    """Tell where all four multipliers lie on the unit circle, whatever the errors are.

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
    coefficients: Array, error: Array | float
) -> tuple[Array, Array, tuple[Array, Array, Array]]:
    """Return growth and uncertainty of `self_inversive_growth`, and y with the sums P."""
    y, total, difference = pair_halves(*coefficients)
    largest = (total + difference) / 2
    # how far the colliding pair stays from the other one
    distance = np.minimum(np.abs(y - (total - difference) / 2), 1)
    distance *= distance
    slack = 2 * error / np.maximum(distance, np.minimum(np.sqrt(error) + 1e-300, 1))
    end = np.abs(y) > 2 - 4 * NEAR_END
    if end.any():
        # there one of S and D is the root of a difference
        small = np.minimum(total, difference)
        slack += np.where(end, 8 * error / np.maximum(small, np.sqrt(8 * error) + 1e-300), 0)
    growth = np.arccosh(np.maximum(largest, 2.0) / 2)
    near = largest + slack > 2
    uncertainty = np.zeros_like(growth)
    upper, lower = (
        np.arccosh(np.maximum(largest[near] + sign * slack[near], 2.0) / 2) for sign in (1, -1)
    )
    uncertainty[near] = np.maximum(upper - growth[near], growth[near] - lower)
    return growth, uncertainty, (y, largest, (total - difference) / 2)


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
    coefficients: Complex, error: Array | float = 0.0, nearness: bool = False
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of general quartics and how far it may be wrong.

    Parameters
    ----------
    coefficients : (3, ...) complex
    error : (...) float
        Bound on the errors of the coefficients.
    nearness : bool
        Whether to fill `approach`.

    Returns
    -------
    growth, uncertainty : (...) float
    approach : (...) float
        Largest Re cosh ln(μ_i/μ_j) − 1 of two multipliers, as in `self_inversive_growth`; NaN if
        not asked for.
    """
    roots = quartic_multipliers(coefficients)
    modulus = np.abs(roots)
    index = modulus.argmax(axis=0)[None]
    top = np.take_along_axis(roots, index, 0)[0]
    size = np.take_along_axis(modulus, index, 0)[0]
    _, slope, bend = slopes(top, coefficients)
    slack = error * (1 + size + size**2) * size
    first, second = np.abs(slope), np.abs(bend)
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = 2 * slack / (first + np.sqrt(first**2 + 4 * slack * second))
    approach: Array = np.broadcast_to(np.nan, size.shape)
    if nearness:
        pairs = [
            ((roots[i] - roots[j]) ** 2 / (2 * roots[i] * roots[j])).real
            for i, j in combinations(range(4), 2)
        ]
        approach = np.max(pairs, axis=0)
    return np.log(size), np.asarray(shift / size), approach


def matrix_growth(monodromy: Complex, error: Array | float = 0.0) -> tuple[Array, Array]:
    """Return ln max|μ| of monodromies by their eigenvalues, and how far it may be wrong.

    Parameters
    ----------
    monodromy : (..., 2n, 2n) complex
    error : (...) float
        Bound on the errors of the characteristic polynomial's coefficients.

    Returns
    -------
    growth, uncertainty : (...) float
        All NaN if one entry is not finite.
    """
    if not np.isfinite(monodromy).all():
        return (np.full(monodromy.shape[:-2], np.nan),) * 2
    values = np.linalg.eigvals(monodromy)
    modulus = np.abs(values)
    top = modulus.argmax(axis=-1)[..., None]
    gap = np.abs(values - np.take_along_axis(values, top, -1))
    np.put_along_axis(gap, top, np.inf, -1)
    gap = gap.min(axis=-1)
    largest = np.take_along_axis(modulus, top, -1)[..., 0]
    slack = 2 * monodromy.shape[-1] * error * largest
    shift = 2 * slack / (gap + np.sqrt(gap**2 + 4 * slack))
    return np.log(largest), shift / largest
