"""Figures 2 and 3: exact against linear stiffness influence coefficients."""

from __future__ import annotations

import numpy as np

from ..charts.figure import Array, Figure, Panel, Series, lettered, parameters
from ..model.stiffness import exact_stiffness, linear_stiffness
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.critical_loads import beck_load, critical_load
from .readings import read_figure_2, read_figure_3

__all__ = ["figure_2", "figure_3"]

_NAMES = (("k̄₁₁", "k̄₁₂"), ("k̄₂₁", "k̄₂₂"))
_UNITS = (("EI/L³", "EI/L²"), ("EI/L²", "EI/L"))


def _panels(
    loads: Array, shear: float, tangency: float, entries: tuple[tuple[str, int, int], ...]
) -> tuple[Panel, ...]:
    """Return one panel an entry (title, row, column)."""
    exact = exact_stiffness(loads, shear, tangency)
    elastic, geometric = linear_stiffness(shear, tangency)
    linear = elastic + loads[:, None, None] * geometric
    panels = []
    for letter, (title, i, j) in lettered("entries", entries):
        pair = np.stack([exact[:, i, j], linear[:, i, j]])
        margin = 0.06 * float(np.ptp(pair))
        panels.append(
            Panel(
                letter=letter,
                title=title,
                x_label="p̄",
                y_label=title,
                x_unit="EI/L²",
                y_unit=_UNITS[i][j],
                series=(
                    Series(f"{_NAMES[i][j]} exact", "exact", "solid", loads, pair[0]),
                    Series(f"{_NAMES[i][j]} linear", "linear", "dashed", loads, pair[1]),
                ),
                x_range=(float(loads[0]), float(loads[-1])),
                y_range=(float(pair.min()) - margin, float(pair.max()) + margin),
            )
        )
    return tuple(panels)


def figure_2(rotor: ShaftDisk = BASE_CASE, points: int = 201) -> Figure:
    """Return Fig. 2: coefficients under an axial load, −p̄_cr to p̄_cr.

    Parameters
    ----------
    rotor : ShaftDisk
        Only its shear parameter matters.
    points : int
        Loads.

    Returns
    -------
    Figure
        Panels (a) k̄₁₁, (b) k̄₁₂ = k̄₂₁, (c) k̄₂₂.
    """
    largest = float(critical_load(rotor.shear))
    loads = np.linspace(-largest, largest, points)
    entries = (("k̄₁₁", 0, 0), ("k̄₁₂ = k̄₂₁", 0, 1), ("k̄₂₂", 1, 1))
    panels = _panels(loads, rotor.shear, 0.0, entries)
    return Figure(
        number=2,
        title="Stiffness influence coefficients under an axial load",
        caption="Solid: exact (Appendix A). Dashed: linear (Appendix B).",
        parameters={"shear": rotor.shear, "tangency": 0.0, "critical_load": largest},
        panels=panels,
        reading=read_figure_2(panels),
    )


def figure_3(rotor: ShaftDisk = BASE_CASE, points: int = 201) -> Figure:
    """Return Fig. 3: coefficients under a follower load, to ± the shaft's flutter load.

    Parameters
    ----------
    rotor : ShaftDisk
        Its shear parameter, and its slenderness for the flutter load.
    points : int
        Loads.

    Returns
    -------
    Figure
        Panels (a) k̄₁₁, (b) k̄₁₂, (c) k̄₂₁, (d) k̄₂₂.

    Notes
    -----
    The exact static coefficients stay finite here: their pole, where the clamped–clamped
    shaft buckles, lies beyond the flutter load.
    """
    largest = beck_load(rotor.shear, rotor.slenderness)
    loads = np.linspace(-largest, largest, points)
    entries = (("k̄₁₁", 0, 0), ("k̄₁₂", 0, 1), ("k̄₂₁", 1, 0), ("k̄₂₂", 1, 1))
    panels = _panels(loads, rotor.shear, 1.0, entries)
    return Figure(
        number=3,
        title="Stiffness influence coefficients under a follower load",
        caption="Solid: exact (Appendix A). Dashed: linear (Appendix B).",
        parameters=parameters(rotor, tangency=1.0, beck_load=largest),
        panels=panels,
        reading=read_figure_3(panels, rotor),
    )
