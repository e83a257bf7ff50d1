"""The paper's five conclusions, and in which sense they hold on our numbers.

All are statements about Bolotin's regions. Whether a rotor in such a region is unstable is
another question once it spins, and only Floquet answers it.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from ..charts.figure import Figure, Statement
from ..floquet.resonance import resonances
from ..model.lumped import lumped
from ..rotors.shaft_disk import BASE_CASE
from ..whirl.critical_loads import critical_load
from ..whirl.frequencies import whirl_frequencies
from .figure_5_shear import figure_5
from .figure_6_axial_load import figure_6
from .figure_7_follower_load import figure_7
from .figure_9_load_type import figure_9
from .verdicts import boundaries, groups, judge, percent, right_of, say

__all__ = [
    "CONCLUSIONS",
    "conclusion_a",
    "conclusion_b",
    "conclusion_c",
    "conclusion_d",
    "conclusion_e",
]


def conclusion_a() -> Statement:
    """Return (a): left boundaries are backward modes, right ones forward modes."""
    buckling = float(critical_load(BASE_CASE.shear))
    signs = [
        np.sign(whirl[np.argsort(np.abs(whirl))])
        for tangency in (0.0, 1.0)
        for spin in (1.0, 2.0)
        for factor in (0.0, 0.2, 0.5)
        for whirl in [whirl_frequencies(lumped(BASE_CASE, spin, tangency), factor * buckling).real]
    ]
    kept = [bool((row == [-1, 1, -1, 1]).all()) for row in signs]
    return Statement(
        "(a) The left boundary of each region is made by the backward, the right one by the "
        "forward mode.",
        f"In {sum(kept)} of {len(kept)} spinning cases of Figs 6 and 7 the frequencies in order "
        "of size are 1B, 1F, 2B, 2F, so each region lies between the two of one mode number.",
        judge(*kept),
        "Without spin both boundaries come from one frequency and there is no direction.",
    )


def _first_widths(figure: Figure, group: str, index: int) -> list[float]:
    edges = [boundaries(panel, group, ("1B", "1F"))[:, index] for panel in figure.panels]
    return [float(right - left) for left, right in edges]


def _tongues(tangency: float, name: str | None = None) -> list[float]:
    """Return the peak growth rate per β_d of one tongue, or the strongest, at Ω̄ = 0, 1, 2."""
    buckling = float(critical_load(BASE_CASE.shear))
    tables = [
        resonances(lumped(BASE_CASE, spin, tangency), 0.5 * buckling, buckling)
        for spin in (0.0, 1.0, 2.0)
    ]
    return [
        buckling * max(row.growth_per_load for row in table if name in (None, row.name))
        for table in tables
    ]


def _list(values: list[float]) -> str:
    return ", ".join(f"{value:.3f}" for value in values)


def conclusion_b() -> Statement:
    """Return (b): shear and the gyroscopic moment are destabilising."""
    figure = figure_5()
    lower = [
        right_of(boundaries(panel, "Euler–Bernoulli"), boundaries(panel, "Timoshenko"))
        for panel in figure.panels
    ]
    widths = _first_widths(figure, "Timoshenko", 10)
    at_zero = _first_widths(figure, "Timoshenko", 0)
    buckling = float(critical_load(BASE_CASE.shear))
    whirl = whirl_frequencies(lumped(BASE_CASE, 2.0), 0.5 * buckling)
    growth = _tongues(0.0, "1B+1F")
    stable = bool(np.abs(whirl.imag).max() == 0)
    return Statement(
        "(b) Shear deformation and the gyroscopic moment are both destabilising.",
        f"Shear lowers every boundary in {sum(lower)} of {len(lower)} panels. At Ω̄ = 0, 1, 2 "
        f"the first region's width is {_list(widths)} at β_d = 0.5, and {_list(at_zero)} at "
        f"β_d = 0, where every whirl frequency is {say(stable, 'real: stable', 'complex')}. The "
        f"true tongue of 1B and 1F grows at {_list(growth)} times β_d.",
        judge(
            *lower,
            widths[0] < widths[1] < widths[2],
            at_zero[2] < 1e-6,
            growth[0] < growth[1] < growth[2],
        ),
        "True of the position and width of Bolotin's regions. The gyroscopic widening is no loss "
        "of stability: the region keeps its width where nothing pulsates, while the true tongue "
        "becomes weaker and narrower with the speed.",
    )


def conclusion_c() -> Statement:
    """Return (c): a higher static load factor brings resonance at lower frequency."""
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


def conclusion_d() -> Statement:
    """Return (d): under a follower load the first region moves inward and narrows."""
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


def conclusion_e() -> Statement:
    """Return (e): an axial load is worse than a follower load."""
    lower, wider = [], []
    axial_growth, follower_growth = _tongues(0.0), _tongues(1.0)
    principal = _tongues(1.0, "1B+1F")[-1]
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
        f"{_list(axial_growth)} times β_d under axial, {_list(follower_growth)} under follower "
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


CONCLUSIONS: dict[str, Callable[[], Statement]] = {
    "a": conclusion_a,
    "b": conclusion_b,
    "c": conclusion_c,
    "d": conclusion_d,
    "e": conclusion_e,
}
"""Each conclusion's function by its letter."""
