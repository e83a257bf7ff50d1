"""The last cell of the Python program: it draws the charts with HoloViews, where it is there."""

from __future__ import annotations

from ..results.analysis import GROWTH_TOPS
from ..results.marked_point import Point
from .program_case import ProgramCase

__all__ = ["drawing_lines"]

FILE = "rotorstab-view.html"
_REPLACE = "from dataclasses import replace\n\n"


def drawing_lines(case: ProgramCase) -> str:
    """Return the lines that draw what the program has computed."""
    view, spin = case.view, case.operation.spin_speed
    growth_unit = case.state.growth_unit
    buckling, flutter = case.marked_loads
    instability = "" if case.marked is None else _marked(case.marked.point)
    return f"""\
# the charts, as the page draws them
{"" if case.marked is None else _REPLACE}from rotorstab.charts import (
{_imports(case)})

growth = GrowthGrid(
    stability.growth,
    stability.unstable,
    None,
    ({view.left!r}, {view.right!r}, 0.0, {view.high!r}),
    {growth_unit == "per period"!r},
    stability.edges,
    stability.growth[: len(stability.edges.pulsating_loads)],
    {GROWTH_TOPS[growth_unit]!r},
)
limits = {{
    "{buckling}": float(critical_load(rotor.shear)),
    "{flutter}": flutter_load(lumped(rotor, {spin!r}, tangency=1.0)),
}}
charts = [
    instability_chart(
        bolotin,
        frequency,
        reference_load,
        ({view.left!r}, {view.right!r}),
        {view.high!r},
        growth,
        [(tongue.centre / frequency, tongue.name) for tongue in tongues],
    ),
    load_frequency_chart(load_curves, static_load, limits),
    campbell_chart(campbell, {spin!r}, critical),
]
{instability}{_SI if case.in_si else ""}{"" if case.marked is None else _point(case.in_si)}
{_VIEW}"""


def _imports(case: ProgramCase) -> str:
    """Return the names of charts that the program imports, a line each."""
    names = ["GrowthGrid", "campbell_chart", "instability_chart", "load_frequency_chart"]
    if case.in_si:
        names += ["in_si"] if case.marked is None else ["in_seconds", "in_si"]
    if case.marked is not None:
        names += ["marker_layer", "multiplier_chart", "orbit_chart", "response_chart"]
    return "".join(f"    {name},\n" for name in sorted(names, key=_import_order))


_VIEW = f"""\
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


def _marked(point: Point) -> str:
    return f"""\
marker = marker_layer({point.ratio!r}, {point.factor!r})
charts[0] = replace(charts[0], layers=(*charts[0].layers, marker))
"""


_SI = "charts = [in_si(chart, scales, frequency, reference_load) for chart in charts]\n"


def _point(in_si: bool) -> str:
    motion = "response_chart(response)"
    if in_si:
        motion = f"in_seconds({motion}, response.period / scales.frequency)"
    return f"charts += [{motion}, multiplier_chart(floquet), orbit_chart(response)]\n"
