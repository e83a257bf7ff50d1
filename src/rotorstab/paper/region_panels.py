"""Panels of Bolotin regions, and of what is unstable, in the plane of θ/ω_n and β_d."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..bolotin.chart import bolotin_chart
from ..charts.figure import Label, Mark, Panel, Region, Series
from ..charts.modes import modes
from ..charts.roles import Style
from ..floquet.resonance import resonances
from ..floquet.tongues.outlines import unstable_outlines
from ..model.system import System

__all__ = ["LOWEST", "Variant", "region_panel"]

LOWEST = 0.2
"""θ/ω_n from which Floquet looks: below, tongues of ever higher order crowd together."""

_MODES = ("1B", "1F", "2B", "2F")
_NAME_WIDTH = 0.06  # of the axis: room for the name of one tongue
_NAME_HEIGHT = 0.09
_APART = 0.05  # of the axis: roots of one pair farther apart are named each


@dataclass(frozen=True, eq=False)
class Variant:
    """One system in a panel, and what its loads are measured by.

    Floquet may take another system in its place, with fewer coordinates.
    """

    group: str
    style: Style
    system: System
    static_factor: float
    reference_load: float
    floquet_system: System | None = None

    @property
    def mean_load(self) -> float:
        """The steady part of the load."""
        return self.static_factor * self.reference_load

    @property
    def true_system(self) -> System:
        """The system whose multipliers are computed."""
        return self.floquet_system or self.system


def _rightmost(series: Sequence[Series]) -> float:
    """Return the largest real θ/ω_n of some boundaries."""
    values = np.concatenate([one.x for one in series])
    return float(values[np.isfinite(values)].max(initial=0.0))


def _draw(
    variant: Variant, frequency: float, largest_factor: float
) -> tuple[list[Series], list[Region]]:
    """Return the first four boundaries of a variant and the regions they bound."""
    reference = variant.reference_load
    chart = bolotin_chart(
        variant.system, variant.static_factor * reference, largest_factor * reference
    )
    factor = chart.pulsating_load / reference
    series = [
        Series(
            f"{variant.group}, {mode.name}", variant.group, variant.style, column, factor, mode=mode
        )
        for name in _MODES
        for mode, column in zip(modes(chart.names), (chart.frequency / frequency).T, strict=True)
        if mode.name == name
    ]
    top = _rightmost(series)
    regions: list[Region] = []
    for polygon in chart.regions:
        x, y = polygon[:, 0] / frequency, polygon[:, 1] / reference
        if x.min() < top:
            name = f"{variant.group}, Bolotin region {len(regions) + 1}"
            regions.append(Region(name, variant.group, variant.style, x, y))
    return series, regions


def _unstable(
    variant: Variant, frequency: float, largest_factor: float, highest: float
) -> list[Region]:
    """Return what Floquet finds unstable of a variant, up to θ/ω_n of `highest`."""
    reference = variant.reference_load
    pieces = unstable_outlines(
        variant.true_system,
        variant.mean_load,
        largest_factor * reference,
        LOWEST * frequency,
        highest * frequency,
    )
    regions = []
    for count, one in enumerate(pieces, 1):
        order = f", order {one.order}" if one.order > 1 else ""
        name = f"{variant.group}, unstable {count}" + (f" ({one.name}{order})" if one.name else "")
        x = np.concatenate([one.left, one.right[::-1]]) / frequency
        y = np.concatenate([one.pulsating_loads, one.pulsating_loads[::-1]]) / reference
        regions.append(Region(name, variant.group, variant.style, x, y, one.name, one.order))
    return regions


def _names(
    variants: Sequence[Variant], frequency: float, largest_factor: float, highest: float
) -> tuple[Mark, ...]:
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
        near = next((other for other in merged if x - other < 0.004 * highest), x)
        merged.setdefault(near, []).append(name)
    marks: list[Mark] = []
    for x, names in merged.items():
        text = ", ".join(sorted(names))
        room = _NAME_WIDTH * highest * len(names)
        x = min(x, highest - room)
        level = 0
        while any(
            one.y == _level(level) * largest_factor
            and one.x - room < x < one.x + _NAME_WIDTH * highest * (1 + one.text.count(","))
            for one in marks
        ):
            level += 1
        marks.append(Mark(x, _level(level) * largest_factor, text))
    return tuple(marks)


def _level(step: int) -> float:
    return 0.015 + _NAME_HEIGHT * step


def region_panel(
    letter: str,
    title: str,
    variants: Sequence[Variant],
    frequency: float,
    largest_factor: float,
    floquet: bool = False,
    highest: float | None = None,
) -> Panel:
    """Return a panel with every variant's regions and boundaries.

    Labels name the first variant's boundaries at their upper ends. With Floquet it also has
    every variant's unstable set. The θ/ω_n axis ends at `highest`, or right of all boundaries.
    """
    series: list[Series] = []
    regions: list[Region] = []
    for variant in variants:
        lines, shades = _draw(variant, frequency, largest_factor)
        series += lines
        regions += shades
    if highest is None:
        highest = float(max(1, math.ceil(1.02 * _rightmost(series))))
    unstable = [
        region
        for variant in variants
        for region in (_unstable(variant, frequency, largest_factor, highest) if floquet else ())
    ]
    return Panel(
        letter=letter,
        title=title,
        x_label="θ/ωₙ",
        y_label="β_d",
        x_unit="-",
        y_unit="-",
        series=tuple(series),
        regions=tuple(regions),
        labels=tuple(
            Label(float(line.x[-1]), largest_factor, line.mode.name, low=not line.mode.forward)
            for line in series[: len(_MODES)]
            if line.mode is not None and np.isfinite(line.x[-1])
        ),
        x_range=(0.0, highest),
        y_range=(0.0, largest_factor),
        unstable=tuple(unstable),
        marks=_names(variants, frequency, largest_factor, highest) if floquet else (),
    )
