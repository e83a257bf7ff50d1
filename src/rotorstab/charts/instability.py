"""The instability chart: Bolotin's regions, and Floquet's growth under them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..bolotin.chart import BolotinChart
from ..floquet.tongues.outlines import Outline
from .columns import Lines, label_columns
from .modes import modes
from .quantities import GROWTH, GROWTH_PER_PERIOD, Quantity
from .structure import Chart, Layer

__all__ = ["GrowthGrid", "instability_chart"]

Array = NDArray[np.float64]


_LABEL = 0.2  # of the chart's width for a label: a phone is narrow


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
    unstable: NDArray[np.bool_]
    bolotin: NDArray[np.bool_] | None
    per_period: bool = False
    outlines: tuple[Outline, ...] = ()


def _label_tongues(
    tongues: Sequence[tuple[float, str]], frequency_range: tuple[float, float], top: float
) -> list[tuple[float, float, str, str]]:
    """Return a label at the foot of each tongue, raised where the next one would touch it."""
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
        rows.append((x, top * _level(level), name, side))
    return rows


def _level(step: int) -> float:
    return 0.045 + 0.075 * step


def _growth_layers(
    grid: GrowthGrid,
    fundamental_frequency: float,
    frequency_range: tuple[float, float],
    top: float,
) -> list[Layer]:
    """Return the map of disagreement and, over it, the map of growth."""
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
    disagree = np.full(verdict.shape, clear, np.float32)
    if grid.bolotin is not None:
        disagree[verdict == 2] = 0.0
        disagree[verdict == 1] = 1.0
    return [
        # below: a colour of growth is that of the colour bar wherever it stands
        Layer("map", "disagreement", {"image": [disagree], **place}),
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


def _opened(x: Array, y: Array, border: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Return a line with gaps where it runs along the window's border: no edge is there."""
    along = np.flatnonzero(border[:-1] & border[1:]) + 1
    return np.insert(x, along, np.nan), np.insert(y, along, np.nan)


def _edge_lines(
    outlines: Sequence[Outline], fundamental_frequency: float, reference_load: float
) -> dict[str, list[Any]]:
    """Return the outline of every piece of the unstable set: up its left edge, down its right.

    The gap between leaves out the top, where a piece only meets the next one or the chart ends.
    """
    gap = np.array([np.nan])
    lines = Lines()
    for one in outlines:
        loads = one.pulsating_loads
        left, up = _opened(one.left, loads, one.borders[0])
        right, down = _opened(one.right[::-1], loads[::-1], one.borders[1, ::-1])
        theta = np.concatenate([left, gap, right]) / fundamental_frequency
        load = np.concatenate([up, gap, down]) / reference_load
        order = f", order {one.order}" if one.order > 1 else ""
        lines.add(theta, load, f"tongue {one.name}{order}" if one.order else "unstable", "edge")
    return lines.columns


def instability_chart(
    bolotin: BolotinChart,
    fundamental_frequency: float,
    reference_load: float,
    frequency_range: tuple[float, float],
    largest_factor: float,
    grid: GrowthGrid | None = None,
    tongues: Sequence[tuple[float, str]] = (),
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
    largest_factor : float
        Top of the β_d axis.
    grid : GrowthGrid, optional
        Floquet's answer; without it the chart is the paper's.
    tongues : sequence of (float, str)
        Centres θ/ω_n and names of the true tongues.
    """
    factor = bolotin.pulsating_load / reference_load
    ratio = bolotin.frequency / fundamental_frequency
    lines = Lines()
    rows = []
    left, right = frequency_range
    for mode, column in zip(modes(bolotin.names), ratio.T, strict=True):
        role = "forward" if mode.forward else "backward"
        lines.add(column, factor, f"{mode.name} boundary", role, mode=mode)
        inside = np.flatnonzero(
            (column >= left) & (column <= right) & (factor <= 0.97 * largest_factor)
        )
        if inside.size:
            # modes 2, 3 … sit a step lower, so that 1F and 2B never collide
            top = largest_factor * (0.97 - 0.08 * (mode.number - 1))
            place = inside[np.abs(factor[inside] - top).argmin()]
            # away from the line's own region, unless the chart's edge is near
            share = (column[place] - left) / (right - left)
            side = "right" if share < 0.08 or (mode.forward and share < 0.92) else "left"
            rows.append((float(column[place]), float(factor[place]), mode.name, side))
    polygons = [polygon / (fundamental_frequency, reference_load) for polygon in bolotin.regions]
    regions: dict[str, Sequence[Any]] = {
        "xs": [polygon[:, 0] for polygon in polygons],
        "ys": [polygon[:, 1] for polygon in polygons],
        "name": ["Bolotin region"] * len(polygons),
    }
    return Chart(
        key="instability",
        title="Instability chart",
        x=Quantity("excitation frequency", "θ/ωₙ"),
        y=Quantity("dynamic load factor", "β_d"),
        x_range=frequency_range,
        y_range=(0.0, largest_factor),
        layers=(
            *(
                ()
                if grid is None
                else _growth_layers(grid, fundamental_frequency, frequency_range, largest_factor)
            ),
            Layer("regions", "Bolotin region", regions),
            Layer("lines", "boundary", lines.columns),
            Layer("labels", "boundary name", label_columns(rows)),
            *(
                ()
                if grid is None
                else (
                    Layer(
                        "lines",
                        "tongue edge",
                        _edge_lines(grid.outlines, fundamental_frequency, reference_load),
                    ),
                    Layer(
                        "labels",
                        "tongue",
                        label_columns(_label_tongues(tongues, frequency_range, largest_factor)),
                    ),
                )
            ),
        ),
    )
