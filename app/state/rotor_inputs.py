"""The inputs of the rotor: its load, its disk and shaft without dimension, and its model."""

from __future__ import annotations

import param

from rotorstab import BASE_CASE, STIFFNESS_LAWS
from rotorstab.charts.quantities import SPIN, Measure, ShareOf, SIForm

from .declaration import DESCRIPTIVE, Facts, Number, Selector, Use

__all__ = ["RotorInputs"]


class RotorInputs(param.Parameterized):
    """The rotor, its load and its model."""

    load_type = Selector(
        Facts("load", DESCRIPTIVE | Use.PRESET),
        default="axial",
        objects=["axial", "partly", "follower"],
        label="Load type",
        doc="An axial load keeps its direction; a follower load turns with the tip; a partly "
        "follower load turns by the fraction μ of the slope of the tip.",
    )
    tangency = Number(
        Facts("mu", DESCRIPTIVE, symbol="μ"),
        default=0.5,
        bounds=(0.0, 1.0),
        step=0.01,
        label="Tangency (partly follower)",
        doc="Fraction of the tip's slope by which a partly follower load turns: 0 axial, 1 "
        "follower. It has no effect on an axial or a follower load.",
    )
    static_load_factor = Number(
        Facts(
            "as",
            DESCRIPTIVE | Use.PRESET,
            symbol="α_s",
            si=SIForm("P_0", Measure.LOAD, ShareOf.REFERENCE_LOAD),
        ),
        default=0.5,
        bounds=(0.0, 0.95),
        step=0.01,
        label="Static load factor",
        doc="Static part of the load as a fraction of the reference load. Compression is positive.",
    )
    spin_speed = Number(
        Facts("spin", DESCRIPTIVE | Use.PRESET, symbol=SPIN.symbol, si=SPIN.si),
        default=2.0,
        bounds=(0.0, 4.0),
        step=0.02,
        label="Spin speed",
        doc="Constant spin speed, in units of √(EI/ρAL⁴).",
    )
    shear = Number(
        Facts("phi", DESCRIPTIVE, symbol="Φ"),
        default=BASE_CASE.shear,
        bounds=(0.0, 0.1),
        step=0.0002,
        label="Shear parameter",
        doc="EI/(κGAL²). At 0 it is the Euler–Bernoulli shaft; larger values are softer in shear.",
    )
    disk_mass = Number(
        Facts("md", DESCRIPTIVE, symbol="M̄_D", si=SIForm("M_D", Measure.MASS)),
        default=BASE_CASE.disk_mass,
        bounds=(0.5, 20.0),
        step=0.05,
        label="Disk mass",
        doc="Mass of the disk divided by the mass of the shaft. The lumped model neglects the mass "
        "of the shaft: use it for 3 or more.",
    )
    diametral_inertia = Number(
        Facts("id", DESCRIPTIVE, symbol="Ī_D", si=SIForm("I_D", Measure.INERTIA)),
        default=BASE_CASE.diametral_inertia,
        bounds=(0.01, 3.0),
        step=0.01,
        label="Diametral inertia",
        doc="The disk's moment of inertia about a diameter, divided by ρAL³.",
    )
    polar_inertia = Number(
        Facts("ip", DESCRIPTIVE, symbol="Ī_P", si=SIForm("I_P", Measure.INERTIA)),
        default=BASE_CASE.polar_inertia,
        bounds=(0.0, 6.0),
        step=0.02,
        label="Polar inertia",
        doc="The disk's moment of inertia about the shaft, divided by ρAL³. A rigid body has at "
        "most 2 Ī_D.",
    )
    reference = Selector(
        Facts("ref", DESCRIPTIVE | Use.PRESET),
        default="buckling",
        objects=["buckling", "flutter"],
        label="Load factors refer to",
        doc="The load that a load factor of 1 stands for: the static buckling load (the paper's "
        "choice for both load types), or the flutter load of the resting rotor under a follower "
        "load.",
    )
    external_damping = Number(
        Facts("ze", DESCRIPTIVE | Use.PRESET, symbol="ζ_e"),
        default=0.0,
        bounds=(0.0, 0.2),
        step=0.001,
        label="External damping",
        doc="Damping ratio ζ_e of forces on the moving disk, C_e = 2ζ_e ωₙ M. The paper has no "
        "damping.",
    )
    internal_damping = Number(
        Facts("zi", DESCRIPTIVE | Use.PRESET, symbol="ζ_i"),
        default=0.0,
        bounds=(0.0, 0.2),
        step=0.001,
        label="Rotating damping",
        doc="Damping ratio ζ_i inside the rotating shaft, C_i = (2ζ_i/ωₙ) Ka. It can destabilise "
        "the rotor.",
    )
    law = Selector(
        Facts("law", DESCRIPTIVE | Use.PRESET),
        default="linear",
        objects=list(STIFFNESS_LAWS),
        label="Stiffness law",
        doc="How the stiffness of the lumped shaft depends on the load: linearly, as in the paper, "
        "or exactly.",
    )
    model = Selector(
        Facts("model", DESCRIPTIVE | Use.PRESET),
        default="lumped",
        objects=["lumped", "finite elements"],
        label="Model",
        doc="Lumped: the paper's two degrees of freedom. Finite elements: a Timoshenko shaft with "
        "its own mass, reduced to 4 coordinates (r² = Φ/3, or r of the shaft in SI if that has "
        "this Φ). Its first four whirl frequencies are accurate to 0.15 %, the third mode to 1 %. "
        "Tongues that involve the fourth mode are not reliable.",
    )
