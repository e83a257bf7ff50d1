"""What the page shows in SI: charts, key numbers, and what each slider's value means."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from rotorstab import Scales
from rotorstab.charts import Chart, chart_factors, in_si

from .state import SI_INPUTS, SYMBOLS, State

__all__ = [
    "chart_in_si",
    "displayed",
    "key_numbers",
    "named_inputs",
    "shaft_words",
    "shown_scales",
    "si_answer",
]


def chart_in_si(chart: Chart, scales: Scales, numbers: Mapping[str, Any]) -> Chart:
    """Return a chart in SI; the key numbers are those of the rotor it shows."""
    return in_si(chart, scales, numbers["fundamental"], numbers["reference"])


def shown_scales(state: State) -> Scales | None:
    """Return the scales of the units the user chose, or None for the paper's numbers."""
    return state.scales() if state.units == "SI" else None


def displayed(
    charts: Mapping[str, Chart], state: State, numbers: Mapping[str, Any]
) -> dict[str, Chart]:
    """Return the charts in the units the user chose."""
    scales = shown_scales(state)
    if scales is None:
        return dict(charts)
    return {key: chart_in_si(chart, scales, numbers) for key, chart in charts.items()}


def key_numbers(scales: Scales, numbers: Mapping[str, Any]) -> dict[str, Any]:
    """Return the key numbers in SI: loads [N], frequencies [Hz], growth of a whirl [1/s].

    `whirl` holds [Hz, 1/s] by mode, everything else one number or None.
    """
    hertz = scales.frequency / (2 * math.pi)
    loads = {
        name: None if numbers[name] is None else numbers[name] * scales.load
        for name in ("buckling", "flutter", "static_load", "reference")
    }
    whirl = {
        name: [real * hertz, imaginary * scales.frequency]
        for name, (real, imaginary) in numbers["whirl"].items()
    }
    return {**loads, "fundamental": numbers["fundamental"] * hertz, "whirl": whirl}


def _quantity(value: float, unit: str) -> str:
    # no exponent where plain digits say as much: 1532 N, 15320 N
    text = (
        f"{value:.4g}" if abs(value) < 1000 or abs(value) >= 1e7 else f"{float(f'{value:.4g}'):.0f}"
    )
    return f"{text} {unit}".replace("-", "−").replace("e+0", "e")


def si_answer(state: State, numbers: Mapping[str, Any], keys: tuple[str, ...]) -> dict[str, Any]:
    """Return what the browser shows in SI: key numbers, hints beside sliders, chart factors."""
    scales = state.scales()
    hertz = scales.frequency / (2 * math.pi)
    reference = numbers["reference"] * scales.load
    fundamental = numbers["fundamental"] * hertz
    inertia = scales.mass * scales.length**2
    hints = {
        "static_load_factor": _quantity(state.static_load_factor * reference, "N"),
        "spin_speed": _quantity(state.spin_speed * hertz * 60, "rpm"),
        "disk_mass": _quantity(state.disk_mass * scales.mass, "kg"),
        "diametral_inertia": _quantity(state.diametral_inertia * inertia, "kg m²"),
        "polar_inertia": _quantity(state.polar_inertia * inertia, "kg m²"),
        "largest_factor": _quantity(state.largest_factor * reference, "N"),
        "lowest_frequency": _quantity(state.lowest_frequency * fundamental, "Hz"),
        "highest_frequency": _quantity(state.highest_frequency * fundamental, "Hz"),
    }
    factors = {
        key: chart_factors(key, scales, numbers["fundamental"], numbers["reference"])
        for key in keys
    }
    return {"numbers": key_numbers(scales, numbers), "hints": hints, "factors": factors}


def shaft_words(state: State) -> dict[str, Any]:
    """Return what the SI data make of Φ, M̄_D, Ī_D and Ī_P, and whether the charts show it."""
    try:
        rotor, _ = state.si_rotor()
    except ValueError as error:
        return {"words": str(error), "in_use": False, "good": False}
    given = [
        f"{SYMBOLS[name]} = {getattr(rotor, name):.5g}"
        for name in ("shear", "disk_mass", "diametral_inertia", "polar_inertia")
    ]
    in_use = state.shaft_in_use()
    words = ", ".join(given)
    return {
        "words": f"{words}: {'what the charts show.' if in_use else 'not what the sliders say.'}",
        "in_use": in_use,
        "good": True,
    }


def named_inputs(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return inputs for a table: those of the shaft in SI only where they count, with units."""
    found: dict[str, Any] = {}
    for name, value in inputs.items():
        if name not in SI_INPUTS:
            found[name] = value
        elif inputs["units"] == "SI":
            found[f"{name} [{SI_INPUTS[name]}]" if SI_INPUTS[name] else name] = value
    return found
