"""The comparator: the same rotor with a distributed shaft, by finite elements."""

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
    """Return the rotor with a distributed shaft: mass, rotary inertia, shear, gyroscopics.

    Parameters
    ----------
    rotor : ShaftDisk
        Its disk may be absent (masses 0); `slenderness` r gives the rotary inertia r²
        and the gyroscopic moment 2r² of the shaft per unit of length.
    spin_speed : (...) float
        Ω̄ [√(EI/(ρAL⁴))].
    tangency : float
        μ, in [0, 1]: 0 axial, 1 follower.
    elements : int
        Number of elements, 1 to 200.
    modes : int, optional
        Reduce to this many complex degrees of freedom, 2 to 2 `elements`. All by default.
    external_damping, internal_damping : float
        ζ_e, ζ_i, 0 or more: C_e = 2ζ_e ω_n M and C_i = (2ζ_i/ω_n) Ka with this system's
        own ω_n.

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
    Frequencies converge from above, with h⁴ at Φ = 0, r = 0 and with h² otherwise: at 20
    elements the whirl frequencies 2B, 1B, 1F, 2F of the base case at Ω̄ 0 to 5 are within
    1.2e-5 of the mesh limit.

    The reduction keeps the tip itself, so the disk's inertia, its gyroscopic moment and the
    follower term stay exact, and approximates only the inside of the shaft. 3 to 9 coordinates
    are chosen for this rotor and load type: the leading directions of its own whirl modes 2B, 1B,
    1F, 2F, right and left ones, at spin speeds 0 and 4 and at loads between ±0.95 p̄_cr. Every spin
    speed and load has the same basis. `modes=2` is the lumped model with the shaft's consistent
    mass added.

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

    Take 4 or more. The largest errors are those of light disks and of a frequency near 0, close
    to buckling. The frequency of the third mode is right to some 1 % with 4 coordinates; what
    higher modes take part in is not to be trusted. A stocky shaft (Φ 0.3, r 0.3) or none but the
    shaft's own mass needs 6 for 1e-3.

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
    """Return a system kept to its first free vibration modes at rest under a steady load.

    Parameters
    ----------
    system : System
    static_load : float
        p̄₀ [EI/L²]; of a follower load the symmetric part of K is taken.
    count : int

    Returns
    -------
    System
        Shapes (count, count).

    Notes
    -----
    For the base case with 4 modes the two kept whirls are within 1e-4 up to Ω̄ = 1, the fourth
    root within 4e-3 at Ω̄ = 4.
    """
    stiffness = system.load_stiffness(static_load)
    symmetric = (stiffness + stiffness.T) / 2
    return system.projected(eigh(symmetric, system.mass, subset_by_index=(0, count - 1))[1])
