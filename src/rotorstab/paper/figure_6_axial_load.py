"""Figure 6: effect of the static load factor on Bolotin regions, axial load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ..charts.figure import Figure, Statement
from ..charts.structure import Chart
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from .arguments import FACTORS, SPINS
from .floquet_numbers import PRINCIPAL, Variants, area, growth, place, read_shading, tongues
from .static_factors import static_factor_figure
from .verdicts import boundaries, by_panel, confirm, groups, judge, right_of

__all__ = ["figure_6"]

Panels = tuple[Chart, ...]


def figure_6(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = SPINS,
    static_factors: Sequence[float] = FACTORS,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 6: effect of the static load factor, axial load.

    Parameters
    ----------
    rotor : ShaftDisk
    spin_speeds : sequence of up to 26 floats
        Ω̄, a panel each.
    static_factors : sequence of up to three floats
        α_s, a line style each.
    largest_factor : float
        Top of the β_d axis.
    floquet : bool
        Whether to add what is unstable, and what of the text Floquet's method confirms.

    Returns
    -------
    Figure
    """
    figure, drawn = static_factor_figure(
        6, 0.0, rotor, spin_speeds, static_factors, largest_factor, floquet
    )
    reading = _read_text(figure.panels)
    if floquet:
        reading += _read_floquet(figure.panels, drawn)
    return replace(figure, reading=reading)


def _read_text(panels: Panels) -> tuple[Statement, ...]:
    """Compare what the text says with Bolotin's regions."""
    facts, numbers = [], []
    for panel in panels:
        lines = [boundaries(panel, group) for group in groups(panel)]
        facts.append(all(right_of(a, b) for a, b in pairwise(lines)))
        steps = " → ".join(f"{edges[0, 0]:.3f}…{edges[1, 0]:.3f}" for edges in lines)
        numbers.append(f"{panel.title}: {steps}")
    return (
        Statement(
            "With a higher α_s the regions shift left, nearer to the β_d axis.",
            f"Every boundary moves left at every β_d in {sum(facts)} of {len(facts)} panels. "
            f"First region at β_d = 0, {'; '.join(numbers)}.",
            judge(*facts),
        ),
    )


def _growths(drawn: Variants, name: str = PRINCIPAL) -> list[list[float]]:
    return [[growth(variant, name) for variant in variants] for variants in drawn]


def _read_floquet(panels: Panels, drawn: Variants) -> tuple[Statement, ...]:
    """Compare what the text says with what Floquet finds unstable."""
    falls = []
    for variants in drawn:
        for before, after in pairwise(variants):
            common = tongues(before).keys() & tongues(after).keys()
            falls += [place(after, name) < place(before, name) for name in common]
    rates = _growths(drawn)
    shares = [[area(panel, group) for group in groups(panel)] for panel in panels]
    rise = all(a < b for row in rates for a, b in pairwise(row))
    more = all(a < b for row in shares for a, b in pairwise(row))
    return (
        read_shading(panels),
        Statement(
            "With a higher α_s the unstable regions shift left, closer to the β_d axis.",
            f"{sum(falls)} of {len(falls)} true tongues root at a lower θ after a step of α_s.",
            confirm(*falls),
            "Each root is a sum of two whirl frequencies, and all of these fall with the load.",
        ),
        Statement(
            "With a higher α_s the system is more unstable.",
            f"{PRINCIPAL} grows at, times β_d, {by_panel(panels, rates)}. Unstable share of the "
            f"window: {by_panel(panels, shares)}.",
            confirm(rise, more),
            "The paper's reason is the lower frequency; the stronger growth is one.",
        ),
    )
