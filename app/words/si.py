"""What the page shows in SI: charts, key numbers, and what each slider's value means."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from rotorstab import Scales
from rotorstab.charts import LOAD_UNITS, Chart, chart_factors, in_si, load_unit, written
from rotorstab.charts.quantities import Measure, Quantity, SIForm
from rotorstab.charts.si import SIUnits, unit_in_si

from ..reading.user_error import UserError
from ..state import SI_INPUTS, SYMBOLS, State
from ..state.inputs import FACTS
from ..state.rates import hertz
from .typography import with_unit

__all__ = [
    "KEY_NUMBERS",
    "InputInSI",
    "chart_in_si",
    "displayed",
    "inputs_in_si",
    "key_number_label",
    "key_numbers",
    "load_in",
    "load_words",
    "named_inputs",
    "rotor_inputs_in_si",
    "shaft_words",
    "shown_scales",
    "si_answer",
]

KEY_NUMBERS = {
    "buckling": Quantity("Buckling load", "p̄_cr", si=SIForm("P_cr", Measure.LOAD)),
    "flutter": Quantity(
        "Flutter load (follower, at this spin)", "p̄_f", si=SIForm("P_f", Measure.LOAD)
    ),
    "static_load": Quantity("Static load", "p̄_0", si=SIForm("P_0", Measure.LOAD)),
    "fundamental": Quantity(
        "Natural frequency at rest", "ω_n", si=SIForm("f_n", Measure.FREQUENCY)
    ),
}
"""The key numbers of a view by their names in `Result.numbers`; for the report, the picture and the
table of pins."""


def key_number_label(name: str, scales: Scales | None, unit: str | None = None) -> str:
    """Return the label of a key number, with its unit where it is in SI."""
    quantity = KEY_NUMBERS[name]
    form = quantity.si
    if scales is None or form is None:
        return quantity.label(with_unit=False)
    return f"{quantity.words} {form.symbol} [{unit_in_si(form.measure, scales, unit)[1]}]"


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


@dataclass(frozen=True)
class InputInSI:
    """What 1 of an input is in SI, the unit and the symbol there."""

    factor: float
    unit: str
    symbol: str


def inputs_in_si(units: SIUnits) -> dict[str, InputInSI]:
    """Return what the inputs without dimension are in SI, by their names."""
    found = {}
    for name, facts in FACTS.items():
        if facts.si is not None:
            quantity = Quantity("", facts.symbol, si=facts.si)
            unit = units.quantity(quantity).unit
            found[name] = InputInSI(units.factor(quantity), unit, facts.si.symbol)
    return found


def rotor_inputs_in_si(scales: Scales) -> dict[str, InputInSI]:
    """Return what the inputs are in SI that have the scales of the shaft, by their names."""
    own = {name for name, facts in FACTS.items() if facts.si is not None and facts.si.of is None}
    found = inputs_in_si(SIUnits(scales, 1.0, 1.0))
    return {name: form for name, form in found.items() if name in own}


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


def si_answer(state: State, numbers: Mapping[str, Any], keys: tuple[str, ...]) -> dict[str, Any]:
    """Return what the browser shows in SI: key numbers, units of the sliders, chart factors."""
    scales = state.scales()
    inputs = inputs_in_si(SIUnits(scales, numbers["fundamental"], numbers["reference"]))
    hints = {
        name: with_unit(written(getattr(state, name) * form.factor), form.unit)
        for name, form in inputs.items()
    }
    factors = {
        key: chart_factors(key, scales, numbers["fundamental"], numbers["reference"])
        for key in keys
    }
    return {
        "numbers": key_numbers(scales, numbers),
        "load_unit": load_unit(scales),
        "hints": hints,
        "inputs": {name: asdict(form) for name, form in inputs.items()},
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
