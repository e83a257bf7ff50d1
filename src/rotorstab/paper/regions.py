"""Figures 4, 5, 6, 7 and 9: Bolotin regions in the plane of θ/ω_n and β_d."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from ..charts.figure import LOAD_KINDS, Figure, Statement, lettered, parameters, styled
from ..charts.roles import Style
from ..model.finite_element import finite_element, first_modes
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import BASE_CASE, TABLE_1_SI, ShaftDisk
from ..whirl.critical_loads import critical_load
from .floquet_readings import (
    read_floquet_4,
    read_floquet_5,
    read_floquet_6,
    read_floquet_7,
    read_floquet_9,
)
from .region_panels import LOWEST, Variant, region_panel
from .region_readings import (
    read_figure_4,
    read_figure_5,
    read_figure_6,
    read_figure_7,
    read_figure_9,
)

__all__ = ["figure_4", "figure_5", "figure_6", "figure_7", "figure_9"]

_SPINS = (0.0, 1.0, 2.0)
_FACTORS = (0.0, 0.2, 0.5)
_FLOQUET = (
    " Pale and thin: Bolotin regions. Full: unstable by Floquet, tongues of first order named by "
    f"their mode pair, the others of order k at θ = |ω_i − ω_j|/k; sought from θ/ω_n = {LOWEST:g}."
)


def _with_floquet(figure: Figure, more: Sequence[Statement]) -> Figure:
    """Return a figure, its panels drawn with Floquet, with the words that belong to it."""
    return replace(
        figure,
        caption=figure.caption + _FLOQUET,
        parameters={**figure.parameters, "floquet_from": LOWEST},
        reading=(*figure.reading, *more),
    )


def figure_4(
    static_factor: float = 0.5,
    speeds_rpm: Sequence[float] = (0.0, 1000.0),
    elements: int = 20,
    modes: int = 6,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 4: the lumped model against finite elements, Table 1's rotor.

    Parameters
    ----------
    static_factor : float
        α_s.
    speeds_rpm : sequence of up to 26 floats
        Ω [rev/min], a panel each.
    elements, modes : int
        Of `finite_element`; 6 modes are within 1e-5 of all.
    largest_factor : float
        Top of the β_d axis.
    floquet : bool
        Whether to add what is unstable, and what of the text survives.

    Returns
    -------
    Figure
        ω_n is the lumped model's, as Table 1 has it, for both models.
    """
    rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
    reference = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    panels, drawn = [], []
    for letter, rpm in lettered("speeds_rpm", speeds_rpm):
        spin = rpm * 2 * math.pi / 60 / scales.frequency
        comparator = finite_element(rotor, spin, elements=elements, modes=modes)
        variants = [
            Variant("present", "solid", lumped(rotor, spin), static_factor, reference),
            Variant(
                "finite element",
                "dashed",
                comparator,
                static_factor,
                reference,
                first_modes(comparator, static_factor * reference) if floquet else None,
            ),
        ]
        title = f"Ω = {rpm:g} r.p.m."
        drawn.append(variants)
        panels.append(region_panel(letter, title, variants, frequency, largest_factor, floquet))
    figure = Figure(
        number=4,
        title=f"Bolotin regions by two models, α_s = {static_factor:g}",
        caption="Solid: present (lumped) model. Dashed: finite elements.",
        parameters=parameters(
            rotor,
            tangency=0.0,
            static_load_factor=static_factor,
            speeds_rpm=list(speeds_rpm),
            elements=elements,
            modes=modes,
            reference_load=reference,
            fundamental_frequency=frequency,
        ),
        panels=tuple(panels),
        reading=read_figure_4(tuple(panels), rotor),
    )
    return _with_floquet(figure, read_floquet_4(figure.panels, drawn)) if floquet else figure


def figure_5(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = _SPINS,
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
        Whether to add what is unstable, and what of the text survives.

    Returns
    -------
    Figure
        ω_n and the load factors' p̄_cr are the Timoshenko rotor's for both shafts. The text
        says so of ω_n only; with each shaft's own p̄_cr the left Euler–Bernoulli boundary
        of a spinning rotor would lie nearer to the β_d axis, against the text.
    """
    reference = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    twin = replace(rotor, shear=0.0)
    shafts: tuple[tuple[str, Style, ShaftDisk], ...] = (
        ("Timoshenko", "solid", rotor),
        ("Euler–Bernoulli", "dashed", twin),
    )
    panels, drawn = [], []
    for letter, spin in lettered("spin_speeds", spin_speeds):
        variants = [
            Variant(group, style, lumped(shaft, spin), static_factor, reference)
            for group, style, shaft in shafts
        ]
        drawn.append(variants)
        panels.append(
            region_panel(letter, f"Ω̄ = {spin:g}", variants, frequency, largest_factor, floquet)
        )
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
        panels=tuple(panels),
        reading=read_figure_5(tuple(panels), rotor, static_factor, spin_speeds[-1]),
    )
    return _with_floquet(figure, read_floquet_5(figure.panels, drawn)) if floquet else figure


def _static_factor_figure(
    number: int,
    tangency: float,
    rotor: ShaftDisk,
    spin_speeds: Sequence[float],
    static_factors: Sequence[float],
    largest_factor: float,
    floquet: bool,
) -> Figure:
    """Return Fig. 6 or 7 with its reading."""
    reference = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    panels, drawn = [], []
    for letter, spin in lettered("spin_speeds", spin_speeds):
        system = lumped(rotor, spin, tangency)
        variants = [
            Variant(f"α_s = {factor:g}", style, system, factor, reference)
            for style, factor in styled("static_factors", static_factors)
        ]
        drawn.append(variants)
        panels.append(
            region_panel(letter, f"Ω̄ = {spin:g}", variants, frequency, largest_factor, floquet)
        )
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
        panels=tuple(panels),
    )
    plain, true = (read_figure_7, read_floquet_7) if tangency else (read_figure_6, read_floquet_6)
    figure = replace(figure, reading=plain(figure.panels))
    return _with_floquet(figure, true(figure.panels, drawn)) if floquet else figure


def figure_6(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = _SPINS,
    static_factors: Sequence[float] = _FACTORS,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 6: effect of the static load factor, axial load.

    Parameters
    ----------
    rotor : ShaftDisk
    spin_speeds : sequence of up to 26 floats
        Ω̄, a panel each.
    static_factors : sequence of up to three floats
        α_s, a line style each.
    largest_factor : float
        Top of the β_d axis.
    floquet : bool
        Whether to add what is unstable, and what of the text survives.

    Returns
    -------
    Figure
    """
    return _static_factor_figure(
        6, 0.0, rotor, spin_speeds, static_factors, largest_factor, floquet
    )


def figure_7(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = _SPINS,
    static_factors: Sequence[float] = _FACTORS,
    largest_factor: float = 1.0,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 7: effect of the static load factor, follower load; see `figure_6`.

    The load factors are measured by the static buckling load here too.
    """
    return _static_factor_figure(
        7, 1.0, rotor, spin_speeds, static_factors, largest_factor, floquet
    )


def figure_9(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = _SPINS,
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
        Whether to add what is unstable, and what of the text survives.

    Returns
    -------
    Figure
    """
    reference = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    panels, drawn = [], []
    for letter, spin in lettered("spin_speeds", spin_speeds):
        variants = [
            Variant(group, style, lumped(rotor, spin, tangency), static_factor, reference)
            for group, style, tangency in LOAD_KINDS
        ]
        drawn.append(variants)
        panels.append(
            region_panel(letter, f"Ω̄ = {spin:g}", variants, frequency, largest_factor, floquet)
        )
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
        panels=tuple(panels),
        reading=read_figure_9(tuple(panels)),
    )
    return _with_floquet(figure, read_floquet_9(figure.panels, drawn)) if floquet else figure
