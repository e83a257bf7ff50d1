"""Whatever says that a point is unstable says the same, also close to the edge of a tongue."""

import pytest

from app.exports.snippet import python_cells
from app.lessons.evaluation import evaluate
from app.pages.marked_point import inspect
from app.results.analysis import solve
from app.results.limits import Detail
from app.results.operation import operation_of
from app.state import State
from rotorstab import floquet_solution, stability_chart, tongue_edges

# relative distances from an edge; the last one is as small as the error of the edge itself
DISTANCES = (1e-4, 1e-6, 1e-9)
SETTINGS = {
    "undamped": {},
    "damped": {"external_damping": 0.01},
    "exact": {"law": "exact"},
    "finite elements": {"model": "finite elements"},
}


def _chart_error(state):
    """Return the distance from which on a chart knows on which side of an edge a point lies."""
    return 1e-6 if state.model == "lumped" else 1e-4


def chart_verdict(system, loads, frequency):
    """Return whether a chart draws the point within an edge."""
    chart = stability_chart(system, loads[0], loads[1:], [frequency], find_narrow=False, edges=True)
    return bool(chart.edges.function[0, 0] > 0)


def program_verdict(state):
    """Return what the Python program of the view computes at the marked point."""
    code = [cell.text for cell in python_cells(state) if cell.is_code]
    names: dict[str, object] = {}
    exec(code[0], names)  # the rotor and its system
    exec(next(text for text in code if text.startswith("# inside the marked point")), names)
    return bool(names["floquet"].unstable)


@pytest.mark.parametrize("setting", SETTINGS)
def test_every_room_says_the_same_close_to_an_edge(setting):
    options = {"spin_speed": 2.0, "static_load_factor": 0.5, **SETTINGS[setting]}
    factor = 0.4
    operation = operation_of(State(**options))
    system, unit = operation.system, operation.fundamental_frequency
    loads = operation.static_load, operation.pulsating_load(factor)
    edges = tongue_edges(system, loads[0], loads[1:], ("1B+1F",))
    for edge, inward in ((edges.left[0, 0], 1), (edges.right[0, 0], -1)):
        for distance in DISTANCES:
            for way in (1, -1):
                ratio = edge * (1 + way * inward * distance) / unit
                state = State(**options, marker_frequency=ratio, marker_factor=factor)
                inspection = inspect(state, solve(state, Detail.COARSE))
                truth = bool(floquet_solution(system, *loads, ratio * unit).unstable)
                growing = inspection.charts["multipliers"].layer("growing multipliers")
                verdicts = {
                    "sentence": inspection.sentence.startswith("Unstable"),
                    "table": dict(inspection.facts)["Floquet"] == "unstable",
                    "explanation": "the rotor is unstable" in inspection.explanation,
                    "multipliers": len(growing.columns["x"]) > 0,
                    "lesson": bool(evaluate("unstable", state.inputs())),
                    "program": program_verdict(state),
                }
                if distance > 1e-9:
                    assert truth == (way > 0)
                if distance >= _chart_error(state):
                    verdicts["chart"] = chart_verdict(system, loads, ratio * unit)
                assert set(verdicts.values()) == {truth}, (distance, way, verdicts)
