"""The smallest destabilising load of a band of frequencies: every tongue followed to its tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .crossings import SHRINKS, Plane, first_crossings, line_summits, summits
from .edges import bracketed_roots

__all__ = ["HIGHEST_ORDER", "Tip", "lowest_load"]

Array = NDArray[np.float64]

HIGHEST_ORDER = 6  # k of θ̄ = |ω_i − ω_j|/k up to which the table's pairs are followed
_COLUMNS = 160  # frequencies of the check
_LEVELS = (0.1, 0.3, 1.0)  # loads of the check, of the smallest known so far
_SMALL = 0.04  # coupling over frequency below which a load hardly moves the tongues
_SAFETY = 30  # on the estimate of second-order growth
_BELOW = 1 - 1e-3  # of the smallest load known, where the check starts
_ROUNDS = 12  # of the check, each of which finds a smaller load
_STENCIL = np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1)], dtype=float)
_STEPS = (0.4, 0.2, 0.1, 0.05)  # of a tip's width: the stencils of its refinement
_RIDGE = 3e-3  # relative, on a load that is refined afterwards
_ZOOMS = 5
_SAME = 1e-6  # relative difference below which two places are one


@dataclass(frozen=True)
class Tip:
    """The lowest point of a tongue: its load, inf if there is none, and its frequency."""

    load: float = np.inf
    frequency: float = np.nan


def _settled(plane: Plane, frequency: Array, load: Array) -> tuple[Array, Array]:
    """Return the tips (K,) of damped tongues near some points, NaN where there is none.

    Newton's method on growth = 0 and ∂growth/∂θ̄ = 0, by differences.
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
            g = np.full((len(theta), 6), np.nan)
            g[good] = plane.excess(loads[good], points[good])
            gx, gy = (g[:, 1] - g[:, 2]) / 2, (g[:, 3] - g[:, 4]) / 2
            gxx = g[:, 1] + g[:, 2] - 2 * g[:, 0]
            gyy = g[:, 3] + g[:, 4] - 2 * g[:, 0]
            gxy = g[:, 5] - g[:, 0] - gx - gy - (gxx + gyy) / 2
            x = y = np.zeros_like(theta)
            for _ in range(3):
                x = -(gx + gxy * y) / gxx
                value = g[:, 0] + gx * x + gy * y + gxx * x**2 / 2 + gxy * x * y + gyy * y**2 / 2
                y = y - value / (gy + gxy * x + gyy * y)
            x, y = np.clip(x, -1.5 / part, 1.5 / part), np.clip(y, -1.5 / part, 1.5 / part)
            theta = np.where(gxx < 0, theta + x * hx, np.nan)
            p = p + y * hy
    return theta, _root(plane, theta, p)


def _root(plane: Plane, frequency: Array, load: Array) -> Array:
    """Return the crossing (K,) within 0.3 % of a load, NaN where there is none."""
    root = np.full_like(load, np.nan)
    good = np.flatnonzero(np.isfinite(frequency + load) & (load > 0) & (load < plane.limit))
    if good.size:
        root[good] = bracketed_roots(
            lambda p, i: plane.excess(p, frequency[good[i]]),
            np.minimum(1.003 * load[good], 0.5 * (load[good] + plane.limit)),
            0.997 * load[good],
            1e-10,
        )
    return root


def _reach(plane: Plane, frequency: Array) -> Array:
    """Return a half-width over which no two multipliers turn by much against one another."""
    whirl = np.real(plane.table.frequencies)
    turn = 2 * np.pi * (whirl.max() - whirl.min())
    return np.asarray(np.minimum(0.02 * frequency, 0.3 * frequency**2 / turn))


def _descended(plane: Plane, frequency: Array, load: Array) -> tuple[Array, Array]:
    """Return the tips of the tongues through unstable points (K,), followed down in the load."""
    rank = np.zeros(len(frequency), dtype=np.intp)

    def ridge(p: Array, guess: Array) -> tuple[Array, Array]:
        place, excess = summits(
            lambda x, i: plane.sample(p[i], x),
            guess,
            _reach(plane, guess),
            rank[: len(p)],
            -np.inf,
            SHRINKS[1:],
        )
        return np.where(np.isfinite(place), place, guess), np.nan_to_num(excess, nan=-1.0)

    start, _ = ridge(load, frequency)
    second, _ = ridge(0.9 * load, start)
    slope = (start - second) / (0.19 * load**2)

    def excess(p: Array, i: NDArray[np.intp]) -> Array:
        # the ridge is even in the load
        return ridge(p, start[i] + slope[i] * (p**2 - load[i] ** 2))[1]

    tip = bracketed_roots(excess, load, np.zeros_like(load), _RIDGE if plane.visible == 0 else 1e-7)
    ok = np.flatnonzero(np.isfinite(tip))
    theta = np.full_like(load, np.nan)
    if ok.size:
        guess = start[ok] + slope[ok] * (tip[ok] ** 2 - load[ok] ** 2)
        theta[ok], _ = ridge(tip[ok], guess)
    if plane.visible > 0 or not ok.size:
        return theta, tip
    exact, p = (np.full_like(load, np.nan) for _ in range(2))
    exact[ok], p[ok] = _settled(plane, theta[ok], tip[ok])
    return exact, p


def _zoomed(plane: Plane, ends: tuple[float, float], frequency: float, load: float) -> Tip:
    """Return the lowest crossing between two frequencies about an unstable point."""
    low, high = ends
    best = Tip()
    for _ in range(_ZOOMS):
        theta = np.unique(np.append(np.linspace(low, high, 9), frequency))
        root = bracketed_roots(
            lambda p, i, theta=theta: plane.excess(p, theta[i]),  # type: ignore[misc]
            np.full_like(theta, load),
            np.zeros_like(theta),
        )
        if np.isnan(root).all():
            break
        k = int(np.nanargmin(root))
        frequency = float(theta[k])
        best = Tip(float(root[k]), frequency)
        low, high = float(theta[max(k - 1, 0)]), float(theta[min(k + 1, len(theta) - 1)])
    return best


def _is_small(plane: Plane, low: float, load: float) -> bool:
    """Tell whether a load hardly moves the tongues: order k grows like (coupling/θ̄)^(k−1)."""
    return plane.strength * load < _SMALL * low


def _is_out_of_reach(plane: Plane, low: float, load: float) -> bool:
    """Tell whether nothing but first-order tongues can overcome the damping up to a load.

    Order k = 2 grows at about (coupling)²/θ̄; a factor of safety is applied.
    """
    coupling = plane.strength * load
    return _SAFETY * coupling**2 < low * max(plane.decay, plane.visible)


def _unstable_points(plane: Plane, band: tuple[float, float], load: float) -> Array:
    """Return frequencies (K,) of a band at which the rotor is unstable at one load.

    The most unstable of neighbouring columns; each place near a root of the table's pairs, of
    any order, where two multipliers come closest; and between columns once the load is large.
    """
    low, high = band
    columns = np.geomspace(low, high, _COLUMNS)
    excess, near = plane.sample(np.full(_COLUMNS, load), columns)
    place = np.unique([row.centre / k for row in plane.table for k in range(1, HIGHEST_ORDER + 1)])
    place = place[(place > 0.9 * low) & (place < 1.1 * high)]
    reach, rank = _reach(plane, place), np.zeros(len(place), dtype=np.intp)
    if not _is_small(plane, low, load):
        _, middle, step, which = line_summits(columns[None], near[None])
        place, reach, rank = np.r_[place, middle], np.r_[reach, step], np.r_[rank, which]
    between, height = summits(
        lambda x, i: plane.sample(np.full_like(x, load), x), place, reach, rank, plane.needed
    )
    around = np.pad(excess, 1, constant_values=-np.inf)
    peak = (excess > 0) & (excess >= around[:-2]) & (excess >= around[2:])
    points = np.concatenate([between[height > 0], columns[peak]])
    points = np.unique(points[(points >= low) & (points <= high)])
    return points[np.diff(points, prepend=0.0) > _SAME * points]


def _tips(plane: Plane, band: tuple[float, float], points: Array, load: float) -> list[Tip]:
    """Return the tips of the tongues through unstable frequencies of a band at one load."""
    low, high = band
    theta, tip = _descended(plane, points, np.full(points.shape, load))
    inside = np.isfinite(tip) & (theta >= low) & (theta <= high)
    tips = [Tip(float(p), float(f)) for f, p in zip(theta[inside], tip[inside], strict=True)]
    # the tip is not in the band, or this is no tongue at all
    step = (high / low) ** (1 / (_COLUMNS - 1))
    for point in points[~inside]:
        ends = max(low, point / step), min(high, point * step)
        tips.append(_zoomed(plane, ends, float(point), load))
    return tips


def _checked(plane: Plane, band: tuple[float, float], largest: float, best: Tip) -> Tip:
    """Return the lowest of a tip and of what is found below it, load by load."""
    clean = 0.0  # nothing is unstable up to this load
    for _ in range(_ROUNDS):
        if _is_out_of_reach(plane, band[0], best.load):
            break
        top = min(best.load * _BELOW, largest)
        parts = _LEVELS[-1:] if _is_small(plane, band[0], top) else _LEVELS
        for load in top * np.array(parts):
            if load <= clean * (1 + _SAME):
                continue
            points = _unstable_points(plane, band, load)
            if points.size:
                break
            clean = load
        else:
            break
        # where no tip can be followed, the unstable point itself is an upper bound
        tips = [*_tips(plane, band, points, load), Tip(float(load), float(points[0]))]
        best = min(tips, key=lambda tip: tip.load)
    return best


def lowest_load(plane: Plane, band: tuple[float, float], largest: float) -> Tip:
    """Return the smallest load at which a frequency of a band is unstable, and that frequency.

    Parameters
    ----------
    plane : Plane
        A stable mean rotor.
    band : tuple of float
        Lowest and highest θ̄.
    largest : float
        Largest p̄_t looked at.
    """
    low, high = band
    best = Tip()
    rows = [row for row in plane.table if 0 < row.threshold < 1.5 * largest and row.centre > 0]
    if rows:
        theta = np.array([row.centre for row in rows])
        load = np.array([row.threshold for row in rows])
        if plane.visible == 0:
            theta, load = _settled(plane, theta, load)
        inside = (theta >= low) & (theta <= high) & (load <= largest)
        tips = [Tip(float(p), float(f)) for f, p in zip(theta[inside], load[inside], strict=True)]
        best = min(tips, key=lambda tip: tip.load, default=best)
    ends = np.array(band)
    crossing = first_crossings(plane, ends, np.full(2, min(best.load, largest)))
    if crossing.min() < best.load:
        best = Tip(float(crossing.min()), float(ends[crossing.argmin()]))
    return _checked(plane, band, largest, best)
