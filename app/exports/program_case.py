"""What the program of a view is of: the page's own results, which the program computes again."""

from __future__ import annotations

from dataclasses import dataclass

from ..results.analysis import Result, home_view, solve
from ..results.curves import LoadCase, load_cases, marked_loads
from ..results.limits import Detail
from ..results.marked_point import Point, PointAnswer, Start, marked_point, solve_point
from ..results.model import Operation
from ..results.operation import operation_of
from ..results.views import View
from ..state import State

__all__ = ["MarkedPoint", "ProgramCase", "program_case"]


@dataclass(frozen=True, eq=False)
class MarkedPoint:
    """The marked point of a view, how its motion starts, and what the solver has of it."""

    point: Point
    start: Start
    answer: PointAnswer


@dataclass(frozen=True, eq=False)
class ProgramCase:
    """One view of the Explore page.

    Parameters
    ----------
    state : State
    operation : Operation
    view : View
        The whole instability chart, without a zoom.
    load_cases : tuple of LoadCase
        Of the load–frequency chart.
    marked_loads : tuple of str
        Names of the loads that this chart marks: buckling, then flutter.
    result : Result
        With a coarse map: the program makes its own.
    marked : MarkedPoint or None
    in_si : bool
        Whether the charts show the shaft in SI, so that the program can begin with its data.
    """

    state: State
    operation: Operation
    view: View
    load_cases: tuple[LoadCase, ...]
    marked_loads: tuple[str, ...]
    result: Result
    marked: MarkedPoint | None
    in_si: bool


def program_case(state: State) -> ProgramCase:
    """Return what the program of a state is of.

    Raises
    ------
    UserError
        Where these inputs have no answer.
    """
    result = solve(state, Detail.COARSE)
    operation = operation_of(state)
    cases = load_cases(operation.model.kind, operation.tangency, state.stiffness)
    marked = None
    if state.marker:
        point, start = marked_point(state)
        marked = MarkedPoint(point, start, solve_point(point, start))
    return ProgramCase(
        state,
        operation,
        home_view(state.inputs()),
        tuple(cases),
        tuple(marked_loads(operation.model.rotor, operation.spin_speed, cases)),
        result,
        marked,
        state.units == "SI" and state.shaft_in_use(),
    )
