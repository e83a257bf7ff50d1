"""Conclusion (a): each boundary belongs to a mode."""

from __future__ import annotations

import numpy as np

from ...charts.figure import Statement
from ...model.lumped import lumped
from ...rotors.shaft_disk import BASE_CASE
from ...whirl.critical_loads import critical_load
from ...whirl.frequencies import whirl_frequencies
from ..arguments import FACTORS, SPINS
from ..floquet_numbers import PRINCIPAL, root, separating
from ..verdicts import confirm, judge
from .cases import base_variant, exact_width

__all__ = ["conclusion_a", "confirmation_a"]


def conclusion_a() -> Statement:
    """Judge (a) on Bolotin's regions: each one lies between the two modes of one number."""
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


def confirmation_a() -> Statement:
    """Judge (a) by Floquet: whether Bolotin's boundaries separate stable from unstable."""
    cases = [(spin, mu, factor) for spin in SPINS for mu in (0.0, 1.0) for factor in FACTORS]
    counts = {case: separating(base_variant(*case)) for case in cases}
    rest = [n for (spin, _, _), n in counts.items() if spin == 0]
    spinning = [n for (spin, _, _), n in counts.items() if spin != 0]
    return Statement(
        "(a) The left boundary of each region is made by the backward, the right one by the "
        "forward mode.",
        f"Bolotin's boundaries with one stable and one unstable side at β_d = 0.1: {sum(rest)} of "
        f"{4 * len(rest)} at rest, {sum(spinning)} of {4 * len(spinning)} of the spinning cases "
        f"of Figs 6 and 7. At Ω̄ = 1, α_s = 0.5 under axial load the true tongue {PRINCIPAL} has "
        f"the one root θ/ω_n = {root(base_variant(1.0)):.4f}, the sum of both frequencies, and is "
        f"{exact_width(1.0, 0.0, 0.5, PRINCIPAL, 0.1):.4f} wide at β_d = 0.1.",
        confirm(4 * len(spinning) == sum(spinning)),
        "Both edges of a true tongue belong to the pair. At 2|ω| of one whirl a multiplier passes "
        "through −1 and stays on the unit circle.",
    )
