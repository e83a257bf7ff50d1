"""Charts as data: what is drawn, before any drawing library.

A `Chart` is a frozen description (axes, layers of named columns). `plots` draws it, the
dashboard patches its columns, a table export writes them: all three see the same arrays.
"""

from .as_figure import chart_figure
from .instability import GrowthGrid, instability_chart
from .numbers import LOAD_UNITS, load_unit, written
from .point import marker_layer, multiplier_chart, orbit_chart, pair_layers, response_chart
from .roles import ROLES, Role
from .si import chart_factors, in_seconds, in_si
from .stiffness import error_loads, stiffness_charts
from .structure import Chart, Layer
from .whirl import campbell_chart, load_frequency_chart

__all__ = [
    "LOAD_UNITS",
    "ROLES",
    "Chart",
    "GrowthGrid",
    "Layer",
    "Role",
    "campbell_chart",
    "chart_factors",
    "chart_figure",
    "error_loads",
    "in_seconds",
    "in_si",
    "instability_chart",
    "load_frequency_chart",
    "load_unit",
    "marker_layer",
    "multiplier_chart",
    "orbit_chart",
    "pair_layers",
    "response_chart",
    "stiffness_charts",
    "written",
]
