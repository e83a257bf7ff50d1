"""Edges of tongues, found along the pair of multipliers that collides in each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..._numerics.angles import wrapped
from ..._numerics.roots import bracketed_roots
from ..._tolerances import EDGE, MERGED_TONGUES
from ..._types import Array, Index
from ...model.system import System
from ..point import floquet_solution
from .collision_measure import edge_function

__all__ = ["tongue_edge"]

_NEAR = 1e-5  # of θ̄: step over which the rate of a pair's phase is measured
_MARCH = (0.6, *np.arange(0.8, 1.3, 0.05), *np.arange(1.3, 2.5, 0.1))  # in widths
_LOWEST = 0.05  # of the centre: no search below this θ̄


@dataclass
class _Pair:
    """Colliding pairs of multipliers, followed along θ̄ by the phase of their middle.

    Parameters
    ----------
    period, middle, rate : (K,) float
        T at which each pair was seen last, the phase of its middle there [rad], and the rate at
        which that changes with T.
    """

    period: Array
    middle: Array
    rate: Array

    def at(
        self, system: System, static: float, load: Array, theta: Array, index: Index
    ) -> tuple[Array, Array]:
        """Return the `edge_function` of each pair alone, and the phase of its middle."""
        period = 2 * np.pi / theta
        guess = self.middle[index] + self.rate[index] * (period - self.period[index])
        logs = np.log(floquet_solution(system, static, load, theta).multipliers)
        off = wrapped(logs.imag - guess[:, None])
        nearest = np.argsort(np.abs(off), axis=-1)[:, :2]
        size = np.take_along_axis(logs.real, nearest, -1)
        off = np.take_along_axis(off, nearest, -1)
        if system.is_damped:
            value = size.max(axis=-1)
        else:
            value = (np.diff(size)[:, 0] ** 2 - np.diff(off)[:, 0] ** 2) / 4
        return value, guess + off.mean(axis=-1)

    def move(self, index: Index, theta: Array, middle: Array) -> None:
        """Record the phases of some pairs at new θ̄, from which the next are extrapolated."""
        period = 2 * np.pi / theta
        self.rate[index] = (middle - self.middle[index]) / (period - self.period[index])
        self.period[index], self.middle[index] = period, middle


def _pairs(system: System, static: float, load: Array, centre: Array) -> _Pair:
    """Return the pairs that grow most at the centres of the tongues."""
    logs = np.log(floquet_solution(system, static, load, centre).multipliers)
    pair = _Pair(2 * np.pi / centre, logs[:, 0].imag, np.zeros_like(centre))
    every, near = np.arange(len(centre)), centre * (1 - _NEAR)
    # from the phase of the multiplier that grows to the middle of the two
    pair.middle = pair.at(system, static, load, centre, every)[1]
    pair.move(every, near, pair.at(system, static, load, near, every)[1])
    return pair


def tongue_edge(
    system: System, static: float, load: Array, centre: Array, width: Array, side: int
) -> Array:
    """Return the edge of each tongue on one side.

    The search marches outward in steps that are small against the width and follows the tongue's
    own pair of multipliers, for the growth of all multipliers may be that of a neighbouring tongue.

    Parameters
    ----------
    system : System
    static : float
        p̄₀ [EI/L²].
    load, centre, width : (K,) float
        p̄_t and, from `tracking.polish`, the centre and width of each tongue.
    side : int
        −1 for the left edge, 1 for the right one.

    Returns
    -------
    (K,) float
        θ̄; NaN where the edge cannot be told from that of a neighbouring tongue.
    """
    pair = _pairs(system, static, load, centre)
    inside, outside = centre.copy(), np.full_like(centre, np.nan)
    live = np.flatnonzero(width > 0)
    for part in _MARCH:
        theta = centre[live] + side * part * width[live]
        valid = theta > _LOWEST * centre[live]
        live, theta = live[valid], theta[valid]
        if not live.size:
            break
        value, middle = pair.at(system, static, load[live], theta, live)
        pair.move(live, theta, middle)
        found = value <= 0
        outside[live[found]] = theta[found]
        inside[live[~found]] = theta[~found]
        live = live[~found]
    return _refined_edge(system, static, load, pair, inside, outside, side)


def _refined_edge(
    system: System,
    static: float,
    load: Array,
    pair: _Pair,
    inside: Array,
    outside: Array,
    side: int,
) -> Array:
    """Return the edge of each tongue between points inside and outside of it, NaN where lost."""
    edge = np.full_like(inside, np.nan)
    there = np.flatnonzero(np.isfinite(outside))
    if there.size:
        edge[there] = bracketed_roots(
            lambda x, i: pair.at(system, static, load[there[i]], x, there[i])[0],
            inside[there],
            outside[there],
            EDGE,
        )
        there = there[np.isfinite(edge[there])]
        beyond = edge[there] * (1 + side * MERGED_TONGUES)
        edge[there[edge_function(system, static, load[there], beyond) > 0]] = np.nan
    return edge
