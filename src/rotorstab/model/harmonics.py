"""Harmonics of the exact stiffness under a pulsating load, K(p̄₀ + p̄_t cos φ) = Σ K_m cos mφ.

The coefficient k₂₂ is infinite at the pole p̄* of the exact stiffness. Its harmonics are those of
`pole_term`, which have a closed form, plus those of the finite rest, which fall off fast.
"""

from __future__ import annotations

import math

import numpy as np

from .._numerics.chebyshev import chebyshev_angles, coefficient_weights
from .._types import Array
from .stiffness import exact_stiffness, largest_exact_load, second_exact_pole

__all__ = ["DIGITS", "exact_harmonics", "harmonic_rate", "pole_harmonics", "pole_term"]

DIGITS = 37.0
"""−ln of the rounding error, 1e-16: what is smaller than exp(−DIGITS) of a sum does not show."""

_SAMPLES_TOGETHER = 1 << 15  # evaluations of K at a time, which take some 10 MB


def exact_harmonics(
    static: Array, pulsating: Array, shear: float, tangency: float, count: int
) -> Array:
    """Return K₀ … K_count of the exact K(p̄₀ + p̄_t cos φ) without `pole_term`.

    Parameters
    ----------
    static, pulsating : (...) float
        p̄₀ and p̄_t [EI/L²], of one shape; their peak is below the pole.
    shear, tangency : float
        Φ and μ [-].
    count : int
        Highest harmonic.

    Returns
    -------
    (count + 1, ..., 2, 2) float
        Chebyshev coefficients of K over the load, by a cosine sum, right to rounding.
    """
    # the aliasing error falls as ρ^(count − 2 points)
    rate = harmonic_rate(static, pulsating, shear)
    points = math.ceil((count + DIGITS / rate) / 2) + 1
    phase = chebyshev_angles(points)
    weights = coefficient_weights(count + 1, points)
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


def harmonic_rate(static: Array, pulsating: Array, shear: float) -> float:
    """Return ln ρ, the smallest of all loads: without `pole_term` harmonic m falls as ρ^−m.

    The second pole of the exact stiffness sets ρ.
    """
    peak, size = static + np.abs(pulsating), np.abs(pulsating)
    room = second_exact_pole(shear) - np.asarray(peak)
    ratio = float(np.min(room / np.maximum(size, 1e-9 * room), initial=np.inf))
    return math.log1p(ratio + math.sqrt(ratio * (ratio + 2)))


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
