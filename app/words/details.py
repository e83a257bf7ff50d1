"""What stands behind "Details": the table of tongues, and the shares of the window."""

from __future__ import annotations

import math
from typing import Any

from rotorstab import Resonance, Scales
from rotorstab.charts import written
from rotorstab.floquet.first_order import FirstOrderRegion, first_order_regions

from ..results.floquet_answer import TABLE_FACTOR, FloquetAnswer
from ..results.limits import Detail
from .units import Units
from .verdict import blank_parts, percent, smallest_load

__all__ = ["details"]

_NONE = "—"
_OF_ALL_WHIRLS = (
    " In this shaft slow and fast whirls become unstable together, so the map is made of all "
    "whirls of the finite elements, on a coarser grid."
)


def details(answer: FloquetAnswer, scales: Scales | None = None) -> dict[str, Any]:
    """Return the tongues and the shares of the window as texts.

    Parameters
    ----------
    answer : FloquetAnswer
    scales : Scales or None
        With scales, frequencies are in Hz and growth is per second.

    Returns
    -------
    dict
        "columns", the heads of the table; "rows", its cells, by the centre of the tongue;
        "shares", pairs of a name and a share; "words", sentences on the smallest load that
        destabilises and on blank parts of the map.
    """
    units = Units(answer.fundamental_frequency, answer.reference_load, scales)
    damped = any(0 < row.threshold < math.inf for row in answer.table)
    columns = ["Tongue", *_heads(units), *(["begins at β_d"] if damped else [])]
    words = smallest_load(answer, units)
    if answer.detail is not Detail.COARSE:
        words += blank_parts(answer, units)
    if answer.of_all_whirls:
        words += _OF_ALL_WHIRLS
    return {
        "columns": columns,
        "rows": [] if answer.table.mean_is_unstable else _rows(answer, units, damped),
        "shares": _shares(answer),
        "words": words,
    }


def _heads(units: Units) -> list[str]:
    at = f"at β_d = {TABLE_FACTOR:g}"
    if units.scales is None:
        return ["θ/ωₙ", f"width {at}", f"growth σ̄ {at}"]
    return ["θ/2π", f"width [Hz] {at}", f"growth σ [1/s] {at}"]


def _rows(answer: FloquetAnswer, units: Units, damped: bool) -> list[list[str]]:
    """Return a row for each tongue in the window, sorted by its centre."""
    low, high = answer.frequency_range
    regions = first_order_regions(answer.table, TABLE_FACTOR * units.reference)
    inside = {tongue.name for region in regions for tongue in region.tongues}
    # with damping, a tongue may begin above the load of the table
    later = [row for row in answer.table.tongues if row.name not in inside]
    found = [(region.centre, _region_cells(region, units, damped)) for region in regions]
    found += [
        (row.centre, _later_cells(row, units)) for row in later if math.isfinite(row.threshold)
    ]
    return [
        cells
        for centre, cells in sorted(found, key=lambda one: one[0])
        if low <= centre / units.fundamental <= high
    ]


def _region_cells(region: FirstOrderRegion, units: Units, damped: bool) -> list[str]:
    growth = max(tongue.growth for tongue in region.tongues)
    rate = growth if units.scales is None else growth * units.scales.frequency
    # tongues that act together grow a little differently from the strongest alone
    about = "≈ " if len(region.tongues) > 1 else ""
    threshold = min(tongue.threshold for tongue in region.tongues) / units.reference
    return [
        region.name,
        units.bare_excitation(region.centre / units.fundamental),
        units.width(region.width / units.fundamental),
        f"{about}{written(rate, 3)}",
        *([written(threshold, 3)] if damped else []),
    ]


def _later_cells(row: Resonance, units: Units) -> list[str]:
    place = units.bare_excitation(row.centre / units.fundamental)
    return [row.name, place, _NONE, _NONE, written(row.threshold / units.reference, 3)]


def _shares(answer: FloquetAnswer) -> list[list[str]]:
    """Return the shares of the window; a coarse map has no true ones."""
    true, bolotin, both = answer.unstable_share, answer.bolotin_share, answer.both_share
    if answer.detail is Detail.COARSE or math.isnan(true):
        return []
    rows = [
        ["Unstable (Floquet)", percent(true, zero_is_none=not answer.has_tongues)],
        ["In a Bolotin region", percent(bolotin)],
        ["In a Bolotin region, but stable", percent(bolotin - both)],
        ["Unstable, but in no Bolotin region", percent(true - both)],
    ]
    return rows
