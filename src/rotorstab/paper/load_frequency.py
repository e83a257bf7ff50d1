"""Figure 8: whirl frequencies over the steady load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .._numerics.roots import is_real
from ..charts.columns import widened
from ..charts.figure import (
    LOAD_KINDS,
    Array,
    Figure,
    Label,
    Mark,
    Panel,
    Region,
    Series,
    lettered,
    parameters,
)
from ..charts.modes import modes
from ..charts.roles import Style
from ..floquet.resonance import resonances
from ..model.lumped import lumped
from ..model.system import System
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.campbell import load_frequency_curves
from ..whirl.critical_loads import critical_load, flutter_load
from ..whirl.frequencies import whirl_frequencies
from .floquet_readings import read_floquet_8
from .readings import read_figure_8

__all__ = ["figure_8"]

_COMPLEX = "complex pair"
_STRIP = 0.065  # of the axis: height of the strip of what is unstable without pulsation
_ROOM = (0.15, 0.98)  # of p̄_cr: where pairs are marked
_FLOQUET = (
    " Each upright line joins two whirls that a pulsation makes grow; its length is the θ of that "
    "tongue at that load. Strips: unstable without any pulsation."
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


def _curves(group: str, style: Style, system: System, loads: Array) -> list[Series]:
    """Return every mode's real stretches, and its complex ones as dotted lines of Re ω."""
    curves = load_frequency_curves(system, _refined(system, loads))
    series = []
    complex_pairs = ~is_real(curves.frequencies)
    columns = zip(modes(curves.names), curves.frequencies.T, complex_pairs.T, strict=True)
    for mode, column, complex_ in columns:
        name = f"{group}, {mode.name}"
        real = np.where(complex_, np.nan, column.real)
        series.append(Series(name, group, style, curves.parameter, real, mode=mode))
        if complex_.any():
            pair = np.where(widened(complex_), column.real, np.nan)
            name = f"{name}, {_COMPLEX}"
            series.append(Series(name, _COMPLEX, "dotted", curves.parameter, pair))
    return series


def _pairs(
    systems: Sequence[tuple[str, Style, System]], buckling: float
) -> tuple[list[Series], list[Mark]]:
    """Return upright lines between the two whirls of every tongue, each at a load of its own."""
    wanted = [
        [row.name for row in resonances(system, buckling / 2, buckling).tongues]
        for _, _, system in systems
    ]
    places = np.linspace(*_ROOM, len(systems) * max(map(len, wanted))) * buckling
    series, marks = [], []
    for index, ((group, style, system), names) in enumerate(zip(systems, wanted, strict=True)):
        own_places = places[index :: len(systems)][: len(names)].tolist()
        for load, name in zip(own_places, names, strict=True):
            table = resonances(system, load, buckling)
            row = next((one for one in table.tongues if one.name == name), None)
            if row is None:
                continue
            ends = sorted(
                float(np.real(w))
                for w, mode in zip(table.frequencies, table.modes, strict=True)
                if mode in (row.first, row.second)
            )
            line = np.array([load, load]), np.array(ends)
            series.append(Series(f"{group}, pair {name}", group, style, *line))
            marks.append(Mark(load, ends[0], name, vertical=True))
    return series, marks


def _strips(
    systems: Sequence[tuple[str, Style, System]], loads: Array, bottom: float, height: float
) -> tuple[list[Region], list[Mark]]:
    """Return the loads at which a rotor is unstable by itself, a strip for each kind of load."""
    regions, marks = [], []
    for index, (group, style, system) in enumerate(systems):
        fine = _refined(system, loads)
        grows = _complex_count(system, fine) > 0
        change = np.diff(np.concatenate([[False], grows, [False]]).astype(np.int8))
        low, high = bottom + index * height, bottom + (index + 0.9) * height
        runs = list(zip(np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1, strict=True))
        for count, (first, last) in enumerate(runs, 1):
            left, right = fine[first], fine[last]
            name = f"{group}, unstable without pulsation {count}"
            corners = np.array([left, left, right, right]), np.array([low, high, high, low])
            regions.append(Region(name, group, style, *corners))
        if runs:
            start = min(float(fine[runs[0][0]]), 0.7 * float(loads[-1]))
            marks.append(Mark(start, low, f"unstable: {group} alone"))
    return regions, marks


def figure_8(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = (0.0, 2.0),
    largest_load: float = 7.0,
    points: int = 281,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 8: load–frequency curves, axial and follower load.

    Parameters
    ----------
    rotor : ShaftDisk
    spin_speeds : sequence of up to 26 floats
        Ω̄, a panel each.
    largest_load : float
        p̄ runs from 0 to this [EI/L²].
    points : int
        Even loads; more are added where two frequencies meet.
    floquet : bool
        Whether to mark the pairs of whirls that a pulsation makes grow, and the loads that
        make the rotor unstable by themselves.

    Returns
    -------
    Figure
        Where two frequencies have met and become a complex pair, its real part is a
        series of its own in the group "complex pair".
    """
    loads = np.linspace(0.0, largest_load, points)
    panels = []
    limits: dict[str, float] = {"critical_load": float(critical_load(rotor.shear))}
    for letter, spin in lettered("spin_speeds", spin_speeds):
        series: list[Series] = []
        systems = [(group, style, lumped(rotor, spin, mu)) for group, style, mu in LOAD_KINDS]
        for group, style, system in systems:
            series += _curves(group, style, system, loads)
            if system.tangency:
                flutter = flutter_load(system)
                if np.isfinite(flutter):
                    limits[f"flutter_load_spin_{spin:g}"] = flutter
        top = float(np.ceil(1.05 * max(np.nanmax(np.abs(one.y)) for one in series)))
        regions: list[Region] = []
        marks: list[Mark] = []
        pairs: list[Series] = []
        bottom = -top
        if floquet:
            lowest = min(float(np.nanmin(one.y)) for one in series)
            span = 1.25 * (top - lowest)
            bottom = top - span
            pairs, marks = _pairs(systems, limits["critical_load"])
            regions, names = _strips(systems, loads, bottom, _STRIP * span)
            marks = marks + names
        panels.append(
            Panel(
                letter=letter,
                title=f"Ω̄ = {spin:g}",
                x_label="p̄",
                y_label="ω̄",
                x_unit="EI/L²",
                y_unit="√(EI/ρAL⁴)",
                series=(*series, *pairs),
                labels=tuple(
                    Label(0.0, float(line.y[0]), line.mode.name, low=not line.mode.forward)
                    for line in series
                    if line.group == "axial force" and line.mode is not None
                ),
                x_range=(0.0, largest_load),
                y_range=(bottom, top),
                unstable=tuple(regions),
                marks=tuple(marks),
            )
        )
    figure = Figure(
        number=8,
        title="Load–frequency curves",
        caption="Solid: axial force. Dashed: follower force. Dotted: real part of a complex pair.",
        parameters=parameters(rotor, spin_speeds=list(spin_speeds), **limits),
        panels=tuple(panels),
        reading=read_figure_8(tuple(panels), rotor),
    )
    if not floquet:
        return figure
    return replace(
        figure,
        caption=figure.caption + _FLOQUET,
        reading=(*figure.reading, *read_floquet_8(figure.panels, rotor, spin_speeds)),
    )
