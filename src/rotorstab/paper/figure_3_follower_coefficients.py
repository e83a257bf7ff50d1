"""Figure 3: exact against linear stiffness influence coefficients, follower load."""

from __future__ import annotations

import numpy as np

from ..charts.figure import Figure, Statement
from ..charts.structure import Chart
from ..model.stiffness import largest_exact_load
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.critical_loads import beck_load
from .arguments import parameters
from .coefficients import CLOSE, coefficient_charts, coefficient_errors, largest_error
from .verdicts import judge, matches

__all__ = ["figure_3"]


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
    panels = coefficient_charts(loads, rotor.shear, 1.0, entries)
    return Figure(
        number=3,
        title="Stiffness influence coefficients under a follower load",
        caption="Solid: exact (Appendix A). Dashed: linear (Appendix B).",
        parameters=parameters(rotor, tangency=1.0, beck_load=largest),
        panels=panels,
        reading=_read_text(panels, rotor),
    )


def _read_text(panels: tuple[Chart, ...], rotor: ShaftDisk) -> tuple[Statement, ...]:
    """Compare what the text says with the arrays."""
    largest = panels[0].x_range[1]
    k11, k12, k21, k22 = (largest_error(panel) for panel in panels)
    pole = float(largest_exact_load(rotor.shear))
    crossing = panels[0].series[0]
    lost = float(np.interp(0.0, -crossing.y, crossing.x))
    return (
        Statement(
            "The critical load of the shaft under a follower load is 12.3019.",
            f"{largest:.5f}: the flutter load of the shaft alone, with its own mass, shear and "
            "rotary inertia (Beck's column).",
            judge(matches(largest, "12.3019")),
            "It is not a load of the lumped model, and the load factors do not use it.",
        ),
        Statement(
            "All but k̄₂₁ and k̄₂₂ are very close to their exact values.",
            "Largest error, as a part of the coefficient's change over the interval: "
            f"{coefficient_errors(panels)}.",
            judge(k11 < CLOSE and k12 < CLOSE, k21 > CLOSE and k22 > CLOSE),
            f"The exact coefficients stay finite to their pole at p̄ = {pole:.3f}; the exact "
            f"k̄₁₁ changes sign at p̄ = {lost:.3f}.",
        ),
    )
