"""Exact against linear stiffness influence coefficients: what Figs 2 and 3 have in common."""

from __future__ import annotations

import numpy as np

from .._types import Array
from ..charts.columns import Lines
from ..charts.quantities import LOAD, Quantity
from ..charts.stiffness import ENTRIES
from ..charts.structure import Chart, Layer
from ..model.stiffness import exact_stiffness, linear_stiffness
from .arguments import lettered
from .verdicts import percent

__all__ = ["CLOSE", "coefficient_charts", "coefficient_errors", "largest_error"]

CLOSE = 0.05
"""Of a coefficient's own change over the interval: below this the linear law is "very close"."""


def coefficient_charts(
    loads: Array,
    shear: float,
    tangency: float,
    entries: tuple[tuple[str, int, int], ...],
) -> tuple[Chart, ...]:
    """Return one panel an entry (title, row, column)."""
    exact = exact_stiffness(loads, shear, tangency)
    elastic, geometric = linear_stiffness(shear, tangency)
    linear = elastic + loads[:, None, None] * geometric
    symbols = {(i, j): (name, unit) for i, j, name, unit in ENTRIES}
    panels = []
    for letter, (title, i, j) in lettered("entries", entries):
        name, unit = symbols[i, j]
        pair = np.stack([exact[:, i, j], linear[:, i, j]])
        margin = 0.06 * float(np.ptp(pair))
        lines = Lines()
        lines.add(loads, pair[0], f"{name} exact", "solid", "exact")
        lines.add(loads, pair[1], f"{name} linear", "dashed", "linear")
        panels.append(
            Chart(
                key=letter,
                letter=letter,
                title=title,
                x=LOAD,
                y=Quantity("", title, unit),
                x_range=(float(loads[0]), float(loads[-1])),
                y_range=(float(pair.min()) - margin, float(pair.max()) + margin),
                layers=(Layer("lines", "coefficient", lines.columns),),
            )
        )
    return tuple(panels)


def largest_error(panel: Chart) -> float:
    """Return the largest |linear − exact| over the exact one's change in the interval."""
    exact, linear = panel.series
    return float(np.abs(linear.y - exact.y).max() / np.ptp(exact.y))


def coefficient_errors(panels: tuple[Chart, ...]) -> str:
    """Write the largest error of every panel."""
    return ", ".join(f"{panel.title} {percent(largest_error(panel))}" for panel in panels)
