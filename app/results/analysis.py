"""From inputs to charts and key numbers: pure functions, cached and shared by all sessions.

The key of a cache holds the inputs that a result depends on and no others, so a slider recomputes
only what it changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorstab import ResonanceTable, System, bolotin_chart, critical_speeds, resonances
from rotorstab.charts import (
    Chart,
    GrowthGrid,
    campbell_chart,
    instability_chart,
    load_frequency_chart,
)

from ..state import State
from .caches import shared_cache
from .curves import campbell, flutter, load_curves, reference_load, rotor_numbers, whirl_numbers
from .floquet_answer import TABLE_FACTOR, FloquetAnswer, floquet_answer
from .growth_maps import known_map
from .limits import Detail
from .model import Model, model_of
from .window import FloquetMap, Window

__all__ = [
    "CHARTS",
    "Result",
    "solve",
    "window_of",
]

CHARTS = ("instability", "load-frequency", "campbell")
BOUNDARY_ROWS = 120  # loads at which Bolotin's boundaries are computed
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


def _loads(inputs: Mapping[str, Any], system: System) -> tuple[float, float]:
    """Return the load that the load factors refer to, and the static load.

    Raises
    ------
    ValueError
        With words for the page, where the rotor has no such load or the exact law ends below it.
    """
    reference = reference_load(inputs["model"].rotor, inputs["reference"])
    static = inputs["static_load_factor"] * reference
    peak = static + TABLE_FACTOR * reference
    if peak >= system.largest_load:
        raise ValueError(
            f"With the exact stiffness law the load must stay below p̄ = {system.largest_load:.4g}, "
            f"where a shaft clamped at both ends buckles. Here p̄₀ = {static:.4g}, and with "
            f"β_d = {TABLE_FACTOR:g} the load reaches {peak:.4g}: choose a smaller static load "
            "factor α_s."
        )
    return reference, static


def _window(inputs: Mapping[str, Any]) -> Window:
    """Return the window of the growth map."""
    model: Model = inputs["model"]
    spin, tangency = inputs["spin_speed"], inputs["tangency"]
    frequency = rotor_numbers(model.rotor)[1]
    reference, static = _loads(inputs, model.system(spin, tangency))
    return Window(
        model,
        spin,
        tangency,
        static,
        inputs["lowest_frequency"] * frequency,
        inputs["highest_frequency"] * frequency,
        inputs["largest_factor"] * reference,
    )


@shared_cache(128)
def _solve(items: tuple[tuple[str, Any], ...], detail: Detail) -> Result:
    inputs = dict(items)
    model: Model = inputs["model"]
    spin, tangency = inputs["spin_speed"], inputs["tangency"]
    frequency = rotor_numbers(model.rotor)[1]
    system = model.system(spin, tangency)
    reference, static = _loads(inputs, system)
    made = known_map(_window(inputs), detail)
    table = resonances(system, static, TABLE_FACTOR * reference)
    ends_at = (system.largest_load - static) / reference
    charts = (
        _instability_chart(inputs, made, table, (reference, static), ends_at),
        _load_frequency_chart(inputs, static),
        campbell_chart(campbell(model, tangency, static), spin, critical_speeds(system, static)),
    )
    return Result(
        charts={chart.key: chart for chart in charts},
        numbers=_key_numbers(inputs, system, reference, static),
        floquet=floquet_answer(
            made,
            table,
            detail,
            fundamental=frequency,
            reference=reference,
            frequency_range=_frequency_range(inputs),
            largest_factor=inputs["largest_factor"],
            ends_at=ends_at,
        ),
    )


def _frequency_range(inputs: Mapping[str, Any]) -> tuple[float, float]:
    return inputs["lowest_frequency"], inputs["highest_frequency"]


def _instability_chart(
    inputs: Mapping[str, Any],
    made: FloquetMap,
    table: ResonanceTable,
    loads: tuple[float, float],
    ends_at: float,
) -> Chart:
    model: Model = inputs["model"]
    frequency = rotor_numbers(model.rotor)[1]
    reference, static = loads
    top = inputs["largest_factor"]
    undamped = model.undamped().system(inputs["spin_speed"], inputs["tangency"])
    grid = GrowthGrid(
        made.growth.growth,
        made.growth.unstable,
        made.mask,
        inputs["growth_unit"] == "per period",
        made.outlines,
    )
    return instability_chart(
        bolotin_chart(undamped, static, min(top, ends_at) * reference, BOUNDARY_ROWS),
        frequency,
        reference,
        _frequency_range(inputs),
        top,
        grid,
        [(row.centre / frequency, row.name) for row in table.tongues],
    )


def _load_frequency_chart(inputs: Mapping[str, Any], static: float) -> Chart:
    model: Model = inputs["model"]
    spin = inputs["spin_speed"]
    curves = load_curves(model, spin, inputs["tangency"], inputs["stiffness"])
    # the flutter load is that of the linear law, whatever law the curves are of
    has_exact = any(name.endswith(" exact") for name in curves)
    limits = {
        "buckling": rotor_numbers(model.rotor)[0],
        "flutter, linear" if has_exact else "flutter": flutter(model.rotor, spin),
    }
    return load_frequency_chart(curves, static, limits)


def _key_numbers(
    inputs: Mapping[str, Any], system: System, reference: float, static: float
) -> dict[str, Any]:
    """Return the key numbers of the page, non-dimensional; `Result` says which."""
    rotor = inputs["model"].rotor
    buckling, frequency, _ = rotor_numbers(rotor)
    flutter_load = flutter(rotor, inputs["spin_speed"])
    return {
        "buckling": buckling,
        "fundamental": frequency,
        "flutter": flutter_load if np.isfinite(flutter_load) else None,
        "static_load": static,
        "reference": reference,
        "whirl": whirl_numbers(system, static),
        # a rigid body has Ī_P ≤ 2 Ī_D
        "rigid": rotor.polar_inertia <= 2 * rotor.diametral_inertia * (1 + _ROUNDING),
    }


def _drawn(state: State) -> dict[str, Any]:
    """Return the inputs that the Explore page's results depend on."""
    inputs = state.inputs()
    drawn = {
        name: inputs[name]
        for name in (
            "static_load_factor",
            "spin_speed",
            "reference",
            "largest_factor",
            "lowest_frequency",
            "highest_frequency",
            "stiffness",
            "growth_unit",
        )
    }
    drawn["tangency"] = state.effective_tangency()
    drawn["model"] = model_of(state)
    return drawn


def window_of(state: State) -> Window:
    """Return the window of the state's growth map; ValueError as `solve`."""
    return _window(_drawn(state))


def solve(state: State, detail: Detail = Detail.REFINED) -> Result:
    """Return the charts and key numbers of the state's present inputs.

    Parameters
    ----------
    state : State
    detail : Detail
        Of the growth map; coarse while sliders move.

    Raises
    ------
    ValueError
        With words for the page, where these inputs have no answer.
    """
    return _solve(tuple(_drawn(state).items()), detail)
