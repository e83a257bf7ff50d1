"""Conclusion (c): a higher static load factor brings resonance at lower frequency."""

from __future__ import annotations

from itertools import pairwise

from ...charts.figure import Statement
from ..arguments import FACTORS, SPINS
from ..figure_6_axial_load import figure_6
from ..floquet_numbers import PRINCIPAL, growth, place, root, tongues
from ..verdicts import boundaries, confirm, groups, judge, listed, percent, right_of
from .cases import AT, base_variant

__all__ = ["conclusion_c", "confirmation_c"]


def conclusion_c() -> Statement:
    """Judge (c) on Bolotin's regions: a higher static load lowers every boundary."""
    kept, shifts = [], []
    for panel in figure_6().panels:
        lines = [boundaries(panel, group) for group in groups(panel)]
        kept += [right_of(a, b) for a, b in pairwise(lines)]
        shifts.append(float(lines[-1][1, 0] / lines[0][1, 0] - 1))
    return Statement(
        "(c) With a higher static load factor parametric resonance occurs at lower axial "
        "disturbance frequency.",
        f"All four boundaries fall at every β_d in {sum(kept)} of {len(kept)} steps of α_s. From "
        f"α_s = 0 to 0.5 the first forward one falls by "
        f"{', '.join(percent(-s) for s in shifts)} at Ω̄ = 0, 1, 2.",
        judge(*kept),
        "Axial load. It follows from the fall of every whirl frequency, so true resonances, "
        "which lie at sums of them, shift the same way.",
    )


def confirmation_c() -> Statement:
    """Judge (c) by Floquet: the root of every tongue over the static load factor."""
    steps, moves = [], []
    for spin in SPINS:
        row = [base_variant(spin, 0.0, factor) for factor in FACTORS]
        for before, after in pairwise(row):
            names = tongues(before).keys() & tongues(after).keys()
            steps += [place(after, name) < place(before, name) for name in names]
        moves.append([root(variant) for variant in row])
    rates = [[growth(base_variant(spin, 0.0, factor)) for factor in FACTORS] for spin in SPINS]
    return Statement(
        "(c) With a higher static load factor parametric resonance occurs at lower axial "
        "disturbance frequency.",
        f"{sum(steps)} of {len(steps)} true tongues root lower after a step of α_s. {AT} "
        f"{PRINCIPAL} goes from θ/ω_n {'; '.join(listed(row) for row in moves)} and grows at "
        f"{'; '.join(listed(row) for row in rates)} times β_d for α_s = 0, 0.2, 0.5.",
        confirm(*steps),
        "Upheld, and the growth rises too.",
    )
