"""The load–frequency chart and the Campbell diagram: all of them, or the part that a zoom shows."""

from __future__ import annotations

import math

from rotorstab import critical_speeds
from rotorstab.charts import Chart, campbell_chart, load_frequency_chart

from .curves import campbell, largest_load, load_cases, load_curves, marked_loads
from .model import Operation
from .views import View

__all__ = ["WHIRL_CHARTS", "whirl_bounds", "whirl_chart"]

WHIRL_CHARTS = ("load-frequency", "campbell")
_BEYOND = 2  # widths of the whole chart by which a zoom may leave it on each side


def whirl_chart(key: str, operation: Operation, stiffness: str, seen: View | None = None) -> Chart:
    """Return one of `WHIRL_CHARTS`.

    Parameters
    ----------
    key : str
    operation : Operation
    stiffness : str
        "linear", "exact" or "both", for the load–frequency chart.
    seen : View, optional
        The part that a zoom shows.
    """
    ranges = None if seen is None else (seen.x, seen.y)
    model, spin, tangency = operation.model, operation.spin_speed, operation.tangency
    if key == "campbell":
        curves = campbell(model, tangency, operation.static_load, seen)
        critical = critical_speeds(operation.system, operation.static_load)
        return campbell_chart(curves, spin, critical, ranges)
    cases = load_cases(model.kind, tangency, stiffness)
    limits = marked_loads(model.rotor, spin, cases)
    loads = load_curves(model, spin, tangency, stiffness, seen)
    return load_frequency_chart(loads, operation.static_load, limits, ranges)


def whirl_bounds(chart: Chart, operation: Operation) -> View:
    """Return the largest part of the axes of a whole chart that a zoom may show."""
    (left, right), (low, high) = chart.x_range, chart.y_range
    across, up = _BEYOND * (right - left), _BEYOND * (high - low)
    if chart.key == "campbell":
        least, most = 0.0, math.inf  # Ω̄ < 0 only exchanges backward and forward
    else:
        least, most = -math.inf, largest_load(operation.model.rotor)
    return View(max(left - across, least), min(right + across, most), low - up, high + up)
