"""Cases of the base rotor that several conclusions compare, and their exact numbers."""

from __future__ import annotations

from functools import cache

from ...charts.figure import Figure
from ...floquet.resonance import resonances
from ...floquet.tongues.edges import tongue_edges
from ...model.lumped import lumped
from ...rotors.shaft_disk import BASE_CASE, ShaftDisk
from ...whirl.critical_loads import critical_load
from ..arguments import resting_frequency
from ..floquet_numbers import area
from ..region_figure import RegionPanel, Variant, region_chart
from ..verdicts import boundaries

__all__ = [
    "AT",
    "base_variant",
    "exact_width",
    "first_widths",
    "peak_growths",
    "unstable_share",
]

AT = "At Ω̄ = 0, 1, 2"


def base_variant(
    spin: float, tangency: float = 0.0, factor: float = 0.5, rotor: ShaftDisk = BASE_CASE
) -> Variant:
    """Return a case of the figures; the loads are measured by the base case's p̄_cr."""
    reference = float(critical_load(BASE_CASE.shear))
    system = lumped(rotor, spin, tangency)
    return Variant("rotor", "solid", system, factor, reference)


@cache
def exact_width(spin: float, tangency: float, factor: float, name: str, load: float) -> float:
    """Return the exact width in θ/ω_n of a tongue at one β_d."""
    variant = base_variant(spin, tangency, factor)
    loads = [load * variant.reference_load]
    edges = tongue_edges(variant.system, variant.mean_load, loads, (name,))
    return float((edges.right - edges.left)[0, 0] / resting_frequency(BASE_CASE))


@cache
def unstable_share(spin: float, tangency: float, highest: float = 8.0) -> float:
    """Return the unstable share of θ/ω_n to `highest` and β_d to 1, at α_s = 0.5."""
    panel = RegionPanel("a", "", [base_variant(spin, tangency)])
    return area(region_chart(panel, resting_frequency(BASE_CASE), 1.0, True, highest), "rotor")


def first_widths(figure: Figure, group: str, index: int) -> list[float]:
    """Return the width of Bolotin's first region in every panel at one of 21 even β_d."""
    edges = [boundaries(panel, group, ("1B", "1F"))[:, index] for panel in figure.panels]
    return [float(right - left) for left, right in edges]


def peak_growths(tangency: float, name: str | None = None) -> list[float]:
    """Return the peak growth rate per β_d of one tongue, or the strongest, at Ω̄ = 0, 1, 2."""
    buckling = float(critical_load(BASE_CASE.shear))
    tables = [
        resonances(lumped(BASE_CASE, spin, tangency), 0.5 * buckling, buckling)
        for spin in (0.0, 1.0, 2.0)
    ]
    return [
        buckling * max(row.growth_per_load for row in table if name in (None, row.name))
        for table in tables
    ]
