"""From monodromy matrices to multipliers: characteristic polynomials in closed form.

For two degrees of freedom, scaled to determinant 1, the polynomial is
μ⁴ − c₁μ³ + c₂μ² − c₃μ + 1; without damping c₃ = c̄₁ and c₂ is real, for the multipliers
come in pairs μ, 1/μ̄.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "characteristic_coefficients",
    "largest_modulus",
    "quartic_multipliers",
    "self_inversive_growth",
    "self_inversive_multipliers",
    "solved",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NEAR_END = 0.05  # of 2 ± y: below it one of the two half-angle quotients is 0/0
_BEYOND = 1e-6  # |y| > 2 by more than this is a real split, not rounding


def solved(matrix: Complex, right: Complex) -> Complex:
    """Return matrix⁻¹ right, all NaN if one of the matrices is singular to rounding.

    That happens where a growth over half a period leaves the range of double precision; a
    chart then computes those pixels one by one.
    """
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.complex128)
    except np.linalg.LinAlgError:
        return np.full(right.shape, np.nan, dtype=np.complex128)


def characteristic_coefficients(monodromy: Complex, scale: Complex) -> NDArray[Any]:
    """Return c₁, c₂, c₃ of the multipliers divided by `scale`.

    Parameters
    ----------
    monodromy : (..., 4, 4) complex
    scale : (...) complex
        A fourth root of the determinant.

    Returns
    -------
    (3, ...) complex
    """
    c1 = np.trace(monodromy, axis1=-2, axis2=-1) / scale
    square = np.einsum("...ij,...ji->...", monodromy, monodromy) / scale**2
    inverse = solved(monodromy, np.broadcast_to(np.eye(4, dtype=complex), monodromy.shape))
    return np.array([c1, (c1**2 - square) / 2, np.trace(inverse, axis1=-2, axis2=-1) * scale])


def _pair_sum(re: Array, im: Array, c2: Array) -> Array:
    """Return y = 2cos(ψ₁ + ψ₂), a root of the resolvent cubic, for one pairing of the roots.

    y³ − c₂y² + (|c₁|² − 4)y − (2Re c₁² − 4c₂) = 0. The root farthest from the others is the
    well conditioned one; if it lies outside [−2, 2] the opposite extreme lies inside.
    """
    re2, im2 = re * re, im * im
    mean = c2 / 3
    linear = re2 + im2 - 4
    q = mean * mean - linear / 3
    r = mean * (q - linear / 6) + (re2 - im2) - 2 * c2
    size = np.sqrt(np.maximum(q, 0))
    cube = size * size * size
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.abs(r) / cube
    single = ~(ratio < 1)
    angle = np.arccos(np.minimum(ratio, 1.0)) / 3
    y = mean + np.copysign(2 * size * np.cos(angle), r)
    if single.any():
        # Cardano: one real root
        q1, r1 = q[single], r[single]
        big = np.cbrt(np.abs(r1) + np.sqrt(np.maximum(r1 * r1 - q1 * q1 * q1, 0)))
        big += big == 0
        y[single] = mean[single] + np.copysign(big + q1 / big, r1)
    outside = ~single & (np.abs(y) > 2 + _BEYOND)
    if outside.any():
        far = 2 * size[outside] * np.cos(angle[outside] - np.pi / 3)
        y[outside] = mean[outside] - np.copysign(far, r[outside])
    return np.asarray(np.clip(y, -2.0, 2.0))


def _pair_halves(re: Array, im: Array, c2: Array) -> tuple[Array, Array, Array]:
    """Return y, |S| and |D| where P = (S ± D)/2 are the real sums of the two pairs.

    Each pair is e^{±jα/2}(u, 1/u) with P = u + 1/u: c₁ = P₁e^{jα/2} + P₂e^{−jα/2} and
    c₂ = 2cos α + P₁P₂.
    """
    y = _pair_sum(re, im, c2)
    cos2, sin2 = (2 + y) / 4, (2 - y) / 4
    product = 4 * (c2 - y)
    with np.errstate(divide="ignore", invalid="ignore"):
        sum2, difference2 = re * re / cos2, im * im / sin2
    sum2 = np.where(cos2 < _NEAR_END, np.maximum(difference2 + product, 0), sum2)
    difference2 = np.where(sin2 < _NEAR_END, np.maximum(sum2 - product, 0), difference2)
    return y, np.sqrt(sum2), np.sqrt(difference2)


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
    y, total, difference = _pair_halves(*coefficients)
    largest = (total + difference) / 2
    # how far the colliding pair stays from the other one
    distance = np.minimum(np.abs(y - (total - difference) / 2), 1)
    distance *= distance
    slack = 2 * error / np.maximum(distance, np.minimum(np.sqrt(error) + 1e-300, 1))
    end = np.abs(y) > 2 - 4 * _NEAR_END
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
    if not nearness:
        return growth, uncertainty, np.full_like(growth, np.nan)
    return growth, uncertainty, _approach(y, largest, (total - difference) / 2)


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


def self_inversive_multipliers(coefficients: Array) -> Complex:
    """Return the four roots of self-inversive quartics.

    Parameters
    ----------
    coefficients : (3, ...) float
        Re c₁, Im c₁, c₂ of μ⁴ − c₁μ³ + c₂μ² − c̄₁μ + 1.

    Returns
    -------
    (4, ...) complex

    Examples
    --------
    >>> mu = self_inversive_multipliers(np.array([2.5, 0.0, 2.0]).reshape(3, 1))
    >>> bool(np.allclose(np.sort(abs(mu.ravel())), [0.5, 1, 1, 2]))
    True
    """
    re, im, c2 = coefficients
    y, total, difference = _pair_halves(re, im, c2)
    total = np.copysign(total, re)
    difference = np.copysign(difference, im)
    half = np.sqrt((2 + y) / 4) + 1j * np.sqrt((2 - y) / 4)
    roots = np.empty((4, *re.shape), dtype=np.complex128)
    for index, (pair, turn) in enumerate(
        (((total + difference) / 2, half), ((total - difference) / 2, half.conj()))
    ):
        square = pair * pair / 4 - 1
        root = np.sqrt(np.abs(square))
        split = np.where(square > 0, np.copysign(root, pair), 1j * root)
        roots[2 * index] = (pair / 2 + split) * turn
        roots[2 * index + 1] = turn * turn / roots[2 * index]
    return roots


def quartic_multipliers(coefficients: Complex) -> Complex:
    """Return the four roots of μ⁴ − c₁μ³ + c₂μ² − c₃μ + 1, Ferrari's way, then two Newton steps.

    Parameters
    ----------
    coefficients : (3, ...) complex

    Returns
    -------
    (4, ...) complex
    """
    c1, c2, c3 = coefficients
    linear = c1 * c3 - 4
    mean = c2 / 3
    q = mean * mean - linear / 3
    r = mean * (q - linear / 6) + (c1 * c1 + c3 * c3) / 2 - 2 * c2
    root = np.sqrt(r * r - q * q * q)
    root = np.where((r.conj() * root).real < 0, -root, root)
    big = (r + root) ** (1 / 3)
    big = np.where(big == 0, 1.0, big)
    turns = np.exp(2j * np.pi / 3 * np.arange(3)).reshape(3, *([1] * np.ndim(c1)))
    candidates = mean + big * turns + q / (big * turns)
    # the root farthest from the others is the well conditioned one
    slope = np.abs(3 * (candidates - mean) ** 2 - 3 * q)
    y = np.take_along_axis(candidates, slope.argmax(axis=0)[None], 0)[0]
    w2, d2 = c1 * c1 / 4 - c2 + y, y * y / 4 - 1
    product = (c1 * y / 2 - c3) / 2
    use_w = np.abs(w2) >= np.abs(d2)
    first = np.sqrt(np.where(use_w, w2, d2))
    second = product / np.where(first == 0, 1.0, first)
    w, d = np.where(use_w, first, second), np.where(use_w, second, first)
    roots = np.empty((4, *np.shape(c1)), dtype=np.complex128)
    for index, sign in enumerate((1, -1)):
        p, s = c1 / 2 + sign * w, y / 2 + sign * d
        split = np.sqrt(p * p - 4 * s)
        split = np.where((p.conj() * split).real < 0, -split, split)
        large = (p + split) / 2
        roots[2 * index] = large
        roots[2 * index + 1] = s / np.where(large == 0, 1.0, large)
    return _polish(roots, coefficients)


def _slopes(roots: Complex, coefficients: Complex) -> tuple[Complex, Complex, Complex]:
    """Return the quartic's value, first and half second derivative at approximate roots."""
    c1, c2, c3 = coefficients
    value = (((roots - c1) * roots + c2) * roots - c3) * roots + 1
    first = ((4 * roots - 3 * c1) * roots + 2 * c2) * roots - c3
    return value, first, (6 * roots - 3 * c1) * roots + c2


def _polish(roots: Complex, coefficients: Complex) -> Complex:
    """Take two Newton steps, save where roots nearly coincide."""
    for _ in range(2):
        value, slope, bend = _slopes(roots, coefficients)
        safe = np.abs(slope) ** 2 > 4 * np.abs(value * bend)
        roots = roots - np.where(safe, value / np.where(safe, slope, 1.0), 0)
    return roots


def largest_modulus(coefficients: Complex, error: Array | float = 0.0) -> tuple[Array, Array]:
    """Return ln max|μ| of general quartics and how far it may be wrong.

    Parameters
    ----------
    coefficients : (3, ...) complex
    error : (...) float
        Bound on the errors of the coefficients.

    Returns
    -------
    growth, uncertainty : (...) float
    """
    roots = quartic_multipliers(coefficients)
    modulus = np.abs(roots)
    index = modulus.argmax(axis=0)[None]
    top = np.take_along_axis(roots, index, 0)[0]
    size = np.take_along_axis(modulus, index, 0)[0]
    _, slope, bend = _slopes(top, coefficients)
    slack = error * (1 + size + size**2) * size
    first, second = np.abs(slope), np.abs(bend)
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = 2 * slack / (first + np.sqrt(first**2 + 4 * slack * second))
    return np.log(size), np.asarray(shift / size)
