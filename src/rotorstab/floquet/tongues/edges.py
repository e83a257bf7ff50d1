"""Instability tongues as curves: centre, both edges and growth, refined point by point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..._arguments import number, numbers
from ..._types import Array, ArrayLike
from ...model.system import System
from ..resonance import resonances
from ..resonance_table import Resonance
from .collision_measure import collision_measure, edge_function
from .pair_edges import tongue_edge
from .tracking import follow, polish, tracking_loads

__all__ = ["TongueEdges", "tongue_edges"]


@dataclass(frozen=True)
class TongueEdges:
    """Tongues of instability as curves over the pulsating load.

    Parameters
    ----------
    names : tuple of str
        The K mode pairs, such as "1B+1F".
    pulsating_loads : (R,) float
        p̄_t [EI/L²] in rising order.
    centre, left, right : (K, R) float
        θ̄ of the strongest collision and of both edges [√(EI/(ρAL⁴))], to 1e-6 or better;
        NaN where unknown.
    growth : (K, R) float
        Growth rate at the centre [√(EI/(ρAL⁴))].
    status : (K, R) str
        "tongue"; "stable": damping suppresses the tongue at this load; "merged": at least one
        edge cannot be told from that of another tongue; "lost": the centre could not be followed.
    """

    names: tuple[str, ...]
    pulsating_loads: Array
    centre: Array
    left: Array
    right: Array
    growth: Array
    status: NDArray[np.str_]


def tongue_edges(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    names: tuple[str, ...] | None = None,
) -> TongueEdges:
    """Return the edges θ̄(p̄_t) of tongues of instability by Floquet's theory.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²], 0 or more, in rising order.
    names : tuple of str, optional
        Pairs to follow, such as ("1B+1F",); by default every tongue of `resonances`.

    Returns
    -------
    TongueEdges

    Raises
    ------
    ValueError
        If an argument is out of range or a name is not a tongue of this system.

    Notes
    -----
    A tongue is followed from its root θ̄ = |ω_i − ω_j| along the place where two multipliers are
    closest. Each edge is then a bracketed root: without damping of the distance of the two
    multipliers, with damping of their growth rate. The tongue's own pair of multipliers is
    followed outward, so that a narrow gap to the next tongue is not missed; tongues closer than
    1e-5 of θ̄ count as merged.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> edges = tongue_edges(lumped(ShaftDisk(), 1.0), 1.178, [0.1178], ("1B+1F",))
    >>> edges.left.round(4).tolist(), edges.right.round(4).tolist()
    ([[0.9739]], [[1.0108]])
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
    edges = _unknown_edges(rows, loads)
    if rows and largest > 0:
        _fill(edges, system, static, rows)
    for k, row in enumerate(rows):
        zero = loads == 0
        edges.centre[k, zero] = row.centre
        edges.growth[k, zero] = table.mean_growth
        at_root = row.threshold == 0
        edges.status[k, zero] = "tongue" if at_root else "stable"
        if at_root:
            edges.left[k, zero] = edges.right[k, zero] = row.centre
    for array in (loads, edges.centre, edges.left, edges.right, edges.growth, edges.status):
        array.flags.writeable = False
    return edges


def _unknown_edges(rows: tuple[Resonance, ...], loads: Array) -> TongueEdges:
    """Return edges of tongues that are all NaN and "lost"."""
    shape = (len(rows), len(loads))
    centre, left, right, growth = (np.full(shape, np.nan) for _ in range(4))
    status = np.full(shape, "lost", dtype="<U6")
    return TongueEdges(tuple(row.name for row in rows), loads, centre, left, right, growth, status)


def _fill(edges: TongueEdges, system: System, static: float, rows: tuple[Resonance, ...]) -> None:
    """Fill in centres, edges, growth and status at every load above 0, all tongues together."""
    loads = edges.pulsating_loads

    def measure(load: Array, frequency: Array) -> Array:
        return collision_measure(system, static, load, frequency)[0]

    levels = tracking_loads(float(loads[-1]))
    centres, widths = polish(measure, loads, levels, rows, follow(measure, levels, rows))
    k, r = np.nonzero(np.isfinite(centres))
    if not len(k):
        return
    theta, width, load = centres[k, r], widths[k, r], loads[r]
    inside = edge_function(system, static, load, theta) > 0
    _, growth = collision_measure(system, static, load, theta)
    edges.status[k, r] = np.where(inside, "merged", "stable" if system.is_damped else "lost")
    edges.centre[k, r], edges.growth[k, r] = theta, growth
    edges.centre[k[~inside], r[~inside]] = np.nan
    k, r = k[inside], r[inside]
    theta, load, width = theta[inside], load[inside], width[inside]
    left, right = (tongue_edge(system, static, load, theta, width, side) for side in (-1, 1))
    edges.left[k, r], edges.right[k, r] = left, right
    both = np.isfinite(left) & np.isfinite(right)
    edges.status[k[both], r[both]] = "tongue"
