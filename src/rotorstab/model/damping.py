"""Damping of a rotor from two damping ratios, which goes beyond the paper."""

from __future__ import annotations

from dataclasses import replace

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
    return replace(
        system,
        external_damping=2 * external * frequency * system.mass,
        internal_damping=2 * internal / frequency * system.elastic,
    )
