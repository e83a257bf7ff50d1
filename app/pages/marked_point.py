"""What is inside one point of the instability chart: motion, multipliers, words, marks."""

from __future__ import annotations

import math
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np

from rotorstab import (
    Scales,
    System,
    TimeResponse,
    in_bolotin_region,
    initial_conditions,
    shaft_shape,
    time_response,
    whirl_frequencies,
)
from rotorstab.charts import (
    Chart,
    Layer,
    in_seconds,
    marker_layer,
    multiplier_chart,
    orbit_chart,
    pair_layers,
    response_chart,
)
from rotorstab.floquet.kicks import harmonic_count
from rotorstab.floquet.point import FloquetSolution, floquet_solution
from rotorstab.model.stiffness import largest_exact_load

from ..results import limits
from ..results.analysis import Result
from ..results.caches import shared_cache
from ..results.model import Model, model_of
from ..state import State
from ..words.point import Pair, describe
from ..words.si import load_in, shown_scales

__all__ = ["INSPECTOR_CHARTS", "Inspection", "inspect", "marked"]

INSPECTOR_CHARTS = ("response", "multipliers", "orbit")
_SAMPLES = (24, 600)  # a period
_RATE_ERROR, _MOTION_ERROR = 1e-4, 1e-6  # of ln|μ| and of one sample: above, nothing is shown
_PER_CYCLE = 14  # samples in one cycle of the fastest whirl
_STEPS_PER_SAMPLE = 5  # at least
_POINTS = 25  # of the shaft's shape
_TOO_SLOW = (
    "One period of this load takes more steps than can be followed while others wait, since the "
    "rotor moves or dies away too fast against it: move the marker to a higher θ/ωₙ."
)


@dataclass(frozen=True, eq=False)
class Inspection:
    """One point, looked into.

    Parameters
    ----------
    charts : dict of str to Chart
    facts : list of [name, value]
        The point in words, for the page.
    sentence : str
        The same as one sentence or two.
    motion : dict
        What the animation needs, plain values.
    response : TimeResponse
    samples : int
        Of the response, a period.
    """

    charts: dict[str, Chart]
    facts: list[list[str]]
    sentence: str
    motion: dict[str, Any]
    response: TimeResponse
    samples: int


@dataclass(frozen=True, eq=False)
class _Point:
    """Loads and frequencies of the marker."""

    model: Model
    spin_speed: float
    tangency: float
    static: float
    pulsating: float
    excitation: float
    initial: str
    seed: int
    periods: int


def _nearest_pair(result: Result, excitation: float) -> Pair | None:
    """Return the pair of first and second modes whose frequencies differ by the nearest to θ̄."""
    table = result.floquet.table
    known = {
        name: float(np.real(one))
        for name, one in zip(table.modes, table.frequencies, strict=True)
        if name[0] in "12" and len(name) == 2
    }
    best: Pair | None = None
    for first, second in combinations(known, 2):
        pair = known[first], known[second]
        gap = abs(pair[0] - pair[1])
        if best is None or abs(gap - excitation) < abs(
            abs(best.frequencies[0] - best.frequencies[1]) - excitation
        ):
            row = next(row for row in table if {row.first, row.second} == {first, second})
            word = "difference" if first[-1] == second[-1] else "sum"
            best = Pair(row.name, pair, f"{word} of {first} and {second}", row.threshold)
    return best


def marked(charts: dict[str, Chart], state: State, result: Result) -> dict[str, Chart]:
    """Return the three charts with the marker on them."""
    excitation = state.marker_frequency * result.numbers["fundamental"]
    marks: dict[str, Sequence[Layer]] = {
        "instability": [marker_layer(state.marker_frequency, state.marker_factor)]
    }
    pair = _nearest_pair(result, excitation)
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


def _floats(values: Any) -> str:
    """Return little-endian 32-bit floats as base64."""
    return b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode()


def _motion(
    point: _Point, motion: TimeResponse, samples: int, scales: Scales | None
) -> dict[str, Any]:
    """Return what the animation draws, sizes relative to the largest excursion."""
    load, unit = (1.0, "") if scales is None else load_in(scales)
    pole = float(largest_exact_load(point.model.rotor.shear))
    shapes = shaft_shape(
        point.model.rotor, min(point.static, 0.9 * pole), np.eye(2), _POINTS
    ).displacement
    largest = float(np.abs(motion.displacement).max()) or 1.0
    u, psi = motion.displacement / largest, motion.slope / largest
    return {
        "tip": _floats([u.real, u.imag, psi.real, psi.imag]),
        "shapes": [[round(float(one), 6) for one in row] for row in shapes],
        "samples": samples,
        "period": motion.period,
        "growth": motion.growth_rate,
        "largest": largest if motion.log_scale == 0 else None,
        "static": point.static * load,
        "pulsating": point.pulsating * load,
        "load": ["P", f" {unit}"] if unit else ["p̄", ""],
        "tangency": point.tangency,
        "spin": point.spin_speed,
        "fastest": float(max(point.excitation, _pace_of(motion))),
    }


def _pace_of(motion: TimeResponse) -> float:
    """Return the mean angular speed of the tip about the axis, for the pace of the animation."""
    turned = np.angle(np.exp(1j * np.diff(np.angle(motion.displacement))))
    size = np.abs(motion.displacement[1:])
    # growth may have taken the tip near the end of double precision
    weights = size / (size.max() or 1.0)
    total = float(weights.sum())
    if total == 0:
        return 0.0
    return float(np.abs(turned) @ weights / total / (motion.time[1] - motion.time[0]))


@shared_cache(64)
def _respond(
    model: Model,
    spin_speed: float,
    tangency: float,
    loads: tuple[float, float],
    excitation: float,
    start: tuple[str, int],
    periods: int,
) -> tuple[TimeResponse, FloquetSolution, int, dict[str, Chart]]:
    """Return the response, Floquet's answer, the samples a period and the charts."""
    system = model.system(spin_speed, tangency)
    static, pulsating = loads
    kind, seed = start
    fastest = _fastest(model, spin_speed, tangency, static)
    if fastest > limits.MOST_CYCLES * excitation:
        raise ValueError(
            f"The whirl makes {fastest / excitation:.0f} cycles in one period of this load, "
            f"more than can be followed ({limits.MOST_CYCLES}): move the marker to a higher θ/ωₙ."
        )
    initial = initial_conditions(system, static, kind.replace(" ", ":"), seed)
    steps = _most_steps(model, system, loads)
    floquet = floquet_solution(system, static, pulsating, excitation, most_steps=steps)
    period = 2 * math.pi / excitation
    if not (floquet.converged or float(floquet.error) * period < _RATE_ERROR):
        raise ValueError(_TOO_SLOW)
    samples = int(np.clip(_PER_CYCLE * fastest / excitation, *_SAMPLES))
    samples = max(_SAMPLES[0], min(samples, steps // _STEPS_PER_SAMPLE))
    periods = max(1, min(periods, limits.MOST_SAMPLES // samples))
    try:
        motion = time_response(
            system, static, pulsating, excitation, initial, periods, samples, most_steps=steps
        )
    except ValueError:
        raise ValueError(_TOO_SLOW) from None
    if not motion.error < _MOTION_ERROR:
        raise ValueError(_TOO_SLOW)
    charts = (response_chart(motion), multiplier_chart(floquet.multipliers), orbit_chart(motion))
    return motion, floquet, samples, {chart.key: chart for chart in charts}


def _most_steps(model: Model, system: System, loads: tuple[float, float]) -> int:
    """Return how many steps of a period the server's one thread has time for."""
    if system.is_linear:
        return limits.MOST_STEPS[model.kind]
    static, pulsating = (np.array([load]) for load in loads)
    return int(
        limits.EXACT_STEPS
        / (1 + harmonic_count(system, (static, pulsating)) / limits.EXACT_HARMONICS)
    )


@shared_cache(64)
def _fastest(model: Model, spin_speed: float, tangency: float, static: float) -> float:
    """Return the largest whirl frequency of the first two modes each way."""
    values = whirl_frequencies(model.system(spin_speed, tangency), static).real
    half = len(values) // 2
    return float(np.abs(values[max(0, half - 2) : half + 2]).max())


def inspect(state: State, result: Result) -> Inspection:
    """Return what is inside the marked point.

    Raises
    ------
    ValueError
        With words for the page, where this point has no answer.
    """
    model = model_of(state)
    reference = result.numbers["reference"]
    point = _Point(
        model=model,
        spin_speed=state.spin_speed,
        tangency=state.effective_tangency(),
        static=result.numbers["static_load"],
        pulsating=state.marker_factor * reference,
        excitation=state.marker_frequency * result.numbers["fundamental"],
        initial=state.initial,
        seed=round(state.seed),
        periods=round(state.periods),
    )
    limit = model.system(point.spin_speed, point.tangency).largest_load
    if (peak := point.static + point.pulsating) >= limit:
        raise ValueError(
            f"Here the load reaches p̄ = {peak:.4g}. With the exact stiffness law it must stay "
            f"below {limit:.4g}, where a shaft clamped at both ends buckles: move the marker to a "
            "lower β_d."
        )
    motion, floquet, samples, charts = _respond(
        model,
        point.spin_speed,
        point.tangency,
        (point.static, point.pulsating),
        point.excitation,
        (point.initial, point.seed if point.initial == "noise" else 0),
        point.periods,
    )
    plain = model.undamped().system(point.spin_speed, point.tangency)
    bolotin = bool(in_bolotin_region(plain, point.static, point.pulsating, point.excitation))
    pair = _nearest_pair(result, point.excitation)
    facts, sentence = describe(state, floquet, bolotin, pair, result)
    shown = round(motion.time[-1] / motion.period)
    if shown < point.periods:
        facts.append(["Periods shown", f"{shown}: the whirl is fast against the load"])
    grown = motion.growth_rate * float(motion.time[-1]) / math.log(10)
    if grown > 2:
        facts.append(["Grows over the stretch", f"by 10 to the power {grown:.1f}"])
    scales = shown_scales(state)
    if scales is not None:
        seconds = motion.period / scales.frequency
        charts = charts | {"response": in_seconds(charts["response"], seconds)}
    return Inspection(
        charts=charts,
        facts=facts,
        sentence=sentence,
        motion=_motion(point, motion, samples, scales),
        response=motion,
        samples=samples,
    )
