"""The data of a shaft and a disk in SI."""

from __future__ import annotations

import param

from rotorstab import TABLE_1_SI
from rotorstab.rotors.materials import MATERIALS

from .declaration import DESCRIPTIVE, Facts, Number, Selector, Use

__all__ = ["ShaftInputs"]


class ShaftInputs(param.Parameterized):
    """A shaft and a disk in SI."""

    shaft_length = Number(
        Facts("len", DESCRIPTIVE, symbol="L", unit="m"),
        default=TABLE_1_SI["length"],
        bounds=(0.01, 20.0),
        step=0.001,
        label="Length",
        doc="Length of the shaft, from its clamp to the disk.",
    )
    shaft_diameter = Number(
        Facts("dia", DESCRIPTIVE, symbol="d", unit="mm"),
        default=1000 * TABLE_1_SI["diameter"],
        bounds=(0.5, 1000.0),
        step=0.1,
        label="Diameter",
        doc="Diameter of the solid round shaft.",
    )
    material = Selector(
        Facts("mat", DESCRIPTIVE, unit=""),
        default="own",
        objects=["own", *MATERIALS],
        label="Material",
        doc="Handbook values of E, G and ρ with Cowper’s κ, or your own values below.",
    )
    youngs_modulus = Number(
        Facts("e", DESCRIPTIVE | Use.MATERIAL, symbol="E", unit="GPa"),
        default=TABLE_1_SI["youngs_modulus"] / 1e9,
        bounds=(0.01, 2000.0),
        step=0.1,
        label="Young’s modulus",
        doc="Elastic modulus E of your own material.",
    )
    shear_modulus = Number(
        Facts("g", DESCRIPTIVE | Use.MATERIAL, symbol="G", unit="GPa"),
        default=TABLE_1_SI["shear_modulus"] / 1e9,
        bounds=(0.004, 1000.0),
        step=0.1,
        label="Shear modulus",
        doc="Shear modulus G of your own material.",
    )
    density = Number(
        Facts("rho", DESCRIPTIVE | Use.MATERIAL, symbol="ρ", unit="kg/m³"),
        default=TABLE_1_SI["density"],
        bounds=(100.0, 30000.0),
        step=1.0,
        label="Density",
        doc="Density ρ of your own material.",
    )
    shear_coefficient = Number(
        Facts("kappa", DESCRIPTIVE | Use.MATERIAL, symbol="κ", unit=""),
        default=TABLE_1_SI["shear_coefficient"],
        bounds=(0.1, 1.0),
        step=0.001,
        label="Shear coefficient",
        doc="Timoshenko’s κ: 0.89 for a solid circle of steel (Cowper).",
    )
    si_disk_mass = Number(
        Facts("simd", DESCRIPTIVE, symbol="M_D", unit="kg"),
        default=TABLE_1_SI["disk_mass"],
        bounds=(1e-6, 1e6),
        step=0.001,
        label="Disk mass in SI",
        doc="Mass of the disk at the tip.",
    )
    si_diametral_inertia = Number(
        Facts("siid", DESCRIPTIVE, symbol="I_D", unit="kg m²"),
        default=TABLE_1_SI["diametral_inertia"],
        bounds=(0.0, 1e6),
        step=0.0001,
        label="Diametral inertia in SI",
        doc="The disk’s moment of inertia about a diameter.",
    )
    si_polar_inertia = Number(
        Facts("siip", DESCRIPTIVE, symbol="I_P", unit="kg m²"),
        default=TABLE_1_SI["polar_inertia"],
        bounds=(0.0, 1e6),
        step=0.0001,
        label="Polar inertia in SI",
        doc="The disk’s moment of inertia about the shaft.",
    )
