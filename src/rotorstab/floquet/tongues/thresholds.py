"""Thresholds of tongues: the lowest load of each, and the frequency at which it lies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._numerics.roots import bracketed_roots
from ..._tolerances import EDGE
from ..._types import Array, Index
from .approaches import SHRINKS, closest_approaches
from .plane import Plane

__all__ = [
    "Threshold",
    "descended_thresholds",
    "pair_reach",
    "refined_thresholds",
    "zoomed_threshold",
]

# the six points of a quadratic in (θ̄, p̄_t)
_STENCIL = np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1)], dtype=float)
_STEPS = (0.4, 0.2, 0.1, 0.05)  # of a tongue's width: the stencils of the refinement
_NEAR = 3e-3  # relative distance from a refined load within which its crossing is sought
_ROOT = 1e-10  # relative width of the last bracket of that crossing
# Relative width of the last bracket of a tongue's lowest load: coarse where `refined_thresholds`
# finds the load by quadratics afterwards, fine where it does not.
_RIDGE_TOLERANCE = 3e-3
_FINAL_RIDGE_TOLERANCE = 1e-7
_ZOOMS = 5


class Threshold(NamedTuple):
    """The lowest point of a tongue: its load p̄_t, inf if there is none, and its frequency θ̄."""

    load: float = np.inf
    frequency: float = np.nan


class _Quadratic(NamedTuple):
    """The growth as a quadratic in steps x of θ̄ and y of p̄_t, (K,) coefficients each."""

    g: Array
    gx: Array
    gy: Array
    gxx: Array
    gyy: Array
    gxy: Array

    @classmethod
    def through(cls, g: Array) -> _Quadratic:
        """Return the quadratics through values (K, 6) at the points of `_STENCIL`."""
        gx, gy = (g[:, 1] - g[:, 2]) / 2, (g[:, 3] - g[:, 4]) / 2
        gxx = g[:, 1] + g[:, 2] - 2 * g[:, 0]
        gyy = g[:, 3] + g[:, 4] - 2 * g[:, 0]
        gxy = g[:, 5] - g[:, 0] - gx - gy - (gxx + gyy) / 2
        return cls(g[:, 0], gx, gy, gxx, gyy, gxy)

    def lowest_zero(self) -> tuple[Array, Array]:
        """Return x and y where the value and ∂/∂x are 0, by Newton's method."""
        g, gx, gy, gxx, gyy, gxy = self
        x = y = np.zeros_like(g)
        for _ in range(3):
            x = -(gx + gxy * y) / gxx
            value = g + gx * x + gy * y + gxx * x**2 / 2 + gxy * x * y + gyy * y**2 / 2
            y = y - value / (gy + gxy * x + gyy * y)
        return x, y


def refined_thresholds(plane: Plane, frequency: Array, load: Array) -> tuple[Array, Array]:
    """Return frequencies and loads (K,) of the thresholds of damped tongues near some points.

    There the excess and ∂growth/∂θ̄ are 0. NaN where there is no threshold.
    """
    theta, p = np.where(load < plane.limit, frequency, np.nan), load.copy()
    near = plane.sample(np.minimum(p, 0.99 * plane.limit), frequency)[1]
    width = np.sqrt(np.maximum(near[..., 0], plane.decay**2))
    with np.errstate(divide="ignore", invalid="ignore"):
        for part in _STEPS:
            hx, hy = part * width, 0.2 * part * p
            points = theta[:, None] + hx[:, None] * _STENCIL[:, 0]
            loads = p[:, None] + hy[:, None] * _STENCIL[:, 1]
            valid = (points > 0) & (loads > 0) & (loads < plane.limit)
            good = np.isfinite(theta) & valid.all(axis=1)
            growth = np.full((len(theta), len(_STENCIL)), np.nan)
            growth[good] = plane.excess(loads[good], points[good])
            quadratic = _Quadratic.through(growth)
            x, y = (np.clip(z, -1.5 / part, 1.5 / part) for z in quadratic.lowest_zero())
            theta = np.where(quadratic.gxx < 0, theta + x * hx, np.nan)
            p = p + y * hy
    return theta, _root(plane, theta, p)


def _root(plane: Plane, frequency: Array, load: Array) -> Array:
    """Return the crossing (K,) near a load, NaN where there is none."""
    root = np.full_like(load, np.nan)
    good = np.flatnonzero(np.isfinite(frequency + load) & (load > 0) & (load < plane.limit))
    if good.size:
        root[good] = bracketed_roots(
            lambda p, i: plane.excess(p, frequency[good[i]]),
            np.minimum((1 + _NEAR) * load[good], 0.5 * (load[good] + plane.limit)),
            (1 - _NEAR) * load[good],
            _ROOT,
        )
    return root


def pair_reach(plane: Plane, frequency: Array) -> Array:
    """Return half-widths of θ̄ over which no two multipliers turn much against each other."""
    whirl = np.real(plane.table.frequencies)
    turn = 2 * np.pi * (whirl.max() - whirl.min())
    return np.asarray(np.minimum(0.02 * frequency, 0.3 * frequency**2 / turn))


class _Ridges(NamedTuple):
    """Lines along which the pair of a tongue is closest, one through each of K points.

    Parameters
    ----------
    plane : Plane
    load, frequency, slope : (K,) float
        p̄_t and θ̄ of the points, and dθ̄/d(p̄_t²): the lines are even in the load.
    """

    plane: Plane
    load: Array
    frequency: Array
    slope: Array

    @classmethod
    def through(cls, plane: Plane, frequency: Array, load: Array) -> _Ridges:
        """Return the lines near some points; a second point of each tells its slope."""
        start, _ = _climbed(plane, load, frequency)
        second, _ = _climbed(plane, 0.9 * load, start)
        return cls(plane, load, start, (start - second) / (0.19 * load**2))

    def at(self, load: Array, index: Index) -> tuple[Array, Array]:
        """Return θ̄ and excess of some lines at given loads."""
        rise = self.slope[index] * (load**2 - self.load[index] ** 2)
        return _climbed(self.plane, load, self.frequency[index] + rise)


def _climbed(plane: Plane, load: Array, guess: Array) -> tuple[Array, Array]:
    """Return θ̄ near a guess at which the closest pair is closest, and the excess there."""
    place, excess = closest_approaches(
        lambda x, i: plane.sample(load[i], x),
        guess,
        pair_reach(plane, guess),
        np.zeros(len(guess), dtype=np.intp),
        -np.inf,
        SHRINKS[1:],
    )
    return np.where(np.isfinite(place), place, guess), np.nan_to_num(excess, nan=-1.0)


def descended_thresholds(plane: Plane, frequency: Array, load: Array) -> tuple[Array, Array]:
    """Return frequencies and loads (K,) of the thresholds of the tongues through unstable points.

    Each tongue is followed downward in the load. NaN where that fails.
    """
    ridges = _Ridges.through(plane, frequency, load)
    lowest = bracketed_roots(
        lambda p, i: ridges.at(p, i)[1],
        load,
        np.zeros_like(load),
        _RIDGE_TOLERANCE if plane.decays else _FINAL_RIDGE_TOLERANCE,
    )
    found = np.flatnonzero(np.isfinite(lowest))
    theta = np.full_like(load, np.nan)
    if found.size:
        theta[found], _ = ridges.at(lowest[found], found)
    if not plane.decays or not found.size:
        return theta, lowest
    exact, p = (np.full_like(load, np.nan) for _ in range(2))
    exact[found], p[found] = refined_thresholds(plane, theta[found], lowest[found])
    return exact, p


def zoomed_threshold(
    plane: Plane, ends: tuple[float, float], frequency: float, load: float
) -> Threshold:
    """Return the lowest crossing between two frequencies on either side of an unstable point."""
    low, high = ends
    best = Threshold()
    for _ in range(_ZOOMS):
        theta = np.unique(np.append(np.linspace(low, high, 9), frequency))
        root = bracketed_roots(
            lambda p, i, theta=theta: plane.excess(p, theta[i]),  # type: ignore[misc]
            np.full_like(theta, load),
            np.zeros_like(theta),
            EDGE,
        )
        if np.isnan(root).all():
            break
        k = int(np.nanargmin(root))
        frequency = float(theta[k])
        best = Threshold(float(root[k]), frequency)
        low, high = float(theta[max(k - 1, 0)]), float(theta[min(k + 1, len(theta) - 1)])
    return best
