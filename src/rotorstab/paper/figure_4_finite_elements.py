"""Figure 4: Bolotin regions of the lumped model and of finite elements, Table 1's rotor."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .._types import Array
from ..charts.figure import Figure, Statement
from ..charts.structure import Chart
from ..model.finite_element import finite_element, first_modes
from ..model.lumped import lumped
from ..model.system import frequencies_at_rest
from ..rotors.shaft_disk import TABLE_1_SI, ShaftDisk
from ..whirl.critical_loads import critical_load
from .arguments import lettered, parameters, resting_frequency
from .floquet_numbers import PRINCIPAL, Variants, place, read_shading, tongues, width
from .region_figure import RegionPanel, Variant, region_figure
from .verdicts import boundaries, confirm, groups, judge, percent, right_of, say, titles

__all__ = ["figure_4"]

Panels = tuple[Chart, ...]


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
        Whether to add what is unstable, and what of the text Floquet's method confirms.

    Returns
    -------
    Figure
        ω_n is the lumped model's, as Table 1 has it, for both models.
    """
    rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
    reference = float(critical_load(rotor.shear))
    frequency = resting_frequency(rotor)
    drawn = []
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
        drawn.append(RegionPanel(letter, title, variants))
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
        panels=(),
    )
    figure = region_figure(figure, drawn, frequency, largest_factor, floquet)
    reading = _read_text(figure.panels, rotor)
    if floquet:
        reading += _read_floquet(figure.panels, [panel.variants for panel in drawn])
    return replace(figure, reading=reading)


def _ratio_range(panel: Chart, modes: tuple[str, ...], span: slice = slice(None)) -> Array:
    """Return the least and largest present/finite-element − 1 of the boundaries."""
    present, comparator = (boundaries(panel, group, modes)[:, span] for group in groups(panel))
    excess = present / comparator - 1
    return np.array([np.nanmin(excess), np.nanmax(excess)])


def _read_text(panels: Panels, rotor: ShaftDisk) -> tuple[Statement, ...]:
    """Compare what the text says with Bolotin's regions."""
    # the left boundary runs to 0 near β_d = 1, where a ratio says nothing
    first = np.array([_ratio_range(panel, ("1B", "1F"), slice(0, 11)) for panel in panels])
    second = np.array([_ratio_range(panel, ("2B", "2F")) for panel in panels])
    shifted = all(
        right_of(*(boundaries(panel, group) for group in groups(panel))) for panel in panels
    )
    systems = lumped(rotor, 0.0), finite_element(rotor, 0.0)
    lumped_second, second_of_elements = (frequencies_at_rest(system)[1] for system in systems)
    excess = float(lumped_second / second_of_elements - 1)
    return (
        Statement(
            "The agreement of the first regions is good.",
            f"To β_d = 0.5 the lumped boundaries are {percent(first.min())} to "
            f"{percent(first.max())} above the finite-element ones.",
            judge(first.max() < 0.1),
        ),
        Statement(
            "The lumped regions are slightly shifted right, in parallel to the β_d axis.",
            say(shifted, "Every", "Not every") + " lumped boundary lies right of its counterpart.",
            judge(shifted),
        ),
        Statement(
            "The boundary frequencies of the second regions are only 15 % higher.",
            f"They are {percent(second.min())} to {percent(second.max())} higher.",
            judge(second.min() > 0.14, second.max() < 0.16),
            f"Unloaded and at rest it is {percent(excess)}, with finite elements that are "
            "converged.",
        ),
    )


def _percents(values: list[float]) -> str:
    return ", ".join(f"{100 * value:.1f}" for value in values)


def _read_floquet(panels: Panels, drawn: Variants) -> tuple[Statement, ...]:
    """Compare what the text says with what Floquet finds unstable."""
    first = [place(present) / place(comparator) - 1 for present, comparator in drawn]
    second = [
        place(present, "2B+2F") / place(comparator, "2B+2F") - 1 for present, comparator in drawn
    ]
    widths = [[width(panel, group, 0.5) for group in groups(panel)] for panel in panels]
    ratio = [a / b - 1 for a, b in widths]
    return (
        read_shading(panels),
        Statement(
            "The agreement of the first unstable regions is good; the lumped ones lie slightly "
            "to the right.",
            f"The true tongue {PRINCIPAL} of the lumped model lies {_percents(first)} "
            f"% above the finite-element one ({titles(panels)}); at β_d = 0.5 it is "
            + "; ".join(f"{a:.3f} against {b:.3f} wide" for a, b in widths)
            + ".",
            confirm(all(0 < x < 0.1 for x in first), all(abs(x) < 0.15 for x in ratio)),
        ),
        Statement(
            "The second regions' boundary frequencies are only 15 % higher.",
            f"The true tongue 2B+2F lies {_percents(second)} % higher.",
            confirm(all(0.12 < x < 0.18 for x in second)),
            "Between the two lie the tongues of 1 with 2, which the paper's method does not seek: "
            + ", ".join(
                name for name, row in tongues(drawn[-1][0]).items() if row.kind != "principal"
            )
            + ".",
        ),
    )
