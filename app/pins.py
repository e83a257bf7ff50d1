"""Pins: curves of earlier settings kept as ghosts, and what differs between them and now."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotorstab import Scales
from rotorstab.charts import Chart, Layer

from .analysis import Result, solve
from .state import SYMBOLS, State
from .units import chart_in_si

__all__ = ["MOST_PINS", "Pin", "differences", "ghosted", "pin"]

MOST_PINS = 3
_CURVES = {"instability": "boundary", "load-frequency": "whirl", "campbell": "whirl"}
_NUMBERS = {
    "buckling": "Buckling load p̄_cr",
    "flutter": "Flutter load p̄_f",
    "static_load": "Static load p̄_0",
    "fundamental": "At rest ω̄_n",
}
_LEFT_OUT = ("show_", "lowest", "highest", "largest", "growth_unit", "marker", "periods")
_LONGEST_NAME = 24


@dataclass(frozen=True, eq=False)
class Pin:
    """A setting that is kept.

    Parameters
    ----------
    name : str
    number : int
        1 to `MOST_PINS`: its look.
    inputs : mapping
    result : Result
    scales : Scales
        Of its own shaft.
    """

    name: str
    number: int
    inputs: Mapping[str, Any]
    result: Result
    scales: Scales


def pin(state: State, name: Any, pins: Sequence[Pin]) -> Pin | None:
    """Return a pin of the present state, or None where all places are taken."""
    free = [n for n in range(1, MOST_PINS + 1) if n not in {one.number for one in pins}]
    if not free:
        return None
    words = " ".join(name.split())[:_LONGEST_NAME] if isinstance(name, str) else ""
    return Pin(
        words or f"Pin {'ABC'[free[0] - 1]}", free[0], state.inputs(), solve(state), state.scales()
    )


def ghosted(charts: dict[str, Chart], pins: Sequence[Pin]) -> dict[str, Chart]:
    """Return the charts with the pinned curves added, in the charts' units."""
    if not pins:
        return charts
    return {
        key: replace(chart, layers=(*chart.layers, _ghosts(chart, pins)))
        if key in _CURVES
        else chart
        for key, chart in charts.items()
    }


def _ghosts(now: Chart, pins: Sequence[Pin]) -> Layer:
    """Return the pinned curves that are not just the present ones again."""
    label = _CURVES[now.key]
    present = now.layer(label).columns
    columns: dict[str, list[Any]] = {"xs": [], "ys": [], "name": [], "role": []}
    for one in pins:
        chart = one.result.charts[now.key]
        if now.units == "SI":
            chart = chart_in_si(chart, one.scales, one.result.numbers)
        kept = chart.layer(label).columns
        for x, y, name, role in zip(*(kept[key] for key in columns), strict=True):
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
    return Layer("lines", "pins", columns)


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    return f"{value:.5g}".replace("-", "−") if isinstance(value, float) else str(value)


def _numbers(result: Result) -> dict[str, str]:
    numbers = {words: _shown(result.numbers[name]) for name, words in _NUMBERS.items()}
    for name, (real, imaginary) in result.numbers["whirl"].items():
        grows = f" {imaginary:+.3g}j".replace("-", "−") if abs(imaginary) > 1e-9 else ""
        numbers[f"Whirl {name} ω̄"] = _shown(real) + grows
    numbers["Unstable share of the window"] = f"{100 * result.floquet.unstable_share:.3g} %"
    tongues = result.floquet.table.tongues
    numbers["Tongues"] = ", ".join(row.name for row in tongues) or "none"
    return numbers


def differences(state: State, result: Result, pins: Sequence[Pin]) -> dict[str, Any]:
    """Return the pins' names and the rows, inputs and key numbers, in which they differ."""
    every = [state.inputs(), *(one.inputs for one in pins)]
    rows = []
    for name in every[0]:
        values = [_shown(inputs[name]) for inputs in every]
        if len(set(values)) > 1 and not name.startswith(_LEFT_OUT):
            label = f"{State.param[name].label} {SYMBOLS.get(name, '')}".strip()
            rows.append([label, *values])
    numbers = [_numbers(result), *(_numbers(one.result) for one in pins)]
    for name in numbers[0]:
        values = [one.get(name, "none") for one in numbers]
        if len(set(values)) > 1:
            rows.append([name, *values])
    return {
        "names": [{"name": one.name, "number": one.number} for one in pins],
        "rows": rows,
        "full": len(pins) >= MOST_PINS,
    }
