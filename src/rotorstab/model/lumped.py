"""The paper's model: a shaft without mass, and a disk with two degrees of freedom at its tip."""

from __future__ import annotations

import numpy as np

from .._arguments import LARGEST, choice, number, numbers
from .._types import ArrayLike
from ..rotors.shaft_disk import ShaftDisk
from .damping import with_damping_ratios
from .stiffness import linear_stiffness
from .stiffness_law import STIFFNESS_LAWS
from .system import System

__all__ = ["lumped"]


def lumped(
    rotor: ShaftDisk,
    spin_speed: ArrayLike,
    tangency: float = 0.0,
    external_damping: float = 0.0,
    internal_damping: float = 0.0,
    stiffness: str = "linear",
) -> System:
    """Return the paper's model of two complex degrees of freedom, Eqs. (7)–(17).

    Parameters
    ----------
    rotor : ShaftDisk
        It needs a disk: `disk_mass` and `diametral_inertia` above 0.
    spin_speed : (...) float
        Ω̄ [√(EI/(ρAL⁴))].
    tangency : float
        μ [-], in [0, 1]: 0 axial, 1 follower.
    external_damping, internal_damping : float
        Damping ratios ζ_e and ζ_i [-], 0 or more (beyond the paper): C_e = 2ζ_e ω_n M and
        C_i = (2ζ_i/ω_n) Ka, acting on q̇ and on q̇ − jΩ̄q.
    stiffness : {"linear", "exact"}
        A name in `STIFFNESS_LAWS`: the law of the stiffness over the load: Eq. (9) or Appendix A.

    Returns
    -------
    System
        Shapes (2, 2); the coordinates are the displacement and the slope of the tip.
        `spin_speed` keeps its shape.

    Raises
    ------
    ValueError
        If an argument is out of range, or the law has another name.

    Notes
    -----
    The mass of the shaft is neglected. The model is good for M̄_D of about 3 or more, and for the
    first mode.

    References
    ----------
    Eqs. (7)–(17), (B1)–(B9) and Appendix A of the source paper.

    Examples
    --------
    >>> lumped(ShaftDisk(), 2.0).size
    2
    """
    disk_mass = number("disk_mass", rotor.disk_mass, 0.0, open_low=True)
    inertia = number("diametral_inertia", rotor.diametral_inertia, 0.0, open_low=True)
    tangency = number("tangency", tangency, 0.0, 1.0)
    law = STIFFNESS_LAWS[choice("stiffness", stiffness, tuple(STIFFNESS_LAWS))]
    elastic, geometric = linear_stiffness(rotor.shear, tangency)
    system = System(
        mass=np.diag([disk_mass, inertia]),  # Eq. (14)
        gyroscopic=np.diag([0.0, rotor.polar_inertia]),  # Eq. (15)
        external_damping=np.zeros((2, 2)),
        internal_damping=np.zeros((2, 2)),
        elastic=elastic,
        geometric=geometric,
        spin_speed=numbers("spin_speed", spin_speed, -LARGEST, LARGEST),
        tangency=tangency,
        law=law(rotor.shear, tangency),
    )
    return with_damping_ratios(system, external_damping, internal_damping)
