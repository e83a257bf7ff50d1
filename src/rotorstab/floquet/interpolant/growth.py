"""Growth rates from characteristic polynomials or monodromies, and how far they may be wrong."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .characteristic import pair_halves, quartic_multipliers

__all__ = ["largest_modulus", "matrix_growth", "reversed_growth", "self_inversive_growth"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_BLOCK = 8192  # polynomials worked on together: what a cache holds
_FAR = 0.1  # of a multiplier: errors that move it farther are beyond a Taylor series
_STRONG = 1e-6  # 1 + t² of multipliers so far off the circle that another way is more accurate
_ROUNDING = 1e-15  # of a matrix, in its eigenvalues
_LOST = 1e-13  # rounding in the cubic's discriminant


def self_inversive_growth(
    coefficients: Array, error: Array, nearness: bool = False
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of self-inversive quartics and how far it may be wrong.

    Parameters
    ----------
    coefficients : (3, ...) float
        Re c₁, Im c₁, c₂.
    error : (3, ...) float
        Bounds on their errors.
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
    slack = _shift(size, distance, 1.0)
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


def _shift(value: Array, slope: Array, bend: Array | float) -> Array:
    """Return how far a root of a function may lie, given bounds of its value at this point.

    With b = |f″|/2 the nearest root of v + f′h + bh² is at most 2v/|f′| and √(v/b) away, whatever
    the phases are; twice the latter leaves room, for slope and bend are those of a moved root.
    """
    least = np.sqrt(value * bend)
    return np.asarray(2 * value / np.maximum(slope - least, least + 1e-300))


def _far_off(growth: Array, size: Array, error: Array) -> Array:
    """Return how far ln max|μ| may be wrong, whatever the errors of |c₁|, |c₂| … are.

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
    coefficients: Complex, determinant: Array, error: Array, nearness: bool = False
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of general quartics and how far it may be wrong.

    Parameters
    ----------
    coefficients : (3, ...) complex
        c₁, c₂, c₃.
    determinant : (...) float
        Product of the multipliers; broadcasts.
    error : (3, ...) float
        Bounds on their errors.
    nearness : bool
        Whether to fill `approach`.

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
    shift = _shift(slack, slope, bend)
    # any root may be the largest
    high, low = (modulus + shift).max(axis=0), (modulus - shift).max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        growth = np.log(size)
        uncertainty = np.log(np.maximum(high / size, size / np.maximum(low, 0)))
    lost = ~(high - low < _FAR * size)
    if lost.any():
        uncertainty[lost] = _far_off(growth[lost], np.abs(coefficients[:, lost]), error[:, lost])
    approach: Array = np.broadcast_to(np.nan, size.shape)
    if nearness:
        with np.errstate(divide="ignore", invalid="ignore"):
            pairs = [
                ((roots[i] - roots[j]) ** 2 / (2 * roots[i] * roots[j])).real
                for i, j in combinations(range(4), 2)
            ]
        # a multiplier that has decayed to 0 meets none
        approach = np.fmax.reduce([np.where(np.isinf(pair), np.nan, pair) for pair in pairs])
    return growth, np.asarray(uncertainty), approach


def matrix_growth(monodromy: Complex, error: Array) -> tuple[Array, Array]:
    """Return ln max|μ| of monodromies by their eigenvalues, and how far it may be wrong.

    Parameters
    ----------
    monodromy : (..., m, m) complex
    error : (..., m, m) float
        Bounds on the errors of its entries.

    Returns
    -------
    growth, uncertainty : (...) float
        The error of an eigenvalue is |w| δM |v| / |w v|, with its eigenvectors w, v. NaN where an
        entry is not finite.
    """
    good, monodromy, error = _finite(monodromy, error)
    values, right = np.linalg.eig(monodromy)
    slack = _first_order(_inverse(right), error + _rounding(monodromy), right)
    size, gap = np.abs(values), _gaps(values).min(axis=-1)
    shift = _shift(slack * gap, gap, 1.0)
    # any eigenvalue may be the largest
    high, low, top = (x.max(axis=-1) for x in (size + shift, size - shift, size))
    with np.errstate(divide="ignore"):
        uncertainty = np.log(np.maximum(high / top, top / np.maximum(low, 0)))
    return np.where(good, np.log(top), np.nan), np.where(good, uncertainty, np.nan)


def reversed_growth(half: Complex, error: Array) -> tuple[Array, Array]:
    """Return ln max|μ| of conj(Y)⁻¹Y, and how far it may be wrong, by a real eigenproblem.

    With Y = R + jS and Sx = tRx it is μ = (1 + jt)/(1 − jt), on the unit circle where t is real.

    Parameters
    ----------
    half : (..., m, m) complex
        Y over half a period, where Y(−t) = conj Y(t).
    error : (..., m, m) float
        Bounds on the errors of its entries.

    Returns
    -------
    growth, uncertainty : (...) float
        Both exactly 0 where no two multipliers may meet. NaN where an entry is not finite.
    """
    good, half, error = _finite(half, error)
    inverse = _inverse(half.real)
    operator = inverse @ half.imag
    t, right = np.linalg.eig(operator)
    left = _inverse(right)
    # d ln μ = 2j dt/(1 + t²), dt = w (δS − t δR) x with w R x = 1
    rate = np.abs(1 + t * t)
    slack = np.sqrt(1 + np.abs(t) ** 2) * _first_order(left @ inverse, error, right)
    slack = 2 * (slack + _first_order(left, _rounding(operator), right)) / rate
    mu = (1 + 1j * t) / (1 - 1j * t)
    log = np.where(t.imag == 0, 0.0, np.log(np.abs(mu)))
    gaps = _gaps(mu) / np.abs(mu)[..., None]
    gap = gaps.min(axis=-1)
    shift = _shift(slack * gap, gap, 1.0)
    # a multiplier on the circle leaves it only to meet another one
    meets = (gaps < slack[..., None] + slack[..., None, :]).any(axis=-1) | (t.imag != 0)
    growth = log.max(axis=-1)
    high = np.where(meets, log + shift, 0.0).max(axis=-1)
    low = np.maximum((log - shift).max(axis=-1), 0.0)
    uncertainty = np.maximum(high - growth, growth - low)
    # growth so strong that 1 − jt is a difference of nothing
    strong = np.flatnonzero(good.ravel() & (rate.min(axis=-1).ravel() < _STRONG))
    if strong.size:
        y, doubt = (x.reshape(-1, *x.shape[-2:])[strong] for x in (half, error))
        solver = _inverse(y.conj())
        monodromy = solver @ y
        doubt = np.abs(solver) @ (doubt + doubt @ np.abs(monodromy))
        growth.flat[strong], uncertainty.flat[strong] = matrix_growth(monodromy, doubt)
    return np.where(good, growth, np.nan), np.where(good, uncertainty, np.nan)


def _finite(matrix: Complex, error: Array) -> tuple[NDArray[np.bool_], Complex, Array]:
    """Return where all entries are finite, and both arrays made so."""
    good = np.asarray(np.isfinite(matrix).all((-2, -1)) & np.isfinite(error).all((-2, -1)))
    if good.all():
        return good, matrix, error
    keep = good[..., None, None]
    return good, np.where(keep, matrix, np.eye(matrix.shape[-1])), np.where(keep, error, 0.0)


def _inverse(matrix: NDArray[Any]) -> NDArray[Any]:
    """Return inverses, pseudo-inverses if one matrix of them is singular."""
    try:
        return np.asarray(np.linalg.inv(matrix))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrix))


def _rounding(matrix: NDArray[Any]) -> Array:
    """Return what rounding adds to each entry's error in an eigenproblem."""
    size = np.abs(matrix).max(axis=(-2, -1), keepdims=True)
    return np.broadcast_to(_ROUNDING * matrix.shape[-1] * size, matrix.shape)


def _first_order(left: NDArray[Any], error: Array, right: NDArray[Any]) -> Array:
    """Return |w| E |v| of each pair of left and right eigenvectors, (..., m)."""
    product = np.abs(left) @ error
    return np.asarray((product * np.swapaxes(np.abs(right), -1, -2)).sum(axis=-1))


def _gaps(values: Complex) -> Array:
    """Return the distances of eigenvalues, (..., m, m), inf from itself."""
    gaps = np.abs(values[..., :, None] - values[..., None, :])
    index = np.arange(values.shape[-1])
    gaps[..., index, index] = np.inf
    return np.asarray(gaps)
