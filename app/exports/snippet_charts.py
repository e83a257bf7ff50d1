"""The last cell of the Python program: it draws the charts with HoloViews, where it is there."""

from __future__ import annotations

from ..results.analysis import GROWTH_TOPS
from ..results.curves import load_cases
from ..state import State

__all__ = ["drawing_lines"]

FILE = "rotorstab-view.html"
_REPLACE = "from dataclasses import replace\n\n"


def drawing_lines(state: State, in_si: bool) -> str:
    """Return the lines that draw what the program has computed.

    Parameters
    ----------
    state : State
    in_si : bool
        Whether the charts show the shaft in SI.
    """
    names = ["GrowthGrid", "campbell_chart", "instability_chart", "load_frequency_chart"]
    if in_si:
        names += ["in_seconds", "in_si"] if state.marker else ["in_si"]
    if state.marker:
        names += ["marker_layer", "multiplier_chart", "orbit_chart", "response_chart"]
    imports = "".join(f"    {name},\n" for name in sorted(names, key=_import_order))
    cases = load_cases(state.model, state.effective_tangency(), state.stiffness)
    # the flutter load is that of the linear law, whatever law the curves are of
    flutter = "flutter, linear" if any(case.law == "exact" for case in cases) else "flutter"
    per_period, top = state.growth_unit == "per period", GROWTH_TOPS[state.growth_unit]
    instability = _marked(state) if state.marker else ""
    return f"""\
# the charts, as the page draws them
{_REPLACE if state.marker else ""}from rotorstab.charts import (
{imports})

growth = GrowthGrid(
    stability.growth,
    stability.unstable,
    None,
    ({state.lowest_frequency!r}, {state.highest_frequency!r}, 0.0, {state.largest_factor!r}),
    {per_period!r},
    stability.edges,
    stability.growth[: len(stability.edges.pulsating_loads)],
    {top!r},
)
limits = {{
    "buckling": float(critical_load(rotor.shear)),
    "{flutter}": flutter_load(lumped(rotor, {state.spin_speed!r}, tangency=1.0)),
}}
charts = [
    instability_chart(
        bolotin,
        frequency,
        reference_load,
        ({state.lowest_frequency!r}, {state.highest_frequency!r}),
        {state.largest_factor!r},
        growth,
        [(tongue.centre / frequency, tongue.name) for tongue in tongues],
    ),
    load_frequency_chart(load_curves, static_load, limits),
    campbell_chart(campbell, {state.spin_speed!r}, critical),
]
{instability}{_SI if in_si else ""}{_point(in_si) if state.marker else ""}
try:
    import holoviews as hv

    hv.extension("bokeh")
except ImportError:
    view = None
    print("HoloViews draws the charts: pip install 'rotorstab[app]'")
else:
    view = hv.Layout([chart.plot() for chart in charts]).opts(shared_axes=False).cols(1)
    hv.save(view, "{FILE}", resources="inline")
    print("the charts are in {FILE}")
view"""


def _import_order(name: str) -> tuple[bool, str]:
    """Return a key that sorts classes before functions."""
    return name[0].islower(), name


def _marked(state: State) -> str:
    return f"""\
marker = marker_layer({state.marker_frequency!r}, {state.marker_factor!r})
charts[0] = replace(charts[0], layers=(*charts[0].layers, marker))
"""


_SI = "charts = [in_si(chart, scales, frequency, reference_load) for chart in charts]\n"


def _point(in_si: bool) -> str:
    motion = "response_chart(response)"
    if in_si:
        motion = f"in_seconds({motion}, response.period / scales.frequency)"
    return f"charts += [{motion}, multiplier_chart(floquet), orbit_chart(response)]\n"
