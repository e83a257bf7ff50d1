"""Figures of Bolotin regions, and of what is unstable, in the plane of θ/ω_n and β_d.

Figs 4, 5, 6, 7 and 9 and the regions of a user's rotor are made here; each has its own variants.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from .._types import Array
from ..bolotin.chart import bolotin_chart
from ..charts.columns import Lines, label_columns
from ..charts.figure import Figure
from ..charts.instability import BOLOTIN
from ..charts.modes import modes
from ..charts.quantities import LOAD_FACTOR, Quantity
from ..charts.roles import Style
from ..charts.structure import Chart, Curve, Layer
from ..charts.tongues import add_outline
from ..floquet.resonance import resonances
from ..floquet.tongues.outlines import unstable_outlines
from ..model.system import System

__all__ = ["LOWEST", "RegionPanel", "Variant", "region_chart", "region_figure"]

LOWEST = 0.2
"""θ/ω_n from which Floquet looks: below, tongues of ever higher order crowd together."""

_FLOQUET = (
    " Pale and thin: Bolotin regions. Full: unstable by Floquet, tongues of first order named by "
    f"their mode pair, the others of order k at θ = |ω_i − ω_j|/k; sought from θ/ω_n = {LOWEST:g}."
)
_FREQUENCY_RATIO = Quantity("", "θ/ωₙ")
_MODES = ("1B", "1F", "2B", "2F")
_NAME_WIDTH = 0.06  # of the axis: room for the name of one tongue
_NAME_HEIGHT = 0.09
_APART = 0.05  # of the axis: roots of one pair farther apart are named each
_TOGETHER = 0.004  # of the axis: roots nearer to each other share a name
_NEAR_LEFT = 0.07  # of the axis: names nearer to its left end stand right of their line


@dataclass(frozen=True, eq=False)
class Variant:
    """One system in a panel, and what its loads are measured by.

    Parameters
    ----------
    group : str
        Its entry in the legend.
    style : Style
        Its line style.
    system : System
    static_factor : float
        α_s.
    reference_load : float
        What a load factor of 1 stands for [EI/L²].
    floquet_system : System, optional
        The system whose multipliers are computed, where that is one with fewer coordinates.
    """

    group: str
    style: Style
    system: System
    static_factor: float
    reference_load: float
    floquet_system: System | None = None

    @property
    def mean_load(self) -> float:
        """The static part of the load [EI/L²]."""
        return self.static_factor * self.reference_load

    @property
    def true_system(self) -> System:
        """The system whose multipliers are computed."""
        return self.floquet_system or self.system


@dataclass(frozen=True, eq=False)
class RegionPanel:
    """What a panel shows: its letter, its title, and variants of which each has its own style."""

    letter: str
    title: str
    variants: Sequence[Variant]


def region_figure(
    figure: Figure,
    panels: Sequence[RegionPanel],
    frequency: float,
    largest_factor: float,
    floquet: bool = False,
) -> Figure:
    """Return a figure with the charts of its panels.

    Parameters
    ----------
    figure : Figure
        Without panels and reading.
    panels : sequence of RegionPanel
    frequency : float
        ω_n [√(EI/(ρAL⁴))], by which θ̄ is divided.
    largest_factor : float
        Top of the β_d axis.
    floquet : bool
        Whether to add what is unstable; the caption and the parameters then say so.
    """
    charts = tuple(region_chart(panel, frequency, largest_factor, floquet) for panel in panels)
    if not floquet:
        return replace(figure, panels=charts)
    return replace(
        figure,
        panels=charts,
        caption=figure.caption + _FLOQUET,
        parameters={**figure.parameters, "floquet_from": LOWEST},
    )


def region_chart(
    panel: RegionPanel,
    frequency: float,
    largest_factor: float,
    floquet: bool = False,
    highest: float | None = None,
) -> Chart:
    """Return the chart of a panel with every variant's regions and boundaries.

    Labels name the first variant's boundaries at their upper ends. With Floquet it also has
    every variant's unstable set. The θ/ω_n axis ends at `highest`, or right of all boundaries.
    """
    lines, regions = Lines(), Lines()
    for variant in panel.variants:
        _add_bolotin(lines, regions, variant, frequency, largest_factor)
    boundary = Layer("lines", "boundary", lines.columns)
    if highest is None:
        highest = float(max(1, math.ceil(1.02 * _largest([line.x for line in boundary.curves()]))))
    above: list[Layer] = []
    if floquet:
        unstable = Lines()
        for variant in panel.variants:
            _add_unstable(unstable, variant, frequency, largest_factor, highest)
        above = [
            Layer("outlines", "tongue edge", unstable.columns),
            _tongue_names(panel.variants, frequency, largest_factor, highest),
        ]
    return Chart(
        key=panel.letter,
        letter=panel.letter,
        title=panel.title,
        x=_FREQUENCY_RATIO,
        y=LOAD_FACTOR,
        x_range=(0.0, highest),
        y_range=(0.0, largest_factor),
        layers=(
            Layer("regions", BOLOTIN, regions.columns),
            boundary,
            _boundary_names(boundary.curves()[: len(_MODES)], highest, largest_factor),
            *above,
        ),
    )


def _largest(ratios: Sequence[Array]) -> float:
    """Return the largest real θ/ω_n of some boundaries."""
    values = np.concatenate(ratios)
    return float(values[np.isfinite(values)].max(initial=0.0))


def _add_bolotin(
    lines: Lines, regions: Lines, variant: Variant, frequency: float, largest_factor: float
) -> None:
    """Add the first four boundaries of a variant and the regions that they bound."""
    reference, group = variant.reference_load, variant.group
    chart = bolotin_chart(
        variant.system, variant.static_factor * reference, largest_factor * reference
    )
    factor = chart.pulsating_load / reference
    ratio = dict(zip(chart.names, (chart.frequency / frequency).T, strict=True))
    known = {mode.name: mode for mode in modes(chart.names)}
    for name in _MODES:
        lines.add(ratio[name], factor, f"{group}, {name}", variant.style, group, known[name])
    right_end = _largest([ratio[name] for name in _MODES])
    count = 0
    for polygon in chart.regions:
        x, y = polygon[:, 0] / frequency, polygon[:, 1] / reference
        if x.min() < right_end:
            count += 1
            regions.add(x, y, f"{group}, {BOLOTIN} {count}", variant.style, group)


def _boundary_names(boundaries: Sequence[Curve], highest: float, largest_factor: float) -> Layer:
    """Name boundaries above their upper ends, backward modes to the left of their lines."""
    rows = []
    for line in boundaries:
        x = float(line.x[-1])
        if line.mode is not None and np.isfinite(x):
            left = not line.mode.forward and x > _NEAR_LEFT * highest
            side = "frame top left" if left else "frame top right"
            rows.append((x, largest_factor, line.mode.name, side))
    return Layer("labels", "boundary name", label_columns(rows))


def _add_unstable(
    lines: Lines, variant: Variant, frequency: float, largest_factor: float, highest: float
) -> None:
    """Add what Floquet finds unstable of a variant, up to θ/ω_n of `highest`."""
    reference, group = variant.reference_load, variant.group
    pieces = unstable_outlines(
        variant.true_system,
        variant.mean_load,
        largest_factor * reference,
        LOWEST * frequency,
        highest * frequency,
    )
    for count, piece in enumerate(pieces, 1):
        order = f", order {piece.order}" if piece.order > 1 else ""
        pair = f" ({piece.name}{order})" if piece.name else ""
        name = f"{group}, unstable {count}{pair}"
        add_outline(lines, piece, (frequency, reference), name, variant.style, group)


def _tongue_names(
    variants: Sequence[Variant], frequency: float, largest_factor: float, highest: float
) -> Layer:
    """Name the tongues of first order, right of their roots, clear of other names."""
    roots: dict[str, list[float]] = {}
    for variant in variants:
        table = resonances(variant.true_system, variant.mean_load, variant.reference_load)
        for row in table.tongues:
            x = row.centre / frequency
            if LOWEST <= x <= highest:
                roots.setdefault(row.name, []).append(x)
    # variants whose roots lie close by share a name, right of the last of them
    places = [
        (x, name)
        for name, row in roots.items()
        for x, after in pairwise([*sorted(row), np.inf])
        if after - x > _APART * highest
    ]
    merged: dict[float, list[str]] = {}
    for x, name in sorted(places):
        near = next((other for other in merged if x - other < _TOGETHER * highest), x)
        merged.setdefault(near, []).append(name)
    rows: list[tuple[float, float, str, str]] = []
    taken: list[tuple[float, float, int]] = []  # where each name begins and ends, and its level
    for x, names in merged.items():
        room = _NAME_WIDTH * highest * len(names)
        x = min(x, highest - room)
        level = 0
        while any(level == at and begin - room < x < end for begin, end, at in taken):
            level += 1
        taken.append((x, x + room, level))
        height = (0.015 + _NAME_HEIGHT * level) * largest_factor
        rows.append((x, height, ", ".join(sorted(names)), "foot"))
    return Layer("labels", "tongue", label_columns(rows))
