"""Rotors to start from: the paper's, three of a textbook, a ship's shaft line and a turbopump."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from .materials import MATERIALS, Material
from .parts import AxialLoad, Bearing, Disk
from .rotor import Rotor
from .sections import ShaftSection
from .shaft_disk import TABLE_1_SI

__all__ = ["PRESETS", "ring"]


def ring(
    position: float, material: Material, diameter: float, bore: float, thickness: float
) -> Disk:
    """Return a disk with a bore as a rigid body.

    Parameters
    ----------
    position : float
        [m].
    material : Material
    diameter, bore, thickness : float
        [m].

    Returns
    -------
    Disk
        Its inertias are those of a circular ring of this thickness.
    """
    mass = material.density * math.pi * (diameter**2 - bore**2) / 4 * thickness
    polar = mass * (diameter**2 + bore**2) / 8
    return Disk(position, mass, polar / 2 + mass * thickness**2 / 12, polar)


def _table_1() -> Rotor:
    si = TABLE_1_SI
    material = Material(si["youngs_modulus"], si["shear_modulus"], si["density"])
    shaft = ShaftSection(
        si["length"], si["diameter"], material, shear_coefficient=si["shear_coefficient"]
    )
    disk = Disk(si["length"], si["disk_mass"], si["diametral_inertia"], si["polar_inertia"])
    return Rotor((shaft,), (disk,), clamps=(0.0,))


_BOOK_STEEL = Material(youngs_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
_BOOK_SHAFT = ShaftSection(1.5, 0.05, _BOOK_STEEL)
_STEEL = MATERIALS["steel"]


def _ship() -> Rotor:
    line = ShaftSection(8.0, 0.36, _STEEL, inner_diameter=0.12)
    return Rotor(
        sections=(ShaftSection(4.0, 0.42, _STEEL), line),
        disks=(Disk(0.0, mass=5200.0, diametral_inertia=1900.0, polar_inertia=3600.0),),
        bearings=(
            Bearing(1.0, kxx=4e8, kyy=9e8, cxx=4e5, cyy=8e5),
            Bearing(4.5, kxx=6e8, kyy=1.2e9, cxx=3e5, cyy=6e5),
            Bearing(8.5, kxx=6e8, kyy=1.2e9, cxx=3e5, cyy=6e5),
            Bearing(11.5, kxx=1e9, kyy=1e9, cxx=2e5),
        ),
        load=AxialLoad(start=11.5, end=0.0),
    )


def _turbopump() -> Rotor:
    return Rotor(
        sections=(
            ShaftSection(0.10, 0.030, _STEEL),
            ShaftSection(0.26, 0.045, _STEEL),
            ShaftSection(0.08, 0.035, _STEEL),
        ),
        disks=(
            Disk(0.02, mass=0.8, diametral_inertia=4e-4, polar_inertia=6e-4),
            Disk(0.08, mass=3.2, diametral_inertia=5e-3, polar_inertia=9e-3),
            Disk(0.42, mass=4.5, diametral_inertia=1e-2, polar_inertia=1.9e-2),
        ),
        bearings=(
            Bearing(0.08, kxx=4e5, kxy=1e5, kyx=-1e5, cxx=250.0),
            Bearing(0.13, kxx=6e7, kyy=4e7, cxx=900.0),
            Bearing(0.34, kxx=6e7, kyy=4e7, cxx=900.0),
        ),
        load=AxialLoad(start=0.13, end=0.42),
    )


PRESETS: Mapping[str, Rotor] = MappingProxyType(
    {
        # Table 1 of the source paper
        "cantilever": _table_1(),
        # Friswell, Penny, Garvey, Lees, Dynamics of Rotating Machines (Cambridge University Press,
        # 2010), examples 5.9.7, 5.9.9 and 6.8.1
        "two disks": Rotor(
            sections=(_BOOK_SHAFT,),
            disks=(
                ring(0.5, _BOOK_STEEL, 0.28, 0.05, 0.07),
                ring(1.0, _BOOK_STEEL, 0.35, 0.05, 0.07),
            ),
            bearings=(Bearing(0.0, kxx=1e6), Bearing(1.5, kxx=1e6)),
        ),
        "overhung disk": Rotor(
            sections=(_BOOK_SHAFT,),
            disks=(ring(1.5, _BOOK_STEEL, 0.35, 0.05, 0.07),),
            bearings=(Bearing(0.0, kxx=1e7), Bearing(1.0, kxx=1e7)),
        ),
        "thin overhung shaft": Rotor(
            sections=(ShaftSection(1.5, 0.025, _BOOK_STEEL),),
            disks=(Disk(1.5, mass=15.3, diametral_inertia=0.062, polar_inertia=0.120),),
            bearings=(Bearing(0.0, kxx=1e7), Bearing(1.0, kxx=1e7)),
        ),
        # Not of a real machine: sizes of a small cargo ship, with the propeller's thrust between
        # the propeller at x = 0 and the thrust bearing, and of a liquid-fuel turbopump
        "ship's shaft line": _ship(),
        "turbopump": _turbopump(),
    }
)
"""Rotors by name, from the literature or of a typical size."""
