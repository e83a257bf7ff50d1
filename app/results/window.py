"""The growth map of a chart's window: Floquet's growth and its edges, and Bolotin's mask.

Arguments and results can be pickled, so that another process can make a map.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotorstab import (
    StabilityChart,
    bolotin_mask,
    stability_chart,
    whirl_frequencies,
)
from rotorstab.floquet.interpolant.slow_whirls import InseparableWhirls
from rotorstab.maps.grid_edges import GridEdges
from rotorstab.maps.work import columns_within_work

from . import limits
from .limits import Detail, map_size
from .model import Model, Operation
from .own_model import OwnModel, OwnOperation
from .views import View

__all__ = ["FloquetMap", "Window", "chart_options", "floquet_map"]


_SLOW = 4  # whirls of a polynomial
_CLOSEST = 6.0  # columns between two tongues: nearer ones cannot be told apart


@dataclass(frozen=True)
class Window:
    """What a growth map is of: a rotor in operation, and the part of the instability chart.

    Parameters
    ----------
    operation : Operation or OwnOperation
        The second has units of its own.
    view : View
        Ranges of θ/ω_n and of β_d.
    """

    operation: Operation | OwnOperation
    view: View

    @property
    def frequencies(self) -> tuple[float, float]:
        """Lowest and highest excitation frequency θ̄ [√(EI/(ρAL⁴))]."""
        return (
            self.operation.excitation_frequency(self.view.left),
            self.operation.excitation_frequency(self.view.right),
        )

    @property
    def loads(self) -> tuple[float, float]:
        """Smallest and largest pulsating load p̄_t [EI/L²]."""
        return (
            self.operation.pulsating_load(self.view.low),
            self.operation.pulsating_load(self.view.high),
        )


@dataclass(frozen=True, eq=False)
class FloquetMap:
    """The growth map of a window, Bolotin's mask on its pixels, and on a finer grid the edges.

    The map is NaN in columns whose load is too slow to be followed, and in rows whose load passes
    `System.largest_load`; the grid of the edges has no such rows and columns.

    Parameters
    ----------
    growth : StabilityChart
    mask : (R, C) bool
    edges : GridEdges or None
        None where nothing is computed.
    rates : (R', C') float or None
        Growth rates on the grid of the edges.
    drawn_from : float
        θ̄ below which no edges are found, although the map may have growth rates there: tongues are
        too near to each other, or nothing is computed. 0 where the whole window has edges.
    of_all_whirls : bool
        Whether all whirls of finite elements were kept, on a coarser grid, since the four slowest
        ones do not stand for them.
    """

    growth: StabilityChart
    mask: NDArray[np.bool_]
    edges: GridEdges | None = None
    rates: NDArray[np.float64] | None = None
    drawn_from: float = 0.0
    of_all_whirls: bool = False


def chart_options(
    model: Model | OwnModel, detail: Detail, matrices: bool = False
) -> dict[str, Any]:
    """Return the options of `stability_chart` for the growth map of a model."""
    return {
        "density": map_size(model, detail, matrices).density,
        "refine": detail is Detail.FULL,
        "most_refined": limits.MOST_REFINED[model.kind],
        # tongues narrower than a pixel are shown by their edges
        "find_narrow": False,
    }


class _Axis:
    """The pixels of one axis, and the nodes of a finer grid with the ends of the window.

    Parameters
    ----------
    low, high : float
        The window.
    pixels, finer : int
        Number of pixels, and of nodes in each of them, an odd number.
    """

    def __init__(self, low: float, high: float, pixels: int, finer: int) -> None:
        count = pixels * finer
        step = (high - low) / count
        inner = low + (np.arange(count) + 0.5) * step
        # a load that does not pulsate in time has no period
        first = [low] if low > step else []
        self.nodes = np.concatenate([first, inner, [high]])
        self.pixels = len(first) + finer // 2 + finer * np.arange(pixels)

    @property
    def centres(self) -> NDArray[np.float64]:
        """The centres of the pixels."""
        return np.asarray(self.nodes[self.pixels])


def floquet_map(window: Window, detail: Detail) -> FloquetMap:
    """Return the map of a window; a full one takes some ten times as long as a coarse one."""
    try:
        return _map(window, detail, matrices=False)
    # a rigid motion of a free rotor has two equal multipliers, and no basis of eigenvectors
    except (InseparableWhirls, np.linalg.LinAlgError):
        return replace(_map(window, detail, matrices=True), of_all_whirls=True)


def _map(window: Window, detail: Detail, matrices: bool) -> FloquetMap:
    """Return the map of a window; with `matrices` all whirls of finite elements are kept."""
    operation = window.operation
    size = map_size(operation.model, detail, matrices, window.view.fineness)
    across = _Axis(*window.frequencies, size.columns, size.finer)
    up = _Axis(*window.loads, size.rows, 1)
    if window.view.low == 0:
        up.nodes, up.pixels = np.append(0.0, up.nodes), up.pixels + 1
    whole, known, resolved = _growth(window, up.nodes, across.nodes, detail, matrices)
    mask = _bolotin_mask(window, up.centres, across.centres)
    growth = _on_pixels(whole, known, up, across)
    edges = whole.edges if whole is not None else None
    if whole is None or edges is None:
        return FloquetMap(growth, mask, drawn_from=math.inf)
    rates = whole.growth[: len(edges.pulsating_loads)]
    frequencies = whole.excitation_frequencies
    first = int(np.searchsorted(frequencies, resolved))
    if len(frequencies) - first < 2:
        return FloquetMap(growth, mask, drawn_from=math.inf)
    lowest = float(frequencies[first])
    if not operation.model.is_damped:  # with damping what is unstable is wide there, and shown
        edges, rates = edges.from_column(first), rates[:, first:]
    return FloquetMap(growth, mask, edges, rates, lowest if lowest > across.nodes[0] else 0.0)


def _bolotin_mask(
    window: Window, loads: NDArray[np.float64], frequencies: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which pixels lie in a Bolotin region, none of a rotor that is not compared."""
    mask = np.zeros((len(loads), len(frequencies)), dtype=np.bool_)
    undamped, static = window.operation.undamped, window.operation.static_load
    if undamped is None:
        return mask
    inside = undamped.in_charts(static + loads)
    if inside.any():
        mask[inside] = bolotin_mask(undamped, static, loads[inside], frequencies)
    return mask


def _growth(
    window: Window,
    loads: NDArray[np.float64],
    frequencies: NDArray[np.float64],
    detail: Detail,
    matrices: bool,
) -> tuple[StabilityChart | None, NDArray[np.bool_], float]:
    """Return the growth in columns whose load can be followed, which these are, and resolved θ̄."""
    model, static = window.operation.model, window.operation.static_load
    system = window.operation.system
    size = map_size(model, detail, matrices)
    whirls = np.sort(np.abs(whirl_frequencies(system, static)))
    if not matrices:
        whirls = whirls[:_SLOW]
    known = _followed(model, float(whirls[-1]), frequencies, detail, matrices)
    resolved = _resolved_from(whirls, frequencies)
    if detail is Detail.COARSE or model.kind != "lumped":
        known &= frequencies >= resolved
    inside = loads[system.in_charts(static + loads)]
    resolve = math.inf if matrices else resolved
    if known.any() and inside.size:
        known[known] = columns_within_work(
            system,
            static,
            float(inside.max()),
            frequencies[known],
            size.density,
            _most_nodes(model, detail),
            resolve=resolve,
            slow_whirls=not matrices,
        )
    if not known.any():
        return None, known, math.inf
    chart = stability_chart(
        system,
        static,
        loads,
        frequencies[known],
        edges=True,
        resolve=resolve,
        refine_from=float(whirls[-1]) / limits.MOST_CYCLES_REFINED,
        slow_whirls=not matrices,
        **chart_options(model, detail, matrices),
    )
    return chart, known, resolved


def _most_nodes(model: Model | OwnModel, detail: Detail) -> float:
    """Return the largest sum of nodes times steps of a map."""
    if detail is Detail.COARSE and model.kind == "finite elements":
        return limits.COARSE_NODES_OF_ELEMENTS
    return limits.MOST_NODES[detail]


def _resolved_from(whirls: NDArray[np.float64], frequencies: NDArray[np.float64]) -> float:
    """Return the θ̄ below which tongues are nearer to each other than `_CLOSEST` columns.

    The tongues θ̄ = Ω/k of the slowest pair of whirls, Ω = ω₁ + ω₂, have a distance of about θ̄²/Ω.
    """
    column = float(np.diff(frequencies).max(initial=0.0))
    return math.sqrt(_CLOSEST * column * float(whirls[:2].sum()))


def _on_pixels(
    whole: StabilityChart | None, known: NDArray[np.bool_], up: _Axis, across: _Axis
) -> StabilityChart:
    """Return a chart on the pixels of the map, NaN in the columns that are not computed."""
    shape = len(up.pixels), len(across.pixels)
    unknown, no = np.full(shape, np.nan), np.zeros(shape, dtype=np.bool_)
    parts: dict[str, Any] = {"growth": unknown, "error": unknown, "peak_growth": unknown}
    parts["unstable"] = no
    if whole is not None:
        seen = known[across.pixels]
        column = (np.cumsum(known) - 1)[across.pixels[seen]]
        for name, blank in parts.items():
            parts[name] = blank.copy()
            parts[name][:, seen] = getattr(whole, name)[np.ix_(up.pixels, column)]
            parts[name].flags.writeable = False
    refined = 0 if whole is None else whole.refined
    return StabilityChart(up.centres, across.centres, **parts, refined=refined, narrow_only=0)


def _followed(
    model: Model | OwnModel,
    fastest: float,
    frequencies: NDArray[np.float64],
    detail: Detail,
    matrices: bool,
) -> NDArray[np.bool_]:
    """Return which columns of a growth map are computed, those of the fastest loads first.

    The time that a column takes grows with the cycles of the fastest whirl in a period of the
    load, and without bound where the load is slow and a small disk whirls fast: one window would
    hold up a class.
    """
    kind = limits.MATRICES if matrices else limits.POLYNOMIALS
    cycles = fastest / frequencies
    most_work = float(limits.MOST_WORK[kind, model.is_damped]) * len(frequencies)
    most_cycles = float(limits.MOST_CYCLES)
    if detail is Detail.COARSE:
        most_work *= limits.COARSE_WORK
        longest = float(np.quantile(cycles, limits.COARSE_SHARE))
        most_cycles = min(most_cycles, max(limits.COARSE_CYCLES, longest))
    order = np.argsort(cycles)
    kept = np.zeros(len(cycles), dtype=np.bool_)
    kept[order] = np.cumsum(cycles[order]) <= most_work
    return kept & (cycles <= most_cycles)
