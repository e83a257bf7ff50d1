"""What Floquet says of the instability chart: map of growth, outlines and names of tongues."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .._types import Array, Mask
from ..floquet.tongues.outlines import Outline
from .columns import Lines, label_columns
from .quantities import GROWTH, GROWTH_PER_PERIOD
from .structure import Layer

__all__ = ["FLOQUET", "GrowthGrid", "add_outline", "edge_layer", "growth_layers", "tongue_labels"]


_LABEL = 0.2  # of the chart's width for a label: a phone is narrow
FLOQUET = "unstable (Floquet)"
"""The group of what Floquet finds unstable, where a chart shows one rotor."""


@dataclass(frozen=True, eq=False)
class GrowthGrid:
    """Floquet's answer on the pixels of the instability chart.

    Parameters
    ----------
    growth : (R, C) float
        σ̄ [√(EI/(ρAL⁴))] at the pixel centres, or of a thinner tongue inside; rows upwards.
    unstable : (R, C) bool
        Floquet's verdict.
    bolotin : (R, C) bool or None
        Whether the pixel lies in a Bolotin region; None where there is none to compare with.
    per_period : bool
        Whether to colour by σ̄T instead of σ̄.
    outlines : tuple of Outline
        Exact edges of the tongues, where they were computed.
    """

    growth: Array
    unstable: Mask
    bolotin: Mask | None
    per_period: bool = False
    outlines: tuple[Outline, ...] = ()


def tongue_labels(
    tongues: Sequence[tuple[float, str]], frequency_range: tuple[float, float], top: float
) -> Layer:
    """Return a label at the foot of each tongue, raised where the next one would touch it.

    Parameters
    ----------
    tongues : sequence of (float, str)
        Abscissas and names; those outside the range are left out.
    frequency_range : (float, float)
        Of the abscissa.
    top : float
        Upper end of the ordinate, which begins at 0.
    """
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
        rows.append((x, top * (0.045 + 0.075 * level), name, side))
    return Layer("labels", "tongue", label_columns(rows))


def growth_layers(
    grid: GrowthGrid,
    fundamental_frequency: float,
    frequency_range: tuple[float, float],
    top: float,
) -> list[Layer]:
    """Return the map of disagreement, if any is known, and over it the map of growth."""
    left, right = frequency_range
    columns = grid.growth.shape[1]
    theta = (left + (np.arange(columns) + 0.5) / columns * (right - left)) * fundamental_frequency
    periods = 2 * np.pi / theta
    shown = grid.growth * periods if grid.per_period else grid.growth
    bolotin = np.zeros_like(grid.unstable) if grid.bolotin is None else grid.bolotin
    place = {"x": [left], "y": [0.0], "dw": [right - left], "dh": [top]}
    verdict = grid.unstable.astype(np.uint8) + 2 * bolotin.astype(np.uint8)
    verdict[~np.isfinite(grid.growth)] = 4  # not computed: it disagrees with nothing
    clear = np.float32(np.nan)
    layers = []
    if grid.bolotin is not None:
        disagree = np.full(verdict.shape, clear, np.float32)
        disagree[verdict == 2] = 0.0
        disagree[verdict == 1] = 1.0
        # below: a colour of growth is that of the colour bar wherever it stands
        layers.append(Layer("map", "disagreement", {"image": [disagree], **place}))
    return [
        *layers,
        Layer(
            "map",
            "growth",
            {
                "image": [np.where(grid.unstable, shown, clear).astype(np.float32)],
                "rate": [np.where(grid.unstable, grid.growth, 0.0).astype(np.float32)],
                "verdict": [verdict],
                "frequency": [fundamental_frequency],
                **place,
            },
            quantity=GROWTH_PER_PERIOD if grid.per_period else GROWTH,
        ),
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


def edge_layer(outlines: Sequence[Outline], scales: tuple[float, float]) -> Layer:
    """Return the outlines of every piece of the unstable set of one rotor."""
    lines = Lines()
    for outline in outlines:
        order = f", order {outline.order}" if outline.order > 1 else ""
        name = f"tongue {outline.name}{order}" if outline.order else "unstable"
        add_outline(lines, outline, scales, name, "edge", FLOQUET)
    return Layer("outlines", "tongue edge", lines.columns)
