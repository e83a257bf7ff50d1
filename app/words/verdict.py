"""The verdict in words: what Floquet finds in the chart, and how far Bolotin is off."""

from __future__ import annotations

import math

from rotorstab import Scales
from rotorstab.charts import written
from rotorstab.floquet.first_order import FirstOrderRegion, first_order_regions

from ..results.analysis import FloquetAnswer
from ..results.limits import Detail
from .si import load_words

__all__ = ["verdict", "verdict_room"]

_GROWS = 1e-9  # growth of the mean system above rounding
_MOST = 6  # regions named in one sentence
_DRIVE = 0.1  # β_d at which the regions of first order are told, as the table is made
_LONGEST_COMPARISON = (
    " Of the computed part of this window 88 % is unstable; Bolotin regions cover 88 %, "
    "overstating the area by 8,888 %; yet 88 % of what is unstable lies outside them."
)


def _percent(share: float, *, none: bool = True) -> str:
    if share == 0 and none:
        return "nothing"
    if share < 0.001:
        return "under 0.1 %"
    return f"{100 * share:.0f} %" if share >= 0.1 else f"{100 * share:.2g} %"


def _newtons(load: float, scales: Scales | None) -> str:
    """Return a pulsating load in words, where it is wanted."""
    return "" if scales is None else f" (P_t = {load_words(load, scales)})"


def _region(one: FirstOrderRegion, frequency: float, scales: Scales | None) -> str:
    if scales is not None:
        hertz = scales.frequency / (2 * math.pi)
        return (
            f"{one.name} at {written(one.centre * hertz)} Hz ({written(one.width * hertz, 3)} wide)"
        )
    centre = f"{one.name} at θ/ωₙ = {one.centre / frequency:.3f}"
    return f"{centre} ({one.width / frequency:.3f} wide)"


def _regions(answer: FloquetAnswer, scales: Scales | None) -> str:
    low, high = answer.frequency_range
    frequency = answer.fundamental_frequency
    regions = first_order_regions(answer.table, _DRIVE * answer.reference_load)
    inside = [one for one in regions if low <= one.centre / frequency <= high]
    if not inside:
        return "No tongue of first order is open in this window at β_d = 0.1."
    named = "; ".join(_region(one, frequency, scales) for one in inside[:_MOST])
    more = f"; and {len(inside) - _MOST} more" if len(inside) > _MOST else ""
    word = "unstable region" if len(inside) == 1 else "unstable regions"
    load = f"β_d = {_DRIVE:g}{_newtons(_DRIVE * answer.reference_load, scales)}"
    return (
        f"To first order in the load, {len(inside)} {word} in this window at {load}: "
        f"{named}{more}; lines without a name are of higher order."
    )


def _margin(answer: FloquetAnswer, scales: Scales | None) -> str:
    table = answer.table
    if table.mean_growth > _GROWS:
        rate = (
            f"σ̄ = {written(table.mean_growth, 3)}"
            if scales is None
            else f"σ = {written(table.mean_growth * scales.frequency, 3)} per second"
        )
        return f"The rotor is unstable without any pulsation: its steady motion grows at {rate}."
    first = min(table, key=lambda row: row.threshold)
    if not math.isfinite(first.threshold):
        return "To first order no pulsation, however large, makes two modes resonate."
    if first.threshold == 0:
        return (
            "Without damping any pulsation, however small, suffices at a first-order "
            "tongue’s centre."
        )
    threshold = first.threshold / answer.reference_load
    words = (
        f"To first order, damping holds up to β_d = {threshold:.3f}"
        f"{_newtons(first.threshold, scales)}; {first.name} goes first"
    )
    if answer.unstable_from < 0.9 * threshold:
        load = _newtons(answer.unstable_from * answer.reference_load, scales)
        words += f", yet the map shows growth from β_d = {answer.unstable_from:.3f}{load}"
    return words + "."


def _comparison(answer: FloquetAnswer, bolotin_shown: bool) -> str:
    true, bolotin, both = answer.unstable_share, answer.bolotin_share, answer.both_share
    if math.isnan(true):
        return ""
    if answer.detail is Detail.COARSE:
        return " Shares of the window and the slowest loads follow once the sliders rest."
    place = "the computed part of this window" if _is_part(answer) else "this window"
    if answer.table.mean_growth > _GROWS:
        if true == 1:
            return f" All of {place} is unstable, at any pulsation."
        return f" Of {place} {_percent(true)} is unstable; elsewhere the pulsation steadies it."
    text = f" Of {place} {_percent(true, none=not answer.has_tongues)} is unstable"
    if not bolotin_shown:
        return text + "."
    text += f"; Bolotin regions cover {_percent(bolotin)}"
    if true > 0 and bolotin > true:
        text += f", overstating the area by {100 * (bolotin / true - 1):,.0f} %"
    missed = true - both
    if missed > 0.001 * true > 0:
        text += f"; yet {_percent(missed / true)} of what is unstable lies outside them"
    return text + "."


_SLIVER = 0.02  # share of the window that may be blank without a word


def _is_slow(answer: FloquetAnswer) -> bool:
    """Whether the slowest loads of the window, more than a sliver, are blank."""
    low, high = answer.frequency_range
    return answer.followed_from > low + _SLIVER * (high - low)


def _is_part(answer: FloquetAnswer) -> bool:
    """Whether more than a sliver of the window is blank."""
    return _is_slow(answer) or math.isfinite(answer.ends_at) or answer.unknown_share > _SLIVER


def _blank(answer: FloquetAnswer) -> str:
    """Say which part of the window is blank, where that is more than a sliver."""
    start = answer.followed_from
    words = ""
    if math.isfinite(answer.ends_at):
        words = (
            f" Above β_d = {answer.ends_at:.3g} the map is blank: a shaft clamped at both ends "
            "buckles under such a load, and the exact stiffness law ends there."
        )
    if answer.unknown_share > _SLIVER:
        words += (
            f" {_percent(answer.unknown_share)} of the map is blank: within one period of the load "
            "the whirl grows too much there for its rate to be known."
        )
    if not _is_slow(answer):
        return words
    where = f"Below θ/ωₙ = {start:.3g}" if start < answer.frequency_range[1] else "Here"
    return words + (
        f" {where} the map is blank: in one period of so slow a load the shaft whirls too often, "
        "or its whirl grows too much, to be followed in time."
    )


def verdict(answer: FloquetAnswer, scales: Scales | None = None, bolotin_shown: bool = True) -> str:
    """Return the verdict on one chart, in three or four sentences.

    With `scales` frequencies are in Hz, growth is per second and loads have a unit beside β_d.
    Bolotin's regions are not spoken of where they are not shown.
    """
    return _opening(answer, scales) + _comparison(answer, bolotin_shown) + _end(answer)


def verdict_room(answer: FloquetAnswer, scales: Scales | None = None) -> str:
    """Return words as long as the verdict of the full map may become, to keep its place free."""
    return _opening(answer, scales) + _LONGEST_COMPARISON + _end(answer)


def _end(answer: FloquetAnswer) -> str:
    return "" if answer.detail is Detail.COARSE else _blank(answer)


def _opening(answer: FloquetAnswer, scales: Scales | None) -> str:
    if answer.table.mean_growth > _GROWS:
        return _margin(answer, scales)  # no tongue stands out of what grows everywhere
    return f"{_regions(answer, scales)} {_margin(answer, scales)}"
