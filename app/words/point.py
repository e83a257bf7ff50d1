"""A marked point in words: facts and one sentence, in the units the user chose."""

from __future__ import annotations

import math
from typing import NamedTuple

from rotorstab import FloquetSolution, ResonanceTable
from rotorstab.charts import written

from ..results.analysis import Result
from ..results.growth import Motion, motion_of
from ..results.nearest import Pair, nearest_resonance
from ..state import State
from .si import shown_scales
from .units import Units

__all__ = ["Fact", "describe", "point_sentence"]


class Fact(NamedTuple):
    """One row of the table of a marked point."""

    name: str
    value: str


_FLOQUET_WORDS = {
    Motion.GROWS: "unstable",
    Motion.DECAYS: "stable: it decays",
    Motion.NEITHER: "stable",
}


def point_sentence(floquet: FloquetSolution, excitation: float, table: ResonanceTable) -> str:
    """Return what is true at a point: whether and how fast the whirl grows, and in which tongue.

    The tongue is named after the resonance |ω_i − ω_j|/k that is nearest to θ̄, as on the chart.

    Parameters
    ----------
    floquet : FloquetSolution
        At the point.
    excitation : float
        θ̄.
    table : ResonanceTable
        Of the same rotor under the same static load.

    Examples
    --------
    "Unstable: the whirl doubles every 5.1 periods of the load. Tongue 1B+1F."
    """
    motion = motion_of(floquet)
    if motion is Motion.NEITHER:
        return "Stable: the whirl neither grows nor decays."
    period = 2 * math.pi / excitation
    pace = written(math.log(2) / abs(float(floquet.growth_rate)) / period, 2)
    every = "every period" if pace == "1" else f"every {pace} periods"
    if motion is Motion.DECAYS:
        return f"Stable: the whirl halves {every} of the load."
    if table.mean_is_unstable:
        return f"Unstable, even without pulsation: the whirl doubles {every} of the load."
    nearest = table.nearest(excitation)
    words = f"Unstable: the whirl doubles {every} of the load."
    if nearest is None:
        return words
    row, order = nearest
    return f"{words} Tongue {row.name}{f' of order {order}' if order > 1 else ''}."


def describe(
    state: State,
    floquet: FloquetSolution,
    in_bolotin_region: bool,
    pair: Pair | None,
    result: Result,
) -> tuple[list[Fact], str]:
    """Return the facts and the explanation of the marked point.

    Parameters
    ----------
    state : State
    floquet : FloquetSolution
        At the marked point.
    in_bolotin_region : bool
        Whether the point lies in a Bolotin region.
    pair : Pair or None
        The nearest pair of modes.
    result : Result
        Of the chart.

    Returns
    -------
    facts : list of Fact
    explanation : str
        Some sentences on what the two methods say of the point, and on the nearest resonance.
    """
    frequency = result.numbers["fundamental"]
    units = Units(frequency, result.numbers["reference"], shown_scales(state))
    period = 2 * math.pi / (state.marker_frequency * frequency)
    motion = motion_of(floquet)
    region = "inside a Bolotin region" if in_bolotin_region else "outside every Bolotin region"
    facts = [Fact("Floquet", _FLOQUET_WORDS[motion]), Fact("Bolotin", region)]
    pace_facts, pace = _pace(motion, float(floquet.growth_rate), period, units)
    facts += pace_facts
    if units.scales is not None:
        facts.append(Fact("Period T of the load", units.time(period)))
    sentence = (
        f"At {units.excitation(state.marker_frequency)} and {units.factor(state.marker_factor)} "
        f"the rotor is {'unstable' if motion is Motion.GROWS else 'stable'} (Floquet: {pace}); "
        f"{_multipliers(floquet)}. "
    )
    if result.floquet.table.mean_is_unstable:
        sentence += "The whirl grows without any pulsation, so no tongue is named."
        return facts, sentence
    sentence += _bolotin_words(in_bolotin_region, motion is Motion.GROWS, region)
    if pair is not None:
        near_facts, words = _near(state, pair, result, units)
        facts += near_facts
        sentence += words
    return facts, sentence


def _pace(motion: Motion, growth: float, period: float, units: Units) -> tuple[list[Fact], str]:
    """Return the facts and the words for how fast the motion grows or decays."""
    if motion is Motion.NEITHER:
        facts = [Fact(units.rate(0.0)[0], "0"), Fact("Doubles in", "never")]
        return facts, "the motion neither grows nor decays"
    time = math.log(2) / abs(growth)
    name = "Doubles in" if motion is Motion.GROWS else "Halves in"
    periods, duration = f"{written(time / period, 3)} periods", units.time(time)
    facts = [
        Fact(*units.rate(growth)),
        Fact(f"Growth {units.product} per period", written(growth * period)),
        Fact(name, f"{periods} ({duration})"),
    ]
    pace = periods if units.scales is None else f"{duration}, {periods}"
    return facts, f"the motion {name.lower()} {pace}"


def _multipliers(floquet: FloquetSolution) -> str:
    """Return how many multipliers lie outside the unit circle, in words."""
    outside = int(floquet.growing.sum())
    verb = "multipliers lie" if outside > 1 else "multiplier lies"
    return f"{outside or 'no'} {verb} outside the unit circle"


def _bolotin_words(in_bolotin_region: bool, unstable: bool, region: str) -> str:
    if in_bolotin_region == unstable:
        return f"Bolotin’s method says the same of this point: it is {region}."
    if in_bolotin_region:
        return "Bolotin’s method draws a region here, but no multiplier has left the unit circle."
    return "Bolotin’s method draws no region here: it misses this tongue."


def _near(state: State, pair: Pair, result: Result, units: Units) -> tuple[list[Fact], str]:
    """Return facts and words of the nearest pair and, if that is no tongue, the nearest tongue."""
    frequency = result.numbers["fundamental"]
    centre = pair.centre / frequency
    facts = [
        Fact("Nearest pair of whirls", f"{pair.name} at {units.place(centre)}"),
        Fact("θ above its resonance by", units.offset(state.marker_frequency - centre)),
    ]
    threshold = pair.threshold / units.reference
    if threshold == 0:
        effect = "makes a tongue"
    elif math.isfinite(threshold):
        effect = (
            f"makes a tongue that, to first order, begins at {units.factor(threshold)} because of "
            "the damping"
        )
    else:
        effect = "makes no tongue under this load"
    combination = "difference" if pair.precession == "same" else "sum"
    words = (
        f" Nearest is the {combination} of {' and '.join(pair.modes)}, {units.excitation(centre)}, "
        f"which {effect}"
    )
    tongue = nearest_resonance(result.floquet.table.tongues, state.marker_frequency * frequency)
    if tongue is not None and not math.isfinite(threshold):
        place = units.bare_excitation(tongue.centre / frequency)
        words += f"; the nearest tongue is {tongue.name} at {place}"
    return facts, f"{words}."
