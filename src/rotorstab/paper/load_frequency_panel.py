"""Panels of Fig. 8: whirl frequencies over the static load, and what grows with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .._numerics.roots import is_real
from .._types import Array
from ..charts.columns import Lines, label_columns, widened
from ..charts.modes import modes
from ..charts.quantities import LOAD, WHIRL
from ..charts.roles import Style
from ..charts.structure import Chart, Layer
from ..floquet.resonance import resonances
from ..model.system import System
from ..whirl.campbell import load_frequency_curves
from ..whirl.frequencies import whirl_frequencies

__all__ = ["LoadedRotor", "whirl_chart"]

Labels = list[tuple[float, float, str, str]]

_COMPLEX = "complex pair"
_STRIP = 0.065  # of the axis: height of the strip of what is unstable without pulsation
_ROOM = (0.15, 0.98)  # of p̄_cr: where pairs are marked


@dataclass(frozen=True, eq=False)
class LoadedRotor:
    """The rotor under one kind of load: its legend entry, its line style, its system."""

    group: str
    style: Style
    system: System


def whirl_chart(
    letter: str,
    title: str,
    rotors: Sequence[LoadedRotor],
    loads: Array,
    buckling: float,
    floquet: bool,
) -> Chart:
    """Return one panel; with Floquet it has pairs and, at its foot, strips."""
    lines = Lines()
    for rotor in rotors:
        _add_curves(lines, rotor, loads)
    whirl = Layer("lines", "whirl", lines.columns)
    curves = whirl.curves()
    top = float(np.ceil(1.05 * max(np.nanmax(np.abs(line.y)) for line in curves)))
    bottom = -top
    above: list[Layer] = []
    if floquet:
        span = 1.25 * (top - min(float(np.nanmin(line.y)) for line in curves))
        bottom = top - span
        pairs, names = _pairs(rotors, buckling)
        strips, more_names = _strips(rotors, loads, bottom, _STRIP * span)
        above = [
            Layer("lines", "pairs", pairs.columns),
            Layer("outlines", "unstable without pulsation", strips.columns),
            Layer("labels", "tongue", label_columns(names + more_names)),
        ]
    names_at_0 = [
        (
            0.0,
            float(line.y[0]),
            line.mode.name,
            "upper right" if line.mode.forward else "lower right",
        )
        for line in curves
        if line.group == rotors[0].group and line.mode is not None
    ]
    return Chart(
        key=letter,
        letter=letter,
        title=title,
        x=LOAD,
        y=WHIRL,
        x_range=(0.0, float(loads[-1])),
        y_range=(bottom, top),
        layers=(whirl, Layer("labels", "mode", label_columns(names_at_0)), *above),
    )


def _complex_count(system: System, loads: Array) -> Array:
    """Return how many whirl frequencies are complex at each load."""
    frequencies = whirl_frequencies(system, loads)
    return np.asarray((~is_real(frequencies)).sum(axis=-1))


def _refined(system: System, loads: Array) -> Array:
    """Return the loads with graded ones added at every meeting of two frequencies.

    There the frequency turns as a square root.
    """
    count = _complex_count(system, loads)
    changes = np.flatnonzero(count[1:] != count[:-1])
    if not changes.size:
        return loads
    low, high, below = loads[changes], loads[changes + 1], count[changes]
    for _ in range(48):
        middle = (low + high) / 2
        same = _complex_count(system, middle) == below
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    grading = (np.linspace(0.0, 1.0, 12)[1:-1] ** 2)[:, None]
    before = low - (low - loads[changes]) * grading
    after = high + (loads[changes + 1] - high) * grading
    return np.unique(np.concatenate([loads, low, high, before.ravel(), after.ravel()]))


def _add_curves(lines: Lines, rotor: LoadedRotor, loads: Array) -> None:
    """Add every mode's real stretches, and its complex ones as dotted lines of Re ω."""
    curves = load_frequency_curves(rotor.system, _refined(rotor.system, loads))
    complex_pairs = ~is_real(curves.frequencies)
    columns = zip(modes(curves.names), curves.frequencies.T, complex_pairs.T, strict=True)
    for mode, column, is_complex in columns:
        name = f"{rotor.group}, {mode.name}"
        real = np.where(is_complex, np.nan, column.real)
        lines.add(curves.parameter, real, name, rotor.style, rotor.group, mode)
        if is_complex.any():
            pair = np.where(widened(is_complex), column.real, np.nan)
            lines.add(curves.parameter, pair, f"{name}, {_COMPLEX}", "dotted", _COMPLEX)


def _pairs(rotors: Sequence[LoadedRotor], buckling: float) -> tuple[Lines, Labels]:
    """Return upright lines between the two whirls of every tongue, each at a load of its own."""
    wanted = [
        [row.name for row in resonances(rotor.system, buckling / 2, buckling).tongues]
        for rotor in rotors
    ]
    places = np.linspace(*_ROOM, len(rotors) * max(map(len, wanted))) * buckling
    lines, labels = Lines(), []
    for index, (rotor, names) in enumerate(zip(rotors, wanted, strict=True)):
        own_places = places[index :: len(rotors)][: len(names)].tolist()
        for load, name in zip(own_places, names, strict=True):
            table = resonances(rotor.system, load, buckling)
            row = next((row for row in table.tongues if row.name == name), None)
            if row is None:
                continue
            ends = sorted(
                float(np.real(frequency))
                for frequency, mode in zip(table.frequencies, table.modes, strict=True)
                if mode in (row.first, row.second)
            )
            line = np.array([load, load]), np.array(ends)
            lines.add(*line, f"{rotor.group}, pair {name}", rotor.style, rotor.group, pair=name)
            labels.append((load, ends[0], name, "upright"))
    return lines, labels


def _strips(
    rotors: Sequence[LoadedRotor], loads: Array, bottom: float, height: float
) -> tuple[Lines, Labels]:
    """Return the loads at which a rotor is unstable by itself, a strip for each kind of load."""
    strips, labels = Lines(), []
    for index, rotor in enumerate(rotors):
        group = rotor.group
        fine = _refined(rotor.system, loads)
        grows = _complex_count(rotor.system, fine) > 0
        change = np.diff(np.concatenate([[False], grows, [False]]).astype(np.int8))
        low, high = bottom + index * height, bottom + (index + 0.9) * height
        runs = list(zip(np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1, strict=True))
        for count, (first, last) in enumerate(runs, 1):
            x = np.array([fine[first], fine[first], np.nan, fine[last], fine[last]])
            y = np.array([low, high, np.nan, high, low])
            strips.add(x, y, f"{group}, unstable without pulsation {count}", rotor.style, group)
        if runs:
            start = min(float(fine[runs[0][0]]), 0.7 * float(loads[-1]))
            labels.append((start, low, f"unstable: {group} alone", "foot"))
    return strips, labels
