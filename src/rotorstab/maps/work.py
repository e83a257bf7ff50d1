"""How much work a stability chart takes, known before it is made."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..floquet.interpolant.chart_panels import chart_panels, node_sampler
from ..model.system import System

__all__ = ["columns_within_work"]


def columns_within_work(
    system: System,
    static_load: float,
    largest_load: float,
    excitation_frequencies: NDArray[np.float64],
    density: float,
    most_work: float,
    *,
    resolve: float = math.inf,
    slow_whirls: bool = False,
) -> NDArray[np.bool_]:
    """Return which columns of `stability_chart` can be computed with a bounded amount of work.

    Parameters
    ----------
    system : System
        One spin speed.
    static_load, largest_load : float
        p̄₀ and the largest p̄_t of the chart [EI/L²].
    excitation_frequencies : (C,) float
        θ̄ of the columns [√(EI/(ρAL⁴))], above 0, in any order.
    density : float
        As for `stability_chart`.
    most_work : float
        Largest sum of Chebyshev nodes times integration steps. Near the load at which the exact
        stiffness law ends the number of steps rises without bound.
    resolve, slow_whirls : float, bool
        As for `stability_chart`.

    Returns
    -------
    (C,) bool
        True for as many columns as the work suffices for, those of the fastest loads first.
    """
    order = np.argsort(-excitation_frequencies, kind="stable")
    periods = 2 * np.pi / excitation_frequencies[order]
    sampler = node_sampler(system, static_load, largest_load, slow_whirls)

    def suffices(count: int) -> bool:
        panels = chart_panels(sampler, periods[:count], density, resolve=2 * np.pi / resolve)
        return sum(panel.work for panel in panels) <= most_work

    enough, too_many = 0, len(order) + 1
    count = len(order)  # mostly the work suffices for all columns
    while too_many - enough > 1:
        enough, too_many = (count, too_many) if suffices(count) else (enough, count)
        count = (enough + too_many) // 2
    kept = np.zeros(len(order), dtype=np.bool_)
    kept[order[:enough]] = True
    return kept
