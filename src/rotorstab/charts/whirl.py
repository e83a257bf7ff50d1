"""Charts of signed whirl frequency: against steady load, and against spin speed (Campbell)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..whirl.campbell import WhirlCurves
from ..whirl.critical_speeds import CriticalSpeeds
from .columns import Lines, around_zero, label_columns, points_layer
from .modes import modes
from .quantities import LOAD, SPIN, WHIRL, Amount, Wording
from .structure import Chart, Layer

__all__ = ["campbell_chart", "load_frequency_chart"]


_LEVEL = 0.14  # step between the labels of two limits, in heights of the chart


def _span(curves: WhirlCurves) -> tuple[float, float]:
    """Return the least and the largest Re ω̄ of modes 1 and 2; finite elements have more."""
    shown = [mode.number <= 2 for mode in modes(curves.names)]
    real = curves.frequencies.real[:, shown]
    return float(real.min()), float(real.max())


def _mode_labels(curves: WhirlCurves, index: int, side: str) -> list[tuple[float, float, str, str]]:
    row = curves.frequencies[index]
    low, high = _span(curves)
    return [
        # names of forward whirl stand above their curves, of backward whirl below them
        (
            float(curves.parameter[index]),
            float(value.real),
            name,
            f"{'upper' if name.endswith('F') else 'lower'} {side}",
        )
        for value, name in zip(row, curves.names, strict=True)
        if low <= value.real <= high
    ]


def _limit_labels(
    limits: Mapping[str, float], x_range: tuple[float, float], y_range: tuple[float, float]
) -> list[tuple[float, float, str, str]]:
    """Return a label at the foot of each limit, inside the chart even on a phone.

    Each has a level of its own, for buckling and flutter loads may nearly coincide.
    """
    (left, right), (bottom, top) = x_range, y_range
    return [
        (
            load,
            bottom + _LEVEL * level * (top - bottom),
            name,
            # a letter takes 3 % of a phone's chart
            "upper right" if load < right - 0.03 * len(name) * (right - left) else "upper left",
        )
        for level, (name, load) in enumerate(limits.items())
    ]


def load_frequency_chart(
    curves: Mapping[str, WhirlCurves],
    static_load: float,
    limits: Mapping[str, float],
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
    """
    first = next(iter(curves.values()))
    x_range = (float(first.parameter[0]), float(first.parameter[-1]))
    lows, highs = zip(*map(_span, curves.values()), strict=True)
    y_range = around_zero(min(lows), max(highs))
    lines, marks = Lines(), Lines()
    for role, whirl in curves.items():
        lines.whirl(whirl, (role, role), f"{{}}, {role}")
    present = Wording("present static load, {}", (Amount(LOAD, static_load, index="₀"),))
    marks.vertical(static_load, y_range, present, "current")
    shown = {name: load for name, load in limits.items() if x_range[0] <= load <= x_range[1]}
    for name, load in shown.items():
        wording = Wording(f"{name}, {{}}", (Amount(LOAD, load, 5),))
        marks.vertical(load, y_range, wording, "limit")
    rows = _mode_labels(first, 0, "right") + _limit_labels(shown, x_range, y_range)
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
            Layer("labels", "mode", label_columns(rows)),
        ),
    )


def campbell_chart(curves: WhirlCurves, spin_speed: float, critical: CriticalSpeeds) -> Chart:
    """Return signed whirl frequency against spin speed, with synchronous whirl.

    Parameters
    ----------
    curves : WhirlCurves
        Over spin speed.
    spin_speed : float
        The present Ω̄, marked.
    critical : CriticalSpeeds
    """
    x_range = (float(curves.parameter[0]), float(curves.parameter[-1]))
    y_range = around_zero(*_span(curves))
    lines, marks = Lines(), Lines()
    lines.whirl(curves, ("backward", "forward"), "{}")
    ends = np.array(x_range)
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
        if speed <= x_range[1]
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
            Layer("labels", "mode", label_columns(_mode_labels(curves, -1, "left"))),
        ),
    )
