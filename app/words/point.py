"""A marked point in words: facts and one sentence, in the units the user chose."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rotorstab import Scales
from rotorstab.charts import written
from rotorstab.floquet.point import FloquetSolution

from ..results.analysis import Result
from ..state import State
from .si import load_words, shown_scales

__all__ = ["Pair", "Units", "describe"]

_PRECISE = 1e-8  # growth below this is rounding


@dataclass(frozen=True)
class Pair:
    """Two whirl modes whose resonance is nearest, and the load from which it is a tongue."""

    name: str
    frequencies: tuple[float, float]
    combination: str
    threshold: float


@dataclass(frozen=True)
class Units:
    """How the quantities of one point are written.

    Parameters
    ----------
    fundamental, reference : float
        ω_n and what β_d = 1 stands for, non-dimensional.
    scales : Scales or None
        Of the shaft; None for the paper's numbers.
    """

    fundamental: float
    reference: float
    scales: Scales | None

    def excitation(self, ratio: float) -> str:
        """Return θ/ωₙ, or θ/2π in Hz."""
        if self.scales is None:
            return f"θ/ωₙ = {ratio:.3f}"
        return f"θ/2π = {self._hertz(ratio)}"

    def place(self, ratio: float) -> str:
        """Return the same without its symbol where the unit tells it."""
        return self.excitation(ratio) if self.scales is None else self._hertz(ratio)

    def offset(self, ratio: float) -> str:
        """Return a difference of θ/ωₙ with its sign."""
        if self.scales is None:
            return f"{ratio:+.3f}".replace("-", "−")
        hertz = ratio * self.fundamental * self.scales.frequency / (2 * math.pi)
        return f"{'+' if hertz >= 0 else ''}{written(hertz, 3)} Hz"

    def factor(self, value: float) -> str:
        """Return β_d, with its load where that has a unit."""
        if self.scales is None:
            return f"β_d = {value:.3f}"
        return f"β_d = {value:.3f} (P_t = {load_words(value * self.reference, self.scales)})"

    def rate(self, growth: float) -> tuple[str, str]:
        """Return the name and the value of a growth rate."""
        if self.scales is None:
            return "Growth rate σ̄", written(growth)
        return "Growth rate σ", f"{written(growth * self.scales.frequency)} 1/s"

    @property
    def product(self) -> str:
        """The symbol of growth a period, a number of its own in any unit."""
        return "σ̄T" if self.scales is None else "σT"

    def time(self, value: float) -> str:
        """Return a time."""
        if self.scales is None:
            return f"t̄ = {written(value)}"
        return f"{written(value / self.scales.frequency)} s"

    def _hertz(self, ratio: float) -> str:
        assert self.scales is not None
        hertz = ratio * self.fundamental * self.scales.frequency / (2 * math.pi)
        return f"{written(hertz)} Hz"


def _pace(growth: float, period: float, units: Units) -> tuple[str, str, str]:
    """Return the name of doubling or halving, its periods and its time."""
    time = math.log(2) / abs(growth)
    name = "Doubles in" if growth > 0 else "Halves in"
    return name, f"{written(time / period, 3)} periods", units.time(time)


def describe(
    state: State, floquet: FloquetSolution, bolotin: bool, pair: Pair | None, result: Result
) -> tuple[list[list[str]], str]:
    """Return the facts, as names and values, and the sentence of the marked point.

    Parameters
    ----------
    state : State
    floquet : FloquetSolution
        At the marker.
    bolotin : bool
        Whether the point lies in a Bolotin region.
    pair : Pair or None
        The nearest pair of modes.
    result : Result
        Of the chart.
    """
    frequency = result.numbers["fundamental"]
    units = Units(frequency, result.numbers["reference"], shown_scales(state))
    period = 2 * np.pi / (state.marker_frequency * frequency)
    growth = float(floquet.growth_rate)
    settled = max(_PRECISE, 3 * float(floquet.error))
    unstable = growth > settled
    decays = growth < -settled
    verdict = "unstable" if unstable else "stable: it decays" if decays else "stable"
    region = "inside a Bolotin region" if bolotin else "outside every Bolotin region"
    facts = [["Floquet", verdict], ["Bolotin", region]]
    outside = int((np.abs(floquet.multipliers) > 1 + 1e-6).sum())
    sentence = (
        f"At {units.excitation(state.marker_frequency)} and {units.factor(state.marker_factor)} "
        f"the rotor is {'unstable' if unstable else 'stable'} (Floquet"
    )
    if unstable or decays:
        name, periods, time = _pace(growth, period, units)
        facts += [
            [*units.rate(growth)],
            [f"{units.product} a period", written(growth * period)],
            [name, f"{periods} ({time})"],
        ]
        pace = periods if units.scales is None else f"{time}, {periods}"
        sentence += f": the motion {name[0].lower()}{name[1:]} {pace})"
    else:
        facts += [[units.rate(0.0)[0], "0"], ["Doubles in", "never"]]
        sentence += ": the motion neither grows nor dies)"
    if units.scales is not None:
        facts.append(["Period T of the load", units.time(period)])
    lies = "multipliers lie" if outside > 1 else "multiplier lies"
    sentence += f"; {outside or 'no'} {lies} outside the unit circle. "
    if result.floquet.table.mean_growth > _PRECISE:
        sentence += (
            "The steady motion grows by itself, without any pulsation, so no tongue stands out."
        )
        pair = None
    elif bolotin == unstable:
        sentence += f"Bolotin agrees: the point is {region}."
    elif bolotin:
        sentence += (
            "Bolotin’s method draws a region here, but no multiplier has left the unit circle."
        )
    else:
        sentence += "Bolotin’s method draws no region here: it misses this tongue."
    if pair is not None:
        more, words = _near(state, pair, result, units)
        facts += more
        sentence += words
    return facts, sentence


def _near(state: State, pair: Pair, result: Result, units: Units) -> tuple[list[list[str]], str]:
    """Return the facts and the words of the nearest pair and, where it is none, tongue."""
    frequency = result.numbers["fundamental"]
    centre = abs(pair.frequencies[0] - pair.frequencies[1]) / frequency
    facts = [
        ["Nearest pair", f"{pair.name} at {units.place(centre)}"],
        ["θ above it by", units.offset(state.marker_frequency - centre)],
    ]
    threshold = pair.threshold / units.reference
    word = "makes no tongue under this load"
    if threshold == 0:
        word = "makes a tongue"
    elif np.isfinite(threshold):
        word = (
            f"makes a tongue where damping gives way, from {units.factor(threshold)} to first order"
        )
    words = f" Nearest is the {pair.combination}, {units.excitation(centre)}, which {word}"
    tongues = result.floquet.table.tongues
    if not np.isfinite(threshold) and tongues:
        excitation = state.marker_frequency * frequency
        tongue = min(tongues, key=lambda row: abs(row.centre - excitation))
        place = units.place(tongue.centre / frequency).removeprefix("θ/ωₙ = ")
        words += f"; the nearest tongue is {tongue.name} at {place}"
    return facts, f"{words}."
