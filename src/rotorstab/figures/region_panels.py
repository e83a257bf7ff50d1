"""Panels of Bolotin regions in the plane of θ/ω_n and β_d."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..bolotin import bolotin_chart
from ..system import System
from .structure import Panel, Region, Series, Style

__all__ = ["Variant", "region_panel"]

_MODES = ("1B", "1F", "2B", "2F")


@dataclass(frozen=True, eq=False)
class Variant:
    """One system in a panel, and what its loads are measured by."""

    group: str
    style: Style
    system: System
    static_factor: float
    reference_load: float


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
        Series(f"{variant.group}, {mode}", variant.group, variant.style, column, factor)
        for mode in _MODES
        for name, column in zip(chart.names, (chart.frequency / frequency).T, strict=True)
        if name == mode
    ]
    top = _rightmost(series)
    regions: list[Region] = []
    for polygon in chart.regions:
        x, y = polygon[:, 0] / frequency, polygon[:, 1] / reference
        if x.min() < top:
            name = f"{variant.group}, Bolotin region {len(regions) + 1}"
            regions.append(Region(name, variant.group, variant.style, x, y))
    return series, regions


def region_panel(
    letter: str,
    title: str,
    variants: Sequence[Variant],
    frequency: float,
    largest_factor: float,
) -> Panel:
    """Return a panel with every variant's regions and boundaries.

    Labels name the first variant's boundaries at their upper ends.
    """
    series: list[Series] = []
    regions: list[Region] = []
    for variant in variants:
        lines, shades = _draw(variant, frequency, largest_factor)
        series += lines
        regions += shades
    top = _rightmost(series)
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
            (float(one.x[-1]), largest_factor, one.name.rsplit(", ", 1)[1])
            for one in series[: len(_MODES)]
            if np.isfinite(one.x[-1])
        ),
        x_range=(0.0, float(max(1, math.ceil(1.02 * top)))),
        y_range=(0.0, largest_factor),
    )
