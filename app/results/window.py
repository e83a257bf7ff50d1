"""The growth map of a chart's window: Floquet's growth, Bolotin's mask, exact tongue edges.

Arguments and results can be pickled, so that another process can make a map.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotorstab import (
    StabilityChart,
    bolotin_mask,
    fundamental_frequency,
    lumped,
    stability_chart,
    whirl_frequencies,
)
from rotorstab.floquet.tongues.outlines import Outline
from rotorstab.maps.tongue_outlines import tongue_outlines
from rotorstab.maps.work import columns_within_work

from . import limits
from .limits import Detail, map_size
from .model import Model

__all__ = ["FloquetMap", "Window", "chart_options", "floquet_map", "window_outlines"]


@dataclass(frozen=True)
class Window:
    """What a growth map is of: a system, its steady load, and the window of the chart.

    Parameters
    ----------
    model : Model
    spin_speed, tangency : float
        Ω̄ and μ.
    static_load : float
        p̄₀ [EI/L²].
    low, high : float
        Lowest and highest excitation frequency θ̄ [√(EI/(ρAL⁴))].
    top : float
        Largest pulsating load p̄_t [EI/L²].
    """

    model: Model
    spin_speed: float
    tangency: float
    static_load: float
    low: float
    high: float
    top: float


@dataclass(frozen=True, eq=False)
class FloquetMap:
    """The growth map of a window, Bolotin's mask on its pixels, and the tongue edges if known.

    The map is NaN in columns whose load is too slow to be followed, and in rows whose load passes
    `System.largest_load`.
    """

    growth: StabilityChart
    mask: NDArray[np.bool_]
    outlines: tuple[Outline, ...] = ()


def chart_options(model: Model, detail: Detail) -> dict[str, Any]:
    """Return the options of `stability_chart` for the growth map of a model."""
    return {
        "density": map_size(model.kind, detail).density,
        "refine": detail is Detail.REFINED,
        "most_refined": limits.MOST_REFINED[model.kind],
        # tongues narrower than a pixel are shown by their edges
        "seed": False,
    }


def floquet_map(window: Window, detail: Detail) -> FloquetMap:
    """Return the map of a window; a full one takes some ten times as long as a coarse one."""
    model = window.model
    rows, columns, _ = map_size(model.kind, detail)
    loads = (np.arange(rows) + 0.5) / rows * window.top
    span = window.high - window.low
    frequencies = window.low + (np.arange(columns) + 0.5) / columns * span
    growth = _growth(window, loads, frequencies, detail)
    undamped = model.undamped().system(window.spin_speed, window.tangency)
    mask = np.zeros((rows, columns), dtype=np.bool_)
    inside = window.static_load + loads < undamped.largest_load
    mask[inside] = bolotin_mask(undamped, window.static_load, loads[inside], frequencies)
    outlines = window_outlines(window) if detail is Detail.REFINED else ()
    return FloquetMap(growth, mask, outlines)


def window_outlines(window: Window) -> tuple[Outline, ...]:
    """Return the edges of the tongues in a window, where they can be computed in a short time."""
    model = window.model
    fundamental = fundamental_frequency(lumped(model.rotor, 0.0, 1.0))
    return tongue_outlines(
        model.system(window.spin_speed, window.tangency),
        window.static_load,
        window.top,
        max(window.low, limits.LOWEST_EDGE * fundamental),
        window.high,
        most_cycles=limits.EDGE_CYCLES,
    )


def _growth(
    window: Window, loads: NDArray[np.float64], frequencies: NDArray[np.float64], detail: Detail
) -> StabilityChart:
    """Return the growth map, NaN where the load is too slow to be followed."""
    model = window.model
    system = model.system(window.spin_speed, window.tangency)
    known = _followed(window, frequencies, detail)
    inside = loads[window.static_load + loads < system.largest_load]
    if known.any() and inside.size:
        known[known] = columns_within_work(
            system,
            window.static_load,
            float(inside.max()),
            frequencies[known],
            map_size(model.kind, detail).density,
            limits.MOST_NODES[detail],
        )
    shape = (len(loads), len(frequencies))
    unknown, no = np.full(shape, np.nan), np.zeros(shape, dtype=np.bool_)
    if not known.any():
        return StabilityChart(loads, frequencies, unknown, unknown, unknown, no, 0, 0)
    chart = stability_chart(
        system, window.static_load, loads, frequencies[known], **chart_options(model, detail)
    )
    if known.all():
        return chart
    wide: dict[str, Any] = {}
    for name in ("growth", "error", "peak_growth", "unstable"):
        wide[name] = (no if name == "unstable" else unknown).copy()
        wide[name][:, known] = getattr(chart, name)
        wide[name].flags.writeable = False
    return replace(chart, excitation_frequencies=frequencies, **wide)


def _followed(
    window: Window, frequencies: NDArray[np.float64], detail: Detail
) -> NDArray[np.bool_]:
    """Return which columns of a growth map are computed, those of the fastest loads first.

    The time that a column takes grows with the whirl cycles in a period of the load, and without
    bound where the load is slow and a small disk whirls fast: one window would hold up a class.
    """
    model = window.model
    system = model.system(window.spin_speed, window.tangency)
    fastest = float(np.abs(whirl_frequencies(system, window.static_load)).max())
    cycles = fastest / frequencies
    most_work = float(limits.MOST_WORK[model.kind, model.is_damped])
    most_cycles = float(limits.MOST_CYCLES)
    if detail is Detail.COARSE:
        most_work *= limits.COARSE_WORK
        longest = float(np.quantile(cycles, limits.COARSE_SHARE))
        most_cycles = min(most_cycles, max(limits.COARSE_CYCLES, longest))
    order = np.argsort(cycles)
    kept = np.zeros(len(cycles), dtype=np.bool_)
    kept[order] = np.cumsum(cycles[order]) <= most_work
    return kept & (cycles <= most_cycles)
