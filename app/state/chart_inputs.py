"""The inputs of the charts: their window, their layers and their units."""

from __future__ import annotations

import param

from rotorstab import STIFFNESS_LAWS
from rotorstab.charts.quantities import Measure, ShareOf, SIForm

from .declaration import Boolean, Facts, Number, Selector, Use

__all__ = ["ChartInputs"]


class ChartInputs(param.Parameterized):
    """What the charts show."""

    largest_factor = Number(
        Facts(
            "bmax",
            Use.PINNED | Use.REPORTED | Use.PICTURE,
            symbol="β_d max",
            si=SIForm("P_t max", Measure.LOAD, ShareOf.REFERENCE_LOAD),
        ),
        default=1.0,
        bounds=(0.05, 2.0),
        step=0.05,
        label="Largest dynamic factor",
        doc="Top of the instability chart: the largest dynamic load factor β_d shown.",
    )
    lowest_frequency = Number(
        Facts(
            "fmin",
            Use.PINNED | Use.REPORTED | Use.PICTURE,
            symbol="θ/ωₙ min",
            si=SIForm("θ/2π min", Measure.FREQUENCY, ShareOf.FUNDAMENTAL_FREQUENCY),
        ),
        default=0.0,
        bounds=(0.0, 39.0),
        step=0.1,
        label="Lowest frequency",
        doc="Left end of the instability chart, in units of ωₙ.",
    )
    highest_frequency = Number(
        Facts(
            "fmax",
            Use.PINNED | Use.REPORTED | Use.PICTURE,
            symbol="θ/ωₙ max",
            si=SIForm("θ/2π max", Measure.FREQUENCY, ShareOf.FUNDAMENTAL_FREQUENCY),
        ),
        default=6.0,
        bounds=(0.5, 40.0),
        step=0.1,
        label="Highest frequency",
        doc="Right end of the instability chart, in units of ωₙ.",
    )
    stiffness = Selector(
        Facts("stiff", Use.PINNED | Use.COMPARED | Use.PICTURE),
        default="linear",
        objects=[*STIFFNESS_LAWS, "both"],
        label="Stiffness in the load–frequency chart",
        doc="The paper's linear coefficients, the exact coefficients of its Appendix A, or both.",
    )
    show_growth = Boolean(
        Facts("growth", Use.LOOK),
        default=True,
        label="Floquet growth",
        doc="Colours where the rotor is unstable by Floquet’s method.",
    )
    show_bolotin = Boolean(
        Facts("bolotin", Use.LOOK),
        default=True,
        label="Bolotin regions",
        doc="Boundaries and hatching of Bolotin’s method, which the paper uses.",
    )
    show_disagreement = Boolean(
        Facts("differ", Use.LOOK),
        default=False,
        label="Disagreement",
        doc="Shading where the two methods disagree.",
    )
    growth_unit = Selector(
        Facts("unit", Use.PICTURE | Use.LOOK),
        default="per time",
        objects=["per time", "per period"],
        label="Growth shown",
        doc="Growth rate σ̄ per unit of non-dimensional time, or σ̄T per period of the load.",
    )
    units = Selector(
        Facts("u", Use.REPORTED | Use.LOOK),
        default="non-dimensional",
        objects=["non-dimensional", "SI"],
        label="Units of the charts",
        doc="Non-dimensional numbers as in the paper, or rpm, Hz and N for the shaft below.",
    )
    compared = Selector(
        Facts("side"),
        default="none",
        objects=["none", "pin 1", "pin 2", "pin 3"],
        label="Compare side by side",
        doc="The pin whose instability chart stands beside the present one.",
    )
