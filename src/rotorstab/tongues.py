"""True instability tongues as curves: centre, both edges and growth, refined point by point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import number, numbers
from .floquet import floquet_solution
from .resonance import Resonance, resonances
from .system import System

__all__ = [
    "TongueEdges",
    "collision",
    "edge_function",
    "illinois",
    "tongue_centres",
    "tongue_edges",
]

Array = NDArray[np.float64]
Measure = Callable[[Array, Array], Array]

_LEVELS = 12  # loads at which tongues are followed from their root
_DRIFT = 0.05  # of θ̄: a centre that moves farther in one step has been lost
_FAR = 0.5  # of its root: a centre farther off has been lost
_EDGE = 1e-9  # wanted on an edge, relative to θ̄
_ROUNDS = 40
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


def _vertex(
    measure: Measure, load: Array, guess: Array, reach: Array
) -> tuple[Array, Array, Array]:
    """Return centre, height and curvature of parabolas through three points around guesses."""
    offsets = np.array([-1.0, 0.0, 1.0])
    points = guess[..., None] + reach[..., None] * offsets
    height = measure(np.broadcast_to(load[..., None], points.shape), points)
    slope = (height[..., 2] - height[..., 0]) / 2
    bend = height[..., 2] - 2 * height[..., 1] + height[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = np.where(bend < 0, -slope / bend, np.nan)
    shift = np.clip(shift, -2, 2)
    top = height[..., 1] + slope * shift + bend * shift**2 / 2
    return guess + shift * reach, top, -bend / reach**2


def _follow(measure: Measure, levels: Array, rows: tuple[Resonance, ...]) -> tuple[Array, Array]:
    """Return centres and first-guess half-widths (K, levels), NaN once a tongue is lost."""
    roots = np.array([row.centre for row in rows])
    strength = np.array([2 * row.growth_per_load for row in rows])
    knots, path = [np.zeros(1)], [roots]
    centre = np.full((len(rows), len(levels)), np.nan)
    width = np.full_like(centre, np.nan)
    for index, level in enumerate(levels):
        # the centre is even in the load: extrapolate in its square
        squares = np.concatenate(knots)
        recent = slice(max(0, len(squares) - 4), None)
        weights = [
            np.prod([(level**2 - b) / (a - b) for b in squares[recent] if b != a])
            for a in squares[recent]
        ]
        guess = np.tensordot(weights, np.array(path[recent]), 1)
        guess = np.where(np.abs(guess - roots) < _FAR * roots, guess, roots)
        load = np.full(len(rows), level)
        reach = np.maximum(2 * strength * level, 1e-3 * roots)
        reach = np.minimum(reach, 0.02 * roots)
        for shrink in (1.0, 0.5, 0.25):
            new, top, bend = _vertex(measure, load, guess, shrink * reach)
            near = np.abs(new - guess) <= _DRIFT * roots
            guess = np.where(near & (np.abs(new - roots) < _FAR * roots), new, np.nan)
            # a lost tongue still needs a number to be evaluated at
            safe = np.where(np.isnan(guess), roots, guess)
            lost, guess = np.isnan(guess), safe
        centre[:, index] = np.where(lost, np.nan, guess)
        with np.errstate(invalid="ignore", divide="ignore"):
            width[:, index] = np.sqrt(np.maximum(top, 0) / bend)
        centre[:, index] = np.where(np.isnan(centre[:, max(index - 1, 0)]), np.nan, guess)
        centre[lost, index] = np.nan
        knots.append(np.array([level**2]))
        path.append(np.where(lost, path[-1], guess))
    return centre, width


def _polish(
    measure: Measure,
    loads: Array,
    levels: Array,
    rows: tuple[Resonance, ...],
    path: Array,
) -> tuple[Array, Array]:
    """Return refined centres and half-widths (K, R) at the loads above 0, NaN where lost."""
    centre, half_width = (np.full((len(rows), len(loads)), np.nan) for _ in range(2))
    for k, row in enumerate(rows):
        good = np.isfinite(path[k])
        squares = np.concatenate([[0.0], levels[good] ** 2])
        guess = np.interp(loads**2, squares, np.concatenate([[row.centre], path[k, good]]))
        lost = (loads**2 > 1.0001 * squares[-1]) | (loads == 0)
        centre[k] = np.where(lost, np.nan, guess)
    tongue, at = np.nonzero(np.isfinite(centre))
    if not len(tongue):
        return centre, half_width
    theta, load = centre[tongue, at], loads[at]
    strength = np.array([2 * row.growth_per_load for row in rows])[tongue]
    reach = np.clip(strength * load, 3e-4 * theta, 0.02 * theta)
    for shrink in (1.0, 0.5, 0.5):
        new, top, bend = _vertex(measure, load, theta, shrink * reach)
        theta = np.where(np.abs(new - theta) < 0.05 * theta, new, theta)
    with np.errstate(invalid="ignore", divide="ignore"):
        width = np.sqrt(np.maximum(top, 0) / bend)
    centre[tongue, at] = theta
    half_width[tongue, at] = np.where(width > 0, width, strength * load)
    return centre, half_width


def tongue_centres(measure: Measure, loads: Array, rows: tuple[Resonance, ...]) -> Array:
    """Return θ̄ (K, R) of the strongest collision of each tongue at rising loads, NaN if lost.

    `measure` maps loads and frequencies to any smooth measure of a collision.
    """
    levels = float(loads[-1]) * np.linspace(0.1, 1, _LEVELS)
    path, _ = _follow(measure, levels, rows)
    return _polish(measure, loads, levels, rows, path)[0]


def edge_function(system: System, static: float, load: Array, theta: Array) -> Array:
    """Return a function positive inside a tongue: growth if damped, the collision if not."""
    approach, growth = collision(system, static, load, theta)
    return np.array(growth if system.is_damped else approach)


def illinois(
    function: Callable[[Array, NDArray[np.intp]], Array], inside: Array, outside: Array
) -> Array:
    """Return roots between points where a function is positive and where it is not.

    Parameters
    ----------
    function : callable
        Of points and their indices.
    inside, outside : (P,) float

    Returns
    -------
    (P,) float
        NaN where the signs are not so.
    """
    a, b = inside.copy(), outside.copy()
    everyone = np.arange(len(a))
    fa, fb = function(a, everyone), function(b, everyone)
    root = np.full_like(a, np.nan)
    live = np.flatnonzero((fa > 0) & (fb <= 0))
    for _ in range(_ROUNDS):
        if not live.size:
            break
        x = (a[live] * fb[live] - b[live] * fa[live]) / (fb[live] - fa[live])
        f = function(x, live)
        root[live] = x
        same = f > 0
        moved = np.where(same, np.abs(x - a[live]), np.abs(x - b[live]))
        step_a, step_b = live[same], live[~same]
        a[step_a], fa[step_a] = x[same], f[same]
        fb[step_a] /= 2
        b[step_b], fb[step_b] = x[~same], f[~same]
        fa[step_b] /= 2
        done = (np.abs(b[live] - a[live]) < _EDGE * x) | (moved < 0.01 * _EDGE * x) | (f == 0)
        live = live[~done]
    return root


def _bracket(
    system: System, static: float, load: Array, centre: Array, width: Array, side: int
) -> tuple[Array, Array]:
    """Return points just inside and just outside an edge, NaN if none is found.

    Marches outward in steps small against the width: a longer bracket could span a
    neighbouring tongue.
    """
    inside, outside = centre.copy(), np.full_like(centre, np.nan)
    live = np.flatnonzero(width > 0)
    for part in _MARCH:
        theta = centre[live] + side * part * width[live]
        valid = theta > 0.05 * centre[live]
        live, theta = live[valid], theta[valid]
        if not live.size:
            break
        f = edge_function(system, static, load[live], theta)
        found = f <= 0
        outside[live[found]] = theta[found]
        inside[live[~found]] = theta[~found]
        live = live[~found]
    return inside, outside


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
    multipliers; damped, that of the growth rate.
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
        levels = largest * np.linspace(0.1, 1, _LEVELS)

        def measure(load: Array, frequency: Array) -> Array:
            return collision(system, static, load, frequency)[0]

        path, _ = _follow(measure, levels, rows)
        polished = _polish(measure, loads, levels, rows, path)
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
    edges = []
    for side in (-1, 1):
        inner, outer = _bracket(system, static, load, theta, width, side)
        found = np.isfinite(outer)
        edge = np.full_like(theta, np.nan)
        if found.any():
            part = load[found]
            edge[found] = illinois(
                lambda x, i, part=part: edge_function(system, static, part[i], x),  # type: ignore[misc]
                inner[found],
                outer[found],
            )
        edges.append(edge)
    left[k_index, r_index], right[k_index, r_index] = edges
    both = np.isfinite(edges[0]) & np.isfinite(edges[1])
    status[k_index[both], r_index[both]] = "tongue"
