"""Whirl frequencies of Table 1's rotor, in SI units."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from ...charts.modes import modes
from ...model.finite_element import finite_element
from ...model.lumped import lumped
from ...model.system import System
from ...rotors.shaft_disk import TABLE_1_SI, Scales, ShaftDisk
from ...whirl.critical_loads import critical_load
from ...whirl.frequencies import whirl_frequencies
from ...whirl.mode_names import mode_names

__all__ = ["table_1_rotor", "table_1_whirl"]


@cache
def table_1_rotor() -> tuple[ShaftDisk, Scales]:
    """Return the rotor and its scales."""
    return ShaftDisk.from_si(**TABLE_1_SI)


@cache
def _system(model: str, rpm: float) -> System:
    """Return Table 1's rotor by one model at one speed."""
    rotor, scales = table_1_rotor()
    spin = rpm * math.pi / 30 / scales.frequency
    return lumped(rotor, spin) if model == "lumped" else finite_element(rotor, spin, elements=40)


def table_1_whirl(model: str, rpm: float, factor: float, mode: str) -> float:
    """Return |ω| [rad/s] of a whirl mode of Table 1's rotor."""
    rotor, scales = table_1_rotor()
    whirl = whirl_frequencies(_system(model, rpm), factor * critical_load(rotor.shear)).real
    wanted = next(known for known in modes(mode_names(whirl.size // 2)) if known.name == mode)
    side = whirl[whirl > 0] if wanted.forward else -whirl[whirl < 0]
    return float(np.sort(side)[wanted.number - 1] * scales.frequency)
