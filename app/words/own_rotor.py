"""What the page Your rotor says: of its marked point, and the key numbers of the rotor."""

from __future__ import annotations

import math

import numpy as np

from rotorstab import FloquetSolution, ResonanceTable, Rotor
from rotorstab.charts import LOAD_UNITS, load_unit, written

from ..results.growth import Motion, motion_of
from ..results.own_charts import OwnPoint
from ..results.own_model import OwnModel
from ..state.rates import hertz, rpm
from .point import point_sentence
from .typography import with_unit

__all__ = ["own_facts", "own_sentence", "point_facts"]

_WAITS = "The growth of the chart is being computed …"


def own_sentence(
    point: OwnPoint, solution: FloquetSolution, table: ResonanceTable, waits: bool
) -> str:
    """Return what is true at the marked point.

    Parameters
    ----------
    point : OwnPoint
    solution : FloquetSolution
        There.
    table : ResonanceTable
        Of the rotor at this speed and static load.
    waits : bool
        Whether the growth of the chart is not there yet.
    """
    if not np.isfinite(solution.growth_rate):
        words = "At this frequency one period needs more steps than the server computes."
    else:
        words = point_sentence(solution, point.excitation, table)
    return f"{words} {_WAITS}" if waits else words


def point_facts(point: OwnPoint, solution: FloquetSolution, model: OwnModel) -> list[list[str]]:
    """Return where the marked point lies, and how fast the motion grows or decays there."""
    unit = load_unit(model.scales)
    load = point.pulsating_load * model.scales.load / LOAD_UNITS[unit]
    facts = [
        ["Excitation frequency", with_unit(written(point.excitation * hertz(model.scales)), "Hz")],
        ["Pulsating load", with_unit(written(load), unit)],
    ]
    rate = float(solution.growth_rate) * model.scales.frequency
    motion = motion_of(solution)
    if not math.isfinite(rate) or motion is Motion.NEITHER:
        return facts
    pace = "Doubling time" if motion is Motion.GROWS else "Half-life"
    return [
        *facts,
        ["Growth rate σ", with_unit(written(rate, 3), "1/s")],
        [pace, with_unit(written(math.log(2) / abs(rate), 3), "s")],
    ]


def own_facts(rotor: Rotor, model: OwnModel, table: ResonanceTable) -> list[list[str]]:
    """Return names and values of the key numbers.

    Parameters
    ----------
    rotor : Rotor
    model : OwnModel
    table : ResonanceTable
        At the present speed and load.
    """
    unit = load_unit(model.scales)
    load = with_unit(written(model.scales.load / LOAD_UNITS[unit], 4), unit)
    mass = sum(one.length * one.properties.mass for one in rotor.sections)
    mass += sum(disk.mass for disk in rotor.disks)
    whirls = sorted(
        (abs(float(np.real(one))) * hertz(model.scales), name)
        for one, name in zip(table.frequencies, table.modes, strict=True)
        if not name.startswith("−")
    )
    return [
        ["Buckling load" if model.buckles else "Unit of load", load],
        ["First natural frequency at rest", _frequency(model)],
        ["Mass", with_unit(written(mass, 4), "kg")],
        ["Length", with_unit(written(rotor.length, 4), "m")],
        *([f"Whirl {name}", with_unit(written(value, 4), "Hz")] for value, name in whirls[:4]),
    ]


def _frequency(model: OwnModel) -> str:
    slow = with_unit(written(hertz(model.scales), 4), "Hz")
    return f"{slow} ({with_unit(written(rpm(model.scales), 4), 'rpm')})"
