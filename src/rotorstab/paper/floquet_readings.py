"""What of the text on Figs 4–9 survives Floquet: claims, numbers, verdicts.

Every number is computed from the systems drawn and from the arrays of the panels.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..charts.figure import Panel, Statement
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.critical_loads import critical_load
from .floquet_numbers import (
    PRINCIPAL,
    Variants,
    area,
    growth,
    place,
    read_shading,
    separating,
    strongest,
    tongues,
    width,
)
from .region_panels import Variant
from .verdicts import groups, listed, percent, uphold

__all__ = [
    "read_floquet_4",
    "read_floquet_5",
    "read_floquet_6",
    "read_floquet_7",
    "read_floquet_8",
    "read_floquet_9",
]

Panels = tuple[Panel, ...]
Reading = tuple[Statement, ...]


def _percents(values: list[float]) -> str:
    return ", ".join(f"{100 * value:.1f}" for value in values)


def _titles(panels: Panels) -> str:
    return ", ".join(panel.title for panel in panels)


def read_floquet_4(panels: Panels, drawn: Variants) -> Reading:
    """Return what survives of Fig. 4."""
    first = [place(one) / place(other) - 1 for one, other in drawn]
    second = [place(one, "2B+2F") / place(other, "2B+2F") - 1 for one, other in drawn]
    widths = [[width(panel, group, 0.5) for group in groups(panel)] for panel in panels]
    ratio = [a / b - 1 for a, b in widths]
    return (
        read_shading(panels),
        Statement(
            "The agreement of the first unstable regions is good; the lumped ones lie slightly "
            "to the right.",
            f"The true tongue {PRINCIPAL} of the lumped model lies {_percents(first)} "
            f"% above the finite-element one ({_titles(panels)}); at β_d = 0.5 it is "
            + "; ".join(f"{a:.3f} against {b:.3f} wide" for a, b in widths)
            + ".",
            uphold(all(0 < x < 0.1 for x in first), all(abs(x) < 0.15 for x in ratio)),
        ),
        Statement(
            "The second regions' boundary frequencies are only 15 % higher.",
            f"The true tongue 2B+2F lies {_percents(second)} % higher.",
            uphold(all(0.12 < x < 0.18 for x in second)),
            "Between the two lie the tongues of 1 with 2, which the paper's method does not seek: "
            + ", ".join(name for name in tongues(drawn[-1][0]) if name[0] != name[3])
            + ".",
        ),
    )


def read_floquet_5(panels: Panels, drawn: Variants) -> Reading:
    """Return what survives of Fig. 5."""
    lower, faster = [], []
    for soft, stiff in drawn:
        common = tongues(soft).keys() & tongues(stiff).keys()
        lower.append(all(place(soft, name) < place(stiff, name) for name in common))
        faster.append(growth(soft) > growth(stiff))
    with_shear, without = ([growth(one[k]) for one in drawn] for k in (0, 1))
    group = groups(panels[0])[0]
    widths = [width(panel, group, 0.5) for panel in panels]
    return (
        read_shading(panels),
        Statement(
            "Neglecting shear deformation is not on the side of safety; shear is destabilising.",
            f"Every true tongue roots at a lower θ with shear in {sum(lower)} of {len(lower)} "
            f"panels. {PRINCIPAL} grows at {listed(with_shear)} times β_d with, at "
            f"{listed(without)} without shear ({_titles(panels)}).",
            uphold(*lower, *faster),
            "Of position and of the strongest tongue. 2B+2F is weaker with shear: "
            + ", ".join(
                f"{growth(soft, '2B+2F'):.3f} against {growth(stiff, '2B+2F'):.3f}"
                for soft, stiff in drawn
            )
            + ".",
        ),
        Statement(
            "As the rotational speed increases the widths of the unstable regions increase "
            "drastically: the gyroscopic moment is destabilising.",
            f"The true tongue {PRINCIPAL} is {listed(widths)} wide at β_d = 0.5 and grows at "
            f"{listed(with_shear)} times β_d ({_titles(panels)}).",
            uphold(
                all(a < b for a, b in pairwise(widths)),
                all(a < b for a, b in pairwise(with_shear)),
            ),
            "It becomes narrower and weaker, while Bolotin's region widens. The tongue 2B+1F does "
            "gain: " + listed([growth(one[0], "2B+1F") for one in drawn]) + ".",
        ),
        _read_boundaries(panels, drawn),
    )


def _read_boundaries(panels: Panels, drawn: Variants) -> Statement:
    """Return whether Bolotin's boundaries separate stable from unstable."""
    counts = [sum(separating(variant) for variant in variants) for variants in drawn]
    of = [4 * len(variants) for variants in drawn]
    spinning = [float(variants[0].system.spin_speed) != 0 for variants in drawn]
    return Statement(
        "The left unstable boundary is constructed by the backward, the right one by the "
        "forward mode.",
        "Boundaries with one stable and one unstable side at β_d = 0.1: "
        + "; ".join(
            f"{panel.title}: {n} of {m}" for panel, n, m in zip(panels, counts, of, strict=True)
        )
        + ".",
        uphold(*(n == m for n, m, spins in zip(counts, of, spinning, strict=True) if spins)),
        "At rest the two modes have one frequency. Once the rotor spins, a tongue hangs from the "
        "sum of both frequencies and both of its edges belong to the pair.",
    )


def _growths(drawn: Variants, name: str = PRINCIPAL) -> list[list[float]]:
    return [[growth(variant, name) for variant in variants] for variants in drawn]


def _by_panel(panels: Panels, rows: list[list[float]], decimals: int = 3) -> str:
    return "; ".join(
        f"{panel.title}: {' → '.join(f'{x:.{decimals}f}' for x in row)}"
        for panel, row in zip(panels, rows, strict=True)
    )


def read_floquet_6(panels: Panels, drawn: Variants) -> Reading:
    """Return what survives of Fig. 6."""
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
            uphold(*falls),
            "Each root is a sum of two whirl frequencies, and all of these fall with the load.",
        ),
        Statement(
            "With a higher α_s the system is more unstable.",
            f"{PRINCIPAL} grows at, times β_d, {_by_panel(panels, rates)}. Unstable share of the "
            f"window: {_by_panel(panels, shares)}.",
            uphold(rise, more),
            "The paper's reason is the lower frequency; the stronger growth is one.",
        ),
    )


def read_floquet_7(panels: Panels, drawn: Variants) -> Reading:
    """Return what survives of Fig. 7."""
    statements = [read_shading(panels)]
    for panel, variants in zip(panels, drawn, strict=True):
        rates = [growth(variant) for variant in variants]
        roots = [place(variant) / _scale(variant) for variant in variants]
        best = [strongest(variant) for variant in variants]
        words = f"{PRINCIPAL} grows at {listed(rates)} times β_d"
        exists = all(rate > 0 for rate in rates)
        if exists:
            words += f" and roots at θ/ω_n = {listed(roots)}"
        words += "; strongest: " + ", ".join(f"{name} {rate:.3f}" for name, rate in best) + "."
        if float(variants[0].system.spin_speed) == 0:
            right = exists and all(a < b for a, b in pairwise(roots))
            beside = next((n for n in tongues(variants[0]) if n[0] != n[3]), "")
            moves = [place(variant, beside) / _scale(variant) for variant in variants]
            statement = Statement(
                f"{panel.title}: the first unstable region shifts right with α_s.",
                words,
                uphold(right),
                f"Beside it {beside} hangs from θ/ω_n = {listed(moves)} and grows at "
                f"{listed([growth(variant, beside) for variant in variants])} times β_d: two "
                "different modes, which the paper's method does not seek.",
            )
        else:
            name = best[0][0]
            moves = [place(variant, name) / _scale(variant) for variant in variants]
            widths = [width(panel, group, 0.1, name) for group in groups(panel)]
            inward = exists and all(a < b for a, b in pairwise(roots))
            narrower = exists and all(a > b for a, b in pairwise(rates))
            statement = Statement(
                f"{panel.title}: the first unstable region shifts inwardly and narrows slightly.",
                words,
                uphold(inward, narrower),
                f"What is unstable in Bolotin's first region at small β_d is {name}, two modes of "
                f"the same direction: it shifts left, θ/ω_n = {listed(moves)}, and is "
                f"{listed(widths)} wide at β_d = 0.1.",
            )
        statements.append(statement)
    return tuple(statements)


def _onset(panel: Panel, group: str) -> float:
    """Return the steady load that makes the rotor unstable by itself, inf if none does."""
    return min((float(one.x[0]) for one in panel.unstable if one.group == group), default=np.inf)


def _table(variant: Variant) -> str:
    """Write the pairs that make a tongue with their places and growth."""
    scale = _scale(variant)
    return ", ".join(
        f"{name} {row.centre / scale:.3f} ({row.growth_per_load * variant.reference_load:.3f})"
        for name, row in tongues(variant).items()
    )


def read_floquet_8(
    panels: Panels, rotor: ShaftDisk, spin_speeds: Sequence[float]
) -> tuple[Statement, ...]:
    """Return what survives of Fig. 8."""
    reference = float(critical_load(rotor.shear))
    kinds = ("axial force", "follower force")

    def variant(spin: float, tangency: float, factor: float) -> Variant:
        system = lumped(rotor, spin, tangency)
        return Variant(kinds[tangency > 0], "solid", system, factor, reference)

    pairs = list(zip(panels, spin_speeds, strict=True))
    axial = [[variant(spin, 0.0, factor) for factor in (0.0, 0.5)] for spin in spin_speeds]
    follower = [variant(spin, 1.0, 0.5) for spin in spin_speeds]
    roots = [[place(one) / _scale(one) for one in row] for row in axial]
    spinning = [one for one in follower if float(one.system.spin_speed) != 0]
    onsets = [[_onset(panel, kind) for kind in kinds] for panel in panels]
    return (
        Statement(
            "The whirl speeds fall with the axial load; this is the reason why the first unstable "
            "regions shift left.",
            f"The tongue {PRINCIPAL} hangs from the sum of both: θ/ω_n from p̄ = 0 to 0.5 p̄_cr "
            f"{_by_panel(panels, roots)}. All tongues at 0.5 p̄_cr, θ/ω_n and growth over β_d: "
            + "; ".join(
                f"{panel.title}: {_table(row[1])}" for panel, row in zip(panels, axial, strict=True)
            )
            + ".",
            uphold(*(row[1] < row[0] for row in roots)),
            "Sums of opposite whirls only: an axial pulsation makes no two of one direction grow.",
        ),
        Statement(
            "The characteristics of the first unstable regions under the follower load can be "
            "expected from 1F and 1B.",
            f"Spinning, 1F and 1B grow together at {listed([growth(one) for one in spinning])} "
            "times β_d. All tongues at 0.5 p̄_cr, θ/ω_n and growth over β_d: "
            + "; ".join(
                f"{panel.title}: {_table(one)}" for panel, one in zip(panels, follower, strict=True)
            )
            + ".",
            uphold(*(growth(one) > 0 for one in spinning)),
            "What lies in the first regions is 1B with 2B, a difference of two speeds.",
        ),
        Statement(
            "The loads are measured by the static buckling load of the non-rotating shaft.",
            "The steady load alone makes the rotor unstable, axial and follower, from "
            + "; ".join(
                f"{panel.title}: p̄ = {a:.4f}, {b:.4f}"
                for (panel, _), (a, b) in zip(pairs, onsets, strict=True)
            )
            + f"; p̄_cr = {reference:.4f}.",
            uphold(*(abs(row[0] / reference - 1) < 0.02 for row in onsets)),
            "Spinning, the gyroscopic moment holds the buckled shaft until 1B, then a forward "
            "whirl, meets 1F; any external damping takes this away. Under the follower force the "
            "spin brings flutter nearer.",
        ),
    )


def _lowest(variant: Variant) -> str:
    """Return the tongue that hangs from the lowest θ."""
    return min(tongues(variant).values(), key=lambda row: row.centre).name


def read_floquet_9(panels: Panels, drawn: Variants) -> Reading:
    """Return what survives of Fig. 9."""
    lowest = [[place(one, _lowest(one)) for one in pair] for pair in drawn]
    lower = [axial < follower for axial, follower in lowest]
    rates = [[strongest(one) for one in pair] for pair in drawn]
    stronger = [axial[1] > follower[1] for axial, follower in rates]
    shares = [[area(panel, group) for group in groups(panel)] for panel in panels]
    larger = [axial > follower for axial, follower in shares]
    scaled = [
        [value / _scale(one) for value, one in zip(row, pair, strict=True)]
        for row, pair in zip(lowest, drawn, strict=True)
    ]
    return (
        read_shading(panels),
        Statement(
            "The first unstable region of the follower force lies right of the axial one's.",
            "Root θ/ω_n of the lowest true tongue, axial and follower: "
            + "; ".join(
                f"{panel.title}: {a:.3f}, {b:.3f}"
                for panel, (a, b) in zip(panels, scaled, strict=True)
            )
            + ".",
            uphold(*lower),
            "They are not the same tongue: under the follower force the lowest is "
            + ", ".join(_lowest(one) for _, one in drawn)
            + f" ({', '.join(panel.title for panel in panels)}).",
        ),
        Statement(
            "A periodic axial loading makes the system more unstable than a follower force.",
            "Strongest tongue, growth over β_d, axial and follower: "
            + "; ".join(
                f"{panel.title}: {a[0]} {a[1]:.3f}, {b[0]} {b[1]:.3f}"
                for panel, (a, b) in zip(panels, rates, strict=True)
            )
            + ". Unstable share of the window: "
            + "; ".join(
                f"{panel.title}: {percent(a)}, {percent(b)}"
                for panel, (a, b) in zip(panels, shares, strict=True)
            )
            + ".",
            uphold(*stronger, *larger),
        ),
    )


def _scale(variant: Variant) -> float:
    """Return ω_n of a variant's own system."""
    return fundamental_frequency(variant.system)
