"""The paper's five conclusions under Floquet: which are upheld, and by what numbers.

`conclusions` judges them as statements about Bolotin's regions; here "unstable" means a growing
motion. Peak growth is per β_d, widths and places are in θ/ω_n, all of the base case.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import pairwise

from ..charts.figure import Statement
from ..floquet.tongues.edges import tongue_edges
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import BASE_CASE, EULER_BERNOULLI_TWIN, ShaftDisk
from ..whirl.critical_loads import critical_load
from .arguments import FACTORS, SPINS
from .floquet_numbers import PRINCIPAL, area, growth, place, root, separating, strongest, tongues
from .region_figure import RegionPanel, Variant, region_chart
from .verdicts import listed, percent, uphold

__all__ = [
    "FLOQUET_CONCLUSIONS",
    "survival_a",
    "survival_b",
    "survival_c",
    "survival_d",
    "survival_e",
]

_AT = "At Ω̄ = 0, 1, 2"


def _variant(
    spin: float, tangency: float = 0.0, factor: float = 0.5, rotor: ShaftDisk = BASE_CASE
) -> Variant:
    """Return a case of the figures; the loads are measured by the base case's p̄_cr."""
    reference = float(critical_load(BASE_CASE.shear))
    system = lumped(rotor, spin, tangency)
    return Variant("rotor", "solid", system, factor, reference)


def _frequency() -> float:
    return fundamental_frequency(lumped(BASE_CASE, 0.0))


@cache
def _exact_width(spin: float, tangency: float, factor: float, name: str, load: float) -> float:
    """Return the exact width in θ/ω_n of a tongue at one β_d."""
    variant = _variant(spin, tangency, factor)
    loads = [load * variant.reference_load]
    edges = tongue_edges(variant.system, variant.mean_load, loads, (name,))
    return float((edges.right - edges.left)[0, 0] / _frequency())


@cache
def _unstable_share(spin: float, tangency: float, highest: float = 8.0) -> float:
    """Return the unstable share of θ/ω_n to `highest` and β_d to 1, at α_s = 0.5."""
    panel = RegionPanel("a", "", [_variant(spin, tangency)])
    return area(region_chart(panel, _frequency(), 1.0, True, highest), "rotor")


def survival_a() -> Statement:
    """Return (a): whether Bolotin's boundaries bound anything."""
    cases = [(spin, mu, factor) for spin in SPINS for mu in (0.0, 1.0) for factor in FACTORS]
    counts = {case: separating(_variant(*case)) for case in cases}
    rest = [n for (spin, _, _), n in counts.items() if spin == 0]
    spinning = [n for (spin, _, _), n in counts.items() if spin != 0]
    return Statement(
        "(a) The left boundary of each region is made by the backward, the right one by the "
        "forward mode.",
        f"Bolotin's boundaries with one stable and one unstable side at β_d = 0.1: {sum(rest)} of "
        f"{4 * len(rest)} at rest, {sum(spinning)} of {4 * len(spinning)} of the spinning cases "
        f"of Figs 6 and 7. At Ω̄ = 1, α_s = 0.5 under axial load the true tongue {PRINCIPAL} has "
        f"the one root θ/ω_n = {root(_variant(1.0)):.4f}, the sum of both frequencies, and is "
        f"{_exact_width(1.0, 0.0, 0.5, PRINCIPAL, 0.1):.4f} wide at β_d = 0.1.",
        uphold(4 * len(spinning) == sum(spinning)),
        "Both edges of a true tongue belong to the pair. At 2|ω| of one whirl a multiplier passes "
        "through −1 and stays on the unit circle.",
    )


def survival_b() -> Statement:
    """Return (b): shear and the gyroscopic moment, one by one."""
    with_shear = [_variant(spin) for spin in SPINS]
    without = [_variant(spin, rotor=EULER_BERNOULLI_TWIN) for spin in SPINS]
    rates, stiff = ([growth(one) for one in row] for row in (with_shear, without))
    lower = [
        all(place(a, name) < place(b, name) for name in tongues(a).keys() & tongues(b).keys())
        for a, b in zip(with_shear, without, strict=True)
    ]
    widths = [_exact_width(spin, 0.0, 0.5, PRINCIPAL, 0.1) for spin in SPINS]
    shares = [_unstable_share(spin, 0.0) for spin in SPINS]
    return Statement(
        "(b) Shear deformation and the gyroscopic moment are both destabilising.",
        f"{_AT} the true tongue {PRINCIPAL} grows at {listed(rates)} times β_d with and "
        f"{listed(stiff)} without shear; with shear every tongue roots lower in {sum(lower)} of "
        f"{len(lower)}. Its width at β_d = 0.1 is {listed(widths, 4)}; of the window to θ/ω_n = 8, "
        f"β_d = 1, {', '.join(map(percent, shares))} is unstable.",
        uphold(
            all(lower) and all(a > b for a, b in zip(rates, stiff, strict=True)),
            all(a < b for a, b in pairwise(rates)),
            all(a < b for a, b in pairwise(widths)),
            all(a < b for a, b in pairwise(shares)),
        ),
        "Shear: upheld. Gyroscopic moment: not upheld; it weakens and narrows the principal "
        "tongue, while Bolotin's region widens.",
    )


def survival_c() -> Statement:
    """Return (c): the place of every tongue over the static load factor."""
    steps, moves = [], []
    for spin in SPINS:
        row = [_variant(spin, 0.0, factor) for factor in FACTORS]
        for before, after in pairwise(row):
            names = tongues(before).keys() & tongues(after).keys()
            steps += [place(after, name) < place(before, name) for name in names]
        moves.append([root(one) for one in row])
    rates = [[growth(_variant(spin, 0.0, factor)) for factor in FACTORS] for spin in SPINS]
    return Statement(
        "(c) With a higher static load factor parametric resonance occurs at lower axial "
        "disturbance frequency.",
        f"{sum(steps)} of {len(steps)} true tongues root lower after a step of α_s. {_AT} "
        f"{PRINCIPAL} goes from θ/ω_n {'; '.join(listed(row) for row in moves)} and grows at "
        f"{'; '.join(listed(row) for row in rates)} times β_d for α_s = 0, 0.2, 0.5.",
        uphold(*steps),
        "Upheld, and the growth rises too.",
    )


def survival_d() -> Statement:
    """Return (d): the principal tongue under a follower load."""
    spins = SPINS[1:]
    rows = [[_variant(spin, 1.0, factor) for factor in FACTORS] for spin in spins]
    rates = [[growth(one) for one in row] for row in rows]
    name = strongest(rows[0][0])[0]
    places = [[root(one, name) for one in row] for row in rows]
    widths = [[_exact_width(spin, 1.0, f, name, 0.1) for f in FACTORS] for spin in spins]
    exists = [all(rate > 0 for rate in row) for row in rates]
    narrower = [all(a > b for a, b in pairwise(row)) for row in widths]
    return Statement(
        "(d) With a higher static load factor the first region under a follower load moves "
        "inward and narrows slightly.",
        f"At Ω̄ = 1, 2 and α_s = 0, 0.2, 0.5 the pair {PRINCIPAL} grows at "
        f"{'; '.join(listed(row) for row in rates)} times β_d. What is unstable there is {name}, "
        f"rooted at θ/ω_n = {'; '.join(listed(row) for row in places)}, "
        f"{'; '.join(listed(row, 4) for row in widths)} wide at β_d = 0.1.",
        uphold(*exists, *narrower),
        "Bolotin's first region holds no principal tongue, save a weak one at Ω̄ = 1, α_s = 0.5. "
        f"The tongue {name} inside it joins two backward modes; it shifts left and widens.",
    )


def survival_e() -> Statement:
    """Return (e): axial against follower load, by growth, place and area."""
    pairs = [[_variant(spin, mu) for mu in (0.0, 1.0)] for spin in SPINS]
    rates = [[strongest(one)[1] for one in pair] for pair in pairs]
    shares = [[_unstable_share(spin, mu) for mu in (0.0, 1.0)] for spin in SPINS]
    lowest = [[min(root(one, name) for name in tongues(one)) for one in pair] for pair in pairs]

    def both(rows: list[list[float]]) -> str:
        return "; ".join(f"{a:.3f}, {b:.3f}" for a, b in rows)

    return Statement(
        "(e) The periodic axial load makes the rotor more unstable than the follower load at "
        "the same static load factor.",
        f"{_AT}, axial and follower, α_s = 0.5: strongest tongue {both(rates)} times β_d; lowest "
        f"root θ/ω_n {both(lowest)}; unstable share of the window to θ/ω_n = 8, β_d = 1, "
        f"{both(shares)}.",
        uphold(
            *(a > b for a, b in rates), *(a < b for a, b in lowest), *(a > b for a, b in shares)
        ),
        "By growth, place and area of what is unstable; under the follower load it is other pairs "
        "of modes that grow.",
    )


FLOQUET_CONCLUSIONS: dict[str, Callable[[], Statement]] = {
    "a": survival_a,
    "b": survival_b,
    "c": survival_c,
    "d": survival_d,
    "e": survival_e,
}
"""Each conclusion's function by its letter."""
