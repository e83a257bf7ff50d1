"""Effect of the static load factor: what Figs 6 and 7 have in common."""

from __future__ import annotations

from collections.abc import Sequence

from ..charts.figure import Figure
from ..model.lumped import lumped
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.critical_loads import critical_load
from .arguments import lettered, parameters, resting_frequency, styled
from .floquet_numbers import Variants
from .region_figure import RegionPanel, Variant, region_figure

__all__ = ["static_factor_figure"]


def static_factor_figure(
    number: int,
    tangency: float,
    rotor: ShaftDisk,
    spin_speeds: Sequence[float],
    static_factors: Sequence[float],
    largest_factor: float,
    floquet: bool,
) -> tuple[Figure, Variants]:
    """Return Fig. 6 or 7 without its reading, and the variants of every panel."""
    reference = float(critical_load(rotor.shear))
    frequency = resting_frequency(rotor)
    drawn = []
    for letter, spin in lettered("spin_speeds", spin_speeds):
        system = lumped(rotor, spin, tangency)
        variants = [
            Variant(f"α_s = {factor:g}", style, system, factor, reference)
            for style, factor in styled("static_factors", static_factors)
        ]
        drawn.append(RegionPanel(letter, f"Ω̄ = {spin:g}", variants))
    kind = "follower" if tangency else "axial"
    lines = "; ".join(
        f"{style.replace('dashdot', 'dash-dot')}: α_s = {factor:g}"
        for style, factor in styled("static_factors", static_factors)
    )
    figure = Figure(
        number=number,
        title=f"Effect of the static load factor, {kind} load",
        caption=f"{lines[0].upper()}{lines[1:]}.",
        parameters=parameters(
            rotor,
            tangency=tangency,
            static_load_factors=list(static_factors),
            spin_speeds=list(spin_speeds),
            reference_load=reference,
            fundamental_frequency=frequency,
        ),
        panels=(),
    )
    figure = region_figure(figure, drawn, frequency, largest_factor, floquet)
    return figure, [panel.variants for panel in drawn]
