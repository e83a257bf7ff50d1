"""The charts of the page Your rotor, in rpm, Hz and N: cached, shared by sessions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from rotorstab import (
    FloquetSolution,
    ResonanceTable,
    Scales,
    campbell_diagram,
    critical_speeds,
    floquet_solution,
    load_frequency_curves,
    resonances,
)
from rotorstab.charts import (
    Chart,
    GrowthGrid,
    chart_factors,
    fitted_top,
    in_si,
    marker_layer,
    rotor_drawing,
    stability_chart_of,
    unsigned_campbell_chart,
    unsigned_load_chart,
)

from .caches import shared_cache
from .growth_maps import known_detail, known_map
from .limits import MOST_STEPS, Detail
from .own_model import OwnModel, OwnOperation, Parts, own_model, scaled_rotor
from .views import View
from .window import FloquetMap, Window

__all__ = [
    "OWN_CHARTS",
    "OwnPoint",
    "marked",
    "own_chart",
    "own_factors",
    "own_floquet",
    "own_point",
    "own_tongues",
    "own_window",
]

OWN_CHARTS = ("rotor-drawing", "rotor-instability", "rotor-campbell", "rotor-load-frequency")
"""Keys of the charts; a page has no two charts of one key."""
LARGEST_FACTOR = 0.5
"""Largest pulsating load of the stability chart, a share of the buckling load."""
_SPEEDS, _LOADS = 120, 160  # samples of the curves
_LARGEST_SPEED = 4.0  # as the slider
_LOAD_RANGE = (-1.0, 1.1)
_TOP = (3.0, 7.0)  # least and largest frequency at the top of the charts
_ROOM = 1.3  # of the second whirl
_WIDTHS = 1.25  # of the largest sum of two slow whirls: width of the stability chart


@shared_cache(128)
def own_tongues(operation: OwnOperation) -> ResonanceTable:
    """Return the resonance table at the largest pulsating load of the chart."""
    system = operation.model.system(operation.spin_speed)
    return resonances(system, operation.static_load, LARGEST_FACTOR)


@shared_cache(64)
def _resting_frequencies(parts: Parts) -> tuple[float, ...]:
    """Return |ω| of the whirls at rest without load, each pair once, ascending."""
    system = own_model(parts).system(0.0)
    found = np.sort(np.abs(resonances(system, 0.0, 0.0).frequencies.real))
    # each whirl at rest comes as ±ω
    return tuple(float(one) for one in found[::2])


@dataclass(frozen=True)
class OwnPoint:
    """A point of the stability chart.

    Parameters
    ----------
    operation : OwnOperation
    excitation, pulsating_load : float
        In the units of the rotor.
    """

    operation: OwnOperation
    excitation: float
    pulsating_load: float


@shared_cache(64)
def own_floquet(point: OwnPoint) -> FloquetSolution:
    """Return Floquet's answer at a point; NaN growth where it takes too many steps."""
    return floquet_solution(
        point.operation.system,
        point.operation.static_load,
        point.pulsating_load,
        point.excitation,
        most_steps=MOST_STEPS[point.operation.model.kind],
    )


def own_point(operation: OwnOperation, frequency: float, factor: float) -> OwnPoint:
    """Return the marked point; a frequency of 0 is that of the strongest tongue of the chart."""
    high = _frequency_range(operation)[1]
    if not frequency:
        seen = [one for one in own_tongues(operation).tongues if one.centre <= high]
        strongest = max(seen, key=lambda one: one.growth, default=None)
        frequency = high / 3 if strongest is None else strongest.centre
    return OwnPoint(operation, min(frequency, high), factor)


def marked(chart: Chart, point: OwnPoint) -> Chart:
    """Return the stability chart with the marked point."""
    hertz, load = own_factors(point.operation.model.scales)
    layer = marker_layer(point.excitation * hertz, point.pulsating_load * load)
    return replace(chart, layers=(*chart.layers, layer))


def own_factors(scales: Scales) -> tuple[float, float]:
    """Return what one unit of each axis of the stability chart is: in Hz, and in N or kN."""
    return chart_factors("instability", scales, 1.0, 1.0)


def _top(operation: OwnOperation) -> float:
    """Return the largest frequency of the whirl charts: a little above the second pair."""
    found = _resting_frequencies(operation.parts)
    second = found[min(len(found) - 1, 3)]
    return float(np.clip(_ROOM * second, *_TOP))


def _frequency_range(operation: OwnOperation) -> tuple[float, float]:
    """Return the excitation frequencies of the stability chart: sums of the slow whirls."""
    found = _resting_frequencies(operation.parts)
    largest = 2 * found[1]
    if len(found) > 2:
        largest = max(largest, found[0] + found[2])
    return 0.0, float(np.clip(_WIDTHS * largest, 2.6, 7.0))


def own_window(operation: OwnOperation) -> Window:
    """Return the window of the growth map."""
    return Window(operation, View(*_frequency_range(operation), 0.0, LARGEST_FACTOR))


def own_chart(key: str, operation: OwnOperation, detail: Detail) -> Chart:
    """Return one of `OWN_CHARTS`.

    While inputs move, the stability chart has growth only if its full map is kept already: even a
    coarse map takes longer than a message may.
    """
    if key == "rotor-drawing":
        return _drawing(operation.parts)
    if key == "rotor-instability":
        known = known_detail(own_window(operation)) is Detail.FULL
        return _stability(operation, known or detail is Detail.FULL)
    return _campbell(operation) if key == "rotor-campbell" else _load_frequency(operation)


@shared_cache(64)
def _drawing(parts: Parts) -> Chart:
    return rotor_drawing(scaled_rotor(parts))


def _shown(chart: Chart, model: OwnModel) -> Chart:
    """Return a chart in SI under the key of this page."""
    return replace(in_si(chart, model.scales, 1.0, 1.0), key=f"rotor-{chart.key}")


@shared_cache(128)
def _campbell(operation: OwnOperation) -> Chart:
    model = operation.model
    speeds = np.linspace(0.0, _LARGEST_SPEED, _SPEEDS)
    curves = campbell_diagram(model.resting, speeds, operation.static_load)
    found = critical_speeds(model.resting, operation.static_load)
    critical = (*found.forward, *found.backward)
    chart = unsigned_campbell_chart(
        curves, operation.spin_speed, sorted(map(float, critical)), _top(operation)
    )
    return _shown(chart, model)


@shared_cache(128)
def _load_frequency(operation: OwnOperation) -> Chart:
    model = operation.model
    loads = np.linspace(*_LOAD_RANGE, _LOADS)
    curves = load_frequency_curves(model.system(operation.spin_speed), loads)
    chart = unsigned_load_chart(curves, operation.static_load, _top(operation))
    return _shown(chart, model)


@shared_cache(128)
def _stability(operation: OwnOperation, known: bool) -> Chart:
    model, table = operation.model, own_tongues(operation)
    low, high = _frequency_range(operation)
    grid, blanks = None, []
    if known:
        made = known_map(own_window(operation), Detail.FULL)
        grid = _grid(made, (low, high), model.planes)
        drawn_from = min(max(made.drawn_from, low), high)
        if drawn_from > low:
            blanks = [((low, drawn_from, 0.0, LARGEST_FACTOR), "too slow to be drawn")]
    chart = stability_chart_of(
        table.tongues, LARGEST_FACTOR, (low, high), grid, blanks, estimates=model.planes
    )
    return _shown(chart, model)


def _grid(made: FloquetMap, frequencies: tuple[float, float], planes: bool) -> GrowthGrid | None:
    """Return what a map shows; None where nothing of it could be computed.

    With two planes many tongues cross on a coarse grid, where lines along thin ones cannot be
    followed: their first-order estimates are shown instead.
    """
    if made.edges is None or made.rates is None or not math.isfinite(made.drawn_from):
        return None
    top = fitted_top(np.where(made.edges.function > 0, made.rates, 0.0))
    return GrowthGrid(
        made.growth.growth,
        made.growth.unstable,
        None,
        (*frequencies, 0.0, LARGEST_FACTOR),
        edges=made.edges._replace(thin=()) if planes else made.edges,
        rates=made.rates,
        top=top,
    )
