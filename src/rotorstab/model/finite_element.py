"""The comparator of the lumped model: the same rotor with a distributed shaft."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from .._arguments import LARGEST, number, numbers, whole_number
from .._types import ArrayLike
from ..rotors.shaft_disk import ShaftDisk
from .damping import with_damping_ratios
from .reduction import reduction_basis
from .system import System
from .timoshenko import rotor_matrices

__all__ = ["finite_element", "first_modes"]

_MOST_ELEMENTS = 200


def finite_element(
    rotor: ShaftDisk,
    spin_speed: ArrayLike,
    tangency: float = 0.0,
    elements: int = 20,
    modes: int | None = None,
    external_damping: float = 0.0,
    internal_damping: float = 0.0,
) -> System:
    """Return the rotor with a distributed shaft, by Timoshenko finite elements.

    The shaft has mass, rotary inertia, shear and a gyroscopic moment of its own.

    Parameters
    ----------
    rotor : ShaftDisk
        Its disk may be absent (masses 0). `slenderness` r gives the rotary inertia r²
        and the gyroscopic moment 2r² of the shaft per unit of length.
    spin_speed : (...) float
        Ω̄ [√(EI/(ρAL⁴))].
    tangency : float
        μ [-], in [0, 1]: 0 axial, 1 follower.
    elements : int
        Number of elements, 1 to 200.
    modes : int, optional
        Number of complex coordinates to which the system is reduced, 2 to 2 `elements`. By
        default it is not reduced.
    external_damping, internal_damping : float
        Damping ratios ζ_e and ζ_i [-], 0 or more: C_e = 2ζ_e ω_n M and C_i = (2ζ_i/ω_n) Ka, where
        ω_n is the `fundamental_frequency` of this system.

    Returns
    -------
    System
        Matrices (2 elements, 2 elements) or (modes, modes). The tip deflection and slope
        are the last two coordinates of the full system, the first two of a reduced one.

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    The frequencies converge from above, with h⁴ at Φ = 0 and r = 0, with h² otherwise. At 20
    elements the whirl frequencies 2B, 1B, 1F, 2F of the base case at Ω̄ from 0 to 5 are within
    1.2e-5 of the mesh limit.

    The reduction keeps the tip itself. So the disk's inertia, its gyroscopic moment and the
    follower term stay exact, and only the inside of the shaft is approximated. A basis of 3 to 9
    coordinates is chosen for this rotor and load type: it holds the leading directions of the
    rotor's whirl modes 2B, 1B, 1F, 2F (right and left eigenvectors) at spin speeds 0 and 4 and at
    loads between ±0.95 p̄_cr. Every spin speed and load has the same basis. `modes=2` is the lumped
    model with the shaft's consistent mass added.

    Errors of 2B, 1B, 1F, 2F against the full model, over random rotors, spin speeds and load
    types from the ranges of the dashboard's sliders (Φ to 0.1, M̄_D 0.5 to 20, Ī_D 0.01 to 3, Ī_P
    to 6, Ω̄ to 4, p̄ from −p̄_cr to 0.95 p̄_cr), relative to the frequency or to 0.1 ω_n if that is
    larger (`benchmarks/bench_finite_element.py`):

    ======  ======  =======
    modes   95 %    largest
    ======  ======  =======
    3       3e-3    1e-2
    4       5e-4    1.5e-3
    5       2e-4    1e-3
    6       5e-5    5e-4
    8       3e-6    5e-5
    ======  ======  =======

    Take 4 or more. The largest errors belong to light disks and to frequencies near 0, close
    to buckling. With 4 coordinates the frequency of the third mode is right to about 1 %, and
    results in which higher modes take part are not reliable. A stocky shaft (Φ = 0.3, r = 0.3), or
    a shaft without a disk, needs 6 for an error of 1e-3.

    References
    ----------
    Z. Friedman, J. B. Kosmatka, An improved two-node Timoshenko beam finite element,
    Computers & Structures 47 (1993) 473–481. Energy and load: Eqs. (A2), (A3) of the
    source paper.

    Examples
    --------
    >>> from rotorstab import fundamental_frequency
    >>> beam = ShaftDisk(0.0, disk_mass=0, diametral_inertia=0, polar_inertia=0, slenderness=0)
    >>> round(fundamental_frequency(finite_element(beam, 0.0)), 5)
    3.51602
    """
    tangency = number("tangency", tangency, 0.0, 1.0)
    elements = whole_number("elements", elements, 1, _MOST_ELEMENTS)
    mass, gyroscopic, elastic, load = rotor_matrices(rotor, elements)
    geometric = load.copy()
    geometric[-2, -1] += tangency  # Eq. (A3)
    system = System(
        mass=mass,
        gyroscopic=gyroscopic,
        external_damping=np.zeros_like(mass),
        internal_damping=np.zeros_like(mass),
        elastic=elastic,
        geometric=geometric,
        spin_speed=numbers("spin_speed", spin_speed, -LARGEST, LARGEST),
        tangency=tangency,
    )
    if modes is not None:
        modes = whole_number("modes", modes, 2, 2 * elements)
        system = system.projected(reduction_basis(rotor, tangency, elements, modes))
    return with_damping_ratios(system, external_damping, internal_damping)


def first_modes(system: System, static_load: float, count: int = 2) -> System:
    """Return a system reduced to its first free vibration modes at rest under a static load.

    Parameters
    ----------
    system : System
        It has the linear stiffness law.
    static_load : float
        p̄₀ [EI/L²]. The modes are those of the symmetric part of K, which differs from K under a
        follower load.
    count : int
        Number of modes.

    Returns
    -------
    System
        Shapes (count, count).

    Raises
    ------
    ValueError
        If the system has the exact stiffness, or the load is not finite.

    Notes
    -----
    For two modes of the base case with 4 coordinates the first two whirls are within 1e-4 up to
    Ω̄ = 1, and the fourth root is within 4e-3 at Ω̄ = 4.
    """
    stiffness = system.load_stiffness(static_load)
    symmetric = (stiffness + stiffness.T) / 2
    return system.projected(eigh(symmetric, system.mass, subset_by_index=(0, count - 1))[1])
