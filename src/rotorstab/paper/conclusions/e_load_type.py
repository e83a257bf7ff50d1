"""Conclusion (e): an axial load is worse than a follower load."""

from __future__ import annotations

from ...charts.figure import Statement
from ...floquet.resonance import resonances
from ...model.lumped import lumped
from ...rotors.shaft_disk import BASE_CASE
from ...whirl.critical_loads import critical_load
from ..arguments import SPINS
from ..figure_9_load_type import figure_9
from ..floquet_numbers import root, strongest, tongues
from ..verdicts import boundaries, confirm, groups, judge, listed, right_of
from .cases import AT, base_variant, peak_growths, unstable_share

__all__ = ["conclusion_e", "confirmation_e"]


def conclusion_e() -> Statement:
    """Judge (e) on Bolotin's regions: an axial load is worse than a follower load."""
    lower, wider = [], []
    axial_growth, follower_growth = peak_growths(0.0), peak_growths(1.0)
    principal = peak_growths(1.0, "1B+1F")[-1]
    buckling = float(critical_load(BASE_CASE.shear))
    table = resonances(lumped(BASE_CASE, 2.0, 1.0), 0.5 * buckling, buckling)
    strongest = max(table, key=lambda row: row.growth_per_load).name
    for panel in figure_9().panels:
        axial, follower = (boundaries(panel, group, ("1B", "1F")) for group in groups(panel))
        lower.append(right_of(follower, axial))
        wider.append(right_of(axial[1] - axial[0], follower[1] - follower[0]))
    return Statement(
        "(e) The periodic axial load makes the rotor more unstable than the follower load at "
        "the same static load factor.",
        f"The axial first region lies at lower frequency in {sum(lower)} and is wider in "
        f"{sum(wider)} of {len(lower)} panels. The strongest true tongue at Ω̄ = 0, 1, 2 grows at "
        f"{listed(axial_growth)} times β_d under axial, {listed(follower_growth)} under follower "
        "load.",
        judge(
            *lower,
            *wider,
            *(a > b for a, b in zip(axial_growth, follower_growth, strict=True)),
        ),
        "At α_s = 0.5, of Bolotin's first region and of the strongest tongue. At Ω̄ = 2 the "
        "follower load's first region holds no tongue of 1B and 1F at all (growth "
        f"{principal:.3f}); its strongest is {strongest}.",
    )


def confirmation_e() -> Statement:
    """Judge (e) by Floquet: growth, roots and unstable area under both kinds of load."""
    pairs = [[base_variant(spin, mu) for mu in (0.0, 1.0)] for spin in SPINS]
    rates = [[strongest(variant)[1] for variant in pair] for pair in pairs]
    shares = [[unstable_share(spin, mu) for mu in (0.0, 1.0)] for spin in SPINS]
    lowest = [
        [min(root(variant, name) for name in tongues(variant)) for variant in pair]
        for pair in pairs
    ]

    def both(rows: list[list[float]]) -> str:
        return "; ".join(f"{a:.3f}, {b:.3f}" for a, b in rows)

    return Statement(
        "(e) The periodic axial load makes the rotor more unstable than the follower load at "
        "the same static load factor.",
        f"{AT}, axial and follower, α_s = 0.5: strongest tongue {both(rates)} times β_d; lowest "
        f"root θ/ω_n {both(lowest)}; unstable share of the window to θ/ω_n = 8, β_d = 1, "
        f"{both(shares)}.",
        confirm(
            *(a > b for a, b in rates), *(a < b for a, b in lowest), *(a > b for a, b in shares)
        ),
        "By growth, place and area of what is unstable; under the follower load it is other pairs "
        "of modes that grow.",
    )
