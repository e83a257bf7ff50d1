"""What the page shows in SI: charts, key numbers, and what each slider's value means."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rotorstab import Scales
from rotorstab.charts import LOAD_UNITS, Chart, chart_factors, in_si, load_unit, written

from ..reading.user_error import UserError
from ..state import SI_INPUTS, SYMBOLS, State
from ..state.rates import hertz, rpm
from .typography import with_unit

__all__ = [
    "chart_in_si",
    "displayed",
    "key_numbers",
    "load_in",
    "load_words",
    "named_inputs",
    "quantities_in_si",
    "shaft_words",
    "shown_scales",
    "si_answer",
]

_SI_SYMBOLS = {
    "static_load_factor": "P_0",
    "spin_speed": "Ω",
    "disk_mass": "M_D",
    "diametral_inertia": "I_D",
    "polar_inertia": "I_P",
    "largest_factor": "P_t max",
    "marker_factor": "P_t",
    "lowest_frequency": "θ/2π min",
    "highest_frequency": "θ/2π max",
    "marker_frequency": "θ/2π",
}


def chart_in_si(
    chart: Chart, scales: Scales, numbers: Mapping[str, Any], unit: str | None = None
) -> Chart:
    """Return a chart in SI; the key numbers are those of the rotor it shows."""
    return in_si(chart, scales, numbers["fundamental"], numbers["reference"], unit)


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


def load_in(scales: Scales, unit: str | None = None) -> tuple[float, str]:
    """Return what one EI/L² is in a unit of load, the shaft's own by default, and its name."""
    unit = unit or load_unit(scales)
    return scales.load / LOAD_UNITS[unit], unit


def load_words(load: float, scales: Scales) -> str:
    """Return a load p̄ with its unit, such as 4596 N or 1.532 MN."""
    factor, unit = load_in(scales)
    return with_unit(written(load * factor), unit)


def quantities_in_si(scales: Scales) -> dict[str, tuple[float, str]]:
    """Return what one unit of a rotor's inputs is in SI, and the unit."""
    inertia = scales.mass * scales.length**2
    return {
        "spin_speed": (rpm(scales), "rpm"),
        "disk_mass": (scales.mass, "kg"),
        "diametral_inertia": (inertia, "kg m²"),
        "polar_inertia": (inertia, "kg m²"),
    }


def key_numbers(
    scales: Scales, numbers: Mapping[str, Any], unit: str | None = None
) -> dict[str, Any]:
    """Return the key numbers in SI: loads, frequencies [Hz], growth of a whirl [1/s].

    Loads are in `unit`, by default the one that suits the shaft. `whirl` holds [Hz, 1/s] by
    mode, everything else one number or None.
    """
    to_hertz = hertz(scales)
    force = load_in(scales, unit)[0]
    loads = {
        name: None if numbers[name] is None else numbers[name] * force
        for name in ("buckling", "flutter", "static_load", "reference")
    }
    whirl = {
        name: [real * to_hertz, imaginary * scales.frequency]
        for name, (real, imaginary) in numbers["whirl"].items()
    }
    return {**loads, "fundamental": numbers["fundamental"] * to_hertz, "whirl": whirl}


def _inputs_in_si(scales: Scales, numbers: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return by input what 1 is in SI ("factor"), the "unit" and the "symbol"."""
    load, load_name = load_in(scales)
    found = quantities_in_si(scales)
    for name in ("static_load_factor", "largest_factor", "marker_factor"):
        found[name] = (numbers["reference"] * load, load_name)
    for name in ("lowest_frequency", "highest_frequency", "marker_frequency"):
        found[name] = (numbers["fundamental"] * hertz(scales), "Hz")
    return {
        name: {"factor": factor, "unit": unit, "symbol": _SI_SYMBOLS[name]}
        for name, (factor, unit) in found.items()
    }


def si_answer(state: State, numbers: Mapping[str, Any], keys: tuple[str, ...]) -> dict[str, Any]:
    """Return what the browser shows in SI: key numbers, units of the sliders, chart factors."""
    scales = state.scales()
    inputs = _inputs_in_si(scales, numbers)
    hints = {
        name: with_unit(written(getattr(state, name) * one["factor"]), one["unit"])
        for name, one in inputs.items()
    }
    factors = {
        key: chart_factors(key, scales, numbers["fundamental"], numbers["reference"])
        for key in keys
    }
    return {
        "numbers": key_numbers(scales, numbers),
        "load_unit": load_unit(scales),
        "hints": hints,
        "inputs": inputs,
        "factors": factors,
    }


def shaft_words(state: State) -> dict[str, Any]:
    """Return Φ, M̄_D, Ī_D and Ī_P of the SI data in words, and whether the charts show them."""
    try:
        rotor, _ = state.si_rotor()
    except UserError as error:
        return {"words": str(error), "in_use": False, "good": False}
    quantities = [
        f"{SYMBOLS[name]} = {written(getattr(rotor, name), 5)}"
        for name in ("shear", "disk_mass", "diametral_inertia", "polar_inertia")
    ]
    in_use = state.shaft_in_use()
    words = ", ".join(quantities)
    use = "The charts use these values." if in_use else "The charts use other values."
    return {
        "words": f"{words}. {use}",
        "in_use": in_use,
        "good": True,
    }


def named_inputs(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return inputs for a table; those of the shaft, with units, only if the charts are in SI."""
    found: dict[str, Any] = {}
    for name, value in inputs.items():
        if name not in SI_INPUTS:
            found[name] = value
        elif inputs["units"] == "SI":
            found[f"{name} [{SI_INPUTS[name]}]" if SI_INPUTS[name] else name] = value
    return found
