"""Charts as data: what is drawn, before any drawing library.

A `Chart` is a frozen description (axes, layers of named columns). `plots` draws it, the
dashboard patches its columns, a table export writes them: all three see the same arrays.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .bolotin import BolotinChart
from .whirl import CriticalSpeeds, WhirlCurves

__all__ = [
    "ROLES",
    "Chart",
    "Layer",
    "Role",
    "campbell_chart",
    "instability_chart",
    "load_frequency_chart",
]

Array = NDArray[np.float64]
_REAL = 1e-9  # |Im ω| below which a tracked frequency is drawn as real


@dataclass(frozen=True)
class Role:
    """How lines of one meaning look; never by colour alone."""

    color: str
    dash: str  # "solid" or lengths in pixels
    width: float
    meaning: str


# Okabe–Ito hues, each at least 3:1 on both the light and the dark ground
ROLES: Mapping[str, Role] = {
    "backward": Role("#1f7fbf", "9 5", 2.2, "backward whirl (B)"),
    "forward": Role("#cf5a12", "solid", 2.2, "forward whirl (F)"),
    "axial": Role("#1f7fbf", "solid", 2.2, "axial load"),
    "follower": Role("#cf5a12", "9 5", 2.2, "follower load"),
    "axial exact": Role("#1f7fbf", "2 4", 2.0, "axial, exact stiffness"),
    "follower exact": Role("#cf5a12", "2 4 8 4", 1.6, "follower, exact stiffness"),
    "growing": Role("#a8518a", "2 4", 2.6, "complex pair: Re ω̄ of a growing whirl"),
    "synchronous": Role("#80868f", "8 4 2 4", 1.4, "synchronous, |ω̄| = Ω̄"),
    "current": Role("#0f8a6a", "solid", 1.8, "present setting"),
    "limit": Role("#80868f", "9 5", 1.4, "buckling or flutter load"),
}


@dataclass(frozen=True, eq=False)
class Layer:
    """One kind of mark with its columns.

    Parameters
    ----------
    kind : {"regions", "lines", "points", "labels"}
        regions and lines hold a list of arrays in `xs`, `ys`; the others one value a row
        in `x`, `y`. All have a `name`; lines also a `role`, a key of `ROLES`; labels also a
        `side` of their point.
    label : str
        Unique within its chart.
    columns : mapping of str to sequence
        Equal lengths.
    """

    kind: str
    label: str
    columns: Mapping[str, Sequence[Any]]


@dataclass(frozen=True, eq=False)
class Chart:
    """Axes and layers of one chart."""

    key: str
    title: str
    x_label: str
    y_label: str
    x_range: tuple[float, float]
    y_range: tuple[float, float]
    layers: tuple[Layer, ...]

    def layer(self, label: str) -> Layer:
        """Return the layer of that label."""
        return next(layer for layer in self.layers if layer.label == label)


class _Lines:
    """Collects polylines into the columns of a "lines" layer."""

    def __init__(self) -> None:
        self.columns: dict[str, list[Any]] = {"xs": [], "ys": [], "name": [], "role": []}

    def add(self, xs: Array, ys: Array, name: str, role: str) -> None:
        for key, value in zip(self.columns, (xs, ys, name, role), strict=True):
            self.columns[key].append(value)

    def vertical(self, x: float, y_range: tuple[float, float], name: str, role: str) -> None:
        self.add(np.array([x, x]), np.array(y_range), name, role)

    def whirl(self, curves: WhirlCurves, roles: tuple[str, str], name: str) -> None:
        """Add every mode: its real stretches in its role, complex ones as growing.

        `roles` is for backward and forward modes; `name` has a place for the mode.
        """
        for column, mode in zip(curves.frequencies.T, curves.names, strict=True):
            complex_ = np.abs(column.imag) > _REAL * np.abs(column)
            real = np.where(complex_, np.nan, column.real)
            self.add(curves.parameter, real, name.format(mode), roles[mode.endswith("F")])
            if complex_.any():
                # one sample more on each side, so that the stretches meet
                near = complex_.copy()
                near[1:] |= complex_[:-1]
                near[:-1] |= complex_[1:]
                pair = np.where(near, column.real, np.nan)
                self.add(curves.parameter, pair, f"{name.format(mode)}, complex pair", "growing")


def _marks(rows: Sequence[tuple[Any, ...]], *extra: str) -> dict[str, Sequence[Any]]:
    """Return columns x, y, name and any extra ones from rows in that order."""
    columns: list[Sequence[Any]] = [list(column) for column in zip(*rows, strict=True)]
    columns = columns or [[] for _ in range(3 + len(extra))]
    x, y, *words = columns
    return {"x": np.array(x, float), "y": np.array(y, float)} | dict(
        zip(("name", *extra), words, strict=True)
    )


def _labels(rows: Sequence[tuple[float, float, str, str]]) -> dict[str, Sequence[Any]]:
    """Return label columns of (x, y, text, side) rows; the side is where the text goes."""
    return _marks(rows, "side")


def _direction(name: str) -> str:
    return "forward" if name.endswith("F") else "backward"


def instability_chart(
    bolotin: BolotinChart,
    fundamental_frequency: float,
    reference_load: float,
    frequency_range: tuple[float, float],
    largest_factor: float,
) -> Chart:
    """Return Bolotin's regions in the paper's axes, θ/ω_n and β_d.

    Parameters
    ----------
    bolotin : BolotinChart
    fundamental_frequency : float
        ω_n.
    reference_load : float
        What β_d = 1 stands for [EI/L²].
    frequency_range : (float, float)
        Of θ/ω_n.
    largest_factor : float
        Top of the β_d axis.
    """
    factor = bolotin.pulsating_load / reference_load
    ratio = bolotin.frequency / fundamental_frequency
    lines = _Lines()
    rows = []
    left, right = frequency_range
    for name, column in zip(bolotin.names, ratio.T, strict=True):
        lines.add(column, factor, f"{name} boundary", _direction(name))
        inside = np.flatnonzero(
            (column >= left) & (column <= right) & (factor <= 0.97 * largest_factor)
        )
        if inside.size:
            # modes 2, 3 … sit a step lower, so that 1F and 2B never collide
            top = largest_factor * (0.97 - 0.08 * (int(name[:-1]) - 1))
            place = inside[np.abs(factor[inside] - top).argmin()]
            # away from the line's own region, unless the chart's edge is near
            share = (column[place] - left) / (right - left)
            side = "right" if share < 0.08 or (name.endswith("F") and share < 0.92) else "left"
            rows.append((float(column[place]), float(factor[place]), name, side))
    polygons = [polygon / (fundamental_frequency, reference_load) for polygon in bolotin.regions]
    regions = {
        "xs": [polygon[:, 0] for polygon in polygons],
        "ys": [polygon[:, 1] for polygon in polygons],
        "name": ["Bolotin region"] * len(polygons),
    }
    return Chart(
        key="instability",
        title="Bolotin regions",
        x_label="excitation frequency θ/ωₙ",
        y_label="dynamic load factor β_d",
        x_range=frequency_range,
        y_range=(0.0, largest_factor),
        layers=(
            Layer("regions", "Bolotin region", regions),
            Layer("lines", "boundary", lines.columns),
            Layer("labels", "mode", _labels(rows)),
        ),
    )


def _symmetric(largest: float) -> tuple[float, float]:
    """Return a range ±largest, rounded up to a step so that it rarely moves."""
    step = 0.5 if largest < 4 else 2.0
    top = step * float(np.ceil(largest * 1.08 / step))
    return -top, top


def _mode_labels(curves: WhirlCurves, index: int, side: str) -> list[tuple[float, float, str, str]]:
    row = curves.frequencies[index]
    return [
        (float(curves.parameter[index]), float(value.real), name, side)
        for value, name in zip(row, curves.names, strict=True)
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
        What to draw; the first one's range is the chart's.
    static_load : float
        The present p̄₀, marked.
    limits : mapping of str to float
        Critical loads to mark by name; those out of range are left out.
    """
    first = next(iter(curves.values()))
    x_range = (float(first.parameter[0]), float(first.parameter[-1]))
    y_range = _symmetric(max(float(np.abs(c.frequencies.real).max()) for c in curves.values()))
    lines, marks = _Lines(), _Lines()
    for role, one in curves.items():
        lines.whirl(one, (role, role), f"{{}}, {role}")
    marks.vertical(static_load, y_range, f"present static load, p̄₀ = {static_load:.4g}", "current")
    rows = _mode_labels(first, 0, "upper right")
    for name, load in limits.items():
        if x_range[0] <= load <= x_range[1]:
            marks.vertical(load, y_range, f"{name}, p̄ = {load:.5g}", "limit")
            rows.append((load, y_range[0], name, "upper right"))
    return Chart(
        key="load-frequency",
        title="Load–frequency curves",
        x_label="steady load p̄",
        y_label="whirl frequency ω̄",
        x_range=x_range,
        y_range=y_range,
        layers=(
            Layer("lines", "whirl", lines.columns),
            Layer("lines", "marks", marks.columns),
            Layer("labels", "mode", _labels(rows)),
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
    y_range = _symmetric(float(np.abs(curves.frequencies.real).max()))
    lines, marks = _Lines(), _Lines()
    lines.whirl(curves, ("backward", "forward"), "{}")
    ends = np.array(x_range)
    lines.add(ends, ends, "synchronous, ω̄ = Ω̄", "synchronous")
    lines.add(ends, -ends, "synchronous, ω̄ = −Ω̄", "synchronous")
    marks.vertical(spin_speed, y_range, f"present spin speed, Ω̄ = {spin_speed:.4g}", "current")
    points = [
        (float(speed), sign * float(speed), f"critical speed, Ω̄ = {speed:.4g} ({word})")
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
        x_label="spin speed Ω̄",
        y_label="whirl frequency ω̄",
        x_range=x_range,
        y_range=y_range,
        layers=(
            Layer("lines", "whirl", lines.columns),
            Layer("lines", "marks", marks.columns),
            Layer("points", "critical speeds", _marks(points)),
            Layer("labels", "mode", _labels(_mode_labels(curves, -1, "upper left"))),
        ),
    )
