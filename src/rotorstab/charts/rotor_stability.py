"""The stability chart of any rotor: Floquet's growth, and first-order tongues until it is there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..floquet.resonance_table import Resonance
from ..maps.grid_edges import GridEdges
from .columns import Lines
from .quantities import EXCITATION_RATIO, LOAD_FACTOR
from .structure import Chart, Layer
from .tongues import GrowthGrid, blank_layers, growth_layers, outline_layers, tongue_labels

__all__ = ["stability_chart_of", "tongue_estimates"]

_NAMED = 0.1  # of the largest growth: slower tongues have no name on the chart
_MOST_NAMES = 8


def stability_chart_of(
    tongues: Sequence[Resonance],
    largest_load: float,
    frequency_range: tuple[float, float],
    grid: GrowthGrid | None = None,
    blanks: Sequence[tuple[tuple[float, float, float, float], str]] = (),
    estimates: bool = False,
) -> Chart:
    """Return the chart over excitation frequency and pulsating load.

    Parameters
    ----------
    tongues : sequence of Resonance
        The unstable pairs of the resonance table at `largest_load`.
    largest_load : float
        Top of the chart.
    frequency_range : (float, float)
        Of the excitation frequency θ̄.
    grid : GrowthGrid, optional
        Floquet's answer. Without it the chart shows the first-order tongues of the table.
    blanks : sequence of ((float, float, float, float), str)
        Parts that the grid does not cover, and why: see `blank_layers`.
    estimates : bool
        Whether the first-order tongues are shown beside a grid, too.
    """
    loads = (0.0, largest_load)
    shown = _nothing(frequency_range, loads) if grid is None else grid
    assert shown.edges is not None
    estimated = tongues if grid is None or estimates else ()
    low, high = frequency_range
    seen = [one for one in tongues if low <= one.centre <= high]
    least = _NAMED * max((one.growth for one in seen), default=0.0)
    names = sorted((one for one in seen if one.growth >= least), key=lambda one: -one.growth)
    return Chart(
        key="instability",
        title="Stability chart",
        x=EXCITATION_RATIO,
        y=LOAD_FACTOR,
        x_range=frequency_range,
        y_range=loads,
        layers=(
            *growth_layers(shown, (1.0, 1.0)),
            *outline_layers(shown.edges, (1.0, 1.0)),
            tongue_estimates(estimated, largest_load),
            *blank_layers(blanks, frequency_range, loads),
            tongue_labels(
                [(one.centre, one.name) for one in names[:_MOST_NAMES]], frequency_range, loads
            ),
        ),
    )


def tongue_estimates(tongues: Sequence[Resonance], largest_load: float) -> Layer:
    """Return the tongues of the resonance table as wedges.

    A wedge begins at the threshold and has the half-width of first order at the largest load. With
    damping its edges are curved between them; the straight lines are an approximation.
    """
    lines = Lines()
    for one in tongues:
        x = one.centre + one.half_width * np.array([-1.0, 0.0, 1.0])
        y = np.array([largest_load, one.threshold, largest_load])
        name = f"first-order estimate of {one.name}"
        lines.add(x, y, name, "estimate", pair=one.name, order=1)
    return Layer("lines", "first-order tongues", lines.columns)


def _nothing(frequencies: tuple[float, float], loads: tuple[float, float]) -> GrowthGrid:
    """Return a grid on which nothing is known."""
    unknown, no = np.full((2, 2), np.nan), np.zeros((2, 2), dtype=np.bool_)
    place = np.maximum(frequencies, np.finfo(float).tiny)
    lines = np.full((2, 1), np.nan), np.full((1, 2), np.nan)
    edges = GridEdges(np.array(loads), place, unknown, *lines)
    return GrowthGrid(
        unknown, no, None, (*frequencies, *loads), edges=edges, rates=unknown, top=1.0
    )
