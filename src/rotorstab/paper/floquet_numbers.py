"""What Floquet says of a variant in numbers: places, growth, widths, areas."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._tolerances import VISIBLE_GROWTH
from .._types import Mask
from ..bolotin.boundaries import boundary_frequencies
from ..charts.figure import Statement
from ..charts.structure import Chart, Curve
from ..floquet.point import growth_rate
from ..floquet.resonance import resonances
from ..floquet.resonance_table import Resonance
from ..model.system import fundamental_frequency
from .region_figure import LOWEST, Variant
from .verdicts import confirm, groups, percent

__all__ = [
    "PRINCIPAL",
    "Variants",
    "area",
    "growth",
    "place",
    "read_shading",
    "root",
    "separating",
    "strongest",
    "tongues",
    "width",
]

PRINCIPAL = "1B+1F"
"""The pair whose tongue the paper's first region stands for."""

_GRID = (600, 80)  # points over θ/ω_n and β_d on which areas are compared
_CONFIRMED = 0.8  # of a Bolotin region that must be unstable for its shading to be confirmed
Variants = Sequence[Sequence[Variant]]


def tongues(variant: Variant) -> dict[str, Resonance]:
    """Return the tongues of first order by name."""
    table = resonances(variant.true_system, variant.mean_load, variant.reference_load)
    return {row.name: row for row in table.tongues}


def growth(variant: Variant, name: str = PRINCIPAL) -> float:
    """Return the peak growth rate of a tongue per β_d, 0 where there is none."""
    row = tongues(variant).get(name)
    return 0.0 if row is None else row.growth_per_load * variant.reference_load


def strongest(variant: Variant) -> tuple[str, float]:
    """Return the strongest tongue and its growth rate per β_d."""
    row = max(tongues(variant).values(), key=lambda tongue: tongue.growth_per_load)
    return row.name, row.growth_per_load * variant.reference_load


def place(variant: Variant, name: str = PRINCIPAL) -> float:
    """Return the root θ̄ = |ω_i − ω_j| of a tongue, NaN where there is none."""
    row = tongues(variant).get(name)
    return float("nan") if row is None else row.centre


def root(variant: Variant, name: str = PRINCIPAL) -> float:
    """Return the root θ/ω_n of a tongue, by the system's own ω_n; NaN where there is none."""
    return place(variant, name) / fundamental_frequency(variant.system)


def separating(variant: Variant, factor: float = 0.1) -> int:
    """Return how many of Bolotin's first four boundaries have one stable and one unstable side.

    The sides are looked at a quarter of the region's width away, or 2 % of θ if that is less.
    """
    system, mean = variant.true_system, variant.mean_load
    pulsating = factor * variant.reference_load
    edges = boundary_frequencies(system, mean, pulsating)[:4]
    steps = np.minimum(np.repeat(edges[1::2] - edges[::2], 2) / 4, 0.02 * edges)
    rates = growth_rate(system, mean, pulsating, np.array([edges - steps, edges + steps]))
    left, right = rates > VISIBLE_GROWTH
    return int((left != right).sum())


def width(panel: Chart, group: str, factor: float, name: str = PRINCIPAL) -> float:
    """Return the width in θ/ω_n of a tongue of first order at one β_d, 0 where it has none."""
    widths = []
    for outline in panel.unstable:
        y, left, right = outline.edges
        first = outline.pair == name and outline.order == 1
        if outline.group == group and first and y[0] <= factor <= y[-1]:
            widths.append(np.interp(factor, y, right) - np.interp(factor, y, left))
    return float(max(widths, default=0.0))


def area(panel: Chart, group: str) -> float:
    """Return the unstable share of the panel's window, from `LOWEST` on."""
    window = (panel.x_range[1] - LOWEST) * panel.y_range[1]
    parts = [outline.edges for outline in panel.unstable if outline.group == group]
    return float(sum(np.trapezoid(right - left, y) for y, left, right in parts) / window)


def _mask(panel: Chart, regions: Sequence[Curve], group: str) -> Mask:
    """Return which points of a grid over the window lie in a group's regions."""
    columns = np.linspace(LOWEST, panel.x_range[1], _GRID[0])
    rows = (np.arange(_GRID[1]) + 0.5) / _GRID[1] * panel.y_range[1]
    inside = np.zeros((rows.size, columns.size), dtype=bool)
    for region in regions:
        if region.group == group:
            y, left, right = region.edges
            here = np.flatnonzero((rows >= y[0]) & (rows <= y[-1]))
            low, high = (np.interp(rows[here], y, edge)[:, None] for edge in (left, right))
            inside[here] |= (columns >= low) & (columns <= high)
    return inside


def read_shading(panels: Sequence[Chart]) -> Statement:
    """Return how much of the shaded area is unstable, and what is unstable outside it."""
    confirmed, missed = [], []
    for panel in panels:
        bolotin, true = [], []
        for group in groups(panel):
            bolotin.append(_mask(panel, panel.regions, group))
            true.append(_mask(panel, panel.unstable, group))
        shaded, unstable = np.array(bolotin), np.array(true)
        confirmed.append(float((shaded & unstable).sum() / max(shaded.sum(), 1)))
        missed.append(float((unstable & ~shaded).sum() / max(unstable.sum(), 1)))
    parts = "; ".join(
        f"{panel.title}: {percent(a)}" for panel, a in zip(panels, confirmed, strict=True)
    )
    return Statement(
        "The unstable regions are shaded.",
        f"Of the area of the Bolotin regions, this much is unstable: {parts}. Of what is "
        f"unstable, {', '.join(percent(m) for m in missed)} lies outside them.",
        confirm(*(share > _CONFIRMED for share in confirmed)),
        "All variants of a panel together. Bolotin's condition asks for a motion of twice the "
        "load's period; a spinning rotor may have such a motion and still be stable. What lies "
        "outside are resonances of two different modes and those of higher order.",
    )
