"""Roots of many real quartics at once.

NumPy solves one polynomial a call; a chart needs a thousand. Euler's resolvent in real
arithmetic where all roots are real, in complex arithmetic elsewhere, then Newton steps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["quadratic_roots", "quartic_roots"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_COSINE_SHIFTS = np.array([0.0, -2 * np.pi / 3, 2 * np.pi / 3])


def quadratic_roots(a: Array | float, b: Array, c: Array) -> Complex:
    """Return both roots (..., 2) of a x² + b x + c without cancellation, a ≠ 0.

    A discriminant that is zero to rounding is taken as zero (a double root).
    """
    discriminant = b * b - 4 * a * c
    noise = 4e-16 * (b * b + np.abs(4 * a * c))
    root = np.sqrt(np.where(np.abs(discriminant) < noise, 0.0, discriminant) + 0j)
    q = (b + np.where(b < 0, -root, root)) / -2
    return np.stack([q / a, c / (q + (q == 0))], axis=-1)


def _resolvent(p: Array, q: Array, r: Array) -> tuple[Array, Array, Array]:
    """Return P, Q of the depressed resolvent w³ + P w + Q and its discriminant."""
    p2 = p * p
    big_p = -p2 / 3 - 4 * r
    big_q = p * (8 * r / 3 - 2 * p2 / 27) - q * q
    return big_p, big_q, -4 * big_p * big_p * big_p - 27 * big_q * big_q


def _combine(s1: NDArray, s2: NDArray, q: Array) -> NDArray:
    """Return the four roots (4, ...) of y⁴ + p y² + q y + r from the resolvent's roots."""
    product = s1 * s2
    # the third root from s₁s₂s₃ = −q; where the product is 0 so is q
    s3 = -q / (product + (product == 0))
    total, difference = s1 + s2, s1 - s2
    roots = np.array([s3 - total, -difference - s3, difference - s3, total + s3])
    roots *= 0.5
    return roots


def _complex_roots(p: Array, q: Array, r: Array) -> Complex:
    """Solve y⁴ + p y² + q y + r where some roots are not real."""
    big_p, big_q, discriminant = _resolvent(p, q, r)
    w = np.empty((*p.shape, 3), np.complex128)
    three = discriminant >= 0
    if three.any():
        amplitude = np.sqrt(np.maximum(-big_p[three] / 3, 0.0))
        with np.errstate(divide="ignore", invalid="ignore"):
            cosine = np.where(amplitude > 0, -big_q[three] / (2 * amplitude**3), 1.0)
        angle = np.arccos(np.clip(cosine, -1, 1)) / 3
        w[three] = 2 * amplitude[..., None] * np.cos(angle[..., None] + _COSINE_SHIFTS)
    one = ~three
    if one.any():
        half = big_q[one] / 2
        root = np.sqrt(np.maximum(half**2 + big_p[one] ** 3 / 27, 0.0))
        a = -np.copysign(np.cbrt(np.abs(half) + root), half)
        with np.errstate(divide="ignore", invalid="ignore"):
            b = np.where(a == 0, 0.0, -big_p[one] / (3 * a))
        imaginary = 1j * np.sqrt(3) / 2 * (a - b)
        w[one] = np.stack([a + b, -(a + b) / 2 + imaginary, -(a + b) / 2 - imaginary], axis=-1)
    z = w - 2 * p[..., None] / 3
    # the two largest, so that the third follows from the product without cancellation
    order = np.argsort(-np.abs(z), axis=-1)
    s = np.sqrt(np.take_along_axis(z, order[..., :2], axis=-1))
    return _combine(s[..., 0], s[..., 1], q)


def _real_roots(p: Array, q: Array, big_p: Array, big_q: Array) -> Array:
    """Solve y⁴ + p y² + q y + r where all roots are real."""
    half = np.sqrt(big_p / -3)
    amplitude = 2 * half
    angle = np.arccos(np.clip(big_q / (amplitude * big_p / 3), -1, 1)) / 3
    base = p * (-2 / 3)
    s1 = np.sqrt(base + amplitude * np.cos(angle))
    second = base + amplitude * np.cos(angle - 2 * np.pi / 3)
    return _combine(s1, np.sqrt(np.maximum(second, 0.0)), q)


def _newton(x: NDArray, c3: Array, c2: Array, c1: Array, c0: Array) -> NDArray:
    """Polish roots x (4, ...) of the monic quartic by two Newton steps."""
    d3, d2 = 3 * c3, 2 * c2
    for _ in range(2):
        value = x + c3
        slope = 4 * x
        slope += d3
        for c, d in ((c2, d2), (c1, c1)):
            value *= x
            value += c
            slope *= x
            slope += d
        value *= x
        value += c0
        value /= slope
        # near a double root the quotient is noise: no step that is not small
        value[~(np.abs(value) <= 1e-5 * np.abs(x))] = 0
        x = x - value
    return x


def quartic_roots(c4: Array, c3: Array, c2: Array, c1: Array, c0: Array) -> Complex:
    """Return the roots of c₄x⁴ + c₃x³ + c₂x² + c₁x + c₀, sorted by real part.

    Parameters
    ----------
    c4, c3, c2, c1, c0 : (...) float
        Real coefficients that broadcast together, c4 ≠ 0.

    Returns
    -------
    (..., 4) complex
        Sorted by real, then imaginary part; real roots have imaginary part 0.

    Notes
    -----
    Simple roots are good to rounding times their condition; a double root to its
    square root, about 1e-8, as with any method that sees coefficients only.

    References
    ----------
    Euler's solution with the trigonometric form of the resolvent's roots.

    Examples
    --------
    >>> one = np.ones(1)
    >>> quartic_roots(one, 0 * one, -5 * one, 0 * one, 4 * one)[0].real.tolist()
    [-2.0, -1.0, 1.0, 2.0]
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        monic = np.broadcast_arrays(c3 / c4, c2 / c4, c1 / c4, c0 / c4)
        shape = monic[0].shape
        return _solve(*(c.ravel() for c in monic)).reshape(*shape, 4)


def _solve(c3: Array, c2: Array, c1: Array, c0: Array) -> Complex:
    """Solve the monic quartics."""
    shift = c3 / 4
    s2 = shift * shift
    p = c2 - 6 * s2
    q = c1 + shift * (8 * s2 - 2 * c2)
    r = c0 + shift * (shift * (c2 - 3 * s2) - c1)
    big_p, big_q, discriminant = _resolvent(p, q, r)
    # all four roots are real only here
    real = (discriminant > 0) & (p < 0) & (4 * r < p * p)
    if real.all():
        roots = _real_roots(p, q, big_p, big_q) - shift
        return np.sort(_newton(roots, c3, c2, c1, c0), axis=0).T.astype(np.complex128)
    roots = np.empty((4, *p.shape), np.complex128)
    if real.any():
        roots[:, real] = _real_roots(p[real], q[real], big_p[real], big_q[real])
    rest = ~real
    roots[:, rest] = _complex_roots(p[rest], q[rest], r[rest])
    roots = _newton(roots - shift, c3, c2, c1, c0)
    noise = np.abs(roots.imag) <= 2e-8 * np.abs(roots).max(axis=0)
    roots.imag[noise] = 0
    return np.sort(roots, axis=0).T
