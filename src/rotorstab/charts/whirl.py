"""Charts of signed whirl frequency: against static load, and against spin speed (Campbell)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..whirl.campbell import WhirlCurves
from ..whirl.critical_speeds import CriticalSpeeds
from .columns import Lines, around_zero, label_columns, points_layer
from .modes import modes
from .quantities import LOAD, SPIN, WHIRL, Amount, Wording
from .structure import Chart, Layer

__all__ = ["campbell_chart", "load_frequency_chart"]


Range = tuple[float, float]

_LEVEL = 0.14  # step between the labels of two limits, in heights of the chart
_LETTER = 0.03  # width of a letter in a phone's chart, in widths of the chart
_STEP = 0.1  # from the end of a curve to the label of a first mode, in widths of the chart
_SIDES = {False: "left", True: "right"}


def _span(curves: WhirlCurves) -> tuple[float, float]:
    """Return the least and the largest Re ω̄ of modes 1 and 2; finite elements have more."""
    shown = [mode.number <= 2 for mode in modes(curves.names)]
    real = curves.frequencies.real[:, shown]
    return float(real.min()), float(real.max())


def _ranges(
    curves: Sequence[WhirlCurves], seen: tuple[Range, Range] | None
) -> tuple[Range, Range, Range]:
    """Return the ranges of both axes, and the range of frequencies whose modes are named."""
    if seen is not None:
        return *seen, seen[1]
    first = curves[0].parameter
    lows, highs = zip(*map(_span, curves), strict=True)
    return (
        (float(first[0]), float(first[-1])),
        around_zero(min(lows), max(highs)),
        _span(curves[0]),
    )


def _mode_labels(
    curves: WhirlCurves, side: str, x_range: Range, named: Range
) -> list[tuple[float, float, str, str]]:
    """Return a label for each mode near one end of its curve, if it lies in the range `named`.

    Names of forward whirl stand above their curves, of backward whirl below them. Those of the
    second modes stand at the end and those of the first a step inside: 1B and 2B are near.
    """
    (left, right), (low, high) = x_range, named
    step = _STEP * (right - left)
    rows = []
    for column, (name, mode) in enumerate(zip(curves.names, modes(curves.names), strict=True)):
        inside = step if mode.number == 1 else 0.0
        place = left + inside if side == "right" else right - inside
        index = int(np.abs(curves.parameter - place).argmin())
        value = float(curves.frequencies[index, column].real)
        if low <= value <= high:
            vertical = "upper" if name.endswith("F") else "lower"
            rows.append((float(curves.parameter[index]), value, name, f"{vertical} {side}"))
    return rows


def _limit_labels(
    limits: Mapping[str, float], x_range: Range, y_range: Range
) -> list[tuple[float, float, str, str]]:
    """Return a label for each limit under the top of the chart, above all curves.

    The smaller load has its label at its left and the larger one at its right, for buckling and
    flutter loads may nearly coincide. A label that would leave the chart stands at the other side,
    one line lower where it would meet the first.
    """
    (left, right), (bottom, top) = x_range, y_range
    rows: list[tuple[float, float, str, str]] = []
    taken = left  # up to where the line at the top is used
    for index, (name, load) in enumerate(sorted(limits.items(), key=lambda limit: limit[1])):
        width = _LETTER * len(name) * (right - left)
        last = index == len(limits) - 1
        at_right = load + width <= right if last else load - width < taken
        start = load if at_right else load - width
        level = 0 if start >= taken else 1
        rows.append(
            (load, top - level * _LEVEL * (top - bottom), name, f"lower {_SIDES[at_right]}")
        )
        taken = start + width
    return rows


def load_frequency_chart(
    curves: Mapping[str, WhirlCurves],
    static_load: float,
    limits: Mapping[str, float],
    seen: tuple[Range, Range] | None = None,
) -> Chart:
    """Return signed whirl frequency against load (Fig. 8).

    Parameters
    ----------
    curves : mapping of {"axial", "follower", "axial exact", "follower exact"} to WhirlCurves
        What to draw; the chart has the range of the first curves.
    static_load : float
        The present p̄₀, marked.
    limits : mapping of str to float
        Critical loads to mark by name; those out of range are left out.
    seen : ((float, float), (float, float)), optional
        Ranges of the load and of the frequency; by default all of the curves.
    """
    first = next(iter(curves.values()))
    x_range, y_range, named = _ranges(tuple(curves.values()), seen)
    lines, marks = Lines(), Lines()
    for role, whirl in curves.items():
        lines.whirl(whirl, (role, role), f"{{}}, {role}")
    present = Wording("present static load, {}", (Amount(LOAD, static_load, index="₀"),))
    marks.vertical(static_load, y_range, present, "current")
    shown = {name: load for name, load in limits.items() if x_range[0] <= load <= x_range[1]}
    for name, load in shown.items():
        wording = Wording(f"{name}, {{}}", (Amount(LOAD, load, 5),))
        marks.vertical(load, y_range, wording, "limit")
    modes = _mode_labels(first, "right", x_range, named)
    names = _limit_labels(shown, x_range, y_range)
    return Chart(
        key="load-frequency",
        title="Load–frequency curves",
        x=LOAD,
        y=WHIRL,
        x_range=x_range,
        y_range=y_range,
        layers=(
            Layer("lines", "whirl", lines.columns),
            Layer("lines", "marks", marks.columns),
            Layer("labels", "mode", label_columns(modes)),
            Layer("labels", "limit", label_columns(names)),
        ),
    )


def campbell_chart(
    curves: WhirlCurves,
    spin_speed: float,
    critical: CriticalSpeeds,
    seen: tuple[Range, Range] | None = None,
) -> Chart:
    """Return signed whirl frequency against spin speed, with synchronous whirl.

    Parameters
    ----------
    curves : WhirlCurves
        Over spin speed.
    spin_speed : float
        The present Ω̄, marked.
    critical : CriticalSpeeds
    seen : ((float, float), (float, float)), optional
        Ranges of the speed and of the frequency; by default all of the curves.
    """
    x_range, y_range, named = _ranges((curves,), seen)
    lines, marks = Lines(), Lines()
    lines.whirl(curves, ("backward", "forward"), "{}")
    ends = curves.parameter[[0, -1]]
    for sign, minus in ((1, ""), (-1, "−")):
        text, si_text = f"synchronous, ω̄ = {minus}Ω̄", f"synchronous, ω = {minus}Ω"
        lines.add(ends, sign * ends, Wording(text, si_text=si_text), "synchronous")
    present = Wording("present spin speed, {}", (Amount(SPIN, spin_speed),))
    marks.vertical(spin_speed, y_range, present, "current")
    points = [
        (
            float(speed),
            sign * float(speed),
            Wording(f"critical speed, {{}} ({word})", (Amount(SPIN, float(speed)),)),
        )
        for sign, word, speeds in (
            (1, "forward", critical.forward),
            (-1, "backward", critical.backward),
        )
        for speed in speeds
        if x_range[0] <= speed <= x_range[1]
    ]
    return Chart(
        key="campbell",
        title="Campbell diagram",
        x=SPIN,
        y=WHIRL,
        x_range=x_range,
        y_range=y_range,
        layers=(
            Layer("lines", "whirl", lines.columns),
            Layer("lines", "marks", marks.columns),
            points_layer("critical speeds", points, "critical speed"),
            Layer("labels", "mode", label_columns(_mode_labels(curves, "left", x_range, named))),
        ),
    )
