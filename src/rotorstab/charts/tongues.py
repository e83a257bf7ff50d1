"""What Floquet says of the instability chart: growth, edges and names of tongues."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._types import Array, Mask
from ..floquet.tongues.outlines import Outline
from ..maps.grid_edges import GridEdges
from .agreement import Agreement, agreement
from .columns import Lines, label_columns
from .quantities import GROWTH, GROWTH_PER_PERIOD
from .structure import Chart, Layer

__all__ = [
    "FLOQUET",
    "GrowthGrid",
    "add_outline",
    "blank_layers",
    "fitted_top",
    "growth_layers",
    "outline_layers",
    "tongue_labels",
    "with_top",
]


_NARROW, _ROOM = 0.25, 0.02  # of the chart's width: a part that is narrower has an upright label
_LABEL = 0.11  # part of the axis for a label; a narrower chart moves its labels itself
THIN = "thin tongue (Floquet)"
FLOQUET = "unstable (Floquet)"
"""The group of what Floquet finds unstable, where a chart shows one rotor."""


@dataclass(frozen=True, eq=False)
class GrowthGrid:
    """Floquet's answer on the pixels of the instability chart, and on a finer grid its edges.

    Parameters
    ----------
    growth : (R, C) float
        σ̄ [√(EI/(ρAL⁴))] at the pixel centres, or the growth of a narrower tongue
        inside the pixel; rows upwards.
    unstable : (R, C) bool
        Floquet's verdict.
    bolotin : (R, C) bool or None
        Whether the pixel lies in a Bolotin region; None where there is none to compare with.
    window : (float, float, float, float)
        Lowest and highest θ/ω_n, lowest and highest β_d of the pixels.
    per_period : bool
        Whether to colour by σ̄T instead of σ̄.
    edges : GridEdges, optional
        Where the unstable set ends, from `stability_chart`; without it there is no colour.
    rates : (R', C') float, optional
        σ̄ on the grid of `edges`.
    top : float, optional
        Growth at the upper end of the colours, in the unit that is shown; by default it fits the
        chart.
    """

    growth: Array
    unstable: Mask
    bolotin: Mask | None
    window: tuple[float, float, float, float]
    per_period: bool = False
    edges: GridEdges | None = None
    rates: Array | None = None
    top: float | None = None


def tongue_labels(
    tongues: Sequence[tuple[float, str]],
    frequency_range: tuple[float, float],
    factor_range: tuple[float, float],
) -> Layer:
    """Return a label at the foot of each tongue, raised where the next one would touch it.

    Parameters
    ----------
    tongues : sequence of (float, str)
        Abscissas and names; those outside the range are left out.
    frequency_range : (float, float)
        Of the abscissa.
    factor_range : (float, float)
        Of the ordinate.
    """
    low, high = factor_range
    left, right = frequency_range
    rows: list[tuple[float, float, str, str]] = []
    taken: list[tuple[float, int]] = []  # where each label starts, and its level
    for x, name in sorted(tongues):
        share = (x - left) / (right - left)
        if not 0 <= share <= 1:
            continue
        side = "right" if share <= 1 - _LABEL else "left"
        start = share if side == "right" else share - _LABEL
        level = 0
        while any(abs(start - other) < _LABEL and level == at for other, at in taken):
            level += 1
        taken.append((start, level))
        rows.append((x, low + (high - low) * (0.045 + 0.075 * level), name, side))
    return Layer("labels", "tongue", label_columns(rows))


def growth_layers(grid: GrowthGrid, scales: tuple[float, float]) -> list[Layer]:
    """Return what is unstable as bands of growth, and below it the maps of growth and disagreement.

    Parameters
    ----------
    grid : GrowthGrid
    scales : (float, float)
        ω_n, and what β_d = 1 stands for.
    """
    left, right, low, high = grid.window
    columns = grid.growth.shape[1]
    ratio = left + (np.arange(columns) + 0.5) / columns * (right - left)
    shown = _shown(grid, grid.growth, ratio * scales[0])
    place = {"x": [left], "y": [low], "dw": [right - left], "dh": [high - low]}
    verdict = agreement(grid.growth, grid.unstable, grid.bolotin)
    clear = np.float32(np.nan)
    layers = []
    if grid.bolotin is not None:
        disagree = np.full(verdict.shape, clear, np.float32)
        disagree[verdict == Agreement.BOLOTIN_ONLY] = 0.0
        disagree[verdict == Agreement.FLOQUET_ONLY] = 1.0
        # below: a colour of growth is that of the colour bar wherever it stands
        layers.append(Layer("map", "disagreement", {"image": [disagree], **place}))
    quantity = GROWTH_PER_PERIOD if grid.per_period else GROWTH
    layers.append(
        Layer(
            "map",
            "growth",
            {
                "image": [np.where(grid.unstable, shown, clear).astype(np.float32)],
                "rate": [np.where(grid.unstable, grid.growth, 0.0).astype(np.float32)],
                "verdict": [verdict],
                "frequency": [scales[0]],
                **place,
            },
            quantity=quantity,
        )
    )
    if grid.edges is not None and grid.rates is not None:
        rates = _shown(grid, grid.rates, grid.edges.excitation_frequencies)
        top = fitted_top(rates) if grid.top is None else grid.top
        growing = np.maximum(np.nan_to_num(rates), 0.0)
        bands = {**_edge_columns(grid.edges, scales), "growth": [growing], "top": [top]}
        layers.append(Layer("bands", "unstable", bands, quantity=quantity))
    return layers


def _shown(grid: GrowthGrid, growth: Array, frequencies: Array) -> Array:
    return growth * (2 * np.pi / frequencies) if grid.per_period else growth


def fitted_top(growth: Array) -> float:
    """Return the upper end of a scale of growth: rounded up, so that it rarely changes."""
    grows = growth[growth > 0]
    # not the maximum: a few points of very slow loads would take all colours
    largest = float(np.percentile(grows, 98)) if grows.size else 0.0
    if largest <= 0:
        return 1.0
    step = 10.0 ** np.floor(np.log10(largest))
    return float(np.ceil(largest / step) * step)


def with_top(chart: Chart, top: float) -> Chart:
    """Return a chart whose colours of growth end at another growth, in the unit that is shown."""
    layers = tuple(
        replace(layer, columns={**layer.columns, "top": [top]}) if layer.kind == "bands" else layer
        for layer in chart.layers
    )
    return replace(chart, layers=layers)


def _edge_columns(edges: GridEdges, scales: tuple[float, float]) -> dict[str, Sequence[Any]]:
    """Return the grid of edges as columns of a layer."""
    return {
        "x": [edges.excitation_frequencies / scales[0]],
        "y": [edges.pulsating_loads / scales[1]],
        "edge": [edges.function],
        "across": [edges.across],
        "along": [edges.along],
    }


def outline_layers(edges: GridEdges, scales: tuple[float, float]) -> list[Layer]:
    """Return the edge of the unstable set, and lines along tongues that the grid does not see."""
    look = {"name": ["edge of what is unstable"], "role": ["edge"], "group": [FLOQUET]}
    lines = Lines()
    for tongue in edges.thin:
        order = f", order {tongue.order}" if tongue.order > 1 else ""
        x, y = tongue.excitation_frequencies / scales[0], tongue.pulsating_loads / scales[1]
        name = f"thin tongue {tongue.name}{order}".strip()
        lines.add(x, y, name, "edge", THIN, pair=tongue.name, order=tongue.order)
    return [
        Layer("edges", "tongue edge", {**_edge_columns(edges, scales), **look}),
        Layer("lines", "thin tongue", lines.columns),
    ]


def blank_layers(
    blanks: Sequence[tuple[tuple[float, float, float, float], str]],
    frequency_range: tuple[float, float],
    factor_range: tuple[float, float],
) -> list[Layer]:
    """Return parts of a chart that are not computed, and a text in each of them.

    Parameters
    ----------
    blanks : sequence of ((float, float, float, float), str)
        Left and right end, lower and upper end of each rectangle, and its text.
    frequency_range, factor_range : (float, float)
        Of the axes.
    """
    width, height = np.ptp(frequency_range), np.ptp(factor_range)
    rows = []
    for (left, right, low, high), text in blanks:
        upright = right - left < _NARROW * width
        x = (left + right) / 2 if upright else left + _ROOM * width
        y = low + (3 * _ROOM * height if upright else (high - low) / 2)
        rows.append((float(x), float(y), text, "upright" if upright else "right"))
    shapes: dict[str, list[Any]] = {
        "xs": [np.array([box[0], box[1], box[1], box[0]]) for box, _ in blanks],
        "ys": [np.array([box[2], box[2], box[3], box[3]]) for box, _ in blanks],
        "name": [text for _, text in blanks],
    }
    return [
        Layer("blanks", "not computed", shapes),
        Layer("labels", "reason", label_columns(rows)),
    ]


def _opened(x: Array, y: Array, border: Mask) -> tuple[Array, Array]:
    """Return a line with gaps where it runs along the window's border: no edge is there."""
    along = np.flatnonzero(border[:-1] & border[1:]) + 1
    return np.insert(x, along, np.nan), np.insert(y, along, np.nan)


def add_outline(
    lines: Lines,
    outline: Outline,
    scales: tuple[float, float],
    name: str,
    role: str,
    group: str,
) -> None:
    """Add the outline of a piece of the unstable set: up its left edge, down its right one.

    The gap between leaves out the top, where a piece only meets the next one or the chart ends.

    Parameters
    ----------
    lines : Lines
    outline : Outline
    scales : (float, float)
        What one unit of the abscissa and of the ordinate stands for, in θ̄ and p̄_t.
    name, role, group : str
        Of its row: see `Curve`.
    """
    gap = np.array([np.nan])
    loads, (left_border, right_border) = outline.pulsating_loads, outline.borders
    left, up = _opened(outline.left, loads, left_border)
    right, down = _opened(outline.right[::-1], loads[::-1], right_border[::-1])
    x = np.concatenate([left, gap, right]) / scales[0]
    y = np.concatenate([up, gap, down]) / scales[1]
    lines.add(x, y, name, role, group, pair=outline.name, order=outline.order)
