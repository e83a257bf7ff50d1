"""Values of the paper's text and of classical solutions."""

from __future__ import annotations

from functools import partial

import numpy as np

from ..._numerics.extrapolation import extrapolation_weights
from ...model.finite_element import finite_element
from ...model.system import frequencies_at_rest, fundamental_frequency
from ...rotors.shaft_disk import BASE_CASE, TABLE_1_SI, ShaftDisk
from ...whirl.critical_loads import beck_load, critical_load
from ..arguments import resting_frequency
from .structure import Published, item
from .table_1 import table_1_rotor, table_1_whirl

__all__ = ["classical", "paper"]

PAPER = "The paper"
CLASSICAL = "Classical solutions"


def _cantilever(number: int) -> float:
    beam = ShaftDisk(0.0, 0.0, 0.0, 0.0, 0.0)
    return float(frequencies_at_rest(finite_element(beam, 0.0, elements=40))[number])


def _tip_mass() -> float:
    rotor = ShaftDisk(0.0, 1.0, 0.0, 0.0, 0.0)
    return fundamental_frequency(finite_element(rotor, 0.0, elements=40))


def _buckling(shear: float) -> float:
    """Return the finite elements' static buckling load, extrapolated in the mesh."""

    def on_mesh(elements: int) -> float:
        rotor = ShaftDisk(shear, 0.0, 0.0, 0.0, 0.0)
        system = finite_element(rotor, 0.0, elements=elements)
        inverse = np.linalg.eigvals(-np.linalg.solve(system.elastic, system.geometric))
        return float(1 / inverse.real.max())

    loads = np.array([on_mesh(20), on_mesh(40)])
    return float(extrapolation_weights((20, 40), order=2) @ loads)


def paper() -> list[Published]:
    """Return the numbers that the paper prints."""
    rotor, scales = table_1_rotor()
    disk = TABLE_1_SI["disk_mass"]
    return [
        item(
            PAPER,
            "buckling load p̄_cr, Φ = 0.0192",
            "EI/L²",
            "2.3558",
            "section 3.1",
            lambda: float(critical_load(BASE_CASE.shear)),
        ),
        item(
            PAPER,
            "follower critical load (Beck, shaft alone)",
            "EI/L²",
            "12.3019",
            "section 3.1",
            lambda: beck_load(BASE_CASE.shear, BASE_CASE.slenderness),
        ),
        item(
            PAPER,
            "ω_n, lumped",
            "rad/s",
            "159.805",
            "Table 1",
            lambda: resting_frequency(rotor) * scales.frequency,
        ),
        item(
            PAPER,
            "buckling load p_cr",
            "kN",
            "16.0",
            "Table 1",
            lambda: float(critical_load(rotor.shear)) * scales.load / 1000,
        ),
        item(
            PAPER,
            "mass of the disk over that of the shaft",
            "-",
            "1.16",
            "section 3.2",
            lambda: rotor.disk_mass,
        ),
        item(
            PAPER,
            "neglected part of the mass",
            "%",
            "46",
            "section 3.2",
            lambda: 100 * scales.mass / (scales.mass + disk),
        ),
        item(
            PAPER,
            "lumped over finite-element second frequency, excess",
            "%",
            "15",
            "section 3.2 (Fig. 4)",
            lambda: (
                100 * (table_1_whirl("lumped", 0, 0, "2F") / table_1_whirl("fe", 0, 0, "2F") - 1)
            ),
            1.0,
            "the text does not say at which load; ours is unloaded and at rest",
        ),
    ]


def classical() -> list[Published]:
    """Return values with closed-form or transcendental solutions."""
    source = "1 + cos x cosh x = 0"
    return [
        *(
            item(
                CLASSICAL,
                f"Euler–Bernoulli cantilever, ω̄ of mode {k + 1}",
                "-",
                printed,
                source,
                partial(_cantilever, k),
                allowed,
            )
            for k, (printed, allowed) in enumerate(
                [("3.5160153", 2e-7), ("22.0344916", 5e-6), ("61.6972144", 1e-4)]
            )
        ),
        item(
            CLASSICAL,
            "cantilever with an equal tip mass, ω̄ of mode 1",
            "-",
            "1.5572979",
            "1 + cos x cosh x + x(cos x sinh x − sin x cosh x) = 0",
            _tip_mass,
        ),
        item(
            CLASSICAL,
            "Euler's cantilever, finite elements",
            "EI/L²",
            "2.4674011",
            "π²/4",
            lambda: _buckling(0.0),
            1e-6,
        ),
        item(
            CLASSICAL,
            "Timoshenko cantilever Φ = 0.0192, finite elements",
            "EI/L²",
            "2.3557973",
            "(π²/4)/(1 + Φπ²/4)",
            lambda: _buckling(0.0192),
            1e-6,
        ),
        item(
            CLASSICAL,
            "Beck's column",
            "EI/L²",
            "20.0509536",
            "Beck 1952, exact determinant",
            lambda: beck_load(0.0, 0.0),
            2e-6,
        ),
    ]
