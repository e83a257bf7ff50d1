"""Rotors of the literature, for tests of any rotor."""

import math

import numpy as np

from rotorstab import Bearing, Disk, Material, Rotor, ShaftSection

# M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines,
# Cambridge University Press, 2010: examples 5.9.7, 5.9.9 and 6.8.1
STEEL = Material(youngs_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
SHAFT = ShaftSection(length=1.5, outer_diameter=0.05, material=STEEL)


def steel_disk(position: float, diameter: float, bore: float = 0.05, width: float = 0.07) -> Disk:
    """Return a steel disk of the book."""
    mass = STEEL.density * math.pi * (diameter**2 - bore**2) / 4 * width
    polar = mass * (diameter**2 + bore**2) / 8
    return Disk(position, mass, polar / 2 + mass * width**2 / 12, polar)


FRISWELL_597 = Rotor(
    sections=(SHAFT,),
    disks=(steel_disk(0.5, 0.28), steel_disk(1.0, 0.35)),
    bearings=(Bearing(0.0, kxx=1e6), Bearing(1.5, kxx=1e6)),
)
FRISWELL_599 = Rotor(
    sections=(SHAFT,),
    disks=(steel_disk(1.5, 0.35),),
    bearings=(Bearing(0.0, kxx=1e7), Bearing(1.0, kxx=1e7)),
)
FRISWELL_681 = Rotor(
    sections=(ShaftSection(length=1.5, outer_diameter=0.025, material=STEEL),),
    disks=(Disk(1.5, mass=15.3, diametral_inertia=0.062, polar_inertia=0.120),),
    bearings=(Bearing(0.0, kxx=1e7), Bearing(1.0, kxx=1e7)),
)
UNEQUAL = Rotor(
    sections=FRISWELL_597.sections,
    disks=FRISWELL_597.disks,
    bearings=(Bearing(0.0, kxx=1e6, kyy=0.6e6), Bearing(1.5, kxx=1e6, kyy=0.6e6)),
)
OIL_FILM = Rotor(
    sections=FRISWELL_597.sections,
    disks=FRISWELL_597.disks,
    bearings=tuple(
        Bearing(
            place,
            kxx=1e6,
            kyy=1.3e6,
            kxy=2e5,
            kyx=-4e5,
            cxx=900.0,
            cyy=1500.0,
            cxy=100.0,
            cyx=-250.0,
        )
        for place in (0.0, 1.5)
    ),
)


def rpm(turns: float) -> float:
    """Return revolutions per minute in rad/s."""
    return turns * math.pi / 30


def real_matrices(
    rotor: Rotor, spin_speed: float, load: float, elements: int = 6
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return M, C, K of the real coordinates (x, y) of a rotor.

    The shaft and the disks are those of the rotor with isotropic bearings, whose complex
    coordinates are x + jy; the bearings are added here, coefficient by coefficient.
    """
    bare = Rotor(rotor.sections, rotor.disks, (), rotor.clamps, rotor.load).system(0.0, elements)
    # no clamps: coordinates are v and γ of the nodes, which divide the shaft evenly
    nodes = np.linspace(0.0, rotor.length, bare.size // 2)
    zero = np.zeros_like(bare.mass)
    shaft = bare.elastic + load * bare.geometric
    mass = np.block([[bare.mass, zero], [zero, bare.mass]])
    spin = spin_speed * bare.gyroscopic
    damping = np.block([[zero, spin], [-spin, zero]])
    stiffness = np.block([[shaft, zero], [zero, shaft]])
    for one in rotor.bearings:
        x = 2 * int(np.abs(nodes - one.position).argmin())
        at = np.ix_([x, x + bare.size], [x, x + bare.size])
        stiffness[at] += [[one.kxx, one.kxy], [one.kyx, one.kyy]]
        damping[at] += [[one.cxx, one.cxy], [one.cyx, one.cyy]]
    return mass, damping, stiffness


def real_frequencies(mass: np.ndarray, damping: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Return ω of all solutions exp(jωt) of real matrices, by scipy."""
    import scipy.linalg

    zero, one = np.zeros_like(mass), np.eye(len(mass))
    state = np.block([[zero, one], [-stiffness, -damping]])
    weight = np.block([[one, zero], [zero, mass]])
    return scipy.linalg.eig(state, weight, right=False) / 1j
