"""Figure 5: Bolotin regions of a Timoshenko and an Euler–Bernoulli shaft, axial load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ..bolotin.boundaries import boundary_frequencies
from ..charts.figure import Figure, Statement
from ..charts.roles import Style
from ..charts.structure import Chart
from ..model.lumped import lumped
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.critical_loads import critical_load
from .arguments import SPINS, lettered, parameters, resting_frequency
from .floquet_numbers import (
    PRINCIPAL,
    Variants,
    growth,
    place,
    read_shading,
    separating,
    tongues,
    width,
)
from .region_figure import RegionPanel, Variant, region_figure
from .verdicts import boundaries, confirm, groups, judge, listed, right_of, say, titles

__all__ = ["figure_5"]

Panels = tuple[Chart, ...]

_TIMOSHENKO, _EULER = "Timoshenko", "Euler–Bernoulli"


def figure_5(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = SPINS,
    static_factor: float = 0.5,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 5: Timoshenko against Euler–Bernoulli shaft, axial load.

    Parameters
    ----------
    rotor : ShaftDisk
        The Timoshenko rotor.
    spin_speeds : sequence of up to 26 floats
        Ω̄, a panel each.
    static_factor : float
        α_s.
    largest_factor : float
        Top of the β_d axis.
    floquet : bool
        Whether to add what is unstable, and what of the text Floquet's method confirms.

    Returns
    -------
    Figure
        ω_n and the load factors' p̄_cr are the Timoshenko rotor's for both shafts. The text
        says so of ω_n only; with each shaft's own p̄_cr the left Euler–Bernoulli boundary
        of a spinning rotor would lie nearer to the β_d axis, against the text.
    """
    reference = float(critical_load(rotor.shear))
    frequency = resting_frequency(rotor)
    twin = replace(rotor, shear=0.0)
    shafts: tuple[tuple[str, Style, ShaftDisk], ...] = (
        (_TIMOSHENKO, "solid", rotor),
        (_EULER, "dashed", twin),
    )
    drawn = []
    for letter, spin in lettered("spin_speeds", spin_speeds):
        variants = [
            Variant(group, style, lumped(shaft, spin), static_factor, reference)
            for group, style, shaft in shafts
        ]
        drawn.append(RegionPanel(letter, f"Ω̄ = {spin:g}", variants))
    figure = Figure(
        number=5,
        title=f"Effect of shear deformation, axial load, α_s = {static_factor:g}",
        caption="Solid: Timoshenko beam theory. Dashed: Euler–Bernoulli beam theory.",
        parameters=parameters(
            rotor,
            tangency=0.0,
            static_load_factor=static_factor,
            spin_speeds=list(spin_speeds),
            reference_load=reference,
            fundamental_frequency=frequency,
        ),
        panels=(),
    )
    figure = region_figure(figure, drawn, frequency, largest_factor, floquet)
    reading = _read_text(figure.panels, rotor, static_factor, spin_speeds[-1])
    if floquet:
        reading += _read_floquet(figure.panels, [panel.variants for panel in drawn])
    return replace(figure, reading=reading)


def _read_text(
    panels: Panels, rotor: ShaftDisk, static_factor: float, last_speed: float
) -> tuple[Statement, ...]:
    """Compare what the text says with Bolotin's regions; the last panel has Ω̄ = `last_speed`."""
    return (
        *_read_shear(panels, _own_start(rotor, static_factor, last_speed), last_speed),
        *_read_spin(panels),
    )


def _own_start(rotor: ShaftDisk, static_factor: float, spin_speed: float) -> float:
    """Return θ/ω_n at which the left Euler–Bernoulli boundary starts with its own p̄_cr."""
    twin = lumped(replace(rotor, shear=0.0), spin_speed)
    start = boundary_frequencies(twin, static_factor * critical_load(0.0), 0.0)[0]
    return float(start / resting_frequency(rotor))


def _middle_widths(panels: Panels, group: str) -> list[float]:
    """Return the width of the first region at the middle β_d."""
    edges = [boundaries(panel, group, ("1B", "1F"))[:, 10] for panel in panels]
    return [float(right - left) for left, right in edges]


def _read_shear(panels: Panels, own: float, last_speed: float) -> tuple[Statement, ...]:
    facts = []
    for panel in panels:
        timoshenko, euler = (boundaries(panel, group) for group in groups(panel))
        facts.append(right_of(euler, timoshenko))
    first, shared = (float(boundaries(panels[-1], group)[0, 0]) for group in groups(panels[-1]))
    widths, euler_widths = (_middle_widths(panels, group) for group in (_TIMOSHENKO, _EULER))
    wider = [a > b for a, b in zip(widths, euler_widths, strict=True)]
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
            f"with shear {listed(widths)}, without {listed(euler_widths)}.",
            judge(all(facts), all(wider)),
            f"Of the position; the region is wider with shear in {sum(wider)} of {len(wider)} "
            "panels.",
        ),
    )


def _read_spin(panels: Panels) -> tuple[Statement, ...]:
    widths = _middle_widths(panels, _TIMOSHENKO)
    edges = [boundaries(panel, _TIMOSHENKO, ("1B", "1F"))[:, 10] for panel in panels]
    ordered = all(
        right_of(lines[1], lines[0]) and right_of(lines[3], lines[2])
        for lines in (boundaries(panel, _TIMOSHENKO) for panel in panels)
    )
    outward = all(a[0] > b[0] and a[1] < b[1] for a, b in pairwise(edges))
    return (
        Statement(
            "With the rotational speed the boundaries move outward and the widths increase "
            "drastically.",
            f"Width of the first region at the middle β_d: {listed(widths)}.",
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
        confirm(*(n == m for n, m, spins in zip(counts, of, spinning, strict=True) if spins)),
        "At rest the two modes have one frequency. Once the rotor spins, a tongue begins at "
        "β_d = 0 at the sum of both frequencies, and both of its edges belong to the pair.",
    )


def _read_floquet(panels: Panels, drawn: Variants) -> tuple[Statement, ...]:
    """Compare what the text says with what Floquet finds unstable."""
    lower, faster = [], []
    for soft, stiff in drawn:
        common = tongues(soft).keys() & tongues(stiff).keys()
        lower.append(all(place(soft, name) < place(stiff, name) for name in common))
        faster.append(growth(soft) > growth(stiff))
    with_shear, without = ([growth(pair[k]) for pair in drawn] for k in (0, 1))
    group = groups(panels[0])[0]
    widths = [width(panel, group, 0.5) for panel in panels]
    return (
        read_shading(panels),
        Statement(
            "Neglecting shear deformation is not on the side of safety; shear is destabilising.",
            f"Every tongue begins at a lower θ with shear in {sum(lower)} of {len(lower)} "
            f"panels. {PRINCIPAL} grows at {listed(with_shear)} times β_d with, at "
            f"{listed(without)} without shear ({titles(panels)}).",
            confirm(*lower, *faster),
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
            f"{listed(with_shear)} times β_d ({titles(panels)}).",
            confirm(
                all(a < b for a, b in pairwise(widths)),
                all(a < b for a, b in pairwise(with_shear)),
            ),
            "It becomes narrower and weaker, while Bolotin's region widens. The tongue 2B+1F does "
            "gain: " + listed([growth(one[0], "2B+1F") for one in drawn]) + ".",
        ),
        _read_boundaries(panels, drawn),
    )
