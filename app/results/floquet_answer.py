"""What the growth map of a window says, as numbers for the verdict and the report."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotorstab import ResonanceTable, StabilityChart, is_unstable

from .limits import Detail
from .window import FloquetMap

__all__ = ["TABLE_FACTOR", "FloquetAnswer", "floquet_answer"]

TABLE_FACTOR = 0.1
"""β_d at which the resonance table, and the widths in the verdict, are computed."""


@dataclass(frozen=True, eq=False)
class FloquetAnswer:
    """What Floquet's growth map says about the window of the chart.

    Parameters
    ----------
    table : ResonanceTable
        Every pair of modes at β_d = `TABLE_FACTOR`.
    frequency_range : (float, float)
        Lowest and highest θ/ω_n of the chart.
    fundamental_frequency, reference_load : float
        ω_n, and the load that β_d = 1 stands for.
    unstable_share, bolotin_share, both_share : float
        Shares of the computed part of the chart that are unstable, in a Bolotin region, and both;
        NaN where nothing is computed.
    unstable_from : float
        Lowest β_d of an unstable pixel, inf where there is none.
    detail : Detail
        Of the growth map: on a coarse one thin tongues have no true area.
    lowest_computed_ratio : float
        θ/ω_n below which the map is blank, since the load is too slow to be followed; 0 where no
        part is blank for that reason.
    drawn_from : float
        θ/ω_n below which tongues are too near to each other to be drawn, or nothing is computed; 0
        where the whole window is drawn, inf where nothing is.
    largest_computed_factor : float
        β_d above which the map is blank, since the stiffness law ends; inf where it does not.
    unknown_share : float
        Share of the other pixels that are blank: the growth within a period is too strong there.
    of_all_whirls : bool
        See `FloquetMap`.
    has_tongues : bool
        Whether the window holds a tongue, however thin.
    """

    table: ResonanceTable
    frequency_range: tuple[float, float]
    fundamental_frequency: float
    reference_load: float
    unstable_share: float
    bolotin_share: float
    both_share: float
    unstable_from: float = math.inf
    detail: Detail = Detail.FULL
    lowest_computed_ratio: float = 0.0
    drawn_from: float = 0.0
    largest_computed_factor: float = math.inf
    unknown_share: float = 0.0
    of_all_whirls: bool = False
    has_tongues: bool = False


def floquet_answer(
    made: FloquetMap,
    table: ResonanceTable,
    detail: Detail,
    *,
    fundamental: float,
    reference: float,
    frequency_range: tuple[float, float],
    largest_factor: float,
    end_of_law: float,
) -> FloquetAnswer:
    """Return what a growth map says.

    Parameters
    ----------
    made : FloquetMap
    table : ResonanceTable
        At β_d = `TABLE_FACTOR`.
    detail : Detail
        Of the map.
    fundamental, reference : float
        ω_n, and the load that β_d = 1 stands for.
    frequency_range : (float, float)
        Lowest and highest θ/ω_n of the window.
    largest_factor : float
        Largest β_d of the window.
    end_of_law : float
        β_d at which the stiffness law ends; inf for the linear law.
    """
    growth = made.growth
    low, high = frequency_range
    has_first_order = any(
        row.threshold < largest_factor * reference and low < row.centre / fundamental < high
        for row in table.tongues
    )
    has_thin = made.edges is not None and bool(made.edges.thin)
    return FloquetAnswer(
        table=table,
        frequency_range=frequency_range,
        fundamental_frequency=fundamental,
        reference_load=reference,
        **_shares(growth, made.mask, reference),
        detail=detail,
        lowest_computed_ratio=_lowest_computed_ratio(growth, fundamental),
        drawn_from=made.drawn_from / fundamental,
        largest_computed_factor=end_of_law if end_of_law < largest_factor else math.inf,
        unknown_share=_unknown_share(growth),
        of_all_whirls=made.of_all_whirls,
        has_tongues=has_thin or has_first_order,
    )


def _lowest_computed_ratio(growth: StabilityChart, fundamental_frequency: float) -> float:
    """Return the lowest θ/ω_n that the map shows, inf if it shows none, 0 if no column is blank."""
    known = np.isfinite(growth.growth).any(axis=0)
    if known.all():
        return 0.0
    shown = growth.excitation_frequencies[known]
    return float(shown.min()) / fundamental_frequency if shown.size else np.inf


def _unknown_share(growth: StabilityChart) -> float:
    """Return the share of blank pixels in the rows and columns that are not blank as a whole."""
    known = np.isfinite(growth.growth)
    inside = known[np.ix_(known.any(axis=1), known.any(axis=0))]
    return float(1 - inside.mean()) if inside.size else 0.0


def _shares(growth: StabilityChart, mask: NDArray[np.bool_], reference: float) -> dict[str, float]:
    """Return the shares of the window's computed part, and the lowest unstable β_d."""
    known = np.isfinite(growth.growth)
    # areas by the pixels' centres: a thin tongue that marks a pixel does not fill it
    grows = is_unstable(growth.growth, growth.error) & known
    rows = growth.pulsating_loads[grows.any(axis=1)]
    count = int(known.sum())
    return {
        name: int((part & known).sum()) / count if count else math.nan
        for name, part in (
            ("unstable_share", grows),
            ("bolotin_share", mask),
            ("both_share", mask & grows),
        )
    } | {"unstable_from": float(rows.min()) / reference if rows.size else math.inf}
