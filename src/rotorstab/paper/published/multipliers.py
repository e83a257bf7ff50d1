"""Values that need Floquet multipliers: true tongues, and a gyroscopic problem in closed form."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...bolotin.boundaries import boundary_frequencies
from ...floquet.point import growth_rate
from ...floquet.resonance import resonances
from ...floquet.tongues.edges import tongue_edges
from ...model.lumped import lumped
from ...model.system import System
from ...rotors.shaft_disk import BASE_CASE
from ...whirl.critical_loads import critical_load
from .structure import Published, item

__all__ = ["multipliers"]

FLOQUET = "Floquet"


def _peak(spin: float, tangency: float, name: str) -> float:
    """Return the peak growth over β_d of a tongue at α_s = 0.5, β_d = 0.05."""
    buckling = float(critical_load(BASE_CASE.shear))
    system = lumped(BASE_CASE, spin, tangency)
    row = resonances(system, 0.5 * buckling, 0.05 * buckling)[name]
    frequencies = row.centre + row.half_width * np.linspace(-0.5, 0.5, 201)
    rates = growth_rate(system, 0.5 * buckling, 0.05 * buckling, frequencies)
    return float(rates.max() / 0.05)


def _gyroscopic() -> System:
    """Return z̈ − jgż + (k + ε cos θt)z = 0 with k = 1, g = 0.4; ε is the pulsating load."""
    one, zero = np.ones((1, 1)), np.zeros((1, 1))
    return System(
        mass=one,
        gyroscopic=one,
        external_damping=zero,
        internal_damping=zero,
        elastic=one,
        geometric=one,
        spin_speed=np.array(0.4),
    )


def _true_edge(side: int) -> float:
    edges = tongue_edges(_gyroscopic(), 0.0, [0.4])
    return float((edges.left, edges.right)[side][0, 0])


def _bolotin_edge(side: int) -> float:
    return float(boundary_frequencies(_gyroscopic(), 0.0, 0.4)[side])


def multipliers() -> list[Published]:
    """Return growth rates of true tongues and the edges of a gyroscopic band."""
    peaks = [(1.0, 0.0, "1B+1F", "0.18479"), (2.0, 1.0, "1B+2B", "0.10316")]
    items = [
        item(
            FLOQUET,
            f"peak growth over β_d of {name}, {'follower' if mu else 'axial'}, Ω̄ = {spin:g}, "
            "α_s = 0.5, β_d = 0.05",
            "-",
            printed,
            "separate code, numerical integration",
            partial(_peak, spin, mu, name),
        )
        for spin, mu, name, printed in peaks
    ]
    closed = "closed form: z = ue^{jgt/2} gives Mathieu's equation"
    first = "closed form, one harmonic"
    case = "of z̈ − jgż + (1 + 0.4 cos θt)z = 0, g = 0.4"
    for side, (true, bolotin) in enumerate(
        (("1.8396583", "1.5820080"), ("2.2306405", "2.4773475"))
    ):
        word = ("left", "right")[side]
        items += [
            item(
                FLOQUET,
                f"{word} true edge θ {case}",
                "-",
                true,
                closed,
                partial(_true_edge, side),
            ),
            item(
                FLOQUET,
                f"{word} Bolotin boundary θ {case}",
                "-",
                bolotin,
                first,
                partial(_bolotin_edge, side),
            ),
        ]
    return items
