"""Which roots are real, and roots of many functions at once between two known signs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .._tolerances import NEGLIGIBLE, REAL
from .._types import AnyArray, Array, Index, Mask

__all__ = ["bracketed_roots", "is_real"]

_MOST_EVALUATIONS = 40  # of each function; bisection alone narrows 1 to 1e-12 in as many


def is_real(roots: AnyArray) -> Mask:
    """Return which roots of a polynomial or eigenvalues of a matrix are real, but for rounding.

    Parameters
    ----------
    roots : (..., k) float or complex
        All roots of one polynomial, or all eigenvalues of one matrix, along the last axis.

    Returns
    -------
    (..., k) bool

    Examples
    --------
    >>> is_real(np.array([2 + 1e-9j, 2 - 1e-9j, 1j, 1e-14j])).tolist()
    [True, True, False, True]
    """
    size = np.abs(roots)
    largest = size.max(axis=-1, keepdims=True, initial=0.0, where=np.isfinite(size))
    return np.asarray(np.abs(np.imag(roots)) <= REAL * size + NEGLIGIBLE * largest)


def bracketed_roots(
    function: Callable[[Array, Index], Array],
    positive: Array,
    not_positive: Array,
    tolerance: float,
    values: tuple[Array, Array] | None = None,
) -> Array:
    """Return a root of each of P functions between points where it is positive and where not.

    Parameters
    ----------
    function : callable
        `function(x, index)` returns the values of the functions number `index` (Q,) at `x` (Q,).
    positive, not_positive : (P,) float
        Points where each function is above 0, and where it is 0 or below. Either may be larger.
    tolerance : float
        Width of the last bracket, relative to the root.
    values : ((P,) float, (P,) float), optional
        The values at both points, where they are known.

    Returns
    -------
    (P,) float
        NaN where the signs of a function at its two points are not as required.

    References
    ----------
    T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a
    nonlinear function without using derivatives, Advances in Engineering Software 28 (1997)
    145–149: inverse quadratic interpolation where three points allow it, else bisection.

    Examples
    --------
    >>> squares = np.array([2.0, 9.0])
    >>> ends = np.zeros(2), np.array([4.0, 5.0])
    >>> bracketed_roots(lambda x, i: squares[i] - x**2, *ends, 1e-12).round(9).tolist()
    [1.414213562, 3.0]
    """
    everyone = np.arange(len(positive))
    a, b = positive.copy(), not_positive.copy()
    fa, fb = values or (function(a, everyone), function(b, everyone))
    root = np.full_like(a, np.nan)
    live = np.flatnonzero((fa > 0) & (fb <= 0))
    a, b, fa, fb = a[live], b[live], fa[live], fb[live]
    share = fa / (fa - fb)
    for _ in range(_MOST_EVALUATIONS):
        if not live.size:
            break
        x = a + share * (b - a)
        f = function(x, live)
        # a is the newest point, b the end across the root, c the point before
        same = (f > 0) == (fa > 0)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, f
        best = np.where(np.abs(fa) < np.abs(fb), a, b)
        root[live] = best
        least = 0.5 * tolerance * np.abs(best) / np.abs(b - a)
        share = _next_share((a, b, c), (fa, fb, fc))
        share = np.clip(share, np.minimum(least, 0.5), np.maximum(1 - least, 0.5))
        more = (least <= 0.5) & (f != 0)
        live, share = live[more], share[more]
        a, b, fa, fb = a[more], b[more], fa[more], fb[more]
    return root


def _next_share(x: tuple[Array, Array, Array], f: tuple[Array, Array, Array]) -> Array:
    """Return which part of the way from the first point to the second is tried next."""
    a, b, c = x
    fa, fb, fc = f
    with np.errstate(divide="ignore", invalid="ignore"):
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        # Chandrupatla's criterion: the inverse parabola through the three points is monotone
        monotone = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
        inverse = fa / (fb - fa) * fc / (fb - fc)
        inverse += (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where(monotone, inverse, 0.5)
