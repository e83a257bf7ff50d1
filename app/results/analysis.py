"""From inputs to charts and key numbers: pure, cached, shared by all sessions.

Caches are keyed by the inputs that matter to a result, so a slider recomputes only what
it changes. Their size is bounded; their arrays are read-only.
"""

from __future__ import annotations

import math
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
from rotorstab.maps.stability_map import StabilityChart

from ..state import State
from .caches import shared_cache
from .curves import campbell, flutter, load_curves, reference_load, rotor_numbers, whirl_numbers
from .growth_maps import known_map
from .limits import Detail
from .model import Model, model_of
from .window import Window

__all__ = [
    "CHARTS",
    "FloquetAnswer",
    "Result",
    "solve",
    "window_of",
]

CHARTS = ("instability", "load-frequency", "campbell")
BOUNDARY_ROWS = 120
TABLE_FACTOR = 0.1  # β_d at which the resonance table and its widths are told


@dataclass(frozen=True, eq=False)
class FloquetAnswer:
    """What Floquet says of the chart's window.

    Parameters
    ----------
    table : ResonanceTable
        Every pair of modes at β_d = 0.1.
    frequency_range : (float, float)
        Of the chart, in ω_n.
    fundamental_frequency, reference_load : float
        ω_n and what β_d = 1 stands for.
    unstable_share, bolotin_share, both_share : float
        Shares of the computed part of the chart, NaN where nothing is.
    unstable_from : float
        Lowest β_d of an unstable pixel, inf where there is none.
    detail : Detail
        Of the growth map: on a coarse one thin tongues have no true area.
    followed_from : float
        θ/ω_n below which the map is blank: the load is too slow to be followed; 0 where it is not.
    ends_at : float
        β_d above which the map is blank, since the exact law ends; inf where it does not.
    unknown_share : float
        Share of the other pixels that are blank: the growth within a period is too strong there.
    has_tongues : bool
        Whether the window holds a tongue, be it too thin for the centre of any pixel.
    """

    table: ResonanceTable
    frequency_range: tuple[float, float]
    fundamental_frequency: float
    reference_load: float
    unstable_share: float
    bolotin_share: float
    both_share: float
    unstable_from: float = math.inf
    detail: Detail = Detail.REFINED
    followed_from: float = 0.0
    ends_at: float = math.inf
    unknown_share: float = 0.0
    has_tongues: bool = False


@dataclass(frozen=True, eq=False)
class Result:
    """What the Explore page shows for one set of inputs."""

    charts: dict[str, Chart]
    numbers: dict[str, Any]
    floquet: FloquetAnswer


def _followed_from(growth: StabilityChart, fundamental_frequency: float) -> float:
    """Return the lowest θ/ω_n that the map shows, inf where it is blank, 0 where it is whole."""
    known = np.isfinite(growth.growth).any(axis=0)
    if known.all():
        return 0.0
    shown = growth.excitation_frequencies[known]
    return float(shown.min()) / fundamental_frequency if shown.size else np.inf


def _unknown_share(growth: StabilityChart) -> float:
    """Return the share of blank pixels in the rows and columns that are not blank as a whole."""
    known = np.isfinite(growth.growth)
    inside = known[np.ix_(known.any(axis=1), known.any(axis=0))]
    return float(1 - inside.mean()) if inside.size else 0.0


def _shares(growth: StabilityChart, mask: np.ndarray, reference: float) -> dict[str, float]:
    """Return the shares of the window's computed part, and the lowest unstable β_d."""
    known = np.isfinite(growth.growth)
    # areas by the pixels' centres: a thin tongue that marks a pixel does not fill it
    grows = (growth.growth > growth.error) & known
    rows = growth.pulsating_loads[grows.any(axis=1)]
    count = int(known.sum())
    return {
        name: int((part & known).sum()) / count if count else math.nan
        for name, part in (
            ("unstable_share", grows),
            ("bolotin_share", mask),
            ("both_share", mask & grows),
        )
    } | {"unstable_from": float(rows.min()) / reference if rows.size else math.inf}


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
    """Return what the growth map depends on."""
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
    rotor, spin, tangency = model.rotor, inputs["spin_speed"], inputs["tangency"]
    buckling, frequency, _ = rotor_numbers(rotor)
    top = inputs["largest_factor"]
    frequency_range = (inputs["lowest_frequency"], inputs["highest_frequency"])
    system = model.system(spin, tangency)
    reference, static = _loads(inputs, system)
    plain = model.undamped().system(spin, tangency)
    ends_at = (system.largest_load - static) / reference
    flutter_now = flutter(rotor, spin)
    made = known_map(_window(inputs), detail)
    growth, mask = made.growth, made.mask
    grid = GrowthGrid(
        growth.growth,
        growth.unstable,
        mask,
        inputs["growth_unit"] == "per period",
        made.outlines,
    )
    table = resonances(system, static, TABLE_FACTOR * reference)
    curves = load_curves(model, spin, tangency, inputs["stiffness"])
    # the flutter load is that of the linear law, whatever the curves are of
    has_exact = any(name.endswith(" exact") for name in curves)
    charts = (
        instability_chart(
            bolotin_chart(plain, static, min(top, ends_at) * reference, BOUNDARY_ROWS),
            frequency,
            reference,
            frequency_range,
            top,
            grid,
            [(row.centre / frequency, row.name) for row in table.tongues],
        ),
        load_frequency_chart(
            curves,
            static,
            {"buckling": buckling, "flutter, linear" if has_exact else "flutter": flutter_now},
        ),
        campbell_chart(campbell(model, tangency, static), spin, critical_speeds(system, static)),
    )
    return Result(
        charts={chart.key: chart for chart in charts},
        numbers={
            "buckling": buckling,
            "fundamental": frequency,
            "flutter": flutter_now if np.isfinite(flutter_now) else None,
            "static_load": static,
            "reference": reference,
            "whirl": whirl_numbers(system, static),
            "rigid": rotor.polar_inertia <= 2 * rotor.diametral_inertia * (1 + 1e-12),
        },
        floquet=FloquetAnswer(
            table=table,
            frequency_range=frequency_range,
            fundamental_frequency=frequency,
            reference_load=reference,
            **_shares(growth, mask, reference),
            detail=detail,
            followed_from=_followed_from(growth, frequency),
            ends_at=ends_at if ends_at < top else math.inf,
            unknown_share=_unknown_share(growth),
            has_tongues=bool(made.outlines)
            or any(
                row.threshold < top * reference
                and frequency_range[0] < row.centre / frequency < frequency_range[1]
                for row in table.tongues
            ),
        ),
    )


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
