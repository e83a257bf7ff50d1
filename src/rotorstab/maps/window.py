"""What Floquet says of a chart's window: growth map, Bolotin's mask, exact edges.

Arguments and results can be pickled, so that another process can make map and edges.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..bolotin.regions import bolotin_mask
from ..floquet.interpolant.chart_interpolant import chart_panels
from ..floquet.interpolant.sampling import NodeSampler
from ..floquet.tongues.outlines import Outline, unstable_outlines
from ..model.finite_element import finite_element, first_modes
from ..model.lumped import lumped
from ..model.system import System, fundamental_frequency
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.frequencies import whirl_frequencies
from .stability_map import StabilityChart, stability_chart

__all__ = [
    "ELEMENTS",
    "MODES",
    "PIXELS",
    "FloquetMap",
    "Model",
    "Window",
    "floquet_map",
    "followed",
    "map_options",
    "tongue_outlines",
    "whole_map",
]

ELEMENTS, MODES = 20, 4
# rows and columns of the growth map and density of its nodes, while moving and settled
PIXELS = {
    ("lumped", False): (40, 80, 0.6),
    ("lumped", True): (120, 240, 1.0),
    ("finite elements", False): (20, 40, 0.6),
    ("finite elements", True): (48, 120, 1.0),
}
_CLEAR = 0.95  # of the third mode's lowest resonance
_TWO_MODES = 1e-2  # error allowed the whirl frequencies of two modes, relative
# cycles of the fastest whirl in one period of the load: on the growth map, on the tongues' edges
MOST_CYCLES, EDGE_CYCLES = 1000, 60
# while moving the slowest loads, a few columns that take as long as the rest, wait for rest
MOVING_CYCLES, MOVING_SHARE, MOVING_WORK = 20, 0.9, 0.25
# the same, summed over the map's columns: seconds of work at most, and while moving a share of
# it; usual windows are whole
MOST_WORK = {
    ("lumped", False): 5000,
    ("lumped", True): 2500,
    ("finite elements", False): 4000,
    ("finite elements", True): 2500,
}
# nodes times steps of a map (`Panel.work`): near the pole of the exact law they rise without end
MOST_NODES = {False: 60_000, True: 2_000_000}  # moving, settled: 0.1 s and some 4 s at most
# pixels of the growth map computed one by one, first those whose verdict is in doubt
MOST_REFINED = {"lumped": 600, "finite elements": 60}
LOWEST_EDGE = 0.4  # of ω_n: below it tongues crowd and the pixels alone show them


@dataclass(frozen=True)
class Model:
    """Which system the charts are of, spin speed and tangency apart."""

    rotor: ShaftDisk
    kind: str = "lumped"
    law: str = "linear"
    external_damping: float = 0.0
    internal_damping: float = 0.0

    def system(self, spin_speed: float, tangency: float, law: str | None = None) -> System:
        """Return the system; `law` overrides the stiffness law of the lumped model."""
        damping = self.external_damping, self.internal_damping
        if self.kind == "lumped":
            return lumped(self.rotor, spin_speed, tangency, *damping, stiffness=law or self.law)
        return finite_element(self.rotor, spin_speed, tangency, ELEMENTS, MODES, *damping)

    def undamped(self) -> Model:
        """Return the model without damping, which is what Bolotin's method is for."""
        return replace(self, external_damping=0.0, internal_damping=0.0)


def map_options(model: Model, settled: bool) -> dict[str, Any]:
    """Return how carefully the growth map of a model is made, for `stability_chart`."""
    return {
        "density": PIXELS[model.kind, settled][2],
        "refine": MOST_REFINED[model.kind] if settled else 0,
        # where edges are drawn they show the tongues thinner than a pixel
        "seed": False,
    }


@dataclass(frozen=True)
class Window:
    """What Floquet is asked: a system, its steady load, and the chart's window.

    `low` and `high` are excitation frequencies θ̄, `top` is the largest pulsating load.
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
    """The growth map of a window, Bolotin's mask on its pixels, and the tongues' edges if known.

    The map is NaN in columns whose load is too slow to be followed (`followed`), and in rows whose
    load passes `System.largest_load`.
    """

    growth: StabilityChart
    mask: NDArray[np.bool_]
    outlines: tuple[Outline, ...] = ()


def _fastest(window: Window) -> float:
    """Return the largest whirl frequency |ω̄| under the steady load."""
    system = window.model.system(window.spin_speed, window.tangency)
    return float(np.abs(whirl_frequencies(system, window.static_load)).max())


def followed(
    window: Window, frequencies: NDArray[np.float64], settled: bool = True
) -> NDArray[np.bool_]:
    """Return which columns of a growth map are computed, the fastest loads first.

    The time that a column takes grows with the whirl cycles in a period of the load, without
    end where the load is slow and a small disk whirls fast: one window would hold up a class.
    """
    model = window.model
    cycles = _fastest(window) / frequencies
    order = np.argsort(cycles)
    kept = np.zeros(len(cycles), dtype=np.bool_)
    most = float(MOST_WORK[model.kind, model != model.undamped()])
    limit = float(MOST_CYCLES)
    if not settled:
        most *= MOVING_WORK
        limit = min(limit, max(MOVING_CYCLES, float(np.quantile(cycles, MOVING_SHARE))))
    kept[order] = np.cumsum(cycles[order]) <= most
    return kept & (cycles <= limit)


def _affordable(
    window: Window,
    largest: float,
    frequencies: NDArray[np.float64],
    known: NDArray[np.bool_],
    settled: bool,
) -> NDArray[np.bool_]:
    """Return the columns of some for which `MOST_NODES` suffice, the fastest loads first."""
    model = window.model
    system = model.system(window.spin_speed, window.tangency)
    order = np.flatnonzero(known)[np.argsort(-frequencies[known], kind="stable")]
    periods = 2 * np.pi / frequencies[order]
    density = PIXELS[model.kind, settled][2]

    sampler = NodeSampler(system, window.static_load, largest)

    def fits(count: int) -> bool:
        panels = chart_panels(sampler, periods[:count], density)
        return sum(panel.work for panel in panels) <= MOST_NODES[settled]

    low, high = 0, len(order) + 1  # fits, does not fit
    count = len(order)
    while high - low > 1:
        low, high = (count, high) if fits(count) else (low, count)
        count = (low + high) // 2
    kept = np.zeros_like(known)
    kept[order[:low]] = True
    return kept


def _growth(
    window: Window,
    loads: NDArray[np.float64],
    frequencies: NDArray[np.float64],
    settled: bool,
    refined: bool,
) -> StabilityChart:
    """Return the growth map, NaN where the load is too slow to be followed."""
    known = followed(window, frequencies, settled)
    system = window.model.system(window.spin_speed, window.tangency)
    inside = loads[window.static_load + loads < system.largest_load]
    if known.any() and inside.size:
        known = _affordable(window, float(inside.max()), frequencies, known, settled)
    shape = (len(loads), len(frequencies))
    nothing, no = np.full(shape, np.nan), np.zeros(shape, dtype=np.bool_)
    if not known.any():
        return StabilityChart(loads, frequencies, nothing, nothing, nothing, no, 0, 0)
    chart = stability_chart(
        system,
        window.static_load,
        loads,
        frequencies[known],
        **map_options(window.model, settled) | ({} if refined else {"refine": 0}),
    )
    if known.all():
        return chart
    wide: dict[str, Any] = {}
    for name, empty in (
        ("growth", nothing),
        ("error", nothing),
        ("peak_growth", nothing),
        ("unstable", no),
    ):
        wide[name] = empty.copy()
        wide[name][:, known] = getattr(chart, name)
        wide[name].flags.writeable = False
    return replace(chart, excitation_frequencies=frequencies, **wide)


def floquet_map(window: Window, settled: bool, refined: bool = False) -> FloquetMap:
    """Return the map of a window without edges; a settled one takes some ten times longer.

    Where `refined`, a settled one's doubtful pixels are computed one by one.
    """
    model = window.model
    rows, columns, _ = PIXELS[model.kind, settled]
    loads = (np.arange(rows) + 0.5) / rows * window.top
    span = window.high - window.low
    frequencies = window.low + (np.arange(columns) + 0.5) / columns * span
    growth = _growth(window, loads, frequencies, settled, refined)
    plain = model.undamped().system(window.spin_speed, window.tangency)
    mask = np.zeros((rows, columns), dtype=np.bool_)
    inside = window.static_load + loads < plain.largest_load
    mask[inside] = bolotin_mask(plain, window.static_load, loads[inside], frequencies)
    return FloquetMap(growth, mask)


def whole_map(window: Window) -> FloquetMap:
    """Return the settled map of a window with all that can be had: refined, with edges."""
    return replace(floquet_map(window, True, refined=True), outlines=tongue_outlines(window))


def tongue_outlines(window: Window) -> tuple[Outline, ...]:
    """Return the edges of the tongues in a window, where they can be had at once.

    Exact for the lumped model. Those of finite elements are of their first two modes: right to
    1e-2 at small loads, some percent off at β_d = 1. They end below the third mode's resonances,
    and there are none where two modes do not hold the first four whirls to 1e-2, as with a fast
    disk of large polar inertia.
    """
    model = window.model
    low = max(window.low, LOWEST_EDGE * fundamental_frequency(lumped(model.rotor, 0.0, 1.0)))
    high = window.high
    system = model.system(window.spin_speed, window.tangency)
    if system.size > 2:
        whirl = whirl_frequencies(system, window.static_load).real
        slow, fast = np.split(whirl[np.argsort(np.abs(whirl))], [4])
        high = min(high, _CLEAR * float(np.abs(np.subtract.outer(fast, slow)).min()))
        system = first_modes(system, window.static_load)
        two = whirl_frequencies(system, window.static_load).real
        slow.sort()
        if (np.abs(np.sort(two) - slow) > _TWO_MODES * np.maximum(np.abs(slow), low / 2)).any():
            return ()
    fastest = float(np.abs(whirl_frequencies(system, window.static_load)).max())
    low = max(low, fastest / EDGE_CYCLES)
    if high <= low:
        return ()
    return unstable_outlines(system, window.static_load, window.top, low, high)
