"""The inputs of the marked point: where it lies, and how its motion starts."""

from __future__ import annotations

import param

from rotorstab.charts.quantities import (
    EXCITATION_RATIO,
    LOAD_FACTOR,
    Measure,
    ShareOf,
    SIForm,
)

from .declaration import Boolean, Facts, Number, Selector

__all__ = ["INITIAL_CONDITIONS", "PointInputs"]

INITIAL_CONDITIONS = {"knock": "knock", "noise": "noise"} | {
    f"mode {mode}": f"mode:{mode}" for mode in ("1B", "1F", "2B", "2F")
}
"""How a motion may start, and the name of each start in `rotorstab.initial_conditions`."""


class PointInputs(param.Parameterized):
    """The marked point."""

    marker = Boolean(
        Facts("at"),
        default=True,
        label="Marked point",
        doc="Shows the multipliers and the motion at one point of the instability chart.",
    )
    marker_follows = Boolean(
        Facts("follow"),
        default=True,
        label="Marked point follows the tongue",
        doc="The marked point stays inside the tongue 1B+1F of the rotor until you move it.",
    )
    marker_frequency = Number(
        Facts("f", symbol=EXCITATION_RATIO.symbol, si=EXCITATION_RATIO.si),
        default=1.68,
        bounds=(0.05, 40.0),
        step=0.01,
        label="Marked point, frequency",
        doc="θ/ωₙ of the marked point.",
    )
    marker_factor = Number(
        Facts(
            "b",
            symbol=LOAD_FACTOR.symbol,
            si=SIForm("P_t", Measure.LOAD, ShareOf.REFERENCE_LOAD),
        ),
        default=0.5,
        bounds=(0.0, 2.0),
        step=0.01,
        label="Marked point, load factor",
        doc="β_d of the marked point.",
    )
    initial = Selector(
        Facts("ic"),
        default="knock",
        objects=list(INITIAL_CONDITIONS),
        label="Starts from",
        doc="An impact on the disk along V, random motion of every whirl mode, or one whirl mode.",
    )
    seed = Number(
        Facts("seed", symbol="s"),
        default=1.0,
        bounds=(0.0, 999.0),
        step=1.0,
        label="Seed of the noise",
        doc="Each whole number gives its own random start.",
    )
    periods = Number(
        Facts("n", symbol="N"),
        default=0.0,
        bounds=(0.0, 400.0),
        step=1.0,
        label="Periods shown",
        doc="Length of the response, in periods of the load; 0 shows as many as the motion needs "
        "to leave the picture of the shaft, 40 at most.",
    )
