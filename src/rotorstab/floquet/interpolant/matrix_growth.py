"""Growth of the multipliers from monodromy matrices of any size, and bounds on its error."""

from __future__ import annotations

import numpy as np

from ..._numerics.root_bounds import root_distance
from ..._types import AnyArray, Array, Complex, Mask
from .growth import Measure

__all__ = ["matrix_growth", "reversed_growth"]

_STRONG = 1e-6  # |1 + t²| below which growth is so strong that the monodromy itself is better
_ROUNDING = 1e-15  # error of a matrix's entries, relative to the largest, in its eigenvalues


def matrix_growth(
    monodromy: Complex, error: Array, measure: Measure | None = None
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of monodromies by their eigenvalues, and a bound on its error.

    Parameters
    ----------
    monodromy : (..., m, m) complex
    error : (..., m, m) float
        Bounds on the errors of the entries.
    measure : callable, optional
        A function of the multipliers (m, ...).

    Returns
    -------
    growth, uncertainty : (...) float
        The error of an eigenvalue is |w| δM |v| / |w v|, with its eigenvectors w, v. NaN where an
        entry is not finite.
    measured : (...) float
        What `measure` returns; NaN without it.
    """
    good, monodromy, error = _finite(monodromy, error)
    values, right = np.linalg.eig(monodromy)
    slack = _first_order(_inverse(right), error + _rounding(monodromy), right)
    size, gap = np.abs(values), _gaps(values).min(axis=-1)
    shift = root_distance(slack * gap, gap, 1.0)
    # any eigenvalue may be the largest
    high, low, top = (x.max(axis=-1) for x in (size + shift, size - shift, size))
    with np.errstate(divide="ignore"):
        uncertainty = np.log(np.maximum(high / top, top / np.maximum(low, 0)))
    found = np.log(top), uncertainty, _measured(values, measure)
    return tuple(np.where(good, part, np.nan) for part in found)  # type: ignore[return-value]


def reversed_growth(
    half: Complex, error: Array, measure: Measure | None = None
) -> tuple[Array, Array, Array]:
    """Return ln max|μ| of conj(Y)⁻¹Y by a real eigenproblem, and a bound on its error.

    With Y = R + jS and Sx = tRx the multipliers are μ = (1 + jt)/(1 − jt), which lie on the unit
    circle where t is real.

    Parameters
    ----------
    half : (..., m, m) complex
        Y over half a period, where Y(−t) = conj Y(t).
    error : (..., m, m) float
        Bounds on the errors of the entries.
    measure : callable, optional
        A function of the multipliers (m, ...).

    Returns
    -------
    growth, uncertainty : (...) float
        Both exactly 0 where no two multipliers may meet. NaN where an entry is not finite.
    measured : (...) float
        What `measure` returns; NaN without it.
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
    shift = root_distance(slack * gap, gap, 1.0)
    # a multiplier on the circle leaves it only to meet another one
    meets = (gaps < slack[..., None] + slack[..., None, :]).any(axis=-1) | (t.imag != 0)
    growth = log.max(axis=-1)
    high = np.where(meets, log + shift, 0.0).max(axis=-1)
    low = np.maximum((log - shift).max(axis=-1), 0.0)
    uncertainty = np.maximum(high - growth, growth - low)
    measured = _measured(mu, measure)
    # growth so strong that 1 − jt is a difference of nearly equal numbers
    strong = np.flatnonzero(good.ravel() & (rate.min(axis=-1).ravel() < _STRONG))
    if strong.size:
        size = half.shape[-2:]
        y, doubt = half.reshape(-1, *size)[strong], error.reshape(-1, *size)[strong]
        solver = _inverse(y.conj())
        monodromy = solver @ y
        doubt = np.abs(solver) @ (doubt + doubt @ np.abs(monodromy))
        again = matrix_growth(monodromy, doubt, measure)
        growth.flat[strong], uncertainty.flat[strong], measured.flat[strong] = again
    found = growth, uncertainty, measured
    return tuple(np.where(good, part, np.nan) for part in found)  # type: ignore[return-value]


def _measured(values: Complex, measure: Measure | None) -> Array:
    """Return a function of multipliers (..., m), NaN without one."""
    if measure is None:
        return np.full(values.shape[:-1], np.nan)
    return measure(np.moveaxis(values, -1, 0))


def _finite(matrix: Complex, error: Array) -> tuple[Mask, Complex, Array]:
    """Return where all entries are finite, and both arrays with the other matrices replaced."""
    good = np.asarray(np.isfinite(matrix).all((-2, -1)) & np.isfinite(error).all((-2, -1)))
    if good.all():
        return good, matrix, error
    keep = good[..., None, None]
    return good, np.where(keep, matrix, np.eye(matrix.shape[-1])), np.where(keep, error, 0.0)


def _inverse(matrix: AnyArray) -> AnyArray:
    """Return inverses; pseudo-inverses if any of the matrices is singular."""
    try:
        return np.asarray(np.linalg.inv(matrix))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrix))


def _rounding(matrix: AnyArray) -> Array:
    """Return what rounding adds to each entry's error in an eigenproblem."""
    size = np.abs(matrix).max(axis=(-2, -1), keepdims=True)
    return np.broadcast_to(_ROUNDING * matrix.shape[-1] * size, matrix.shape)


def _first_order(left: AnyArray, error: Array, right: AnyArray) -> Array:
    """Return |w| E |v| of each pair of left and right eigenvectors, (..., m)."""
    product = np.abs(left) @ error
    return np.asarray((product * np.swapaxes(np.abs(right), -1, -2)).sum(axis=-1))


def _gaps(values: Complex) -> Array:
    """Return the distances between eigenvalues, (..., m, m), with inf on the diagonal."""
    gaps = np.abs(values[..., :, None] - values[..., None, :])
    index = np.arange(values.shape[-1])
    gaps[..., index, index] = np.inf
    return np.asarray(gaps)
