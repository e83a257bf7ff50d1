"""What the page Your rotor says: a sentence above the chart, and the key numbers of the rotor."""

from __future__ import annotations

import math

import numpy as np

from rotorstab import ResonanceTable, Rotor
from rotorstab.charts import LOAD_UNITS, load_unit, written

from ..results.own_model import OwnModel
from ..state.rates import hertz, rpm
from .typography import with_unit

__all__ = ["own_facts", "own_sentence"]

_WAITS = "Dotted: first-order tongues. Floquet’s growth is being computed …"


def own_sentence(
    model: OwnModel, table: ResonanceTable, largest_frequency: float, waits: bool
) -> str:
    """Return what is seen of the stability chart.

    Parameters
    ----------
    model : OwnModel
    table : ResonanceTable
        At the largest load of the chart.
    largest_frequency : float
        At the right end of the chart.
    waits : bool
        Whether the growth is not there yet.
    """
    if table.mean_is_unstable:
        pace = math.log(2) / (table.mean_growth * model.scales.frequency)
        words = f"Unstable, even without pulsation: a whirl doubles every {written(pace, 3)} s."
        return f"{words} {_WAITS}" if waits else words
    if waits:
        return _WAITS
    seen = [one for one in table.tongues if one.centre <= largest_frequency]
    if not seen:
        return "No two whirls make a tongue of first order here."
    widest = max(seen, key=lambda one: one.growth)
    place = with_unit(written(widest.centre * hertz(model.scales), 3), "Hz")
    return f"Coloured: unstable by Floquet’s method. Strongest tongue: {widest.name} at {place}."


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
