"""The dashboard's inputs as they are declared: bounds, step and one-line meaning of each."""

from __future__ import annotations

import param

from rotorstab import BASE_CASE, STIFFNESS_LAWS, TABLE_1_SI
from rotorstab.rotors.materials import MATERIALS

__all__ = ["SI_INPUTS", "SYMBOLS", "Inputs"]

SYMBOLS = {
    "tangency": "μ",
    "static_load_factor": "α_s",
    "spin_speed": "Ω̄",
    "shear": "Φ",
    "external_damping": "ζ_e",
    "internal_damping": "ζ_i",
    "disk_mass": "M̄_D",
    "diametral_inertia": "Ī_D",
    "polar_inertia": "Ī_P",
    "largest_factor": "β_d max",
    "lowest_frequency": "θ/ωₙ min",
    "highest_frequency": "θ/ωₙ max",
    "marker_frequency": "θ/ωₙ",
    "marker_factor": "β_d",
    "seed": "s",
    "periods": "N",
    "shaft_length": "L",
    "shaft_diameter": "d",
    "youngs_modulus": "E",
    "shear_modulus": "G",
    "density": "ρ",
    "shear_coefficient": "κ",
    "si_disk_mass": "M_D",
    "si_diametral_inertia": "I_D",
    "si_polar_inertia": "I_P",
}
SI_INPUTS = {
    "shaft_length": "m",
    "shaft_diameter": "mm",
    "material": "",
    "youngs_modulus": "GPa",
    "shear_modulus": "GPa",
    "density": "kg/m³",
    "shear_coefficient": "",
    "si_disk_mass": "kg",
    "si_diametral_inertia": "kg m²",
    "si_polar_inertia": "kg m²",
}
"""The inputs of the shaft and disk in SI, and the unit of each; they set Φ, M̄_D, Ī_D and Ī_P only
when `State.use_shaft` is called."""


class Inputs(param.Parameterized):
    """Every input of the dashboard, with its bounds, step and one-line meaning."""

    load_type = param.Selector(
        default="axial",
        objects=["axial", "partly", "follower"],
        label="Load type",
        doc="An axial load keeps its direction; a follower load turns with the tip; a partly "
        "follower load turns by the fraction μ of the slope of the tip.",
    )
    tangency = param.Number(
        default=0.5,
        bounds=(0.0, 1.0),
        step=0.01,
        label="Tangency (partly follower)",
        doc="Fraction of the tip's slope by which a partly follower load turns: 0 axial, 1 "
        "follower. It has no effect on an axial or a follower load.",
    )
    static_load_factor = param.Number(
        default=0.5,
        bounds=(0.0, 0.95),
        step=0.01,
        label="Static load factor",
        doc="Steady part of the load as a fraction of the reference load. Compression is positive.",
    )
    spin_speed = param.Number(
        default=2.0,
        bounds=(0.0, 4.0),
        step=0.02,
        label="Spin speed",
        doc="Constant rotation speed, in units of √(EI/ρAL⁴).",
    )
    shear = param.Number(
        default=BASE_CASE.shear,
        bounds=(0.0, 0.1),
        step=0.0002,
        label="Shear parameter",
        doc="EI/(κGAL²). At 0 it is the Euler–Bernoulli shaft; larger values are softer in shear.",
    )
    disk_mass = param.Number(
        default=BASE_CASE.disk_mass,
        bounds=(0.5, 20.0),
        step=0.05,
        label="Disk mass",
        doc="Mass of the disk divided by the mass of the shaft. The lumped model neglects the mass "
        "of the shaft: use it for 3 or more.",
    )
    diametral_inertia = param.Number(
        default=BASE_CASE.diametral_inertia,
        bounds=(0.01, 3.0),
        step=0.01,
        label="Diametral inertia",
        doc="The disk's moment of inertia about a diameter, divided by ρAL³.",
    )
    polar_inertia = param.Number(
        default=BASE_CASE.polar_inertia,
        bounds=(0.0, 6.0),
        step=0.02,
        label="Polar inertia",
        doc="The disk's moment of inertia about the shaft, divided by ρAL³. A rigid body has at "
        "most 2 Ī_D.",
    )
    reference = param.Selector(
        default="buckling",
        objects=["buckling", "flutter"],
        label="Load factors refer to",
        doc="The load that a load factor of 1 stands for: the static buckling load (the paper's "
        "choice for both load types), or the flutter load of the resting rotor under a follower "
        "load.",
    )
    largest_factor = param.Number(
        default=1.0,
        bounds=(0.05, 2.0),
        step=0.05,
        label="Largest dynamic factor",
        doc="Top of the instability chart: the largest dynamic load factor β_d shown.",
    )
    lowest_frequency = param.Number(
        default=0.0,
        bounds=(0.0, 39.0),
        step=0.1,
        label="Lowest frequency",
        doc="Left end of the instability chart, in units of ωₙ.",
    )
    highest_frequency = param.Number(
        default=16.0,
        bounds=(0.5, 40.0),
        step=0.1,
        label="Highest frequency",
        doc="Right end of the instability chart, in units of ωₙ.",
    )
    stiffness = param.Selector(
        default="linear",
        objects=[*STIFFNESS_LAWS, "both"],
        label="Stiffness in the load–frequency chart",
        doc="The paper's linear coefficients, the exact coefficients of its Appendix A, or both.",
    )

    external_damping = param.Number(
        default=0.0,
        bounds=(0.0, 0.2),
        step=0.001,
        label="External damping",
        doc="Damping ratio ζ_e of forces on the moving disk, C_e = 2ζ_e ωₙ M. The paper has no "
        "damping.",
    )
    internal_damping = param.Number(
        default=0.0,
        bounds=(0.0, 0.2),
        step=0.001,
        label="Rotating damping",
        doc="Damping ratio ζ_i inside the rotating shaft, C_i = (2ζ_i/ωₙ) Ka. It can destabilise "
        "the rotor.",
    )
    law = param.Selector(
        default="linear",
        objects=list(STIFFNESS_LAWS),
        label="Stiffness law",
        doc="How the stiffness of the lumped shaft depends on the load: linearly, as in the paper, "
        "or exactly.",
    )
    model = param.Selector(
        default="lumped",
        objects=["lumped", "finite elements"],
        label="Model",
        doc="Lumped: the paper's two degrees of freedom. Finite elements: a Timoshenko shaft with "
        "its own mass, reduced to 4 coordinates (r² = Φ/3, or r of the shaft in SI if that has "
        "this Φ). Its first four whirl frequencies are accurate to 0.15 %, the third mode to 1 %. "
        "The edges of tongues use two modes; six of seven are accurate to 1 %.",
    )
    show_growth = param.Boolean(
        default=True,
        label="Floquet growth",
        doc="Colours where the rotor is unstable by Floquet’s method.",
    )
    show_bolotin = param.Boolean(
        default=True,
        label="Bolotin regions",
        doc="Boundaries and hatching of Bolotin’s method, which the paper uses.",
    )
    show_disagreement = param.Boolean(
        default=False,
        label="Disagreement",
        doc="Shading where the two methods disagree.",
    )
    growth_unit = param.Selector(
        default="per time",
        objects=["per time", "per period"],
        label="Growth shown",
        doc="Growth rate σ̄ per unit of non-dimensional time, or σ̄T per period of the load.",
    )

    marker = param.Boolean(
        default=False,
        label="Marker",
        doc="Shows the multipliers and the motion at one point of the instability chart.",
    )
    marker_frequency = param.Number(
        default=1.68,
        bounds=(0.05, 40.0),
        step=0.01,
        label="Marker frequency",
        doc="θ/ωₙ of the marked point.",
    )
    marker_factor = param.Number(
        default=0.5,
        bounds=(0.0, 2.0),
        step=0.01,
        label="Marker factor",
        doc="β_d of the marked point.",
    )

    initial = param.Selector(
        default="knock",
        objects=["knock", "noise", "mode 1B", "mode 1F", "mode 2B", "mode 2F"],
        label="Starts from",
        doc="An impact on the disk along V, random motion of every whirl mode, or one whirl mode.",
    )
    seed = param.Number(
        default=1.0,
        bounds=(0.0, 999.0),
        step=1.0,
        label="Seed of the noise",
        doc="Each whole number gives its own random start.",
    )
    periods = param.Number(
        default=12.0,
        bounds=(1.0, 400.0),
        step=1.0,
        label="Periods shown",
        doc="Length of the response, in periods of the load.",
    )

    units = param.Selector(
        default="non-dimensional",
        objects=["non-dimensional", "SI"],
        label="Units of the charts",
        doc="Non-dimensional numbers as in the paper, or rpm, Hz and N for the shaft below.",
    )
    shaft_length = param.Number(
        default=TABLE_1_SI["length"],
        bounds=(0.01, 20.0),
        step=0.001,
        label="Length",
        doc="Length of the shaft, from its clamp to the disk.",
    )
    shaft_diameter = param.Number(
        default=1000 * TABLE_1_SI["diameter"],
        bounds=(0.5, 1000.0),
        step=0.1,
        label="Diameter",
        doc="Diameter of the solid round shaft.",
    )
    material = param.Selector(
        default="own",
        objects=["own", *MATERIALS],
        label="Material",
        doc="Handbook values of E, G and ρ with Cowper’s κ, or your own values below.",
    )
    youngs_modulus = param.Number(
        default=TABLE_1_SI["youngs_modulus"] / 1e9,
        bounds=(0.01, 2000.0),
        step=0.1,
        label="Young’s modulus",
        doc="Elastic modulus E of your own material.",
    )
    shear_modulus = param.Number(
        default=TABLE_1_SI["shear_modulus"] / 1e9,
        bounds=(0.004, 1000.0),
        step=0.1,
        label="Shear modulus",
        doc="Shear modulus G of your own material.",
    )
    density = param.Number(
        default=TABLE_1_SI["density"],
        bounds=(100.0, 30000.0),
        step=1.0,
        label="Density",
        doc="Density ρ of your own material.",
    )
    shear_coefficient = param.Number(
        default=TABLE_1_SI["shear_coefficient"],
        bounds=(0.1, 1.0),
        step=0.001,
        label="Shear coefficient",
        doc="Timoshenko’s κ: 0.89 for a solid circle of steel (Cowper).",
    )
    si_disk_mass = param.Number(
        default=TABLE_1_SI["disk_mass"],
        bounds=(1e-6, 1e6),
        step=0.001,
        label="Disk mass in SI",
        doc="Mass of the disk at the tip.",
    )
    si_diametral_inertia = param.Number(
        default=TABLE_1_SI["diametral_inertia"],
        bounds=(0.0, 1e6),
        step=0.0001,
        label="Diametral inertia in SI",
        doc="The disk’s moment of inertia about a diameter.",
    )
    si_polar_inertia = param.Number(
        default=TABLE_1_SI["polar_inertia"],
        bounds=(0.0, 1e6),
        step=0.0001,
        label="Polar inertia in SI",
        doc="The disk’s moment of inertia about the shaft.",
    )
