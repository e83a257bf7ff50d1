"""Where a rotor becomes unstable along lines of the load–frequency plane, thin tongues included."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ...model.stiffness import largest_exact_load
from ...model.system import System
from ..point import floquet_solution
from ..resonance import ResonanceTable
from .edges import bracketed_roots

__all__ = ["SHRINKS", "Plane", "first_crossings", "line_summits", "summits"]

Array = NDArray[np.float64]
Index = NDArray[np.intp]

VISIBLE = 1e-6  # growth that counts where the mean rotor neither grows nor decays
_ROWS = (10, 20, 40, 80)  # loads scanned at one frequency: the fewest that are close enough
_TURN = 0.15  # by which two multipliers may turn between them [rad]
_RANKS = 3  # pairs of multipliers looked at in one place, the closest first
SHRINKS = (0.5, 0.1, 0.02, 0.004)  # half-widths of the parabolas, in steps of the scan
_INSIDE = 1.02  # times a first-order threshold
_PASSED = 0.5  # part of a detuning: a forecast below means that its sign has changed
_SLACK = 0.2  # of a parabola's fall over its half-width: how far its summit may be too low


@dataclass(frozen=True)
class Plane:
    """The plane of pulsating load and excitation frequency of one system under one mean load.

    Parameters
    ----------
    system : System
        One spin speed.
    static : float
        p̄₀ [EI/L²].
    table : ResonanceTable
        Of the same system and mean load.
    """

    system: System
    static: float
    table: ResonanceTable

    @property
    def decay(self) -> float:
        """Slowest decay rate of the mean system, 0 undamped."""
        return max(-self.table.mean_growth, 0.0)

    @property
    def strength(self) -> float:
        """Largest √|g| of the table: the rate per unit load at which the load couples modes."""
        return float(max(abs(row.coupling) for row in self.table) ** 0.5)

    @property
    def limit(self) -> float:
        """Pulsating load at which the exact stiffness has its pole, inf for the linear law."""
        shear = self.system.exact_shear
        return np.inf if shear is None else float(largest_exact_load(shear)) - self.static

    @property
    def needed(self) -> float:
        """Closeness, second of `sample`, that a pair must exceed in order to grow."""
        return self.visible**2 + self.decay**2 / 2

    @property
    def visible(self) -> float:
        """Growth above which a point counts as unstable: 0 unless the mean rotor is neutral."""
        return VISIBLE if self.decay < VISIBLE else 0.0

    def sample(self, load: Array, frequency: Array) -> tuple[Array, Array]:
        """Return what is above 0 at unstable points (...), and how close pairs are (..., R).

        The first is the growth rate less `visible`; undamped, where growth starts like a square
        root, its square. The second is Re ((ln μ_i − ln μ_j)/2T)² of the closest pairs, closest
        first: −(half the detuning)² outside a tongue, (growth)² of an undamped one inside.
        """
        solution = floquet_solution(self.system, self.static, load, frequency)
        rate = frequency / (2 * np.pi)
        logs = np.log(solution.multipliers)
        pairs = []
        for i, j in combinations(range(logs.shape[-1]), 2):
            gap = logs[..., i] - logs[..., j]
            turn = gap.imag - 2 * np.pi * np.round(gap.imag / (2 * np.pi))
            pairs.append((gap.real**2 - turn**2) / 4 * rate**2)
        near = -np.sort(-np.stack(pairs, axis=-1), axis=-1)[..., :_RANKS]
        if self.system.is_damped:
            return solution.growth_rate - self.visible, near
        return near[..., 0] - self.visible**2, near

    def excess(self, load: Array, frequency: Array) -> Array:
        """Return the first of `sample`."""
        return self.sample(load, frequency)[0]


def _vertex(x: Array, y: Array) -> tuple[Array, Array, Array]:
    """Return place, height and curvature of parabolas through three points (..., 3)."""
    left, right = x[..., 0] - x[..., 1], x[..., 2] - x[..., 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        down, up = (y[..., 0] - y[..., 1]) / left, (y[..., 2] - y[..., 1]) / right
        bend = (up - down) / (right - left)
        slope = down - bend * left
        shift = np.where(bend < 0, -slope / (2 * bend), np.nan)
        return x[..., 1] + shift, y[..., 1] + slope * shift / 2, bend


def summits(
    measure: Callable[[Array, Index], tuple[Array, Array]],
    place: Array,
    reach: Array,
    rank: Index,
    needed: float,
    shrinks: tuple[float, ...] = SHRINKS,
) -> tuple[Array, Array]:
    """Return where pairs of multipliers come closest near some places, and the excess there.

    Parameters
    ----------
    measure : callable
        `Plane.sample` along the lines, of coordinates and the places' indices.
    place, reach : (K,) float
        Coordinate along each line, half the interval looked at.
    rank : (K,) int
        Which of the closest pairs.
    needed : float
        Least closeness at which a pair can grow: others are given up early.
    shrinks : tuple of float
        Half-widths of the parabolas, in half intervals.

    Returns
    -------
    place, excess : (K,) float
        NaN where given up.
    """
    low, high = place - reach, place + reach
    centre, measured, excess = place.copy(), place.copy(), np.full_like(place, np.nan)
    live = np.arange(len(place))
    for shrink in shrinks:
        if not live.size:
            break
        step = shrink * reach[live]
        points = centre[live][:, None] + step[:, None] * np.array([-1.0, 0.0, 1.0])
        who = np.repeat(live, 3)
        value, near = measure(points.ravel(), who)
        measured[live], excess[live] = points[:, 1], value[1::3]
        height = near[np.arange(len(who)), rank[who]].reshape(-1, 3)
        top_at, top, bend = _vertex(points, height)
        uphill = points[:, 1] + np.sign(height[:, 2] - height[:, 0]) * step
        moved = np.where(np.isfinite(top_at), top_at, uphill)
        moved = np.clip(moved, points[:, 0] - step, points[:, 2] + step)
        centre[live] = np.clip(moved, low[live], high[live])
        hopeless = (bend < 0) & (top + _SLACK * np.abs(bend) * step**2 < needed)
        centre[live[hopeless]] = excess[live[hopeless]] = np.nan
        live = live[~hopeless]
    if live.size:
        # the last move counts where it led higher, so that place and excess belong together
        value, _ = measure(centre[live], live)
        centre[live] = np.where(value > excess[live], centre[live], measured[live])
        excess[live] = np.maximum(value, excess[live])
    return centre, excess


def line_summits(x: Array, near: Array) -> tuple[Index, Array, Array, Index]:
    """Return where pairs may come closest along lines: line, place, reach and rank.

    These are the local maxima of the closeness, and the intervals in which a pair seems to come
    and go unseen: its detuning, nearly linear, would change sign there by the slope before.

    Parameters
    ----------
    x : (L, N) float
        Rising coordinates.
    near : (L, N, R) float
    """
    rise = np.diff(near, axis=1)
    top = np.ones(near.shape, dtype=bool)
    top[:, 1:] &= rise >= 0
    top[:, :-1] &= rise <= 0
    line, at, rank = np.nonzero(top)
    # at an end the summit may lie within the last interval
    triple = np.clip(at, 1, x.shape[1] - 2)[:, None] + np.array([-1, 0, 1])
    places, heights = x[line[:, None], triple], near[line[:, None], triple, rank[:, None]]
    place, _, _ = _vertex(places, heights)
    keep = (place >= places[:, 0]) & (place <= places[:, 2])
    reach = (places[:, 2] - places[:, 0]) / 2

    step = np.diff(x, axis=1)[..., None]
    detuning = np.sqrt(np.maximum(-near, 0))
    middle, change = detuning[:, 1:-1], np.diff(detuning, axis=1)
    passed = np.zeros(rise.shape, dtype=bool)
    # products with the steps, some of which may be 0
    later, earlier = step[:, 1:], step[:, :-1]
    passed[:, 1:] = earlier * (_PASSED * detuning[:, 2:] - middle) > later * change[:, :-1]
    passed[:, :-1] |= later * (_PASSED * detuning[:, :-2] - middle) > -earlier * change[:, 1:]
    passed &= ~(top[:, 1:] | top[:, :-1]) & (detuning[:, 1:] + detuning[:, :-1] > 0)
    there, first, which = np.nonzero(passed)
    before, after = detuning[there, first, which], detuning[there, first + 1, which]
    # inside a tongue the pair at that end is another one
    part = np.where((before > 0) & (after > 0), before / (before + after), 0.5)
    width = step[there, first, 0]
    return (
        np.r_[line[keep], there],
        np.r_[place[keep], x[there, first] + part * width],
        np.r_[reach[keep], width / 2],
        np.r_[rank[keep], which],
    )


def _loads(plane: Plane, frequency: Array, largest: Array, count: int) -> Array:
    """Return the loads (C, N) looked at: even rows, and the first-order crossings of the table."""
    even = largest[:, None] * np.arange(count + 1) / count
    special = [
        # just above the threshold, inside the tongue
        _INSIDE * np.hypot(row.threshold, (frequency - row.centre) / (2 * row.growth_per_load))
        for row in plane.table
        if row.growth_per_load > 0
    ]
    if not special:
        return even
    crossings = np.stack(special, axis=1)
    # what lies beyond the largest load gives way to rows between the even ones
    between = largest[:, None] * (np.arange(len(special)) + 0.5) / max(count, len(special))
    crossings = np.where(crossings < largest[:, None], crossings, between)
    return np.sort(np.concatenate([even, crossings], axis=1), axis=1)


def first_crossings(plane: Plane, frequency: Array, largest: Array) -> Array:
    """Return the smallest load at which each frequency becomes unstable, inf if none.

    Parameters
    ----------
    plane : Plane
    frequency : (C,) float
        θ̄.
    largest : (C,) float
        Largest p̄_t looked at.
    """
    turn = 2 * np.pi * plane.strength * largest / frequency
    rows = np.array(_ROWS)[np.searchsorted(np.array(_ROWS[:-1]) * _TURN, turn)]
    critical = np.empty(len(frequency))
    for count in np.unique(rows):
        mine = np.flatnonzero(rows == count)
        critical[mine] = _crossings(plane, frequency[mine], largest[mine], int(count))
    return critical


def _crossings(plane: Plane, frequency: Array, largest: Array, count: int) -> Array:
    """Return what `first_crossings` does, from so many even rows."""
    loads = _loads(plane, frequency, largest, count)
    excess, near = plane.sample(loads, np.broadcast_to(frequency[:, None], loads.shape))
    # the detuning is nearly linear in the square of the load
    square = loads**2
    line, place, reach, rank = line_summits(square, near)
    # what begins beyond the first unstable load does not count
    first = np.where((excess > 0).any(axis=1), (excess > 0).argmax(axis=1), -1)
    below = place - 0.99 * reach < square[line, first[line]]
    line, place, reach, rank = line[below], place[below], reach[below], rank[below]
    place, height = summits(
        lambda u, i: plane.sample(np.sqrt(np.maximum(u, 0)), frequency[line[i]]),
        place,
        reach,
        rank,
        plane.needed,
    )
    critical = np.full(len(frequency), np.inf)
    inside, outside = np.full((2, len(frequency)), np.nan)
    for c in range(len(frequency)):
        mine = (line == c) & np.isfinite(height)
        at = np.concatenate([loads[c], np.sqrt(np.maximum(place[mine], 0))])
        value = np.concatenate([excess[c], height[mine]])
        order = np.argsort(at, kind="stable")
        at, value = at[order], value[order]
        unstable = np.flatnonzero(value > 0)
        if unstable.size and unstable[0] == 0:
            critical[c] = 0.0
        elif unstable.size:
            inside[c], outside[c] = at[unstable[0]], at[unstable[0] - 1]
    cross = np.flatnonzero(np.isfinite(inside))
    root = bracketed_roots(
        lambda load, i: plane.excess(load, frequency[cross[i]]), inside[cross], outside[cross]
    )
    critical[cross] = np.where(np.isfinite(root), root, inside[cross])
    return critical
