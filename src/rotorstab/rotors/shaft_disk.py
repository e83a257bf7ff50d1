"""The rotor: a cantilever shaft with a disk at its free end, in non-dimensional form.

Length L, bending stiffness EI and line mass ρA are 1, so time is in √(ρAL⁴/EI),
force in EI/L² and moment in EI/L.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .._arguments import number

__all__ = ["BASE_CASE", "EULER_BERNOULLI_TWIN", "TABLE_1_SI", "Scales", "ShaftDisk"]


@dataclass(frozen=True)
class Scales:
    """SI values of the non-dimensional units of one rotor.

    Parameters
    ----------
    length : float
        Shaft length L [m].
    mass : float
        Shaft mass ρAL [kg].
    load : float
        EI/L² [N].
    frequency : float
        √(EI/(ρAL⁴)) [rad/s]; also the unit of spin speeds and growth rates.
    """

    length: float
    mass: float
    load: float
    frequency: float


@dataclass(frozen=True)
class ShaftDisk:
    """A cantilever shaft with a disk at its free end, non-dimensional.

    Parameters
    ----------
    shear : float
        Shear parameter Φ = EI/(κGAL²) [-], in [0, 1); 0 is the Euler–Bernoulli shaft.
    disk_mass : float
        M̄_D = M_D/(ρAL) [-], 0 or more.
    diametral_inertia : float
        Ī_D = I_D/(ρAL³) [-], 0 or more.
    polar_inertia : float
        Ī_P = I_P/(ρAL³) [-], 0 or more. A rigid body has Ī_P ≤ 2 Ī_D; this is not enforced.
    slenderness : float
        r = √(I/A)/L [-], in [0, 1); used by the finite-element shaft only.

    Raises
    ------
    ValueError
        If a value is not a finite number in its range.

    References
    ----------
    Eqs. (25), (31)–(33) of the source paper.

    Examples
    --------
    >>> ShaftDisk().disk_mass
    5.0
    """

    shear: float = 0.0192
    disk_mass: float = 5.0
    diametral_inertia: float = 0.8
    polar_inertia: float = 1.6
    slenderness: float = 0.08

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        for name, high in (
            ("shear", 1.0),
            ("disk_mass", math.inf),
            ("diametral_inertia", math.inf),
            ("polar_inertia", math.inf),
            ("slenderness", 1.0),
        ):
            value = number(name, getattr(self, name), 0.0, high, open_high=True)
            object.__setattr__(self, name, value)

    @classmethod
    def from_si(
        cls,
        *,
        length: float,
        diameter: float,
        youngs_modulus: float,
        shear_modulus: float,
        density: float,
        shear_coefficient: float,
        disk_mass: float,
        diametral_inertia: float,
        polar_inertia: float,
    ) -> tuple[ShaftDisk, Scales]:
        """Return the rotor with a solid circular shaft from SI values, and its scales.

        Parameters
        ----------
        length, diameter : float
            Shaft length and diameter [m].
        youngs_modulus, shear_modulus : float
            E and G [Pa].
        density : float
            ρ [kg/m³].
        shear_coefficient : float
            κ [-], in (0, 1].
        disk_mass : float
            M_D [kg].
        diametral_inertia, polar_inertia : float
            I_D and I_P of the disk [kg m²].

        Returns
        -------
        rotor : ShaftDisk
        scales : Scales
            A non-dimensional result times its scale is the result in SI units.

        Raises
        ------
        ValueError
            If a value is not finite or out of its range, or the rotor that it gives is.

        References
        ----------
        Eqs. (25), (31)–(35) of the source paper.

        Examples
        --------
        >>> rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
        >>> round(rotor.disk_mass, 6)
        1.161334
        """
        length = number("length", length, 0.0, open_low=True)
        diameter = number("diameter", diameter, 0.0, open_low=True)
        youngs_modulus = number("youngs_modulus", youngs_modulus, 0.0, open_low=True)
        shear_modulus = number("shear_modulus", shear_modulus, 0.0, open_low=True)
        density = number("density", density, 0.0, open_low=True)
        shear_coefficient = number("shear_coefficient", shear_coefficient, 0.0, 1.0, open_low=True)
        disk_mass = number("disk_mass", disk_mass, 0.0)
        diametral_inertia = number("diametral_inertia", diametral_inertia, 0.0)
        polar_inertia = number("polar_inertia", polar_inertia, 0.0)

        area = math.pi * diameter**2 / 4
        bending = youngs_modulus * math.pi * diameter**4 / 64
        mass = density * area * length
        scales = Scales(
            length=length,
            mass=mass,
            load=bending / length**2,
            frequency=math.sqrt(bending / (mass * length**3)),
        )
        rotor = cls(
            shear=bending / (shear_coefficient * shear_modulus * area * length**2),
            disk_mass=disk_mass / mass,
            diametral_inertia=diametral_inertia / (mass * length**2),
            polar_inertia=polar_inertia / (mass * length**2),
            slenderness=diameter / (4 * length),
        )
        return rotor, scales


BASE_CASE = ShaftDisk()
"""The paper's basic data: r = 0.08, E/κG = 3, M̄_D = 5, Ī_D = 0.8, Ī_P = 1.6."""

EULER_BERNOULLI_TWIN = ShaftDisk(shear=0.0)
"""The base case without shear deformation (Fig. 5)."""

TABLE_1_SI = {
    "length": 0.5,
    "diameter": 0.02,
    "youngs_modulus": 207e9,
    "shear_modulus": 79.6e9,
    "density": 7680.0,
    "shear_coefficient": 0.89,
    "disk_mass": 1.401,
    "diametral_inertia": 0.0136,
    "polar_inertia": 0.0272,
}
"""Table 1 of the paper, as arguments of `ShaftDisk.from_si`."""
