"""From inputs to charts and key numbers: pure, cached, shared by all sessions.

Caches are keyed by the inputs that matter to a result, so a slider recomputes only what
it changes. Their size is bounded; their arrays are read-only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np

from rotorstab import (
    ShaftDisk,
    System,
    WhirlCurves,
    bolotin_chart,
    campbell_diagram,
    critical_load,
    critical_speeds,
    flutter_load,
    fundamental_frequency,
    load_frequency_curves,
    lumped,
)
from rotorstab.charts import (
    Chart,
    campbell_chart,
    error_loads,
    instability_chart,
    load_frequency_chart,
    stiffness_charts,
)
from rotorstab.figures import FIGURES, Figure
from rotorstab.stiffness import largest_exact_load

from .state import State

__all__ = ["CHARTS", "Result", "error_table", "paper_figure", "solve", "stiffness_comparison"]

CHARTS = ("instability", "load-frequency", "campbell")
BOUNDARY_ROWS = 120
LOADS = 400
SPEEDS = 200
LARGEST_SPEED = float(State.param.spin_speed.bounds[1])


@dataclass(frozen=True, eq=False)
class Result:
    """What the Explore page shows for one set of inputs."""

    charts: dict[str, Chart]
    numbers: dict[str, Any]


@lru_cache(maxsize=256)
def _rotor_numbers(rotor: ShaftDisk) -> tuple[float, float, float]:
    """Return p̄_cr, ω_n and the follower flutter load, all of the resting rotor."""
    at_rest = lumped(rotor, 0.0, 1.0)
    buckling = float(critical_load(rotor.shear))
    return buckling, fundamental_frequency(at_rest), flutter_load(at_rest)


@lru_cache(maxsize=256)
def _flutter(rotor: ShaftDisk, spin_speed: float) -> float:
    return flutter_load(lumped(rotor, spin_speed, 1.0))


def _loads(rotor: ShaftDisk, spin_speed: float) -> np.ndarray:
    """Return the load axis: from tension to past buckling and flutter, where they are near."""
    buckling = _rotor_numbers(rotor)[0]
    pole = float(largest_exact_load(rotor.shear))
    flutter = _flutter(rotor, spin_speed)
    far = max(1.6 * buckling, 1.2 * flutter if flutter < 0.8 * pole else 0.0)
    step = 0.5
    low = -step * np.ceil(buckling / step)
    return np.linspace(low, min(step * np.ceil(far / step), 0.9 * pole), LOADS)


@lru_cache(maxsize=128)
def _load_curves(
    rotor: ShaftDisk, spin_speed: float, tangency: float, stiffness: str
) -> dict[str, WhirlCurves]:
    loads = _loads(rotor, spin_speed)
    kinds = {"axial": 0.0, "follower": 1.0}
    if tangency not in kinds.values():
        kinds["partly"] = tangency
    laws = {"linear": ("linear",), "exact": ("exact",), "both": ("linear", "exact")}[stiffness]
    return {
        kind + (" exact" if law == "exact" else ""): load_frequency_curves(
            lumped(rotor, spin_speed, share, stiffness=law), loads
        )
        for law in laws
        for kind, share in kinds.items()
    }


@lru_cache(maxsize=128)
def _campbell(rotor: ShaftDisk, tangency: float, load: float) -> WhirlCurves:
    speeds = np.linspace(0.0, LARGEST_SPEED, SPEEDS)
    return campbell_diagram(lumped(rotor, 0.0, tangency), speeds, load)


def _frequencies(system: System, load: float) -> dict[str, list[float]]:
    """Return the four whirl frequencies by name, as [real, imaginary]."""
    curves = load_frequency_curves(system, np.linspace(0.0, load, 24) if load else [0.0])
    return {
        name: [float(value.real), float(value.imag)]
        for name, value in zip(curves.names, curves.frequencies[-1], strict=True)
    }


@lru_cache(maxsize=512)
def _solve(items: tuple[tuple[str, Any], ...]) -> Result:
    inputs = dict(items)
    rotor: ShaftDisk = inputs["rotor"]
    spin, tangency = inputs["spin_speed"], inputs["tangency"]
    buckling, frequency, flutter_at_rest = _rotor_numbers(rotor)
    reference = buckling if inputs["reference"] == "buckling" else flutter_at_rest
    if not np.isfinite(reference):
        raise ValueError(
            "this rotor has no flutter load: let the load factors refer to static buckling"
        )
    static = inputs["static_load_factor"] * reference
    system = lumped(rotor, spin, tangency)
    flutter = _flutter(rotor, spin)
    limits = {"buckling": buckling, "flutter": flutter}
    charts = (
        instability_chart(
            bolotin_chart(system, static, inputs["largest_factor"] * reference, BOUNDARY_ROWS),
            frequency,
            reference,
            (inputs["lowest_frequency"], inputs["highest_frequency"]),
            inputs["largest_factor"],
        ),
        load_frequency_chart(
            _load_curves(rotor, spin, tangency, inputs["stiffness"]), static, limits
        ),
        campbell_chart(_campbell(rotor, tangency, static), spin, critical_speeds(system, static)),
    )
    return Result(
        charts={chart.key: chart for chart in charts},
        numbers={
            "buckling": buckling,
            "fundamental": frequency,
            "flutter": flutter if np.isfinite(flutter) else None,
            "static_load": static,
            "reference": reference,
            "whirl": _frequencies(system, static),
            "rigid": rotor.polar_inertia <= 2 * rotor.diametral_inertia * (1 + 1e-12),
        },
    )


def solve(state: State) -> Result:
    """Return the charts and key numbers of the state's present inputs.

    Raises
    ------
    ValueError
        With words for the page, where these inputs have no answer.
    """
    inputs = state.inputs()
    for name in ("shear", "disk_mass", "diametral_inertia", "polar_inertia"):
        inputs.pop(name)
    inputs |= {"rotor": state.rotor(), "tangency": state.effective_tangency()}
    del inputs["load_type"]
    return _solve(tuple(inputs.items()))


@lru_cache(maxsize=128)
def stiffness_comparison(shear: float, tangency: float) -> dict[str, Chart]:
    """Return the charts of exact against linear coefficients by key.

    The load range is the paper's: ±p̄_cr axial, ±12.3 follower, in between by μ.
    """
    reach = float(critical_load(shear)) * (1 + tangency * 4.2)
    return {chart.key: chart for chart in stiffness_charts(shear, tangency, (-reach, reach))}


@lru_cache(maxsize=128)
def error_table(shear: float, tangency: float) -> list[list[float]]:
    """Return [tension 1 %, compression 1 %, tension 5 %, compression 5 %] of k̄₁₁ and k̄₂₂."""
    one, five = (error_loads(shear, tangency, level) for level in (0.01, 0.05))
    return [[*map(float, one[i, i]), *map(float, five[i, i])] for i in (0, 1)]


@cache
def paper_figure(number: int) -> Figure:
    """Return a figure of the paper, by its number."""
    return FIGURES[number]()
