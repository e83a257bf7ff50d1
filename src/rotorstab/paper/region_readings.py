"""What the text says of Figs 4–7 and 9, against what their arrays show.

Every number in a statement is computed from the arrays handed over. "Region" is always
Bolotin's: where the paper says "unstable" of a spinning rotor, only Floquet can confirm it.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..bolotin.boundaries import boundary_frequencies
from ..charts.figure import Array, Panel, Statement
from ..model.finite_element import finite_element
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.critical_loads import critical_load
from .verdicts import boundaries, groups, judge, percent, right_of, say

__all__ = [
    "read_figure_4",
    "read_figure_5",
    "read_figure_6",
    "read_figure_7",
    "read_figure_9",
]

Panels = tuple[Panel, ...]


def _ratio_range(panel: Panel, modes: tuple[str, ...], span: slice = slice(None)) -> Array:
    """Return the least and largest present/finite-element − 1 of the boundaries."""
    present, comparator = (boundaries(panel, group, modes)[:, span] for group in groups(panel))
    excess = present / comparator - 1
    return np.array([np.nanmin(excess), np.nanmax(excess)])


def read_figure_4(panels: Panels, rotor: ShaftDisk) -> tuple[Statement, ...]:
    """Return the reading of Fig. 4."""
    # the left boundary runs to 0 near β_d = 1, where a ratio says nothing
    first = np.array([_ratio_range(panel, ("1B", "1F"), slice(0, 11)) for panel in panels])
    second = np.array([_ratio_range(panel, ("2B", "2F")) for panel in panels])
    shifted = all(
        right_of(*(boundaries(panel, group) for group in groups(panel))) for panel in panels
    )
    second_frequency = [
        np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(one.mass, one.elastic)).real)[1])
        for one in (lumped(rotor, 0.0), finite_element(rotor, 0.0))
    ]
    excess = float(second_frequency[0] / second_frequency[1] - 1)
    return (
        Statement(
            "The agreement of the first regions is good.",
            f"To β_d = 0.5 the lumped boundaries are {percent(first.min())} to "
            f"{percent(first.max())} above the finite-element ones.",
            judge(first.max() < 0.1),
        ),
        Statement(
            "The lumped regions are slightly shifted right, in parallel to the β_d axis.",
            say(shifted, "Every", "Not every") + " lumped boundary lies right of its counterpart.",
            judge(shifted),
        ),
        Statement(
            "The boundary frequencies of the second regions are only 15 % higher.",
            f"They are {percent(second.min())} to {percent(second.max())} higher.",
            judge(second.min() > 0.14, second.max() < 0.16),
            f"Unloaded and at rest it is {percent(excess)}, with finite elements that are "
            "converged.",
        ),
    )


def _widths(panel: Panel, group: str, factor_index: int) -> float:
    left, right = boundaries(panel, group, ("1B", "1F"))[:, factor_index]
    return float(right - left)


def read_figure_5(
    panels: Panels, rotor: ShaftDisk, static_factor: float, last_speed: float
) -> tuple[Statement, ...]:
    """Return the reading of Fig. 5, whose last panel is of the spin speed `last_speed`."""
    facts = []
    for panel in panels:
        timoshenko, euler = (boundaries(panel, group) for group in groups(panel))
        facts.append(right_of(euler, timoshenko))
    twin = replace(rotor, shear=0.0)
    scale = fundamental_frequency(lumped(rotor, 0.0))
    own = float(
        boundary_frequencies(lumped(twin, last_speed), static_factor * critical_load(0.0), 0.0)[0]
        / scale
    )
    first, shared = (float(boundaries(panels[-1], group)[0, 0]) for group in groups(panels[-1]))
    widths = [_widths(panel, "Timoshenko", 10) for panel in panels]
    euler_widths = [_widths(panel, "Euler–Bernoulli", 10) for panel in panels]
    wider = [a > b for a, b in zip(widths, euler_widths, strict=True)]
    edges = [boundaries(panel, "Timoshenko", ("1B", "1F"))[:, 10] for panel in panels]
    ordered = all(
        right_of(lines[1], lines[0]) and right_of(lines[3], lines[2])
        for lines in (boundaries(panel, "Timoshenko") for panel in panels)
    )
    outward = all(a[0] > b[0] and a[1] < b[1] for a, b in pairwise(edges))
    return (
        Statement(
            "The Euler–Bernoulli regions are shifted away from the β_d axis.",
            f"{sum(facts)} of {len(facts)} panels: every Euler–Bernoulli boundary lies right.",
            judge(*facts),
            "With the Timoshenko shaft's p̄_cr for both. With its own p̄_cr the left boundary "
            f"at Ω̄ = {last_speed:g}, β_d = 0 would be {own:.4f}, "
            f"{say(own < first, 'left', 'not left')} of Timoshenko's {first:.4f} "
            f"(drawn: {shared:.4f}).",
        ),
        Statement(
            "Shear deformation is destabilising.",
            say(all(facts), "It moves", "It does not always move")
            + " the regions to lower frequency. Width of the first at the middle β_d, "
            f"with shear {', '.join(f'{w:.3f}' for w in widths)}, without "
            f"{', '.join(f'{w:.3f}' for w in euler_widths)}.",
            judge(all(facts), all(wider)),
            f"Of the position; the region is wider with shear in {sum(wider)} of {len(wider)} "
            "panels.",
        ),
        Statement(
            "With the rotational speed the boundaries move outward and the widths increase "
            "drastically.",
            "Width of the first region at the middle β_d: "
            f"{', '.join(f'{w:.3f}' for w in widths)}.",
            judge(outward, all(a < b for a, b in pairwise(widths))),
            "The width of a spinning rotor's region stays finite at β_d = 0, where the rotor "
            "is plainly stable: a Bolotin region, not instability.",
        ),
        Statement(
            "The left boundary is made by the backward, the right by the forward mode.",
            say(ordered, "True", "Not true") + " of 1B, 1F and of 2B, 2F in every panel.",
            judge(ordered),
            "At rest both boundaries come from one mode and there is no distinction.",
        ),
    )


def read_figure_6(panels: Panels) -> tuple[Statement, ...]:
    """Return the reading of Fig. 6."""
    facts, numbers = [], []
    for panel in panels:
        lines = [boundaries(panel, group) for group in groups(panel)]
        facts.append(all(right_of(a, b) for a, b in pairwise(lines)))
        steps = " → ".join(f"{one[0, 0]:.3f}…{one[1, 0]:.3f}" for one in lines)
        numbers.append(f"{panel.title}: {steps}")
    return (
        Statement(
            "With a higher α_s the regions shift left, nearer to the β_d axis.",
            f"Every boundary moves left at every β_d in {sum(facts)} of {len(facts)} panels. "
            f"First region at β_d = 0, {'; '.join(numbers)}.",
            judge(*facts),
        ),
    )


def read_figure_7(panels: Panels) -> tuple[Statement, ...]:
    """Return the reading of Fig. 7."""
    statements = []
    for panel in panels:
        lines = [boundaries(panel, group, ("1B", "1F")) for group in groups(panel)]
        pairs = list(pairwise(lines))
        right_edges = [right_of(b[1], a[1]) for a, b in pairs]
        left_edges = [right_of(b[0], a[0]) for a, b in pairs]
        steps = " → ".join(f"{one[0, 0]:.4f}…{one[1, 0]:.4f}" for one in lines)
        if np.isclose(lines[0][0, 0], lines[0][1, 0], atol=1e-6):
            statements.append(
                Statement(
                    f"{panel.title}: the first region shifts right with α_s.",
                    f"At β_d = 0: {steps}; at every β_d: "
                    f"{'yes' if all(left_edges + right_edges) else 'no'}.",
                    judge(all(left_edges), all(right_edges)),
                )
            )
            continue
        inward = [right_of(a[1], b[1]) for a, b in pairs]
        widths = [one[1] - one[0] for one in lines]
        narrower = all(right_of(a, b) for a, b in pairwise(widths))
        change = float(widths[-1][0] / widths[0][0] - 1)
        statements.append(
            Statement(
                f"{panel.title}: the first region shifts inward and narrows slightly with α_s.",
                f"At β_d = 0: {steps}; width {percent(change)}.",
                judge(all(left_edges), all(inward), narrower),
                ""
                if all(inward)
                else "Its left boundary moves inward, its right one a little outward: here 1F "
                "rises with the follower load.",
            )
        )
    return tuple(statements)


def read_figure_9(panels: Panels) -> tuple[Statement, ...]:
    """Return the reading of Fig. 9."""
    facts, wider = [], []
    for panel in panels:
        axial, follower = (boundaries(panel, group, ("1B", "1F")) for group in groups(panel))
        facts.append(right_of(follower, axial))
        wider.append(right_of(axial[1] - axial[0], follower[1] - follower[0]))
    return (
        Statement(
            "The first region of the follower force lies right of the axial one's.",
            f"Both boundaries, at every β_d, in {sum(facts)} of {len(facts)} panels.",
            judge(*facts),
        ),
        Statement(
            "A periodic axial load makes the system more unstable than a follower load.",
            "The axial load's first region lies at lower frequency and is at least as wide in "
            f"{sum(a and b for a, b in zip(facts, wider, strict=True))} of {len(facts)} panels.",
            judge(all(facts), all(wider)),
            "Of Bolotin's first region. Under a follower load Floquet also finds tongues of "
            "two modes of the same direction, which no Bolotin region shows.",
        ),
    )
