"""Damping of a rotor from two damping ratios, which goes beyond the paper."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .._arguments import LARGEST, number
from .system import System, fundamental_frequency

__all__ = ["with_damping_ratios"]


def with_damping_ratios(system: System, external_damping: float, internal_damping: float) -> System:
    """Return an undamped system with external and rotating damping.

    C_e = 2ζ_e ω_n M acts on q̇ and C_i = (2ζ_i/ω_n) Ka on q̇ − jΩ̄q, where ω_n is the system's
    `fundamental_frequency`. At rest each of them alone gives the first mode its damping ratio ζ.

    Parameters
    ----------
    system : System
        Undamped.
    external_damping, internal_damping : float
        Damping ratios ζ_e and ζ_i [-], 0 or more.

    Returns
    -------
    System
        With two planes, damping that turns against the coordinates is a part of the
        `external_damping` and of the `spin_stiffness`.

    Raises
    ------
    ValueError
        If a ratio is out of range.
    """
    external = number("external_damping", external_damping, 0.0, LARGEST)
    internal = number("internal_damping", internal_damping, 0.0, LARGEST)
    if external == 0 and internal == 0:
        return system
    frequency = fundamental_frequency(system)
    outside = 2 * external * frequency * system.mass
    inside = 2 * internal / frequency * system.elastic
    if not system.planes:
        return replace(system, external_damping=outside, internal_damping=inside)
    # what turns against the coordinates: the inside, or in rotating coordinates the outside
    turning = inside if system.spin_softening is None else -outside
    across = np.roll(turning, system.size // 2, axis=1)
    return replace(
        system,
        external_damping=outside + inside,
        spin_stiffness=across if across.any() else None,
    )
