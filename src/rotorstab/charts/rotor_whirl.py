"""Whirl charts of any rotor, |ω| against spin speed and against static load.

Rotordynamics draws frequencies without a sign, and the letter of a whirl says its direction. This
serves rotors of one plane, whose frequencies have a sign, and of two planes, whose frequencies come
in pairs ±ω.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from .._types import Array, Mask
from ..whirl.campbell import WhirlCurves
from .columns import Lines, label_columns, points_layer, where_growing, widened
from .quantities import LOAD, SPIN, WHIRL, Amount, Wording
from .structure import Chart, Layer

__all__ = ["unsigned_campbell_chart", "unsigned_load_chart"]

_ROLES = {"B": "backward", "F": "forward", "S": "straight"}
_SIDES = {"B": "lower left", "F": "upper left", "S": "upper left"}


class _Whirl(NamedTuple):
    """One whirl along a curve: its name, |Re ω| and where it grows."""

    name: str
    frequency: Array
    grows: Mask


def _whirls(curves: WhirlCurves, top: float) -> Iterator[_Whirl]:
    """Yield the whirls that come below the top of the chart."""
    columns = zip(
        curves.names, curves.frequencies.T, where_growing(curves.frequencies).T, strict=True
    )
    for name, frequency, grows in columns:
        size = np.abs(frequency.real)
        # with two planes −ω is the same motion
        if not name.startswith("−") and size.min() <= top:
            yield _Whirl(name, size, grows)


def _layers(curves: WhirlCurves, top: float) -> list[Layer]:
    """Return the lines of the whirls and their names, near the right end."""
    lines, names = Lines(), []
    for name, frequency, grows in _whirls(curves, top):
        role = _ROLES[name[-1]]
        lines.add(curves.parameter, np.where(grows, np.nan, frequency), name, role)
        if grows.any():
            stretch = np.where(widened(grows), frequency, np.nan)
            lines.add(curves.parameter, stretch, f"{name}, growing", "growing")
        inside = np.flatnonzero(frequency <= 0.9 * top)
        inside = inside[inside <= 0.97 * len(frequency)]
        if inside.size:
            last = inside[-1]
            place = float(curves.parameter[last]), float(frequency[last])
            names.append((*place, name, _SIDES[name[-1]]))
    return [
        Layer("lines", "whirl", lines.columns),
        Layer("labels", "mode", label_columns(names)),
    ]


def unsigned_campbell_chart(
    curves: WhirlCurves, spin_speed: float, critical: Sequence[float], top: float
) -> Chart:
    """Return the Campbell diagram of any rotor.

    Parameters
    ----------
    curves : WhirlCurves
        Over the spin speed.
    spin_speed : float
        The present Ω̄, marked.
    critical : sequence of float
        Spin speeds at which a whirl is as fast as the spin.
    top : float
        Largest |ω̄| of the chart.
    """
    speeds = curves.parameter[[0, -1]]
    lines, names = _layers(curves, top)
    marks = Lines()
    words = Wording("synchronous, |ω̄| = Ω̄", si_text="synchronous, |ω| = Ω")
    marks.add(speeds, speeds, words, "synchronous")
    present = Wording("present spin speed, {}", (Amount(SPIN, spin_speed),))
    marks.vertical(spin_speed, (0.0, top), present, "current")
    points = [
        (speed, speed, Wording("critical speed, {}", (Amount(SPIN, speed),)))
        for speed in map(float, critical)
        if speed <= min(speeds[-1], top)
    ]
    return Chart(
        key="campbell",
        title="Campbell diagram",
        x=SPIN,
        y=WHIRL,
        x_range=(float(speeds[0]), float(speeds[-1])),
        y_range=(0.0, top),
        layers=(
            lines,
            Layer("lines", "marks", marks.columns),
            points_layer("critical speeds", points, "critical speed"),
            names,
        ),
    )


def unsigned_load_chart(curves: WhirlCurves, static_load: float, top: float) -> Chart:
    """Return |ω̄| of any rotor against the static load.

    Parameters
    ----------
    curves : WhirlCurves
        Over the load.
    static_load : float
        The present p̄₀, marked.
    top : float
        Largest |ω̄| of the chart.
    """
    marks = Lines()
    present = Wording("present static load, {}", (Amount(LOAD, static_load, index="₀"),))
    marks.vertical(static_load, (0.0, top), present, "current")
    lines, names = _layers(curves, top)
    return Chart(
        key="load-frequency",
        title="Load–frequency curves",
        x=LOAD,
        y=WHIRL,
        x_range=(float(curves.parameter[0]), float(curves.parameter[-1])),
        y_range=(0.0, top),
        layers=(lines, Layer("lines", "marks", marks.columns), names),
    )
