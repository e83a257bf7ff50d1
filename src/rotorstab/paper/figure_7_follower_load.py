"""Figure 7: effect of the static load factor on Bolotin regions, follower load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from .._tolerances import NO_WIDTH
from ..charts.figure import Figure, Statement
from ..charts.structure import Chart
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from .arguments import FACTORS, SPINS
from .floquet_numbers import (
    PRINCIPAL,
    Variants,
    growth,
    read_shading,
    root,
    strongest,
    tongues,
    width,
)
from .region_figure import Variant
from .static_factors import static_factor_figure
from .verdicts import boundaries, confirm, groups, judge, listed, percent, right_of

__all__ = ["figure_7"]

Panels = tuple[Chart, ...]


def figure_7(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = SPINS,
    static_factors: Sequence[float] = FACTORS,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 7: effect of the static load factor, follower load; see `figure_6`.

    The load factors are measured by the static buckling load here too.
    """
    figure, drawn = static_factor_figure(
        7, 1.0, rotor, spin_speeds, static_factors, largest_factor, floquet
    )
    reading = _read_text(figure.panels)
    if floquet:
        reading += _read_floquet(figure.panels, drawn)
    return replace(figure, reading=reading)


def _read_text(panels: Panels) -> tuple[Statement, ...]:
    """Compare what the text says with Bolotin's regions."""
    return tuple(map(_read_panel, panels))


def _read_panel(panel: Chart) -> Statement:
    """Compare one panel; at rest the two boundaries start from one frequency."""
    lines = [boundaries(panel, group, ("1B", "1F")) for group in groups(panel)]
    pairs = list(pairwise(lines))
    left_edges = [right_of(after[0], before[0]) for before, after in pairs]
    steps = " → ".join(f"{edges[0, 0]:.4f}…{edges[1, 0]:.4f}" for edges in lines)
    if lines[0][1, 0] - lines[0][0, 0] < NO_WIDTH:
        right_edges = [right_of(after[1], before[1]) for before, after in pairs]
        return Statement(
            f"{panel.title}: the first region shifts right with α_s.",
            f"At β_d = 0: {steps}; at every β_d: "
            f"{'yes' if all(left_edges + right_edges) else 'no'}.",
            judge(all(left_edges), all(right_edges)),
        )
    inward = [right_of(before[1], after[1]) for before, after in pairs]
    widths = [edges[1] - edges[0] for edges in lines]
    narrower = all(right_of(before, after) for before, after in pairwise(widths))
    change = float(widths[-1][0] / widths[0][0] - 1)
    note = (
        "Its left boundary moves inward, its right one a little outward: here 1F rises with the "
        "follower load."
    )
    return Statement(
        f"{panel.title}: the first region shifts inward and narrows slightly with α_s.",
        f"At β_d = 0: {steps}; width {percent(change)}.",
        judge(all(left_edges), all(inward), narrower),
        "" if all(inward) else note,
    )


def _read_floquet(panels: Panels, drawn: Variants) -> tuple[Statement, ...]:
    """Compare what the text says with what Floquet finds unstable."""
    statements = [read_shading(panels)]
    for panel, variants in zip(panels, drawn, strict=True):
        spins = float(variants[0].system.spin_speed) != 0
        statements.append((_read_spinning if spins else _read_at_rest)(panel, variants))
    return tuple(statements)


def _principal(variants: Sequence[Variant]) -> tuple[list[float], list[float], str]:
    """Return growth and roots of the principal tongue, and both in words with the strongest."""
    rates, roots = [growth(variant) for variant in variants], list(map(root, variants))
    words = f"{PRINCIPAL} grows at {listed(rates)} times β_d"
    if all(rate > 0 for rate in rates):
        words += f" and begins at θ/ω_n = {listed(roots)}"
    best = ", ".join(f"{name} {rate:.3f}" for name, rate in map(strongest, variants))
    return rates, roots, f"{words}; strongest: {best}."


def _read_at_rest(panel: Chart, variants: Sequence[Variant]) -> Statement:
    rates, roots, words = _principal(variants)
    exists = all(rate > 0 for rate in rates)
    of_two_modes = (row for row in tongues(variants[0]).values() if row.kind != "principal")
    other = next((row.name for row in of_two_modes), "")
    moves = [root(variant, other) for variant in variants]
    return Statement(
        f"{panel.title}: the first unstable region shifts right with α_s.",
        words,
        confirm(exists and all(a < b for a, b in pairwise(roots))),
        f"Beside it {other} begins at β_d = 0 at θ/ω_n = {listed(moves)} and grows at "
        f"{listed([growth(variant, other) for variant in variants])} times β_d: two "
        "different modes, which the paper's method does not seek.",
    )


def _read_spinning(panel: Chart, variants: Sequence[Variant]) -> Statement:
    rates, roots, words = _principal(variants)
    exists = all(rate > 0 for rate in rates)
    name, _ = strongest(variants[0])
    moves = [root(variant, name) for variant in variants]
    widths = [width(panel, group, 0.1, name) for group in groups(panel)]
    inward = exists and all(a < b for a, b in pairwise(roots))
    narrower = exists and all(a > b for a, b in pairwise(rates))
    return Statement(
        f"{panel.title}: the first unstable region shifts inwardly and narrows slightly.",
        words,
        confirm(inward, narrower),
        f"What is unstable in Bolotin's first region at small β_d is {name}, two modes of "
        f"the same direction: it shifts left, θ/ω_n = {listed(moves)}, and is "
        f"{listed(widths)} wide at β_d = 0.1.",
    )
