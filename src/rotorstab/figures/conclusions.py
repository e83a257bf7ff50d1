"""The paper's five conclusions, and in which sense they hold on our numbers.

All are statements about Bolotin's regions. Whether a rotor in such a region is unstable is
another question once it spins, and only Floquet answers it.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from ..critical import critical_load
from ..rotor import BASE_CASE
from ..system import lumped
from ..whirl import whirl_frequencies
from .regions import figure_5, figure_6, figure_7, figure_9
from .structure import Figure, Statement
from .verdicts import boundaries, groups, judge, percent, right_of

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
    stable = bool(np.abs(whirl.imag).max() == 0)
    return Statement(
        "(b) Shear deformation and the gyroscopic moment are both destabilising.",
        f"Shear lowers every boundary in {sum(lower)} of {len(lower)} panels. The first region's "
        f"width at β_d = 0.5 is {', '.join(f'{w:.3f}' for w in widths)} at Ω̄ = 0, 1, 2; "
        f"at β_d = 0 it is {', '.join(f'{w:.3f}' for w in at_zero)}, though there every whirl "
        "frequency is " + ("real, that is stable." if stable else "complex."),
        judge(*lower, widths[0] < widths[1] < widths[2], at_zero[2] < 1e-6),
        "True of the position and width of Bolotin's regions. The gyroscopic widening is no "
        "loss of stability: the region keeps its width where nothing pulsates.",
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
    for panel in figure_9().panels:
        axial, follower = (boundaries(panel, group, ("1B", "1F")) for group in groups(panel))
        lower.append(right_of(follower, axial))
        wider.append(right_of(axial[1] - axial[0], follower[1] - follower[0]))
    return Statement(
        "(e) The periodic axial load makes the rotor more unstable than the follower load at "
        "the same static load factor.",
        f"The axial first region lies at lower frequency in {sum(lower)} and is wider in "
        f"{sum(wider)} of {len(lower)} panels.",
        judge(*lower, *wider),
        "True of Bolotin's first region at α_s = 0.5. It says nothing of combination "
        "resonances, which a follower load has more of.",
    )


CONCLUSIONS: dict[str, Callable[[], Statement]] = {
    "a": conclusion_a,
    "b": conclusion_b,
    "c": conclusion_c,
    "d": conclusion_d,
    "e": conclusion_e,
}
"""Each conclusion's function by its letter."""
