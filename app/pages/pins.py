"""Pins: curves of earlier settings kept as ghosts, and what differs between them and now."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotorstab import Scales
from rotorstab.charts import Chart, Layer, load_unit, written

from ..results.analysis import Result, solve, window_of
from ..results.growth import shows_growth
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..state import SI_INPUTS, SYMBOLS, State
from ..state.address import MOST_PINS, PINNED, PinnedInputs, pin_name
from ..words.si import chart_in_si, key_numbers, quantities_in_si, shown_scales

__all__ = ["Pin", "differences", "ghosted", "pin", "solved"]

_CURVES = {"instability": "boundary", "load-frequency": "whirl", "campbell": "whirl"}
# non-dimensional and in SI, where loads are in the unit of the present shaft
_NUMBERS = {
    "buckling": ("Buckling load p̄_cr", "Buckling load P_cr [{}]"),
    "flutter": ("Flutter load p̄_f", "Flutter load P_f [{}]"),
    "static_load": ("Static load p̄_0", "Static load P_0 [{}]"),
    "fundamental": ("At rest ω̄_n", "At rest f_n [Hz]"),
}
_RANGES = ("lowest", "highest", "largest")


@dataclass(frozen=True, eq=False)
class Pin(PinnedInputs):
    """A setting that is kept, and its curves.

    Parameters
    ----------
    result : Result
    scales : Scales
        Of its own shaft.
    settled : bool
        Whether the shares of the window are from the fine map.
    """

    result: Result
    scales: Scales
    settled: bool


def pin(state: State, name: Any, pins: Sequence[PinnedInputs]) -> Pin | None:
    """Return a pin of the present state, or None where all places are taken."""
    free = [n for n in range(1, MOST_PINS + 1) if n not in {one.number for one in pins}]
    if not free:
        return None
    inputs = state.inputs()
    kept = {name: inputs[name] for name in PINNED}
    return solved(PinnedInputs(pin_name(name, free[0]), free[0], kept))


def solved(one: PinnedInputs) -> Pin:
    """Return a pin with its curves.

    Raises
    ------
    ValueError
        With words for the page, where its inputs have no answer.
    """
    state = State(**one.inputs)
    # no curve of a pin is of the growth map, so nobody waits for a fine one
    settled = known_detail(window_of(state)) is Detail.REFINED
    result = solve(state, Detail.REFINED if settled else Detail.COARSE)
    return Pin(one.name, one.number, one.inputs, result, state.scales(), settled)


def ghosted(
    charts: dict[str, Chart], pins: Sequence[Pin], scales: Scales | None
) -> dict[str, Chart]:
    """Return the charts with the pinned curves added, in the charts' units.

    `scales` are those of the present shaft, or None for the paper's numbers.
    """
    if not pins:
        return charts
    return {
        key: replace(chart, layers=(*chart.layers, _ghosts(chart, pins, scales)))
        if key in _CURVES
        else chart
        for key, chart in charts.items()
    }


def _ghosts(now: Chart, pins: Sequence[Pin], scales: Scales | None) -> Layer:
    """Return the pinned curves that are not just the present ones again."""
    label = _CURVES[now.key]
    present = now.layer(label).columns
    columns: dict[str, list[Any]] = {key: [] for key in ("xs", "ys", "name", "role", "group")}
    for one in pins:
        chart = one.result.charts[now.key]
        if scales is not None:
            chart = chart_in_si(chart, one.scales, one.result.numbers, load_unit(scales))
        kept = chart.layer(label).columns
        for x, y, name, role in zip(
            *(kept[key] for key in ("xs", "ys", "name", "role")), strict=True
        ):
            covered = any(
                np.array_equal(y, new_y, equal_nan=True)
                and np.array_equal(x, new_x, equal_nan=True)
                for new_x, new_y in zip(present["xs"], present["ys"], strict=True)
            )
            if not covered and role != "synchronous":
                columns["xs"].append(x)
                columns["ys"].append(y)
                columns["name"].append(f"{one.name}: {name}")
                columns["role"].append(f"pin {one.number}")
                columns["group"].append(one.name)
    return Layer("lines", "pins", columns)


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    return written(value, 5) if isinstance(value, float) else str(value)


def _numbers(
    result: Result, scales: Scales | None, unit: str, settled: bool = True
) -> dict[str, str]:
    """Return the key numbers by name; with the scales of its shaft in SI, loads in `unit`."""
    shown = result.numbers if scales is None else key_numbers(scales, result.numbers, unit)
    si = scales is not None
    numbers = {words[si].format(unit): _shown(shown[name]) for name, words in _NUMBERS.items()}
    for name, (real, imaginary) in shown["whirl"].items():
        grows = ""
        if shows_growth(imaginary):
            word = "grows" if imaginary < 0 else "decays"
            grows = f", {word} by {written(abs(imaginary), 3)}{' 1/s' if si else ''}"
        numbers[f"Whirl {name} {'f [Hz]' if si else 'ω̄'}"] = _shown(real) + grows
    part = result.floquet.unstable_share
    share = f"{100 * part:.3g} %" if math.isfinite(part) else "not computed"
    rough = not settled and math.isfinite(part)
    numbers["Unstable share of the computed window"] = f"≈ {share}" if rough else share
    tongues = result.floquet.table.tongues
    numbers["Tongues"] = ", ".join(row.name for row in tongues) or "none"
    return numbers


def differences(state: State, result: Result, pins: Sequence[Pin]) -> dict[str, Any]:
    """Return the pins' names and the rows, inputs and key numbers, in which they differ."""
    scales = shown_scales(state)
    unit = "" if scales is None else load_unit(scales)
    own = [scales, *(None if scales is None else one.scales for one in pins)]
    every = [
        _inputs(inputs, one)
        for inputs, one in zip([state.inputs(), *(p.inputs for p in pins)], own, strict=True)
    ]
    rows = [
        [label, *(one[label] for one in every)]
        for label in every[0]
        if len({one[label] for one in every}) > 1
    ]
    numbers = [_numbers(result, scales, unit)]
    numbers += [
        _numbers(one.result, of, unit, one.settled) for one, of in zip(pins, own[1:], strict=True)
    ]
    for name in numbers[0]:
        values = [one.get(name, "none") for one in numbers]
        if len(set(values)) > 1:
            rows.append([name, *values])
    return {
        "names": [{"name": one.name, "number": one.number} for one in pins],
        "rows": rows,
        "full": len(pins) >= MOST_PINS,
    }


def _inputs(inputs: Mapping[str, Any], scales: Scales | None) -> dict[str, str]:
    """Return the inputs that a pin tells by label; with the scales of their shaft in SI."""
    units = {} if scales is None else quantities_in_si(scales)
    found = {}
    for name in PINNED:
        if name.startswith(_RANGES):
            continue
        factor, unit = units.get(name, (None, SI_INPUTS.get(name, "")))
        value = inputs[name] if factor is None else inputs[name] * factor
        symbol = SYMBOLS.get(name, "")
        if factor is not None:
            symbol = symbol.replace("\u0304", "")  # the bar of the non-dimensional
        label = f"{State.param[name].label} {symbol} {f'[{unit}]' if unit else ''}"
        found[" ".join(label.split())] = _shown(value)
    return found
