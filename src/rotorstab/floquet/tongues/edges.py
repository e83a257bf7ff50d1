"""True instability tongues as curves: centre, both edges and growth, refined point by point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._arguments import number, numbers
from ...model.system import System
from ..point import floquet_solution
from ..resonance import resonances
from .tracking import LEVELS, follow, polish

__all__ = [
    "TongueEdges",
    "bracketed_roots",
    "collision",
    "edge_function",
    "tongue_edges",
]

Array = NDArray[np.float64]

_EDGE = 1e-9  # wanted on an edge, relative to θ̄
_ROUNDS = 40
_NEAR = 1e-5  # of θ̄: from a centre to the point that tells how its pair turns
_GAP = 1e-5  # of θ̄: ground that grows so near to an edge belongs to another tongue
_MARCH = (0.6, *np.arange(0.8, 1.3, 0.05), *np.arange(1.3, 2.5, 0.1))  # of the half-width


@dataclass(frozen=True)
class TongueEdges:
    """Tongues of instability as curves over the pulsating load.

    Parameters
    ----------
    names : tuple of str
        Mode pairs, K of them.
    pulsating_loads : (R,) float
        p̄_t [EI/L²], rising.
    centre, left, right : (K, R) float
        θ̄ of the strongest collision and of both edges [√(EI/(ρAL⁴))], to 1e-6 or better;
        NaN where the status is not "tongue".
    growth : (K, R) float
        Growth rate at the centre.
    status : (K, R) str
        "tongue", "stable" (not there at this load: damping), "merged" (an edge could not be
        told from another tongue's) or "lost" (the centre could not be followed).
    """

    names: tuple[str, ...]
    pulsating_loads: Array
    centre: Array
    left: Array
    right: Array
    growth: Array
    status: NDArray[np.str_]


def collision(
    system: System, static_load: float, load: ArrayLike, frequency: ArrayLike
) -> tuple[Array, Array]:
    """Return how close two multipliers are to a collision, and the growth rate.

    Parameters
    ----------
    system : System
    static_load : float
    load, frequency : (...) float
        p̄_t and θ̄; broadcast.

    Returns
    -------
    approach : (...) float
        Largest Re (ln μ_i/μ_j)²/4 over all pairs. Undamped it is −(half the gap of the
        arguments)² outside a tongue and (σT)² inside: smooth, so roots are edges.
    growth : (...) float
    """
    solution = floquet_solution(system, static_load, load, frequency)
    logs = np.log(solution.multipliers)
    best = np.full(solution.growth_rate.shape, -np.inf)
    for i, j in combinations(range(logs.shape[-1]), 2):
        gap = logs[..., i] - logs[..., j]
        turn = gap.imag - 2 * np.pi * np.round(gap.imag / (2 * np.pi))
        best = np.maximum(best, (gap.real**2 - turn**2) / 4)
    return best, solution.growth_rate


def edge_function(system: System, static: float, load: Array, theta: Array) -> Array:
    """Return a function positive inside a tongue: growth if damped, the collision if not."""
    approach, growth = collision(system, static, load, theta)
    return np.array(growth if system.is_damped else approach)


def bracketed_roots(
    function: Callable[[Array, NDArray[np.intp]], Array],
    inside: Array,
    outside: Array,
    tolerance: float = _EDGE,
) -> Array:
    """Return roots between points where a function is positive and where it is not.

    Parameters
    ----------
    function : callable
        Of points and their indices.
    inside, outside : (P,) float
    tolerance : float
        Width of the last bracket, relative.

    Returns
    -------
    (P,) float
        NaN where the signs are not so.

    References
    ----------
    T. R. Chandrupatla, Adv. Eng. Software 28 (1997) 145: inverse quadratic interpolation where
    three points allow it, else bisection.
    """
    everyone = np.arange(len(inside))
    a, b = inside.copy(), outside.copy()
    fa, fb = function(a, everyone), function(b, everyone)
    root = np.full_like(a, np.nan)
    live = np.flatnonzero((fa > 0) & (fb <= 0))
    a, b, fa, fb = a[live], b[live], fa[live], fb[live]
    share = fa / (fa - fb)
    for _ in range(_ROUNDS):
        if not live.size:
            break
        x = a + share * (b - a)
        f = function(x, live)
        # a is the newest point, b the end across the root, c the one before
        same = (f > 0) == (fa > 0)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, f
        best = np.where(np.abs(fa) < np.abs(fb), a, b)
        least = 0.5 * tolerance * np.abs(best) / np.abs(b - a)
        root[live] = best
        with np.errstate(divide="ignore", invalid="ignore"):
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            smooth = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
            inverse = fa / (fb - fa) * fc / (fb - fc)
            inverse += (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        share = np.where(smooth, inverse, 0.5)
        share = np.clip(share, np.minimum(least, 0.5), np.maximum(1 - least, 0.5))
        more = (least <= 0.5) & (f != 0)
        live, share = live[more], share[more]
        a, b, fa, fb = a[more], b[more], fa[more], fb[more]
    return root


@dataclass
class _Pair:
    """Colliding pairs of multipliers, followed by their place on the circle along θ̄."""

    period: Array
    middle: Array
    rate: Array

    def at(
        self, system: System, static: float, load: Array, theta: Array, index: NDArray[np.intp]
    ) -> tuple[Array, Array]:
        """Return what is positive in the tongue of each pair and the pair's middle phase.

        Growth if damped, the collision if not, as in `edge_function` but of this pair alone.
        """
        period = 2 * np.pi / theta
        guess = self.middle[index] + self.rate[index] * (period - self.period[index])
        logs = np.log(floquet_solution(system, static, load, theta).multipliers)
        off = logs.imag - guess[:, None]
        off -= 2 * np.pi * np.round(off / (2 * np.pi))
        two = np.argsort(np.abs(off), axis=-1)[:, :2]
        size = np.take_along_axis(logs.real, two, -1)
        off = np.take_along_axis(off, two, -1)
        if system.is_damped:
            value = size.max(axis=-1)
        else:
            value = (np.diff(size)[:, 0] ** 2 - np.diff(off)[:, 0] ** 2) / 4
        return value, guess + off.mean(axis=-1)

    def move(self, index: NDArray[np.intp], theta: Array, middle: Array) -> None:
        """Take the phases at new θ̄; the next ones are extrapolated from them."""
        period = 2 * np.pi / theta
        self.rate[index] = (middle - self.middle[index]) / (period - self.period[index])
        self.period[index], self.middle[index] = period, middle


def _pairs(system: System, static: float, load: Array, centre: Array) -> _Pair:
    """Return the pairs that grow most at the tongues' centres."""
    logs = np.log(floquet_solution(system, static, load, centre).multipliers)
    pair = _Pair(2 * np.pi / centre, logs[:, 0].imag, np.zeros_like(centre))
    everyone, near = np.arange(len(centre)), centre * (1 - _NEAR)
    # from the phase of the multiplier that grows to the middle of the two
    pair.middle = pair.at(system, static, load, centre, everyone)[1]
    pair.move(everyone, near, pair.at(system, static, load, near, everyone)[1])
    return pair


def _edge(
    system: System, static: float, load: Array, centre: Array, width: Array, side: int
) -> Array:
    """Return the edge of each tongue on one side, NaN where it is not to be told from another's.

    Marches outward in steps small against the width, along the tongue's own pair: the growth
    of all multipliers could be that of a neighbouring tongue.
    """
    pair = _pairs(system, static, load, centre)
    inside, outside = centre.copy(), np.full_like(centre, np.nan)
    live = np.flatnonzero(width > 0)
    for part in _MARCH:
        theta = centre[live] + side * part * width[live]
        valid = theta > 0.05 * centre[live]
        live, theta = live[valid], theta[valid]
        if not live.size:
            break
        value, middle = pair.at(system, static, load[live], theta, live)
        pair.move(live, theta, middle)
        found = value <= 0
        outside[live[found]] = theta[found]
        inside[live[~found]] = theta[~found]
        live = live[~found]
    edge = np.full_like(centre, np.nan)
    there = np.flatnonzero(np.isfinite(outside))
    if there.size:
        edge[there] = bracketed_roots(
            lambda x, i: pair.at(system, static, load[there[i]], x, there[i])[0],
            inside[there],
            outside[there],
        )
        there = there[np.isfinite(edge[there])]
        beyond = edge[there] * (1 + side * _GAP)
        edge[there[edge_function(system, static, load[there], beyond) > 0]] = np.nan
    return edge


def tongue_edges(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    names: tuple[str, ...] | None = None,
) -> TongueEdges:
    """Return the true edges θ̄(p̄_t) of tongues of instability.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²], 0 or more, rising.
    names : tuple of str, optional
        Pairs to follow, such as ("1B+1F",); every tongue of `resonances` if not given.

    Returns
    -------
    TongueEdges

    Raises
    ------
    ValueError
        If an argument is out of range or a name is not a tongue of this system.

    Notes
    -----
    A tongue is followed from its root θ̄ = |ω_i − ω_j| by the vertex of the collision measure,
    then each edge is a bracketed root. Undamped, the root is that of the collision of two
    multipliers; damped, that of their growth rate. Along each edge the tongue's own pair of
    multipliers is followed, so that a narrow gap to the next tongue is not jumped; tongues
    closer than 1e-5 of θ̄ count as merged.
    """
    static = number("static_load", static_load)
    loads = np.array(numbers("pulsating_loads", pulsating_loads, 0.0))
    if loads.ndim != 1 or loads.size == 0 or (np.diff(loads) < 0).any():
        raise ValueError("`pulsating_loads` must be a rising list of numbers")
    largest = float(loads[-1])
    table = resonances(system, static, largest)
    rows = table.tongues
    if names is not None:
        known = {row.name: row for row in rows}
        for name in names:
            if name not in known:
                raise ValueError(f"`names` must be among {sorted(known)}, got {name!r}")
        rows = tuple(known[name] for name in names)
    shape = (len(rows), len(loads))
    centre, left, right, growth = (np.full(shape, np.nan) for _ in range(4))
    status = np.full(shape, "lost", dtype="<U6")
    if rows and largest > 0:
        levels = largest * np.linspace(0.1, 1, LEVELS)

        def measure(load: Array, frequency: Array) -> Array:
            return collision(system, static, load, frequency)[0]

        path, _ = follow(measure, levels, rows)
        polished = polish(measure, loads, levels, rows, path)
        _fill(system, static, loads, polished, (centre, left, right, growth, status))
    for k, row in enumerate(rows):
        zero = loads == 0
        centre[k, zero] = row.centre
        growth[k, zero] = table.mean_growth
        at_root = row.threshold == 0
        status[k, zero] = "tongue" if at_root else "stable"
        if at_root:
            left[k, zero] = right[k, zero] = row.centre
    for array in (loads, centre, left, right, growth, status):
        array.flags.writeable = False
    return TongueEdges(tuple(row.name for row in rows), loads, centre, left, right, growth, status)


def _fill(
    system: System,
    static: float,
    loads: Array,
    polished: tuple[Array, Array],
    out: tuple[Array, Array, Array, Array, NDArray[np.str_]],
) -> None:
    """Fill in edges at every load, all tongues together."""
    centre, left, right, growth, status = out
    theta_all, width_all = polished
    k_index, r_index = np.nonzero(np.isfinite(theta_all))
    if not len(k_index):
        return
    theta, width = theta_all[k_index, r_index], width_all[k_index, r_index]
    load = loads[r_index]
    inside = edge_function(system, static, load, theta)
    _, rate = collision(system, static, load, theta)
    ok = inside > 0
    status[k_index, r_index] = np.where(ok, "merged", "stable" if system.is_damped else "lost")
    centre[k_index, r_index], growth[k_index, r_index] = theta, rate
    centre[k_index[~ok], r_index[~ok]] = np.nan
    k_index, r_index = k_index[ok], r_index[ok]
    theta, load, width = theta[ok], load[ok], width[ok]
    edges = [_edge(system, static, load, theta, width, side) for side in (-1, 1)]
    left[k_index, r_index], right[k_index, r_index] = edges
    both = np.isfinite(edges[0]) & np.isfinite(edges[1])
    status[k_index[both], r_index[both]] = "tongue"
