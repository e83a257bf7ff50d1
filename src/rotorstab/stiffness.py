"""Stiffness influence coefficients of the longitudinally loaded cantilever shaft.

With x = k² = p̄/(1 − Φp̄) every exact coefficient is a ratio of four entire functions
of x, so one formula serves compression (x > 0), tension (x < 0) and no load.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import numbers

__all__ = ["exact_stiffness", "largest_exact_load", "linear_stiffness", "refuse_poles"]

Array = NDArray[np.float64]

_SERIES_BELOW = 2.0  # closed forms lose digits for smaller |x|
_ORDERS = np.arange(1, 14)
_SIGNS = (-1.0) ** (_ORDERS + 1)
# Taylor coefficients in x, lowest first
_G = _SIGNS * 2 * _ORDERS / np.array([math.factorial(2 * n + 1) for n in _ORDERS])
_D = _SIGNS * 2 * _ORDERS / np.array([math.factorial(2 * n + 2) for n in _ORDERS])
_S = _SIGNS / np.array([math.factorial(2 * n - 1) for n in _ORDERS])
_C = _SIGNS / np.array([math.factorial(2 * n) for n in _ORDERS])
_SERIES = np.column_stack([_S, _C, _G, _D])


def _matrix(k11: ArrayLike, k12: ArrayLike, k21: ArrayLike, k22: ArrayLike) -> Array:
    """Stack four coefficients of one shape into (..., 2, 2)."""
    k11, k12, k21, k22 = np.broadcast_arrays(k11, k12, k21, k22)
    matrix = np.empty((*k11.shape, 2, 2))
    matrix[..., 0, 0], matrix[..., 0, 1] = k11, k12
    matrix[..., 1, 0], matrix[..., 1, 1] = k21, k22
    return matrix


def _entire_functions(x: Array) -> tuple[Array, Array, Array, Array]:
    """Return s = sin k/k, c = (1−cos k)/x, g = (s−cos k)/x, d = (2c−s)/x with k = √x.

    All four carry one common positive factor (e^{−|k|} in tension, against overflow),
    which cancels in every stiffness coefficient.
    """
    small = np.abs(x) < _SERIES_BELOW
    near = np.where(small, x, 0.0)
    far = np.where(small, 1.0, x)
    k = np.sqrt(np.abs(far))
    decay = np.exp(-k)
    stretched = far < 0
    one = np.where(stretched, decay, 1.0)
    cosine = np.where(stretched, (1 + decay**2) / 2, np.cos(k))
    s = np.where(stretched, (1 - decay**2) / 2, np.sin(k)) / k
    c = (one - cosine) / far
    g = (s - cosine) / far
    d = (2 * c - s) / far
    # one product for the four series
    powers = np.vander(near.ravel(), len(_ORDERS), increasing=True)
    series = (powers @ _SERIES).T.reshape(4, *x.shape)
    s, c, g, d = np.where(small, series, [s, c, g, d])
    return s, c, g, d


def refuse_poles(load: ArrayLike, shear: ArrayLike) -> None:
    """Raise ValueError if a load is at or past the pole of the exact stiffness."""
    bad, limit = np.broadcast_arrays(load, largest_exact_load(shear))
    past = bad >= limit
    if past.any():
        raise ValueError(
            f"`load` must be below the pole of the exact stiffness, {limit[past].flat[0]:g} "
            f"at this shear, got {bad[past].flat[0]:g}"
        )


def largest_exact_load(shear: ArrayLike) -> Array:
    """Return the first pole of the exact coefficients, p̄ = 4π²/(1 + 4π²Φ) (k = 2π).

    There the clamped–clamped shaft buckles and the flexibility matrix is singular.

    Parameters
    ----------
    shear : (...) float
        Φ [-], in [0, 1).

    Returns
    -------
    (...) float
        Load [EI/L²].
    """
    shear = numbers("shear", shear, 0.0, 1.0, open_high=True)
    return 4 * np.pi**2 / (1 + 4 * np.pi**2 * shear)


def exact_stiffness(load: ArrayLike, shear: ArrayLike, tangency: ArrayLike = 0.0) -> Array:
    """Return the exact influence coefficients K(p̄), Eqs. (A11)–(A25).

    Parameters
    ----------
    load : (...) float
        Longitudinal load p̄ [EI/L²], compression positive, below `largest_exact_load`.
    shear : (...) float
        Φ [-], in [0, 1).
    tangency : (...) float
        μ [-] of (A3), in [0, 1]: 0 axial, 1 follower.

    Returns
    -------
    (..., 2, 2) float
        Coefficients of (tip displacement, tip slope) [EI/L³, EI/L², EI/L].

    Raises
    ------
    ValueError
        If an argument is out of range or the load is at or past the pole.

    Notes
    -----
    Signs of k₁₂, k₂₁ are −c₁₂/Δ, −c₂₁/Δ (the printed A22–A23 lack the minus).

    Examples
    --------
    >>> exact_stiffness(0.0, 0.0).round(12).tolist()
    [[12.0, -6.0], [-6.0, 4.0]]
    """
    load = numbers("load", load)
    shear = numbers("shear", shear, 0.0, 1.0, open_high=True)
    tangency = numbers("tangency", tangency, 0.0, 1.0)
    refuse_poles(load, shear)
    s, c, g, d = _entire_functions(np.asarray(load / (1 - shear * load)))
    e = d + 2 * shear * c
    k12 = -c / e
    return _matrix((1 - shear * load) * s / e, k12 + tangency * load, k12, (g + shear * s) / e)


def linear_stiffness(shear: ArrayLike, tangency: ArrayLike = 0.0) -> tuple[Array, Array]:
    """Return Ka and Kb of K(p̄) ≈ Ka + p̄ Kb, Eqs. (9), (B1)–(B9).

    Parameters
    ----------
    shear : (...) float
        Φ [-], in [0, 1).
    tangency : (...) float
        μ [-], in [0, 1].

    Returns
    -------
    Ka, Kb : (..., 2, 2) float
        Value and slope of the exact K at p̄ = 0. The shapes broadcast together.

    Raises
    ------
    ValueError
        If an argument is out of range.

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
