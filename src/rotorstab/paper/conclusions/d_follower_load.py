"""Conclusion (d): under a follower load the first region moves inward and narrows."""

from __future__ import annotations

from itertools import pairwise

from ...charts.figure import Statement
from ..arguments import FACTORS, SPINS
from ..figure_7_follower_load import figure_7
from ..floquet_numbers import PRINCIPAL, growth, root, strongest
from ..verdicts import boundaries, confirm, groups, judge, listed, percent, right_of
from .cases import base_variant, exact_width

__all__ = ["conclusion_d", "confirmation_d"]


def conclusion_d() -> Statement:
    """Judge (d) on Bolotin's regions: the first one moves inward and narrows."""
    left, right, narrower, changes = [], [], [], []
    panels = [panel for panel in figure_7().panels if panel.title != "Ω̄ = 0"]
    for panel in panels:
        first, *_, last = (boundaries(panel, group, ("1B", "1F")) for group in groups(panel))
        left.append(right_of(last[0], first[0]))
        right.append(right_of(first[1], last[1]))
        narrower.append(right_of(first[1] - first[0], last[1] - last[0]))
        changes.append(float((last[1, 0] - last[0, 0]) / (first[1, 0] - first[0, 0]) - 1))
    return Statement(
        "(d) With a higher static load factor the first region under a follower load moves "
        "inward and narrows slightly.",
        f"Of {len(panels)} spinning panels the left boundary moves inward in {sum(left)}, the "
        f"right one in {sum(right)}; the region narrows in {sum(narrower)} "
        f"({', '.join(percent(c) for c in changes)} from α_s = 0 to 0.5).",
        judge(*left, *right, *narrower),
        "Where it does not, at Ω̄ = 1, 1F rises with the follower load. Without spin the region "
        "moves right and widens.",
    )


def confirmation_d() -> Statement:
    """Judge (d) by Floquet: the tongues in the first region under a follower load."""
    spins = SPINS[1:]
    rows = [[base_variant(spin, 1.0, factor) for factor in FACTORS] for spin in spins]
    rates = [[growth(variant) for variant in row] for row in rows]
    name = strongest(rows[0][0])[0]
    places = [[root(variant, name) for variant in row] for row in rows]
    widths = [[exact_width(spin, 1.0, f, name, 0.1) for f in FACTORS] for spin in spins]
    exists = [all(rate > 0 for rate in row) for row in rates]
    narrower = [all(a > b for a, b in pairwise(row)) for row in widths]
    return Statement(
        "(d) With a higher static load factor the first region under a follower load moves "
        "inward and narrows slightly.",
        f"At Ω̄ = 1, 2 and α_s = 0, 0.2, 0.5 the pair {PRINCIPAL} grows at "
        f"{'; '.join(listed(row) for row in rates)} times β_d. What is unstable there is {name}, "
        f"rooted at θ/ω_n = {'; '.join(listed(row) for row in places)}, "
        f"{'; '.join(listed(row, 4) for row in widths)} wide at β_d = 0.1.",
        confirm(*exists, *narrower),
        "Bolotin's first region holds no principal tongue, save a weak one at Ω̄ = 1, α_s = 0.5. "
        f"The tongue {name} inside it joins two backward modes; it shifts left and widens.",
    )
