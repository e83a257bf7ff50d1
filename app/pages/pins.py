"""Pins: curves of earlier settings that stay on the charts, and how those differ from now."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rotorstab import Scales
from rotorstab.charts import load_unit, written

from ..results.analysis import Result, solve, window_of
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..state import SI_INPUTS, SYMBOLS, State, Use, names_for
from ..state.address import MOST_PINS, PINNED, PinnedInputs, pin_name
from ..words.si import (
    KEY_NUMBERS,
    InputInSI,
    key_number_label,
    key_numbers,
    rotor_inputs_in_si,
    shown_scales,
)
from ..words.typography import with_unit

__all__ = ["Pin", "differences", "pin", "side_by_side", "solve_pin"]

_MOST_IN_TITLE = 3  # inputs that a title names


@dataclass(frozen=True, eq=False)
class Pin(PinnedInputs):
    """A pinned setting with its numbers.

    Parameters
    ----------
    state : State
        Its inputs; it does not change.
    result : Result
    scales : Scales
        Of its own shaft.
    full : bool
        Whether the shares of the window are those of a full map.
    """

    state: State
    result: Result
    scales: Scales
    full: bool


def pin(state: State, name: Any, pins: Sequence[PinnedInputs]) -> Pin | None:
    """Return a pin of the present state, or None if there are `MOST_PINS` already."""
    taken = {pin.number for pin in pins}
    free = [number for number in range(1, MOST_PINS + 1) if number not in taken]
    if not free:
        return None
    inputs = state.inputs()
    kept = {name: inputs[name] for name in PINNED}
    return solve_pin(PinnedInputs(pin_name(name, free[0]), free[0], kept))


def solve_pin(pinned: PinnedInputs) -> Pin:
    """Return a pinned setting with its numbers.

    Raises
    ------
    UserError
        Where its inputs have no answer.
    """
    state = State(**pinned.inputs)
    # no curve depends on the growth map: a full one is used only if it is there
    full = known_detail(window_of(state)) is Detail.FULL
    result = solve(state, Detail.FULL if full else Detail.COARSE)
    return Pin(pinned.name, pinned.number, pinned.inputs, state, result, state.scales(), full)


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    return written(value, 5) if isinstance(value, float) else str(value)


def _numbers(result: Result, scales: Scales | None, unit: str, full: bool = True) -> dict[str, str]:
    """Return the key numbers by label; in SI with the scales of the shaft, loads in `unit`."""
    shown = result.numbers if scales is None else key_numbers(scales, result.numbers, unit)
    si = scales is not None
    numbers = {key_number_label(name, scales, unit): _shown(shown[name]) for name in KEY_NUMBERS}
    for name, (real, imaginary) in shown["whirl"].items():
        grows = ""
        if imaginary:
            word = "grows" if imaginary < 0 else "decays"
            rate = with_unit(written(abs(imaginary), 3), "1/s" if si else "")
            grows = f", {word} by {rate}"
        numbers[f"Whirl {name} {'f [Hz]' if si else 'ω̄'}"] = _shown(real) + grows
    part = result.floquet.unstable_share
    share = with_unit(f"{100 * part:.3g}", "%") if math.isfinite(part) else "not computed"
    rough = not full and math.isfinite(part)
    numbers["Unstable share of the computed window"] = f"≈ {share}" if rough else share
    tongues = result.floquet.table.tongues
    numbers["Tongues"] = ", ".join(row.name for row in tongues) or "none"
    return numbers


def differences(state: State, result: Result, pins: Sequence[Pin]) -> dict[str, Any]:
    """Return the pins' names and the rows, inputs and key numbers, in which they differ."""
    scales = shown_scales(state)
    unit = "" if scales is None else load_unit(scales)
    # each setting in the scales of its own shaft
    inputs = [_inputs(state.inputs(), scales)]
    numbers = [_numbers(result, scales, unit)]
    for pin in pins:
        own = None if scales is None else pin.scales
        inputs.append(_inputs(pin.inputs, own))
        numbers.append(_numbers(pin.result, own, unit, pin.full))
    return {
        "names": [{"name": pin.name, "number": pin.number} for pin in pins],
        "rows": [*_differing(inputs), *_differing(numbers)],
        "full": len(pins) >= MOST_PINS,
    }


def _differing(columns: Sequence[Mapping[str, str]]) -> list[list[str]]:
    """Return a row, label and values, for each label of the first column whose values differ."""
    rows = [[label, *(column.get(label, "none") for column in columns)] for label in columns[0]]
    return [row for row in rows if len(set(row[1:])) > 1]


def _inputs(inputs: Mapping[str, Any], scales: Scales | None) -> dict[str, str]:
    """Return the pinned inputs by label; in SI with the scales of their shaft."""
    forms = {} if scales is None else rotor_inputs_in_si(scales)
    found = {}
    for name in names_for(Use.COMPARED):
        value, unit, symbol = _input(name, inputs, forms)
        label = f"{State.param[name].label} {symbol} {f'[{unit}]' if unit else ''}"
        found[" ".join(label.split())] = _shown(value)
    return found


def _input(
    name: str, inputs: Mapping[str, Any], forms: Mapping[str, InputInSI]
) -> tuple[Any, str, str]:
    """Return the value of an input, its unit and its symbol, both of which may be empty."""
    form = forms.get(name)
    if form is None:
        return inputs[name], SI_INPUTS.get(name, ""), SYMBOLS.get(name, "")
    return inputs[name] * form.factor, form.unit, form.symbol


def side_by_side(state: State, pin: Pin) -> dict[str, str]:
    """Return the titles of the present chart and a pin's: names, and inputs that differ."""
    scales = shown_scales(state)
    now = state.inputs()
    names = [name for name in names_for(Use.COMPARED) if pin.inputs[name] != now[name]]
    return {
        "now": _title("Now", names, now, scales),
        "pin": _title(pin.name, names, pin.inputs, None if scales is None else pin.scales),
    }


def _title(
    name: str, differing: Sequence[str], inputs: Mapping[str, Any], scales: Scales | None
) -> str:
    forms = {} if scales is None else rotor_inputs_in_si(scales)
    parts = []
    for one in differing[:_MOST_IN_TITLE]:
        value, unit, symbol = _input(one, inputs, forms)
        symbol = symbol or str(State.param[one].label).lower()
        parts.append(f"{symbol} = {with_unit(_shown(value), unit)}")
    more = ", …" if len(differing) > _MOST_IN_TITLE else ""
    return f"{name}: {', '.join(parts)}{more}" if parts else name
