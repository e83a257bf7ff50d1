"""Charts as data: what every picture shows, before any drawing library.

Read `structure` first (a `Chart` is axes and layers of named columns), then the charts
(`instability` with `tongues` and `agreement`, `whirl`, `stiffness`, `point`, `pinned`), `si` for
their units, and `figure` for charts as panels of a figure. Any rotor is drawn by `rotor_drawing`,
`rotor_stability` and `rotor_whirl`. The live page, print and tables all see the same arrays.
"""

from .figure import Figure, Statement, chart_figure
from .instability import instability_chart
from .numbers import LOAD_UNITS, load_unit, written
from .pinned import outline_name
from .point import marker_layer, multiplier_chart, orbit_chart, pair_layers, response_chart
from .roles import ROLES, Role
from .rotor_drawing import rotor_drawing
from .rotor_stability import stability_chart_of
from .rotor_whirl import unsigned_campbell_chart, unsigned_load_chart
from .si import chart_factors, in_seconds, in_si
from .stiffness import error_loads, stiffness_charts, stiffness_loads
from .structure import Chart, Curve, Layer
from .tongues import GrowthGrid, fitted_top, with_top
from .whirl import campbell_chart, load_frequency_chart

__all__ = [
    "LOAD_UNITS",
    "ROLES",
    "Chart",
    "Curve",
    "Figure",
    "GrowthGrid",
    "Layer",
    "Role",
    "Statement",
    "campbell_chart",
    "chart_factors",
    "chart_figure",
    "error_loads",
    "fitted_top",
    "in_seconds",
    "in_si",
    "instability_chart",
    "load_frequency_chart",
    "load_unit",
    "marker_layer",
    "multiplier_chart",
    "orbit_chart",
    "outline_name",
    "pair_layers",
    "response_chart",
    "rotor_drawing",
    "stability_chart_of",
    "stiffness_charts",
    "stiffness_loads",
    "unsigned_campbell_chart",
    "unsigned_load_chart",
    "with_top",
    "written",
]
