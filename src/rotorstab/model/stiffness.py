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
    "DIGITS",
    "NEAR_POLE",
    "PastPole",
    "exact_harmonics",
    "exact_stiffness",
    "harmonic_rate",
    "largest_exact_load",
    "linear_stiffness",
    "pole_harmonics",
    "pole_term",
    "refuse_peaks",
    "refuse_poles",
]

_POLES = 4 * np.pi**2, 4 * 4.493409457909064**2
"""The two lowest poles of the exact coefficients in x: k = 2π, and tan(k/2) = k/2."""
DIGITS = 37.0  # −ln of rounding
NEAR_POLE = 1e-3  # relative distance of the pole that charts keep: nearer, their steps have no end
_SAMPLES_TOGETHER = 1 << 15  # evaluations of K at a time, which take some 10 MB

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
    flat = x.ravel()
    functions = np.empty((4, flat.size))
    small = np.abs(flat) < _SERIES_BELOW
    if small.any():
        # one product for the four series
        powers = np.vander(flat[small], len(_ORDERS), increasing=True)
        functions[:, small] = (powers @ _SERIES).T
    if not small.all():
        functions[:, ~small] = _closed_forms(flat[~small])
    s, c, g, d = functions.reshape(4, *x.shape)
    return s, c, g, d


def _closed_forms(x: Array) -> Array:
    """Return s, c, g and d (4, n) of `_entire_functions` where |x| is not small."""
    k = np.sqrt(np.abs(x))
    one, sine, cosine = np.ones_like(k), np.sin(k), np.cos(k)
    stretched = x < 0
    if stretched.any():
        decay = np.exp(-k[stretched])
        one[stretched] = decay
        sine[stretched], cosine[stretched] = (1 - decay**2) / 2, (1 + decay**2) / 2
    s = sine / k
    c = (one - cosine) / x
    g = (s - cosine) / x
    return np.stack([s, c, g, (2 * c - s) / x])


class PastPole(ValueError):
    """A load is at or past the pole of the exact stiffness."""


def refuse_poles(load: ArrayLike, shear: ArrayLike, name: str = "`load`") -> None:
    """Raise PastPole if a load is at or past the pole of the exact stiffness."""
    bad, limit = np.broadcast_arrays(load, largest_exact_load(shear))
    past = bad >= limit
    if past.any():
        raise PastPole(
            f"{name} must be below the pole of the exact stiffness, {limit[past].flat[0]:g} "
            f"at this shear, got {bad[past].flat[0]:g}"
        )


def refuse_peaks(static: ArrayLike, pulsating: ArrayLike, shear: float) -> None:
    """Raise PastPole if the largest load of a pulsation is at or past the pole."""
    peak = np.add(static, np.abs(pulsating))
    refuse_poles(peak, shear, "`static_load` + |`pulsating_load`|")


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
    return np.asarray(_POLES[0] / (1 + _POLES[0] * shear))


def pole_term(load: Array, shear: float) -> Array:
    """Return −R/(p̄* − p̄), R = p̄*²/(2π²): the part of k₂₂ that is infinite at the pole p̄*.

    The other coefficients stay finite there.

    Parameters
    ----------
    load : (...) float
        p̄ [EI/L²].
    shear : float
        Φ [-].

    Returns
    -------
    (...) float
        [EI/L].
    """
    pole = largest_exact_load(shear)
    return np.asarray(-(pole**2) / (2 * np.pi**2) / (pole - load))


def pole_harmonics(static: Array, pulsating: Array, shear: float, count: int) -> Array:
    """Return the cosine coefficients (count + 1, ...) of `pole_term` at p̄₀ + p̄_t cos φ.

    1/(a − b cos φ) = (1 + 2 Σ zᵐ cos mφ)/√(a² − b²) with z = b/(a + √(a² − b²)).
    """
    pole = largest_exact_load(shear)
    room = pole - static
    root = np.sqrt((room - pulsating) * (room + pulsating))
    ratio = np.asarray(pulsating / (room + root))
    orders = np.arange(count + 1).reshape(-1, *[1] * ratio.ndim)
    coefficients = -(pole**2) / np.pi**2 / root * ratio**orders
    coefficients[0] /= 2
    return np.asarray(coefficients)


def harmonic_rate(static: Array, pulsating: Array, shear: float) -> float:
    """Return ln ρ, the smallest of all loads: without `pole_term` the harmonics fall like ρ^−m.

    The second pole of the exact coefficients sets ρ.
    """
    peak, size = static + np.abs(pulsating), np.abs(pulsating)
    room = _POLES[1] / (1 + _POLES[1] * shear) - np.asarray(peak)
    ratio = float(np.min(room / np.maximum(size, 1e-9 * room), initial=np.inf))
    return math.log1p(ratio + math.sqrt(ratio * (ratio + 2)))


def exact_harmonics(
    static: Array, pulsating: Array, shear: float, tangency: float, count: int
) -> Array:
    """Return K₀ … K_count of the exact K(p̄₀ + p̄_t cos φ) without `pole_term`.

    Parameters
    ----------
    static, pulsating : (...) float
        p̄₀ and p̄_t [EI/L²], of one shape, their peak below the pole.
    shear, tangency : float
        Φ and μ [-].
    count : int
        Highest harmonic.

    Returns
    -------
    (count + 1, ..., 2, 2) float
        Chebyshev coefficients by a cosine sum, to rounding.
    """
    # the aliasing error falls as ρ^(count − 2 points)
    rate = harmonic_rate(static, pulsating, shear)
    points = math.ceil((count + DIGITS / rate) / 2) + 1
    phase = (np.arange(points) + 0.5) * np.pi / points
    weights = np.cos(np.outer(np.arange(count + 1), phase)) * 2 / points
    weights[0] /= 2
    mean, swing = static.ravel(), pulsating.ravel()
    harmonics = np.empty((count + 1, mean.size, 4))
    batch = max(1, _SAMPLES_TOGETHER // points)
    for start in range(0, mean.size, batch):
        part = slice(start, start + batch)
        load = mean[part] + np.outer(np.cos(phase), swing[part])
        samples = exact_stiffness(load, shear, tangency)
        samples[..., 1, 1] -= pole_term(load, shear)
        harmonics[:, part] = (weights @ samples.reshape(points, -1)).reshape(count + 1, -1, 4)
    return harmonics.reshape(count + 1, *static.shape, 2, 2)


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
