"""Parametric instability of a cantilever shaft–disk rotor under a pulsating load."""

from .bolotin import BolotinChart, bolotin_chart, boundary_frequencies, in_bolotin_region
from .critical import beck_load, critical_load, flutter_load
from .finite_element import finite_element
from .rotor import BASE_CASE, EULER_BERNOULLI_TWIN, TABLE_1_SI, Scales, ShaftDisk
from .stiffness import exact_stiffness, linear_stiffness
from .system import System, fundamental_frequency, lumped
from .whirl import (
    CriticalSpeeds,
    WhirlCurves,
    campbell_diagram,
    critical_speeds,
    load_frequency_curves,
    whirl_frequencies,
)

__all__ = [
    "BASE_CASE",
    "EULER_BERNOULLI_TWIN",
    "TABLE_1_SI",
    "BolotinChart",
    "CriticalSpeeds",
    "Scales",
    "ShaftDisk",
    "System",
    "WhirlCurves",
    "beck_load",
    "bolotin_chart",
    "boundary_frequencies",
    "campbell_diagram",
    "critical_load",
    "critical_speeds",
    "exact_stiffness",
    "finite_element",
    "flutter_load",
    "fundamental_frequency",
    "in_bolotin_region",
    "linear_stiffness",
    "load_frequency_curves",
    "lumped",
    "whirl_frequencies",
]
