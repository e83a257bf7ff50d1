"""From monodromy matrices to multipliers: characteristic polynomials in closed form.

For two degrees of freedom the polynomial is μ⁴ − c₁μ³ + c₂μ² − c₃μ + c₄; without damping it
is scaled to c₄ = 1, then c₃ = c̄₁ and c₂ is real, for the multipliers come in pairs μ, 1/μ̄.
"""

from __future__ import annotations

import numpy as np

from ..._types import Array, Complex

__all__ = [
    "characteristic_coefficients",
    "pair_halves",
    "quartic_multipliers",
    "reversed_coefficients",
    "self_inversive_multipliers",
]

# the k-th pair of rows and the (5 − k)-th are together all four rows
_PAIRS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
_FIRST, _SECOND = np.array(_PAIRS).T
_SIGNS = np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0])  # of the permutation (pair, other pair)
_NEAR_END = 0.05  # cos² or sin² of a half angle below which the quotient by it is near 0/0
_BEYOND = 1e-6  # a root |y| > 2 by more than this is no rounding: rounding splits it by 1e-7


def _minors(matrix: Complex) -> Complex:
    """Return the determinants (6, 6, ...) of two rows and two columns of (4, 4, ...)."""
    upper, lower = matrix[_FIRST], matrix[_SECOND]
    minors = upper[:, _FIRST] * lower[:, _SECOND]
    minors -= upper[:, _SECOND] * lower[:, _FIRST]
    return np.asarray(minors)


def _cofactor_sum(matrix: Complex, minors: Complex, other: Complex) -> Complex:
    """Return Σ C_ij B_ij, C the cofactors of A = `matrix` and B = `other`, (4, 4, ...) each."""
    total = np.zeros(matrix.shape[2:], dtype=np.complex128)
    for row, rest in ((0, 5), (2, 0)):
        mixed = matrix[row][_FIRST] * other[row + 1][_SECOND]
        mixed -= matrix[row][_SECOND] * other[row + 1][_FIRST]
        mixed += other[row][_FIRST] * matrix[row + 1][_SECOND]
        mixed -= other[row][_SECOND] * matrix[row + 1][_FIRST]
        total += np.einsum("j,j...,j...->...", _SIGNS, minors[rest, ::-1], mixed)
    return total


def characteristic_coefficients(monodromy: Complex, scale: Complex) -> Complex:
    """Return c₁, c₂, c₃ of the multipliers divided by `scale`.

    Parameters
    ----------
    monodromy : (4, 4, ...) complex
    scale : (...) complex
        Any number, such as a fourth root of the determinant.

    Returns
    -------
    (3, ...) complex
    """
    minors = _minors(monodromy)
    one = np.eye(4, dtype=np.complex128).reshape(4, 4, *[1] * (monodromy.ndim - 2))
    return np.array(
        [
            np.einsum("ii...->...", monodromy) / scale,
            np.einsum("ii...->...", minors) / scale**2,
            _cofactor_sum(monodromy, minors, one) / scale**3,
        ]
    )


def reversed_coefficients(half: Complex, scale: Complex) -> Array:
    """Return Re c₁, Im c₁ and c₂ of conj(Y)⁻¹Y, the monodromy where Y(−t) = conj Y(t).

    Parameters
    ----------
    half : (4, 4, ...) complex
        Y over half a period, |det Y| = 1.
    scale : (...) complex
        A fourth root of the monodromy's determinant, a square root of Y's.

    Returns
    -------
    (3, ...) float

    Notes
    -----
    The inverse's minors are those of Y (Jacobi): no matrix is solved, and c₂ is no difference
    of large traces.
    """
    minors = _minors(half)
    conjugate = minors.conj()
    first = _cofactor_sum(half.conj(), conjugate, half) * scale
    products = conjugate[:2:-1, ::-1] * minors[:3]
    second = 2 * np.einsum("i,j,ij...->...", _SIGNS[:3], _SIGNS, products.real)
    return np.array([first.real, first.imag, second])


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
    outside = np.abs(y) > 2 + _BEYOND
    if outside.any():
        # the other two roots from their product and sum, for arccos loses them beside a large y
        top = y[outside]
        product = (2 * (re2 - im2) - 4 * c2)[outside] / top
        half = (linear[outside] - product) / top / 2
        apart = half + np.copysign(np.sqrt(np.maximum(half * half - product, 0)), half)
        apart += apart == 0
        y[outside] = np.where(half * top > 0, product / apart, apart)
    return np.asarray(np.clip(y, -2.0, 2.0))


def pair_halves(re: Array, im: Array, c2: Array) -> tuple[Array, Array, Array]:
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
    y, total, difference = pair_halves(re, im, c2)
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


def quartic_multipliers(
    coefficients: Complex, determinant: Array | float = 1.0
) -> tuple[Complex, Array, Array, Array]:
    """Return the roots of μ⁴ − c₁μ³ + c₂μ² − c₃μ + c₄ by Ferrari's formula and two Newton steps.

    Parameters
    ----------
    coefficients : (3, ...) complex
        c₁, c₂, c₃.
    determinant : (...) float
        c₄; broadcasts.

    Returns
    -------
    roots : (4, ...) complex
    value, slope, bend : (4, ...) float
        Moduli of the quartic, of its first derivative and of half its second derivative at the
        roots before the last step.
    """
    c1, c2, c3 = coefficients
    y = _resolvent_root(c1, c2, c3, determinant)
    w2, d2 = c1 * c1 / 4 - c2 + y, y * y / 4 - determinant
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
    roots, *_ = _newton_step(roots, coefficients, determinant)
    return _newton_step(roots, coefficients, determinant)


def _resolvent_root(c1: Complex, c2: Complex, c3: Complex, determinant: Array | float) -> Complex:
    """Return the root of Ferrari's resolvent cubic that lies farthest from the two others."""
    linear = c1 * c3 - 4 * determinant
    mean = c2 / 3
    q = mean * mean - linear / 3
    r = mean * (q - linear / 6) + (c1 * c1 * determinant + c3 * c3) / 2 - 2 * c2 * determinant
    root = np.sqrt(r * r - q * q * q)
    root = np.where((r.conj() * root).real < 0, -root, root)
    big = (r + root) ** (1 / 3)
    big = np.where(big == 0, 1.0, big)
    turns = np.exp(2j * np.pi / 3 * np.arange(3)).reshape(3, *([1] * np.ndim(c1)))
    candidates = mean + big * turns + q / (big * turns)
    # the root farthest from the others is the well conditioned one
    slope = np.abs(3 * (candidates - mean) ** 2 - 3 * q)
    return np.asarray(np.take_along_axis(candidates, slope.argmax(axis=0)[None], 0)[0])


def _newton_step(
    roots: Complex, coefficients: Complex, determinant: Array | float
) -> tuple[Complex, Array, Array, Array]:
    """Return roots after a Newton step and the moduli it used; nearly double roots stay."""
    c1, c2, c3 = coefficients
    value = (((roots - c1) * roots + c2) * roots - c3) * roots + determinant
    slope = ((4 * roots - 3 * c1) * roots + 2 * c2) * roots - c3
    bend = (6 * roots - 3 * c1) * roots + c2
    sizes = np.abs(value), np.abs(slope), np.abs(bend)
    safe = sizes[1] ** 2 > 4 * sizes[0] * sizes[2]
    return roots - np.where(safe, value / np.where(safe, slope, 1.0), 0), *sizes
