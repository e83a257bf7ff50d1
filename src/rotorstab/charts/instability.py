"""The instability chart: Bolotin's regions, and Floquet's growth under them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..bolotin.chart import BolotinChart
from .columns import Lines, label_columns
from .modes import modes
from .quantities import AXES
from .structure import Chart, Layer
from .tongues import GrowthGrid, blank_layers, growth_layers, outline_layers, tongue_labels

__all__ = ["BOLOTIN", "instability_chart"]

BOLOTIN = "Bolotin region"
"""The name of Bolotin's regions, which are not called unstable."""


def instability_chart(
    bolotin: BolotinChart,
    fundamental_frequency: float,
    reference_load: float,
    frequency_range: tuple[float, float],
    factor_range: float | tuple[float, float],
    grid: GrowthGrid | None = None,
    tongues: Sequence[tuple[float, str]] = (),
    blanks: Sequence[tuple[tuple[float, float, float, float], str]] = (),
) -> Chart:
    """Return Bolotin's regions, and Floquet's growth, in the paper's axes θ/ω_n and β_d.

    Parameters
    ----------
    bolotin : BolotinChart
    fundamental_frequency : float
        ω_n.
    reference_load : float
        What β_d = 1 stands for [EI/L²].
    frequency_range : (float, float)
        Of θ/ω_n.
    factor_range : float or (float, float)
        Of β_d; a single number is the upper end of a range from 0.
    grid : GrowthGrid, optional
        Floquet's answer; without it the chart is the paper's.
    tongues : sequence of (float, str)
        Centres θ/ω_n and names of the true tongues.
    blanks : sequence of ((float, float, float, float), str)
        Rectangles of the chart that `grid` does not cover, and why: see `blank_layers`.
    """
    scales = fundamental_frequency, reference_load
    low, high = factor_range if isinstance(factor_range, tuple) else (0.0, factor_range)
    below: list[Layer] = []
    above: list[Layer] = []
    if grid is not None:
        below = growth_layers(grid, scales)
        above = [] if grid.edges is None else outline_layers(grid.edges, scales)
        above += blank_layers(blanks, frequency_range, (low, high))
        above.append(tongue_labels(tongues, frequency_range, (low, high)))
    return Chart(
        key="instability",
        title="Instability chart",
        x=AXES["instability"][0],
        y=AXES["instability"][1],
        x_range=frequency_range,
        y_range=(low, high),
        layers=(
            *below,
            _region_layer(bolotin, scales),
            *_boundary_layers(bolotin, scales, frequency_range, (low, high)),
            *above,
        ),
    )


def _region_layer(bolotin: BolotinChart, scales: tuple[float, float]) -> Layer:
    regions = Lines()
    for polygon in bolotin.regions:
        x, y = (polygon / scales).T
        regions.add(x, y, BOLOTIN, "solid", BOLOTIN)
    return Layer("regions", BOLOTIN, regions.columns)


def _boundary_layers(
    bolotin: BolotinChart,
    scales: tuple[float, float],
    frequency_range: tuple[float, float],
    factor_range: tuple[float, float],
) -> list[Layer]:
    """Return Bolotin's boundaries, and their names near the top of the chart."""
    ratio, factor = bolotin.frequency / scales[0], bolotin.pulsating_load / scales[1]
    left, right = frequency_range
    low, high = factor_range
    lines = Lines()
    rows = []
    for mode, column in zip(modes(bolotin.names), ratio.T, strict=True):
        role = "forward" if mode.forward else "backward"
        lines.add(column, factor, f"{mode.name} boundary", role, mode=mode)
        inside = np.flatnonzero(
            (column >= left)
            & (column <= right)
            & (factor >= low)
            & (factor <= low + 0.97 * (high - low))
        )
        if inside.size:
            # modes 2, 3 … sit a step lower, so that 1F and 2B never collide
            top = low + (high - low) * (0.97 - 0.08 * (mode.number - 1))
            place = inside[np.abs(factor[inside] - top).argmin()]
            # away from the line's own region, unless the chart's edge is near
            share = (column[place] - left) / (right - left)
            side = "right" if share < 0.08 or (mode.forward and share < 0.92) else "left"
            rows.append((float(column[place]), float(factor[place]), mode.name, side))
    return [
        Layer("lines", "boundary", lines.columns),
        Layer("labels", "boundary name", label_columns(rows)),
    ]
