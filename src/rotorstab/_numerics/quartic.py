"""Roots of many real quartics at once.

NumPy solves one polynomial per call, and a chart needs a thousand. Here each quartic is split into
two real quadratics: all arithmetic is real, and complex roots are exact conjugates.
"""

from __future__ import annotations

import numpy as np

from .._tolerances import DOUBLE_ROOT
from .._types import Array, ArrayLike, Complex, Mask

__all__ = ["quadratic_roots", "quartic_roots"]

_TINY = 1e-300  # added to denominators that are 0 only where the numerator is 0 too
_STEPS = 3  # of Bairstow's method, which converges quadratically
_SAFE = 1e-3  # part of its terms above which a constant coefficient has kept 13 digits


def quartic_roots(
    c4: ArrayLike, c3: ArrayLike, c2: ArrayLike, c1: ArrayLike, c0: ArrayLike
) -> Complex:
    """Return the roots of c₄x⁴ + c₃x³ + c₂x² + c₁x + c₀, sorted by real part.

    Parameters
    ----------
    c4, c3, c2, c1, c0 : (...) float
        Real coefficients that broadcast together, c4 ≠ 0, ratios to c4 up to 1e24.

    Returns
    -------
    (..., 4) complex
        Sorted by real, then imaginary part; real roots have imaginary part 0.

    Notes
    -----
    The error of a simple root is rounding times its condition number. A double root is known to
    the square root of rounding, about 1e-8, as with any method that uses the coefficients only.

    References
    ----------
    Euler's resolvent, its isolated root by Viète's or Cardano's formula; Bairstow's step.

    Examples
    --------
    >>> quartic_roots(1.0, 0.0, -5.0, 0.0, 4.0).real.tolist()
    [-2.0, -1.0, 1.0, 2.0]
    """
    c3, c2, c1, c0 = (np.divide(c, c4) for c in (c3, c2, c1, c0))
    shape = np.broadcast(c3, c2, c1, c0).shape
    if not shape:
        c0 = np.reshape(c0, 1)
    # y = x + c₃/4
    h = 0.25 * c3
    hh = h * h
    p = c2 - 6 * hh
    q = c1 - 2 * h * (p + 2 * hh)
    r = c0 - h * (c1 - h * (p + 3 * hh))
    s, t, sum_p = _split(p, q, r)
    a = np.empty((2, *s.shape))
    b = np.empty((2, *s.shape))
    np.add(h, s, out=a[0])
    np.subtract(h, s, out=a[1])
    np.subtract(sum_p, t, out=b[0])
    np.add(sum_p, t, out=b[1])
    b *= 0.5
    b += h * a
    a += h
    # b loses as many digits as it is smaller than the terms of its sum
    good: Mask = np.asarray(np.abs(b) > _SAFE * (hh + s * s + np.abs(t)))
    if not good.all():
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            good = _polish(a, b, c3, c2, c1, c0)
    roots = _roots_of_factors(a, b)
    if not good.all():
        # the roots differ very much in size, or three of them nearly meet
        bad = ~good.all(axis=0)
        rest = (np.broadcast_to(c, bad.shape)[bad] for c in (c3, c2, c1, c0))
        roots[bad] = np.sort(_companion_roots(*rest))
    return roots.reshape(*shape, 4)


def quadratic_roots(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Complex:
    """Return the roots of ax² + bx + c, sorted by real, then imaginary part.

    Parameters
    ----------
    a, b, c : (...) float
        Real coefficients that broadcast together, a ≠ 0.

    Returns
    -------
    (..., 2) complex
        A discriminant that is below zero by rounding counts as zero (a double root).

    Examples
    --------
    >>> quadratic_roots(1.0, -3.0, 2.0).real.tolist()
    [1.0, 2.0]
    """
    b, c = np.broadcast_arrays(np.divide(b, a), np.divide(c, a))
    return _roots_of_factors(b[None], c[None])


def _split(p: Array, q: Array, r: Array) -> tuple[Array, Array, Array]:
    """Return s, t and p + s² of y⁴ + py² + qy + r = Π (y² ± sy + (p + s² ∓ t)/2)."""
    z = _isolated_square(p, q, r)
    # st = q, and t² = (p + z)² − 4r; compute the larger of s and t by a root, the other from st
    sum_p = p + z
    t2 = sum_p * sum_p - 4 * r
    by_s = z * z >= t2
    larger = np.sqrt(np.where(by_s, z, t2))
    other = q / (larger + (larger == 0))
    return np.where(by_s, larger, other), np.where(by_s, other, larger), sum_p


def _isolated_square(p: Array, q: Array, r: Array) -> Array:
    """Return z = s² of `_split`, a root of Euler's resolvent z³ + 2pz² + (p² − 4r)z − q².

    The isolated root is taken, for then a double root of the quartic falls inside one factor. It
    is found by Viète's formula where the resolvent has three real roots, else by Cardano's.
    """
    # with w = 3z/2 + p: 4w³ − 3mw − n = 0
    p2, r4 = p * p, 4 * r
    r12 = 3 * r4
    m = p2 + r12
    n = 13.5 * (q * q) - p * (3 * r12 - p2)
    size = np.abs(n)
    root = np.sqrt(np.maximum(m, 0.0))
    cube = m * root
    angle = np.arccos(np.minimum(size, cube) / (cube + _TINY)) / 3
    w = root * np.cos(angle)
    single = size > cube
    if single.any():
        a = np.cbrt(size + np.sqrt(np.abs(size * size - m * m * m)))
        np.copyto(w, 0.5 * (a + m / (a + _TINY)), where=single)
    z = (np.copysign(w, n) - p) * (2 / 3)
    if z.min(initial=0.0) < 0:
        # with four complex roots the two other z have unlike signs: take the positive one
        four = (z < 0) & ~single & ((p >= 0) | (r4 >= p2))
        total, product = -2 * p - z, q * q / (z - (z == 0))
        root = np.sqrt(np.maximum(total * total - 4 * product, 0.0))
        far = np.abs(total) + root
        np.copyto(z, np.where(total > 0, far / 2, -2 * product / (far + (far == 0))), where=four)
        np.maximum(z, 0.0, out=z)
    return np.asarray(z)


def _polish(a: Array, b: Array, c3: Array, c2: Array, c1: Array, c0: Array) -> Mask:
    """Improve the factors x² + ax + b (2, ...) in place by Bairstow's steps; return success."""
    for _ in range(_STEPS):
        # quotient x² + ex + f and remainder r1 x + r0
        e = c3 - a
        f = c2 - a * e - b
        r1 = c1 - a * f - b * e
        r0 = c0 - b * f
        m, n = e - a, f - b
        bm, k = b * m, n - a * m
        resultant = n * k + bm * m
        da = (n * r1 - m * r0) / resultant
        db = (k * r0 + bm * r1) / resultant
        size = np.abs(b)
        # the next step, its square, would be rounding
        good = (np.abs(db) <= 1e-8 * size) & (da * da <= 1e-16 * (a * a + size))
        a += da
        b += db
        if good.all():
            break
    return good


def _roots_of_factors(b: Array, c: Array) -> Complex:
    """Return the roots (..., 2k) of k quadratics x² + bx + c (k, ...) together, sorted."""
    half = -0.5 * b
    square = half * half
    discriminant = square - c
    root = np.sqrt(np.abs(discriminant))
    outer = half + np.copysign(root, half)
    # the other root from the product: no cancellation
    inner = c / (outer + (outer == 0))
    pair = discriminant < -DOUBLE_ROOT * square
    count = len(b)
    roots = np.zeros((*b.shape[1:], 2 * count), np.complex128)
    if pair.any():
        outer, inner = np.where(pair, half, outer), np.where(pair, half, inner)
        root *= pair
        for k in range(count):
            roots.imag[..., k] = root[k]
            np.subtract(0.0, root[k], out=roots.imag[..., k + count])
    for k in range(count):
        roots.real[..., k], roots.real[..., k + count] = outer[k], inner[k]
    roots.sort(axis=-1)
    return roots


def _companion_roots(c3: Array, c2: Array, c1: Array, c0: Array) -> Complex:
    """Return the roots (k, 4) of k monic quartics as eigenvalues; LAPACK balances the matrix."""
    companion = np.zeros((c0.size, 4, 4))
    companion[:, [1, 2, 3], [0, 1, 2]] = 1
    companion[:, 0] = -np.stack([c3, c2, c1, c0], axis=-1)
    return np.linalg.eigvals(companion).astype(np.complex128)
