"""Figure 9: Bolotin regions under an axial and under a follower load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..charts.figure import Figure, Statement
from ..charts.structure import Chart
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.critical_loads import critical_load
from .arguments import LOAD_KINDS, SPINS, lettered, parameters, resting_frequency
from .floquet_numbers import Variants, area, place, read_shading, strongest, tongues
from .region_figure import RegionPanel, Variant, region_figure
from .verdicts import boundaries, confirm, groups, judge, percent, right_of

__all__ = ["figure_9"]

Panels = tuple[Chart, ...]


def figure_9(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = SPINS,
    static_factor: float = 0.5,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 9: axial against follower load at one static load factor.

    Parameters
    ----------
    rotor : ShaftDisk
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
    """
    reference = float(critical_load(rotor.shear))
    frequency = resting_frequency(rotor)
    drawn = []
    for letter, spin in lettered("spin_speeds", spin_speeds):
        variants = [
            Variant(group, style, lumped(rotor, spin, tangency), static_factor, reference)
            for group, style, tangency in LOAD_KINDS
        ]
        drawn.append(RegionPanel(letter, f"Ω̄ = {spin:g}", variants))
    figure = Figure(
        number=9,
        title=f"Effect of the loading type, α_s = {static_factor:g}",
        caption="Solid: axial force. Dashed: follower force.",
        parameters=parameters(
            rotor,
            static_load_factor=static_factor,
            spin_speeds=list(spin_speeds),
            reference_load=reference,
            fundamental_frequency=frequency,
        ),
        panels=(),
    )
    figure = region_figure(figure, drawn, frequency, largest_factor, floquet)
    reading = _read_text(figure.panels)
    if floquet:
        reading += _read_floquet(figure.panels, [panel.variants for panel in drawn])
    return replace(figure, reading=reading)


def _read_text(panels: Panels) -> tuple[Statement, ...]:
    """Compare what the text says with Bolotin's regions."""
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


def _lowest(variant: Variant) -> str:
    """Return the tongue that begins at the lowest θ."""
    return min(tongues(variant).values(), key=lambda row: row.centre).name


def _read_floquet(panels: Panels, drawn: Variants) -> tuple[Statement, ...]:
    """Compare what the text says with what Floquet finds unstable."""
    lowest = [[place(variant, _lowest(variant)) for variant in pair] for pair in drawn]
    lower = [axial < follower for axial, follower in lowest]
    rates = [[strongest(variant) for variant in pair] for pair in drawn]
    stronger = [axial[1] > follower[1] for axial, follower in rates]
    shares = [[area(panel, group) for group in groups(panel)] for panel in panels]
    larger = [axial > follower for axial, follower in shares]
    scaled = [
        [
            value / fundamental_frequency(variant.system)
            for value, variant in zip(row, pair, strict=True)
        ]
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
            confirm(*lower),
            "They are not the same tongue: under the follower force the lowest is "
            + ", ".join(_lowest(variant) for _, variant in drawn)
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
            confirm(*stronger, *larger),
        ),
    )
