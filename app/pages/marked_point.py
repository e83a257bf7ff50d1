"""What is inside one point of the instability chart: motion, multipliers, words, marks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from rotorstab import TimeResponse, in_bolotin_region
from rotorstab.charts import Chart, Layer, in_seconds, marker_layer, pair_layers

from ..results.analysis import Result
from ..results.marked_point import marked_point, solve_point
from ..results.nearest import nearest_pair
from ..results.operation import operation_of
from ..state import State
from ..words.point import Fact, describe, point_sentence
from ..words.si import shown_scales
from .animation import animation

__all__ = ["INSPECTOR_CHARTS", "Inspection", "inspect", "with_marks"]

INSPECTOR_CHARTS = ("response", "multipliers", "orbit")
_STRONG_GROWTH = 2.0  # powers of 10 over the response from which on the growth is named


@dataclass(frozen=True, eq=False)
class Inspection:
    """What the page shows of one point.

    Parameters
    ----------
    charts : dict of str to Chart
        In the units that the user chose.
    sentence : str
        What is true at the point, in plain words.
    explanation : str
        The same with its reasons, for who asks.
    facts : list of Fact
        The point in numbers, for the page.
    motion : dict
        What the animation needs, plain values.
    """

    charts: dict[str, Chart]
    sentence: str
    explanation: str
    facts: list[Fact]
    motion: dict[str, Any]


def with_marks(charts: dict[str, Chart], state: State, result: Result) -> dict[str, Chart]:
    """Return the three charts with the marker, and the nearest pair of modes, drawn on them."""
    excitation = operation_of(state).excitation_frequency(state.marker_frequency)
    marks: dict[str, Sequence[Layer]] = {
        "instability": [marker_layer(state.marker_frequency, state.marker_factor)]
    }
    pair = nearest_pair(result.floquet.table, excitation)
    if pair is not None:
        for key, x in (
            ("load-frequency", result.numbers["static_load"]),
            ("campbell", state.spin_speed),
        ):
            marks[key] = pair_layers(x, pair.frequencies, pair.name, excitation)
    return {
        key: replace(chart, layers=(*chart.layers, *marks.get(key, ())))
        for key, chart in charts.items()
    }


def inspect(state: State, result: Result) -> Inspection:
    """Return what is inside the marked point.

    Raises
    ------
    UserError
        Where this point has no answer.
    """
    point, start = marked_point(state)
    answer = solve_point(point, start)
    bolotin = bool(in_bolotin_region(point.operation.undamped, *point.loads, point.excitation))
    pair = nearest_pair(result.floquet.table, point.excitation)
    facts, explanation = describe(state, answer.floquet, bolotin, pair, result)
    facts += _facts_of_motion(answer.response, round(state.periods))
    scales = shown_scales(state)
    charts = answer.charts
    if scales is not None:
        seconds = answer.response.period / scales.frequency
        charts = charts | {"response": in_seconds(charts["response"], seconds)}
    return Inspection(
        charts=charts,
        sentence=point_sentence(answer.floquet, point.excitation, result.floquet.table),
        explanation=explanation,
        facts=facts,
        motion=animation(point, answer.response, answer.samples, scales),
    )


def _facts_of_motion(response: TimeResponse, wanted: int) -> list[Fact]:
    """Return what the response chart does not say: that it is shorter, or grows strongly."""
    facts = []
    shown = round(response.time[-1] / response.period)
    if shown < wanted:
        facts.append(Fact("Periods shown", f"{shown}: more would take too long to compute"))
    powers = response.growth_rate * float(response.time[-1]) / math.log(10)
    if powers > _STRONG_GROWTH:
        power = f"by a factor of 10 to the power {powers:.1f}"
        facts.append(Fact("Growth over the time shown", power))
    return facts
