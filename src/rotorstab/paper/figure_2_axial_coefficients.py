"""Figure 2: exact against linear stiffness influence coefficients, axial load."""

from __future__ import annotations

import numpy as np

from ..charts.figure import Figure, Statement
from ..charts.structure import Chart
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.critical_loads import critical_load
from .coefficients import CLOSE, coefficient_charts, coefficient_errors, largest_error
from .verdicts import judge, matches, percent

__all__ = ["figure_2"]


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
    panels = coefficient_charts(loads, rotor.shear, 0.0, entries)
    return Figure(
        number=2,
        title="Stiffness influence coefficients under an axial load",
        caption="Solid: exact (Appendix A). Dashed: linear (Appendix B).",
        parameters={"shear": rotor.shear, "tangency": 0.0, "critical_load": largest},
        panels=panels,
        reading=_read_text(panels),
    )


def _read_text(panels: tuple[Chart, ...]) -> tuple[Statement, ...]:
    """Compare what the text says with the arrays."""
    largest = panels[0].x_range[1]
    relative = max(
        float((np.abs(linear.y - exact.y) / np.abs(exact.y)).max())
        for exact, linear in (panel.series for panel in panels)
    )
    return (
        Statement(
            "The critical load of the axially loaded shaft is 2.3558.",
            f"p̄_cr = {largest:.5f}.",
            judge(matches(largest, "2.3558")),
        ),
        Statement(
            "The approximate values are very close to the exact ones over a considerable range.",
            "Largest error, as a part of the coefficient's change over the interval: "
            f"{coefficient_errors(panels)}; relative to its value at most {percent(relative)}.",
            judge(all(largest_error(panel) < CLOSE for panel in panels)),
        ),
    )
