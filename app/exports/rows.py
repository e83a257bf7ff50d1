"""The parameters and key numbers of a view as rows of a table, for the report and the picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rotorstab import Scales
from rotorstab.charts import written

from ..state import SI_INPUTS, SYMBOLS, State, Use, names_for
from ..state.address import PinnedInputs
from ..words.si import KEY_NUMBERS, key_number_label, key_numbers, shown_scales

__all__ = [
    "input_labels",
    "number_rows",
    "parameter_rows",
    "parameter_sentence",
    "pin_sentence",
    "units_sentence",
]

Row = tuple[str, str]
_DIGITS = 6
_DAMPING = ("external_damping", "internal_damping")


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    return written(value, _DIGITS) if isinstance(value, float) else str(value)


def _label(name: str) -> str:
    unit = SI_INPUTS.get(name, "")
    words = State.param[name].label, SYMBOLS.get(name, ""), f"[{unit}]" if unit else ""
    return " ".join(word for word in words if word)


def input_labels() -> dict[str, dict[str, Any]]:
    """Return the words of every input of `parameter_rows`, and whether only views in SI have it."""
    names = names_for(Use.REPORTED)
    return {name: {"words": _label(name), "in_si": name in SI_INPUTS} for name in names}


def parameter_rows(state: State, hints: Mapping[str, str] | None = None) -> list[Row]:
    """Return name and value of every input that moves a curve or a number of the view.

    Parameters
    ----------
    state : State
    hints : mapping of str to str, optional
        What values of inputs are in SI, by name; they follow the values in brackets.
    """
    rows = []
    for name in names_for(Use.REPORTED):
        if state.units == "SI" or name not in SI_INPUTS:
            hint = (hints or {}).get(name)
            value = _shown(getattr(state, name))
            rows.append((_label(name), f"{value} ({hint})" if hint else value))
    return rows


def pin_sentence(state: State, pins: Sequence[PinnedInputs]) -> str:
    """Return which curves are pinned, and the inputs in which they differ from the present ones."""
    now = state.inputs()
    found = []
    for pin in pins:
        moved = [
            f"{_symbol(name)} = {_shown(value)}"
            for name, value in pin.inputs.items()
            if value != now[name]
        ]
        found.append(f"{pin.name} ({', '.join(moved) or 'the present settings'})")
    return f"Pinned curves: {'; '.join(found)}." if found else ""


def _symbol(name: str) -> str:
    return SYMBOLS.get(name) or str(State.param[name].label).lower()


def parameter_sentence(state: State) -> str:
    """Return the inputs with their symbols in one line, for the foot of a picture.

    Damping that is zero and a tangency without effect are left out.
    """
    unused = {name for name in _DAMPING if not getattr(state, name)}
    if state.load_type != "partly":
        unused.add("tangency")
    if state.units != "SI":
        unused.update(SI_INPUTS)
    parts = []
    for name in names_for(Use.REPORTED):
        if name not in unused:
            value, unit = _shown(getattr(state, name)), SI_INPUTS.get(name, "")
            parts.append(f"{_symbol(name)} = {value} {unit}".strip())
    return f"{units_sentence(state)}: {', '.join(parts)}"


def number_rows(numbers: Mapping[str, Any], scales: Scales | None) -> list[Row]:
    """Return names and values of the key numbers, in SI with scales."""
    shown = numbers if scales is None else key_numbers(scales, numbers)
    rows = []
    for key in KEY_NUMBERS:
        rows.append((key_number_label(key, scales), _shown(shown[key])))
    unit = "" if scales is None else " ω/2π [Hz]"
    for name, (real, imaginary) in shown["whirl"].items():
        text = written(real, _DIGITS)
        if imaginary and scales is None:
            text += f" {'+' if imaginary > 0 else '−'} {written(abs(imaginary), _DIGITS)}j"
        elif imaginary:
            verb = "decays" if imaginary > 0 else "grows"
            text += f", {verb} by {written(abs(imaginary), _DIGITS)} 1/s"
        rows.append((f"whirl frequency {name}{unit}", text))
    return rows


def units_sentence(state: State) -> str:
    """Return in which units the numbers of a view are."""
    if shown_scales(state) is None:
        return "Non-dimensional"
    return (
        f"In SI for a shaft of {state.shaft_length:g} m, {state.shaft_diameter:g} mm; parameters "
        "without a unit are non-dimensional"
    )
