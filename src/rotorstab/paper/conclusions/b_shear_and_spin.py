"""Conclusion (b): shear and the gyroscopic moment are destabilising."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..._tolerances import NO_WIDTH
from ...charts.figure import Statement
from ...model.lumped import lumped
from ...rotors.shaft_disk import BASE_CASE, EULER_BERNOULLI_TWIN
from ...whirl.critical_loads import critical_load
from ...whirl.frequencies import whirl_frequencies
from ..arguments import SPINS
from ..figure_5_shear import figure_5
from ..floquet_numbers import PRINCIPAL, growth, place, tongues
from ..verdicts import boundaries, confirm, judge, listed, percent, right_of, say
from .cases import AT, base_variant, exact_width, first_widths, peak_growths, unstable_share

__all__ = ["conclusion_b", "confirmation_b"]


def conclusion_b() -> Statement:
    """Judge (b) on Bolotin's regions: shear and the gyroscopic moment are destabilising."""
    figure = figure_5()
    lower = [
        right_of(boundaries(panel, "Euler–Bernoulli"), boundaries(panel, "Timoshenko"))
        for panel in figure.panels
    ]
    widths = first_widths(figure, "Timoshenko", 10)
    at_zero = first_widths(figure, "Timoshenko", 0)
    buckling = float(critical_load(BASE_CASE.shear))
    whirl = whirl_frequencies(lumped(BASE_CASE, 2.0), 0.5 * buckling)
    growth = peak_growths(0.0, "1B+1F")
    stable = bool(np.abs(whirl.imag).max() == 0)
    return Statement(
        "(b) Shear deformation and the gyroscopic moment are both destabilising.",
        f"Shear lowers every boundary in {sum(lower)} of {len(lower)} panels. At Ω̄ = 0, 1, 2 "
        f"the first region's width is {listed(widths)} at β_d = 0.5, and {listed(at_zero)} at "
        f"β_d = 0, where every whirl frequency is {say(stable, 'real: stable', 'complex')}. The "
        f"true tongue of 1B and 1F grows at {listed(growth)} times β_d.",
        judge(
            *lower,
            widths[0] < widths[1] < widths[2],
            at_zero[2] < NO_WIDTH,
            growth[0] < growth[1] < growth[2],
        ),
        "True of the position and width of Bolotin's regions. The gyroscopic widening is no loss "
        "of stability: the region keeps its width where nothing pulsates, while the true tongue "
        "becomes weaker and narrower with the speed.",
    )


def confirmation_b() -> Statement:
    """Judge (b) by Floquet: growth, width and area with and without shear, and over spin speed."""
    with_shear = [base_variant(spin) for spin in SPINS]
    without = [base_variant(spin, rotor=EULER_BERNOULLI_TWIN) for spin in SPINS]
    rates, stiff = ([growth(variant) for variant in row] for row in (with_shear, without))
    lower = [
        all(place(a, name) < place(b, name) for name in tongues(a).keys() & tongues(b).keys())
        for a, b in zip(with_shear, without, strict=True)
    ]
    widths = [exact_width(spin, 0.0, 0.5, PRINCIPAL, 0.1) for spin in SPINS]
    shares = [unstable_share(spin, 0.0) for spin in SPINS]
    return Statement(
        "(b) Shear deformation and the gyroscopic moment are both destabilising.",
        f"{AT} the true tongue {PRINCIPAL} grows at {listed(rates)} times β_d with and "
        f"{listed(stiff)} without shear; with shear every tongue roots lower in {sum(lower)} of "
        f"{len(lower)}. Its width at β_d = 0.1 is {listed(widths, 4)}; of the window to θ/ω_n = 8, "
        f"β_d = 1, {', '.join(map(percent, shares))} is unstable.",
        confirm(
            all(lower) and all(a > b for a, b in zip(rates, stiff, strict=True)),
            all(a < b for a, b in pairwise(rates)),
            all(a < b for a, b in pairwise(widths)),
            all(a < b for a, b in pairwise(shares)),
        ),
        "Shear: upheld. Gyroscopic moment: not upheld; it weakens and narrows the principal "
        "tongue, while Bolotin's region widens.",
    )
