"""The verdict in words: what Floquet finds in the chart, and how Bolotin's regions differ."""

from __future__ import annotations

import math

from rotorstab import Scales
from rotorstab.floquet.first_order import FirstOrderRegion, first_order_regions

from ..results.floquet_answer import TABLE_FACTOR, FloquetAnswer
from ..results.limits import Detail
from .typography import with_unit
from .units import Units

__all__ = ["blank_parts", "percent", "smallest_load", "verdict"]

_MOST = 6  # regions named in one sentence
_BELOW_THRESHOLD = 0.9  # part of the first-order threshold below which growth contradicts it
_LARGER = 1.05  # ratio of two areas above which one is called larger
_UNREPORTED_BLANK = 0.02  # share of the window that may be blank without being reported
_MISSED = 0.001  # share of what is unstable that may lie outside Bolotin's regions without a word


def percent(share: float, *, zero_is_none: bool = True) -> str:
    """Return a share in words.

    Parameters
    ----------
    share : float
    zero_is_none : bool
        Whether 0 is written as "nothing"; otherwise it is "under 0.1 %".
    """
    if share == 0 and zero_is_none:
        return "nothing"
    if share < 0.001:
        return f"under {with_unit('0.1', '%')}"
    return with_unit(f"{100 * share:{'.0f' if share >= 0.1 else '.2g'}}", "%")


def _region(region: FirstOrderRegion, units: Units) -> str:
    centre = units.place(region.centre / units.fundamental)
    return f"{region.name} at {centre} ({units.width(region.width / units.fundamental)} wide)"


def _regions(answer: FloquetAnswer, units: Units) -> str:
    """Return the unstable regions of first order in the window, in words."""
    low, high = answer.frequency_range
    regions = first_order_regions(answer.table, TABLE_FACTOR * units.reference)
    inside = [region for region in regions if low <= region.centre / units.fundamental <= high]
    if not inside:
        return f"To first order no tongue lies in this window at β_d = {TABLE_FACTOR:g}."
    named = "; ".join(_region(region, units) for region in inside[:_MOST])
    more = f"; and {len(inside) - _MOST} more" if len(inside) > _MOST else ""
    noun = "unstable region" if len(inside) == 1 else "unstable regions"
    return (
        f"To first order in the load, {len(inside)} {noun} in this window at "
        f"{units.factor(TABLE_FACTOR, 'g')}: {named}{more}; tongues without a label "
        "are of higher order."
    )


def smallest_load(answer: FloquetAnswer, units: Units) -> str:
    """Return the smallest pulsating load that destabilises, in words."""
    table = answer.table
    if table.mean_is_unstable:
        rate = units.rate_words(table.mean_growth)
        return f"The rotor is unstable without any pulsation: its whirl grows at {rate}."
    first = min(table, key=lambda row: row.threshold)
    if not math.isfinite(first.threshold):
        return "To first order no pulsating load makes two modes grow together."
    if first.threshold == 0:
        return (
            "Without damping any pulsation, however small, destabilises the rotor at the centre of "
            "a first-order tongue."
        )
    threshold = first.threshold / units.reference
    words = (
        f"To first order, damping keeps the rotor stable up to {units.factor(threshold)}, where "
        f"the tongue {first.name} begins"
    )
    if answer.unstable_from < _BELOW_THRESHOLD * threshold:
        words += f", but the map shows growth from {units.factor(answer.unstable_from)}"
    return words + "."


def _comparison(answer: FloquetAnswer, bolotin_shown: bool) -> str:
    """Return how much of the window is unstable, and what Bolotin's regions cover, in words."""
    true, bolotin, both = answer.unstable_share, answer.bolotin_share, answer.both_share
    if math.isnan(true):
        return ""
    if answer.detail is Detail.COARSE:
        return " The shares and the lowest frequencies are computed when the sliders rest."
    place = "the computed part of this window" if _is_part(answer) else "this window"
    if answer.table.mean_is_unstable:
        if true == 1:
            return f" All of {place} is unstable, at any pulsation."
        return (
            f" Of {place} {percent(true)} is unstable; elsewhere the pulsation stabilises the "
            "rotor."
        )
    text = f" Of {place} {percent(true, zero_is_none=not answer.has_tongues)} is unstable"
    if not bolotin_shown:
        return text + "."
    text += f"; Bolotin regions cover {percent(bolotin)}"
    if true > 0 and bolotin > _LARGER * true:
        ratio = bolotin / true
        text += f", an area {ratio:,.0f} times" if ratio >= 100 else f", an area {ratio:.3g} times"
        text += " as large"
    missed = true - both
    if missed > _MISSED * true > 0:
        text += f"; {percent(missed / true)} of what is unstable lies outside them"
    return text + "."


def _is_slow(answer: FloquetAnswer) -> bool:
    """Whether the map is blank for the slowest loads, in a part of the window that is reported."""
    low, high = answer.frequency_range
    return answer.lowest_computed_ratio > low + _UNREPORTED_BLANK * (high - low)


def _is_part(answer: FloquetAnswer) -> bool:
    """Whether a part of the window is blank that is reported."""
    return (
        _is_slow(answer)
        or math.isfinite(answer.largest_computed_factor)
        or answer.unknown_share > _UNREPORTED_BLANK
    )


def blank_parts(answer: FloquetAnswer, units: Units) -> str:
    """Say which part of the window is blank, where that is reported."""
    start = answer.lowest_computed_ratio
    words = ""
    if math.isfinite(answer.largest_computed_factor):
        words = (
            f" Above β_d = {answer.largest_computed_factor:.3g} the map is blank: the stiffness "
            "law has a pole at this load and is not valid above it."
        )
    if answer.unknown_share > _UNREPORTED_BLANK:
        words += (
            f" {percent(answer.unknown_share)} of the map is blank: within one period of the load "
            "the whirl grows too much there for its rate to be known."
        )
    if _is_slow(answer):
        words += (
            f" {_below(answer, start, units)} the map is blank: the load is so slow that one "
            "period holds too many whirl cycles, or too much growth, to compute."
        )
    low, high = answer.frequency_range
    if answer.drawn_from > max(low, start) + _UNREPORTED_BLANK * (high - low):
        words += (
            f" {_below(answer, answer.drawn_from, units)} (dotted) outlines are left out or "
            "rough: tongues of high order stand closer together there than the chart can show; "
            "zoom in to see them."
        )
    return words


def _below(answer: FloquetAnswer, frequency: float, units: Units) -> str:
    """Return which part of the chart lies below a frequency, in words."""
    return f"Below {units.place(frequency)}" if frequency < answer.frequency_range[1] else "Here"


def verdict(answer: FloquetAnswer, scales: Scales | None = None, bolotin_shown: bool = True) -> str:
    """Return the verdict on one chart, in three or four sentences.

    Parameters
    ----------
    answer : FloquetAnswer
    scales : Scales or None
        With scales, frequencies are in Hz, growth is per second and loads have a unit beside β_d.
    bolotin_shown : bool
        Whether the chart shows Bolotin's regions; otherwise the verdict does not name them.
    """
    return _opening(answer, scales) + _comparison(answer, bolotin_shown) + _end(answer, scales)


def _opening(answer: FloquetAnswer, scales: Scales | None) -> str:
    units = Units(answer.fundamental_frequency, answer.reference_load, scales)
    if answer.table.mean_is_unstable:
        return smallest_load(answer, units)  # no tongue stands out where everything grows
    return f"{_regions(answer, units)} {smallest_load(answer, units)}"


def _end(answer: FloquetAnswer, scales: Scales | None) -> str:
    if answer.detail is Detail.COARSE:
        return ""
    return blank_parts(answer, Units(answer.fundamental_frequency, answer.reference_load, scales))
