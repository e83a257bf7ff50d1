"""Parametric instability of a cantilever shaft–disk rotor under a pulsating load."""

from .bolotin.boundaries import boundary_frequencies
from .bolotin.chart import BolotinChart, bolotin_chart
from .bolotin.hill import hill_boundary_frequencies
from .bolotin.regions import bolotin_mask, in_bolotin_region
from .floquet.criterion import grows_or_decays, is_unstable, mean_is_unstable
from .floquet.first_order import FirstOrderRegion, first_order_regions
from .floquet.initial_conditions import initial_conditions
from .floquet.point import FloquetSolution, floquet_multipliers, floquet_solution, growth_rate
from .floquet.resonance import resonances
from .floquet.resonance_table import Resonance, ResonanceTable
from .floquet.response import TimeResponse, time_response
from .floquet.tongues.edges import TongueEdges, tongue_edges
from .floquet.tongues.outlines import Outline, unstable_outlines
from .maps.margin import CriticalPulsation, StabilityMargin, critical_pulsation, stability_margin
from .maps.stability_map import StabilityChart, stability_chart, stability_map
from .model.finite_element import finite_element
from .model.lumped import lumped
from .model.periodic_load import FittedLoad, PeriodicLoad
from .model.rotor_system import RotorShapes
from .model.shaft_shape import ShaftShape, shaft_shape
from .model.stiffness import PastPole, exact_stiffness, largest_exact_load, linear_stiffness
from .model.stiffness_law import STIFFNESS_LAWS, StiffnessLaw
from .model.system import System, fundamental_frequency
from .rotors.materials import MATERIALS, Material
from .rotors.parts import AxialLoad, Bearing, Disk
from .rotors.presets import PRESETS
from .rotors.ross import NotCarriedOver
from .rotors.rotor import Rotor
from .rotors.sections import ShaftSection, Sleeve
from .rotors.shaft_disk import BASE_CASE, EULER_BERNOULLI_TWIN, TABLE_1_SI, Scales, ShaftDisk
from .whirl.campbell import WhirlCurves, campbell_diagram, load_frequency_curves
from .whirl.critical_loads import beck_load, critical_load, flutter_load
from .whirl.critical_speeds import CriticalSpeeds, critical_speeds
from .whirl.frequencies import whirl_frequencies
from .whirl.mode_names import mode_names, named_frequencies

__all__ = [
    "BASE_CASE",
    "EULER_BERNOULLI_TWIN",
    "MATERIALS",
    "PRESETS",
    "STIFFNESS_LAWS",
    "TABLE_1_SI",
    "AxialLoad",
    "Bearing",
    "BolotinChart",
    "CriticalPulsation",
    "CriticalSpeeds",
    "Disk",
    "FirstOrderRegion",
    "FittedLoad",
    "FloquetSolution",
    "Material",
    "NotCarriedOver",
    "Outline",
    "PastPole",
    "PeriodicLoad",
    "Resonance",
    "ResonanceTable",
    "Rotor",
    "RotorShapes",
    "Scales",
    "ShaftDisk",
    "ShaftSection",
    "ShaftShape",
    "Sleeve",
    "StabilityChart",
    "StabilityMargin",
    "StiffnessLaw",
    "System",
    "TimeResponse",
    "TongueEdges",
    "WhirlCurves",
    "beck_load",
    "bolotin_chart",
    "bolotin_mask",
    "boundary_frequencies",
    "campbell_diagram",
    "critical_load",
    "critical_pulsation",
    "critical_speeds",
    "exact_stiffness",
    "finite_element",
    "first_order_regions",
    "floquet_multipliers",
    "floquet_solution",
    "flutter_load",
    "fundamental_frequency",
    "grows_or_decays",
    "growth_rate",
    "hill_boundary_frequencies",
    "in_bolotin_region",
    "initial_conditions",
    "is_unstable",
    "largest_exact_load",
    "linear_stiffness",
    "load_frequency_curves",
    "lumped",
    "mean_is_unstable",
    "mode_names",
    "named_frequencies",
    "resonances",
    "shaft_shape",
    "stability_chart",
    "stability_map",
    "stability_margin",
    "time_response",
    "tongue_edges",
    "unstable_outlines",
    "whirl_frequencies",
]
