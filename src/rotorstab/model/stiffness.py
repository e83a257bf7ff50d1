"""Stiffness influence coefficients of the longitudinally loaded cantilever shaft.

With x = k² = p̄/(1 − Φp̄) every exact coefficient is a ratio of four entire functions
of x, so one formula serves compression (x > 0), tension (x < 0) and no load.
"""

from __future__ import annotations

import math

import numpy as np

from .._arguments import numbers
from .._types import Array, ArrayLike

__all__ = [
    "PastPole",
    "exact_stiffness",
    "largest_exact_load",
    "linear_stiffness",
    "refuse_poles",
    "second_exact_pole",
]

_FIRST_POLE = 4 * np.pi**2
"""Lowest pole of the exact coefficients in x: k = 2π."""

_SECOND_POLE = 4 * 4.493409457909064**2
"""Second pole of the exact coefficients in x: k/2 is the first positive root of tan(k/2) = k/2."""

_SERIES_BELOW = 2.0  # |x| below which the closed forms lose digits and the series are used
_ORDERS = np.arange(1, 14)  # 13 terms: the next is below rounding for |x| < 2
_SIGNS = (-1.0) ** (_ORDERS + 1)
# Taylor coefficients in x of s, c, g and d, lowest first
_S = _SIGNS / np.array([math.factorial(2 * n - 1) for n in _ORDERS])
_C = _SIGNS / np.array([math.factorial(2 * n) for n in _ORDERS])
_G = _SIGNS * 2 * _ORDERS / np.array([math.factorial(2 * n + 1) for n in _ORDERS])
_D = _SIGNS * 2 * _ORDERS / np.array([math.factorial(2 * n + 2) for n in _ORDERS])
_SERIES = np.column_stack([_S, _C, _G, _D])


def exact_stiffness(load: ArrayLike, shear: ArrayLike, tangency: ArrayLike = 0.0) -> Array:
    """Return the exact influence coefficients K(p̄), Eqs. (A11)–(A25).

    The arguments broadcast together.

    Parameters
    ----------
    load : (...) float
        Longitudinal load p̄ [EI/L²], compression positive, below `largest_exact_load`.
    shear : (...) float
        Shear parameter Φ [-], in [0, 1).
    tangency : (...) float
        μ [-] of (A3), in [0, 1]: 0 axial, 1 follower.

    Returns
    -------
    (..., 2, 2) float
        Coefficients of (tip displacement, tip slope): k₁₁ [EI/L³], k₁₂ and k₂₁ [EI/L²], k₂₂
        [EI/L].

    Raises
    ------
    ValueError
        If an argument is out of range.
    PastPole
        If a load is at or past `largest_exact_load`; this is a ValueError too.

    Notes
    -----
    The printed Eqs. (A22) and (A23) lack a minus sign: k₁₂ = −c₁₂/Δ and k₂₁ = −c₂₁/Δ.

    References
    ----------
    Appendix A of the source paper.

    Examples
    --------
    >>> exact_stiffness(0.0, 0.0).round(12).tolist()
    [[12.0, -6.0], [-6.0, 4.0]]
    """
    load = numbers("load", load)
    shear = numbers("shear", shear, 0.0, 1.0, open_high=True)
    tangency = numbers("tangency", tangency, 0.0, 1.0)
    refuse_poles(load, largest_exact_load(shear))
    s, c, g, d = _entire_functions(np.asarray(load / (1 - shear * load)))
    e = d + 2 * shear * c
    k12 = -c / e
    # Eqs. (A21)–(A25); the load's tangency adds μp̄ to k₁₂
    return _matrix((1 - shear * load) * s / e, k12 + tangency * load, k12, (g + shear * s) / e)


def linear_stiffness(shear: ArrayLike, tangency: ArrayLike = 0.0) -> tuple[Array, Array]:
    """Return Ka and Kb of K(p̄) ≈ Ka + p̄ Kb, Eqs. (9), (B1)–(B9).

    Parameters
    ----------
    shear : (...) float
        Shear parameter Φ [-], in [0, 1).
    tangency : (...) float
        μ [-], in [0, 1]: 0 axial, 1 follower.

    Returns
    -------
    Ka, Kb : (..., 2, 2) float
        Value and slope of the exact K at p̄ = 0, for (tip displacement, tip slope): Ka in the
        units of `exact_stiffness`, Kb₁₁ [1/L], Kb₁₂ and Kb₂₁ [-], Kb₂₂ [L]. The shapes of the
        arguments broadcast together.

    Raises
    ------
    ValueError
        If an argument is out of range.

    References
    ----------
    Appendix B of the source paper.

    Examples
    --------
    >>> Ka, Kb = linear_stiffness(0.0, tangency=1.0)
    >>> float(Kb[0, 1])
    1.1
    """
    shear = numbers("shear", shear, 0.0, 1.0, open_high=True)
    tangency = numbers("tangency", tangency, 0.0, 1.0)
    shear, tangency = np.broadcast_arrays(shear, tangency)
    d = 1 + 12 * shear
    # Eqs. (B1), (B3), (B5), (B7)
    elastic = _matrix(12 / d, -6 / d, -6 / d, 4 * (1 + 3 * shear) / d)
    # Eqs. (B2), (B4), (B6), (B8); the follower term gives (B9)
    b12 = 0.1 / d**2
    geometric = _matrix(
        -1.2 * (1 + 20 * shear + 120 * shear**2) / d**2,
        b12 + tangency,
        b12,
        -2 / 15 * (1 + 15 * shear + 90 * shear**2) / d**2,
    )
    return elastic, geometric


def largest_exact_load(shear: ArrayLike) -> Array:
    """Return the first pole of the exact coefficients, p̄ = 4π²/(1 + 4π²Φ) (k = 2π).

    There a shaft that is clamped at both ends buckles, and the flexibility matrix is singular.

    Parameters
    ----------
    shear : (...) float
        Φ [-], in [0, 1).

    Returns
    -------
    (...) float
        Load [EI/L²].

    Raises
    ------
    ValueError
        If Φ is out of range.

    References
    ----------
    Appendix A of the source paper.

    Examples
    --------
    >>> float(largest_exact_load(0.0192).round(6))
    22.456621
    """
    shear = numbers("shear", shear, 0.0, 1.0, open_high=True)
    return np.asarray(_FIRST_POLE / (1 + _FIRST_POLE * shear))


def second_exact_pole(shear: float) -> float:
    """Return the second pole of the exact coefficients [EI/L²] at one Φ."""
    return _SECOND_POLE / (1 + _SECOND_POLE * shear)


class PastPole(ValueError):
    """A load is at or past the pole of the stiffness law, such as `largest_exact_load`."""


def refuse_poles(
    load: ArrayLike, pole: ArrayLike, name: str = "`load`", law: str = "exact"
) -> None:
    """Raise PastPole if a load is at or past the pole of a stiffness law."""
    bad, limit = np.broadcast_arrays(load, pole)
    past = bad >= limit
    if past.any():
        raise PastPole(
            f"{name} must be below the pole of the {law} stiffness, {limit[past].flat[0]:g} "
            f"at this shear, got {bad[past].flat[0]:g}"
        )


def _entire_functions(x: Array) -> tuple[Array, Array, Array, Array]:
    """Return s = sin k/k, c = (1−cos k)/x, g = (s−cos k)/x, d = (2c−s)/x with k = √x.

    All four carry one common positive factor (e^{−|k|} in tension, against overflow),
    which cancels in every stiffness coefficient.
    """
    flat = x.ravel()
    functions = np.empty((4, flat.size))
    small = np.abs(flat) < _SERIES_BELOW
    if small.any():
        # one matrix product gives all four series
        powers = np.vander(flat[small], len(_ORDERS), increasing=True)
        functions[:, small] = (powers @ _SERIES).T
    if not small.all():
        functions[:, ~small] = _closed_forms(flat[~small])
    s, c, g, d = functions.reshape(4, *x.shape)
    return s, c, g, d


def _closed_forms(x: Array) -> Array:
    """Return s, c, g and d (4, n) of `_entire_functions` where |x| is not small."""
    k = np.sqrt(np.abs(x))
    unit, sine, cosine = np.ones_like(k), np.sin(k), np.cos(k)
    tension = x < 0
    if tension.any():
        decay = np.exp(-k[tension])
        unit[tension] = decay
        sine[tension], cosine[tension] = (1 - decay**2) / 2, (1 + decay**2) / 2
    s = sine / k
    c = (unit - cosine) / x
    g = (s - cosine) / x
    return np.stack([s, c, g, (2 * c - s) / x])


def _matrix(k11: ArrayLike, k12: ArrayLike, k21: ArrayLike, k22: ArrayLike) -> Array:
    """Stack four coefficients whose shapes broadcast together into (..., 2, 2)."""
    k11, k12, k21, k22 = np.broadcast_arrays(k11, k12, k21, k22)
    matrix = np.empty((*k11.shape, 2, 2))
    matrix[..., 0, 0], matrix[..., 0, 1] = k11, k12
    matrix[..., 1, 0], matrix[..., 1, 1] = k21, k22
    return matrix
