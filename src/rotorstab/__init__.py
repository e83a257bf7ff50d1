"""Parametric instability of a cantilever shaft–disk rotor under a pulsating load."""

from .rotor import BASE_CASE, EULER_BERNOULLI_TWIN, TABLE_1_SI, Scales, ShaftDisk
from .stiffness import exact_stiffness, linear_stiffness
from .system import System, fundamental_frequency, lumped

__all__ = [
    "BASE_CASE",
    "EULER_BERNOULLI_TWIN",
    "TABLE_1_SI",
    "Scales",
    "ShaftDisk",
    "System",
    "exact_stiffness",
    "fundamental_frequency",
    "linear_stiffness",
    "lumped",
]
