"""Rotors of the literature, for tests of any rotor."""

import math

import numpy as np

from rotorstab import PRESETS, Bearing, Disk, Rotor
from rotorstab.rotors.presets import ring

FRISWELL_597 = PRESETS["two disks"]
FRISWELL_599 = PRESETS["overhung disk"]
FRISWELL_681 = PRESETS["thin overhung shaft"]
SHAFT = FRISWELL_597.sections[0]
STEEL = SHAFT.material


def steel_disk(position: float, diameter: float) -> Disk:
    """Return a steel disk of the book."""
    return ring(position, STEEL, diameter, 0.05, 0.07)


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
