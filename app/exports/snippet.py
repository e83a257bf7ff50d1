"""The Python program that computes and draws what the Explore page shows.

It needs rotorstab alone; `program` makes a file or a notebook of its cells.
"""

from __future__ import annotations

import math

from rotorstab.model.stiffness import largest_exact_load
from rotorstab.model.stiffness_law import LINEAR

from ..results.analysis import BOUNDARY_ROWS
from ..results.curves import LARGEST_SPEED, LOADS, SPEEDS
from ..results.floquet_answer import TABLE_FACTOR
from ..results.limits import Detail, map_size
from ..results.marked_point import EDGE
from ..results.model import ELEMENTS, MODES, Operation
from ..results.window import chart_options
from ..state import State
from .program import Cell
from .program_case import MarkedPoint, ProgramCase, program_case
from .snippet_charts import drawing_lines

__all__ = ["python_cells"]

_ROUNDING = 1e-9  # of a time in periods


def _arguments(**values: object) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def _system(
    operation: Operation, tangency: float, law: str | None = None, damped: bool = True
) -> str:
    """Return the call that makes the system of an operation, with another tangency or law."""
    model = operation.model if damped else operation.model.undamped()
    options: dict[str, object] = {"tangency": tangency} if tangency else {}
    maker = "lumped"
    if model.kind != "lumped":
        maker = "finite_element"
        options |= {"elements": ELEMENTS, "modes": MODES}
    elif (law or model.law) != LINEAR:
        options["stiffness"] = law or model.law
    for name in ("external_damping", "internal_damping"):
        if getattr(model, name):
            options[name] = getattr(model, name)
    more = f", {_arguments(**options)}" if options else ""
    return f"{maker}(rotor, {operation.spin_speed!r}{more})"


def _rotor(case: ProgramCase) -> str:
    """Return the lines that make the rotor, from SI data where the charts show that shaft."""
    state, rotor = case.state, case.operation.model.rotor
    if case.in_si:
        data = "".join(f"    {name}={value!r},\n" for name, value in state.si_data().items())
        return (
            f"rotor, scales = ShaftDisk.from_si(  # m, Pa, kg/m³, kg, kg m²\n{data})\n"
            "hertz = scales.frequency / (2 * np.pi)  # what one unit of frequency is"
        )
    fields = _arguments(
        shear=rotor.shear,
        disk_mass=rotor.disk_mass,
        diametral_inertia=rotor.diametral_inertia,
        polar_inertia=rotor.polar_inertia,
        slenderness=rotor.slenderness,
    )
    line = f"rotor = ShaftDisk({fields})"
    if state.units != "SI":
        return line
    scales = state.scales()
    return (
        "# The sliders do not show the shaft in SI: this stays non-dimensional. With its scales\n"
        f"# one unit of load is {scales.load:.6g} N, of frequency {scales.frequency:.6g} rad/s,\n"
        f"# of length {scales.length:.6g} m, of mass {scales.mass:.6g} kg.\n{line}"
    )


def _curves(case: ProgramCase) -> str:
    """Return the lines of the load–frequency chart."""
    low, high = case.result.charts["load-frequency"].x_range
    systems = "".join(
        f"    {curves.name!r}: {_system(case.operation, curves.tangency, curves.law)},\n"
        for curves in case.load_cases
    )
    return (
        f"load_axis = np.linspace({low!r}, {high!r}, {LOADS})\n"
        f"load_systems = {{\n{systems}}}\n"
        "load_curves = {name: load_frequency_curves(one, load_axis)"
        " for name, one in load_systems.items()}\n"
    )


def _point(marked: MarkedPoint) -> str:
    """Return the lines of the marked point."""
    point, start, answer = marked.point, marked.start, marked.answer
    periods = math.ceil(answer.response.time[-1] / answer.response.period - _ROUNDING)
    end = "" if start.periods else f".until({EDGE!r})"
    seed = f", {start.seed}" if start.initial == "noise" else ""
    return f"""\
# inside the marked point
point = (
    static_load,
    {point.factor!r} * reference_load,
    {point.ratio!r} * frequency,
)
floquet = floquet_solution(system, *point)
multipliers, rate = floquet.multipliers, floquet.growth_rate
start = initial_conditions(system, static_load, {start.initial!r}{seed})
response = time_response(system, *point, start, {periods}, {answer.samples}){end}"""


_PRINTS = """\
print("whirl frequencies:", whirl)
print("unstable share of the window:", stability.unstable[np.isfinite(stability.growth)].mean())
for tongue in tongues:
    print(tongue.name, "at θ/ωₙ =", tongue.centre / frequency)"""
_PRINTS_SI = """\
print("whirl frequencies [Hz]:", whirl.real * hertz)
print("their growth [1/s]:", -whirl.imag * scales.frequency)
print("buckling load [N]:", critical_load(rotor.shear) * scales.load)
print("static load [N]:", static_load * scales.load)
print("unstable share of the window:", stability.unstable[np.isfinite(stability.growth)].mean())
print("largest growth [1/s]:", np.nanmax(stability.growth) * scales.frequency)
for tongue in tongues:
    print(tongue.name, "at", tongue.centre * hertz, "Hz")"""


def python_cells(state: State) -> list[Cell]:
    """Return the cells of a program that reproduces the view's arrays, prints and draws them.

    The program defines `whirl`, `load_curves`, `bolotin`, `stability`, `campbell`, `critical` and
    `tongues`; with a marker also `multipliers`, `rate` and `response`; in SI, where the charts
    show the shaft in SI, also `scales`. Where HoloViews is installed, `charts` are drawn.

    Raises
    ------
    UserError
        Where these inputs have no answer.
    """
    case = program_case(state)
    unit = "The rotor in SI; what is computed is" if case.in_si else "It is"
    cells = [
        Cell(f"What rotorstab shows, as Python. {unit} non-dimensional: L = EI = ρA = 1.", False),
        Cell(_model_lines(case)),
        Cell(_whirl_lines(case)),
        Cell(_instability(case)),
    ]
    if case.marked is not None:
        cells.append(Cell(_point(case.marked)))
    cells.append(Cell(_PRINTS_SI if case.in_si else _PRINTS))
    return [*cells, Cell(drawing_lines(case))]


def _model_lines(case: ProgramCase) -> str:
    """Return the lines that import what is used and make the rotor and its system."""
    operation = case.operation
    undamped = (
        f"undamped = {_system(operation, operation.tangency, damped=False)}"
        "  # Bolotin's method knows no damping\n"
        if operation.model.is_damped
        else ""
    )
    return f"""\
import numpy as np

from rotorstab import (
{_imports(case)})

{_rotor(case)}
system = {_system(operation, operation.tangency)}
{undamped}\
reference_load = {_reference_load(case)}  # what a load factor of 1 stands for
static_load = {case.state.static_load_factor!r} * reference_load
frequency = fundamental_frequency(lumped(rotor, 0.0))  # ω_n"""


def _whirl_lines(case: ProgramCase) -> str:
    """Return the lines of the load–frequency chart and of the Campbell diagram."""
    return f"""\
# whirl frequencies at the static load, over load, and over spin speed
whirl = whirl_frequencies(system, static_load)
{_curves(case)}\
campbell = campbell_diagram(system, np.linspace(0.0, {LARGEST_SPEED!r}, {SPEEDS}), static_load)
critical = critical_speeds(system, static_load)"""


def _imports(case: ProgramCase) -> str:
    """Return the names that the program imports, a line each."""
    names = {"ShaftDisk", "bolotin_chart", "campbell_diagram", "critical_load"}
    names |= {
        "critical_speeds",
        "flutter_load",
        "fundamental_frequency",
        "load_frequency_curves",
        "lumped",
        "resonances",
    }
    names |= {"stability_chart", "whirl_frequencies"}
    if case.operation.model.kind != "lumped":
        names.add("finite_element")
    if case.marked is not None:
        names |= {"floquet_solution", "initial_conditions", "time_response"}
    return "".join(f"    {name},\n" for name in sorted(names))


def _reference_load(case: ProgramCase) -> str:
    if case.state.reference == "buckling":
        return "float(critical_load(rotor.shear))"
    # up to the pole of the exact stiffness, as on the page
    pole = float(largest_exact_load(case.operation.model.rotor.shear))
    return f"flutter_load(lumped(rotor, 0.0, tangency=1.0), {pole!r})"


def _instability(case: ProgramCase) -> str:
    """Return the lines of the instability chart."""
    model, view = case.operation.model, case.view
    rows, columns, *_ = map_size(model, Detail.FULL)
    options = _arguments(**chart_options(model, Detail.FULL))
    undamped, largest = "undamped" if model.is_damped else "system", "largest_load"
    if math.isfinite(case.result.floquet.largest_computed_factor):  # the law ends inside the chart
        largest = f"min({largest}, system.largest_load - static_load)"
    return f"""\
# Bolotin's boundaries: bolotin.frequency / frequency over bolotin.pulsating_load / reference_load
largest_load = {view.high!r} * reference_load
bolotin = bolotin_chart({undamped}, static_load, {largest}, {BOUNDARY_ROWS})

# Floquet's growth rates on the chart's pixels, and the true tongues at a load factor of 0.1
low, high = {view.left!r} * frequency, {view.right!r} * frequency
loads = (np.arange({rows}) + 0.5) / {rows} * largest_load
frequencies = low + (np.arange({columns}) + 0.5) / {columns} * (high - low)
stability = stability_chart(
    system, static_load, loads, frequencies, edges=True, {options}
)
tongues = resonances(system, static_load, {TABLE_FACTOR:g} * reference_load).tongues"""
