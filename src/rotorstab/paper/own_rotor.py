"""Bolotin regions of any rotor, in the form of the paper's figures."""

from __future__ import annotations

from collections.abc import Sequence

from .._arguments import number
from ..charts.figure import Figure, Value
from ..model.system import System, fundamental_frequency
from ..whirl.critical_loads import critical_load
from .arguments import lettered, styled
from .region_figure import RegionPanel, Variant, region_figure

__all__ = ["own_regions"]


def own_regions(
    system: System,
    shear: float,
    spin_speeds: Sequence[float],
    static_factors: Sequence[float],
    largest_factor: float = 1.0,
    parameters: dict[str, Value] | None = None,
) -> Figure:
    """Return the Bolotin regions of a system as a figure that is not in the paper.

    Parameters
    ----------
    system : System
        Undamped; its own spin speed is not used.
    shear : float
        Φ, for the static buckling load that the load factors are measured by.
    spin_speeds : sequence of 1 to 26 floats
        Ω̄, a panel each.
    static_factors : sequence of 1 to 3 floats
        α_s, a line style each.
    largest_factor : float
        Top of the β_d axis, above 0.
    parameters : mapping, optional
        Plain values to carry along.

    Returns
    -------
    Figure
        Number 0, no reading.

    Raises
    ------
    ValueError
        If an argument is out of range or the system is damped.
    """
    speeds, lines = lettered("spin_speeds", spin_speeds), styled("static_factors", static_factors)
    number("largest_factor", largest_factor, 0.0, open_low=True)
    if system.is_damped:
        raise ValueError("`system` must be undamped for Bolotin regions, got a damped one")
    reference = float(critical_load(shear))
    room, peak = system.largest_load / reference, max(static_factors) + largest_factor
    if not system.in_charts(peak * reference):
        raise ValueError(
            f"`static_factors` + `largest_factor` must be below {room:g}, where the exact "
            f"stiffness has its pole, got {peak:g}"
        )
    frequency = fundamental_frequency(system)
    panels = []
    for letter, spin in speeds:
        variants = [
            Variant(f"α_s = {factor:g}", style, system.at_speed(spin), factor, reference)
            for style, factor in lines
        ]
        panels.append(RegionPanel(letter, f"Ω̄ = {spin:g}", variants))
    figure = Figure(
        number=0,
        title="Bolotin regions",
        caption="First two regions.",
        parameters={
            **(parameters or {}),
            "spin_speeds": list(spin_speeds),
            "static_load_factors": list(static_factors),
            "reference_load": reference,
            "fundamental_frequency": frequency,
        },
        panels=(),
    )
    return region_figure(figure, panels, frequency, largest_factor)
