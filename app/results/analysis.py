"""From inputs to charts and key numbers: pure functions, cached and shared by all sessions.

The key of a cache holds the inputs that a result depends on and no others, so a slider recomputes
only what it changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorstab import ResonanceTable, bolotin_chart, resonances
from rotorstab.charts import Chart, GrowthGrid, instability_chart

from ..state import State, Use, names_for
from .caches import shared_cache
from .curves import flutter, rotor_numbers, whirl_numbers
from .floquet_answer import TABLE_FACTOR, FloquetAnswer, floquet_answer
from .growth_maps import known_map
from .limits import Detail
from .model import Operation
from .operation import check_peak, operation_of
from .views import View
from .whirl_charts import WHIRL_CHARTS, whirl_chart
from .window import FloquetMap, Window

__all__ = [
    "CHARTS",
    "GROWTH_TOPS",
    "Result",
    "home_view",
    "solve",
    "window_of",
]

CHARTS = ("instability", *WHIRL_CHARTS)
BOUNDARY_ROWS, MOST_BOUNDARY_ROWS = 120, 1200  # loads at which Bolotin's boundaries are computed
GROWTH_TOPS = {"per time": 0.2, "per period": 1.0}
"""Growth σ̄ or σ̄T at the upper end of the colours; faster growth has the last colour. They suit the
paper's rotor, and stay the same while one explores."""
_TOO_SLOW = "not drawn: load too slow"
_SMALLER_STATIC_LOAD = "choose a smaller static load factor α_s"
_ROUNDING = 1e-12  # by which Ī_P may exceed 2 Ī_D and still be equal


@dataclass(frozen=True, eq=False)
class Result:
    """What the Explore page shows for one set of inputs.

    Parameters
    ----------
    charts : dict of str to Chart
        Non-dimensional, by key.
    numbers : dict
        Key numbers, non-dimensional: loads "buckling", "flutter" (or None), "static_load" and
        "reference", ω_n as "fundamental", [real, imaginary] of each "whirl" by mode (see
        `whirl_numbers`), and whether the disk can be a "rigid" body.
    floquet : FloquetAnswer
    """

    charts: dict[str, Chart]
    numbers: dict[str, Any]
    floquet: FloquetAnswer


def home_view(inputs: Mapping[str, Any]) -> View:
    """Return what the instability chart shows without a zoom."""
    return View(*_frequency_range(inputs), 0.0, inputs["largest_factor"])


def _window(inputs: Mapping[str, Any], view: View | None) -> Window:
    """Return the window of the growth map."""
    operation: Operation = inputs["operation"]
    check_peak(operation, TABLE_FACTOR, _SMALLER_STATIC_LOAD)
    return Window(operation, view or home_view(inputs))


@shared_cache(128)
def _solve(items: tuple[tuple[str, Any], ...], detail: Detail, view: View | None) -> Result:
    inputs = dict(items)
    operation: Operation = inputs["operation"]
    window = _window(inputs, view)
    system, static, reference = operation.system, operation.static_load, operation.reference_load
    made, seen = known_map(window, detail), window.view
    table = resonances(system, static, operation.pulsating_load(TABLE_FACTOR))
    end_of_law = (system.largest_load - static) / reference
    charts = (
        _instability_chart(inputs, made, table, end_of_law, seen, detail),
        *(whirl_chart(key, operation, inputs["stiffness"]) for key in WHIRL_CHARTS),
    )
    return Result(
        charts={chart.key: chart for chart in charts},
        numbers=_key_numbers(operation),
        floquet=floquet_answer(
            made,
            table,
            detail,
            fundamental=operation.fundamental_frequency,
            reference=reference,
            frequency_range=(seen.left, seen.right),
            largest_factor=seen.high,
            end_of_law=end_of_law,
        ),
    )


def _frequency_range(inputs: Mapping[str, Any]) -> tuple[float, float]:
    return inputs["lowest_frequency"], inputs["highest_frequency"]


def _instability_chart(
    inputs: Mapping[str, Any],
    made: FloquetMap,
    table: ResonanceTable,
    end_of_law: float,
    seen: View,
    detail: Detail,
) -> Chart:
    operation: Operation = inputs["operation"]
    frequency, reference = operation.fundamental_frequency, operation.reference_load
    top = seen.high
    largest = operation.pulsating_load(min(top, end_of_law))
    grid = GrowthGrid(
        made.growth.growth,
        made.growth.unstable,
        made.mask,
        (seen.left, seen.right, seen.low, seen.high),
        inputs["growth_unit"] == "per period",
        made.edges,
        made.rates,
        GROWTH_TOPS[inputs["growth_unit"]],
    )
    drawn_from = min(max(made.drawn_from / frequency, seen.left), seen.right)
    # as many rows in what is seen, however small a part of the loads it is
    rows = min(MOST_BOUNDARY_ROWS, round(BOUNDARY_ROWS * top / (top - seen.low)))
    return instability_chart(
        bolotin_chart(operation.undamped, operation.static_load, largest, rows),
        frequency,
        reference,
        (seen.left, seen.right),
        (seen.low, top),
        grid,
        [(row.centre / frequency, row.name) for row in table.tongues],
        _blanks(seen, drawn_from, min(max(end_of_law, seen.low), top), detail),
    )


def _blanks(
    seen: View, drawn_from: float, end_of_law: float, detail: Detail
) -> list[tuple[tuple[float, float, float, float], str]]:
    """Return the parts of the instability chart that are not computed, and why."""
    found = []
    if end_of_law < seen.high:
        box = (seen.left, seen.right, end_of_law, seen.high)
        found.append((box, "beyond the exact stiffness law"))
    if drawn_from > seen.left and end_of_law > seen.low:
        reason = "computed at rest" if detail is Detail.COARSE else _TOO_SLOW
        found.append(((seen.left, drawn_from, seen.low, end_of_law), reason))
    return found


def _key_numbers(operation: Operation) -> dict[str, Any]:
    """Return the key numbers of the page, non-dimensional; `Result` says which."""
    rotor = operation.model.rotor
    flutter_load = flutter(rotor, operation.spin_speed)
    return {
        "buckling": rotor_numbers(rotor).buckling_load,
        "fundamental": operation.fundamental_frequency,
        "flutter": flutter_load if np.isfinite(flutter_load) else None,
        "static_load": operation.static_load,
        "reference": operation.reference_load,
        "whirl": whirl_numbers(operation.system, operation.static_load),
        # a rigid body has Ī_P ≤ 2 Ī_D
        "rigid": rotor.polar_inertia <= 2 * rotor.diametral_inertia * (1 + _ROUNDING),
    }


def _drawn(state: State) -> dict[str, Any]:
    """Return what the Explore page's results depend on."""
    inputs = {name: getattr(state, name) for name in names_for(Use.PICTURE)}
    return inputs | {"operation": operation_of(state)}


def window_of(state: State, view: View | None = None) -> Window:
    """Return the window of the state's growth map; UserError as `solve`."""
    return _window(_drawn(state), view)


def solve(state: State, detail: Detail = Detail.FULL, view: View | None = None) -> Result:
    """Return the charts and key numbers of the state's present inputs.

    Parameters
    ----------
    state : State
    detail : Detail
        Of the growth map; coarse while sliders move.
    view : View, optional
        The part of the instability chart that a zoom shows; the other charts are whole.

    Raises
    ------
    UserError
        Where these inputs have no answer.
    """
    return _solve(tuple(_drawn(state).items()), detail, view)
