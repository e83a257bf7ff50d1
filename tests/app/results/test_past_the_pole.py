"""Loads near and past the pole of the exact stiffness: blank rows, and refusals in words."""

import math
import re

import numpy as np
import pytest

from app.lessons.evaluation import evaluate
from app.pages.marked_point import inspect
from app.results.analysis import solve
from app.results.limits import Detail
from app.session import Session
from app.state import State
from app.words.verdict import verdict
from rotorstab import ShaftDisk, bolotin_chart, lumped
from rotorstab.__main__ import main
from rotorstab._tolerances import MAP_SHORT_OF_POLE
from rotorstab.charts.agreement import Agreement
from rotorstab.model.stiffness import largest_exact_load

PAST = {"reference": "flutter", "law": "exact", "shear": 0.05, "largest_factor": 2.0}
# without a flutter load below the pole at 7.98: the linear law knows one at 19.26
STIFF = {
    "reference": "flutter",
    "spin_speed": 0.0,
    "shear": 0.1,
    "disk_mass": 9.0,
    "diametral_inertia": 0.02,
}
CLAMPED = "where a shaft clamped at both ends buckles"


def state_of(**values):
    state = State()
    assert state.change(values) == {}
    return state


def test_rows_of_the_map_past_the_pole_are_blank():
    state = state_of(**PAST)
    result = solve(state, Detail.FULL)
    pole = float(largest_exact_load(0.05))
    static, reference = result.numbers["static_load"], result.numbers["reference"]
    assert static + 2 * reference > pole
    limit = (pole * (1 - MAP_SHORT_OF_POLE) - static) / reference
    assert result.floquet.largest_computed_factor == pytest.approx(limit, rel=1e-12)
    chart = result.charts["instability"]
    growth = chart.layer("growth").columns["verdict"][0]
    factor = (np.arange(len(growth)) + 0.5) / len(growth) * 2.0
    assert (growth[factor > limit] == Agreement.NOT_COMPUTED).all()
    shown = growth[factor < limit]
    assert (shown != Agreement.NOT_COMPUTED).any(axis=1).all()
    assert Agreement.NOT_COMPUTED not in shown[:, growth.shape[1] // 2 :]
    heights = [np.nanmax(y) for y in chart.layer("boundary").columns["ys"]]
    assert max(heights) == pytest.approx(limit, rel=1e-9)
    assert all(y.max() <= limit * (1 + 1e-9) for y in chart.layer("Bolotin region").columns["ys"])
    blank = chart.layer("not computed")
    assert "beyond the exact stiffness law" in blank.columns["name"]
    assert blank.columns["ys"][0].min() == pytest.approx(limit)
    words = verdict(result.floquet)
    assert f"Above β_d = {limit:.3g} the map is blank" in words
    assert "the computed part of this window" in words


def test_the_boundaries_below_the_pole_are_those_of_a_lower_chart():
    state = state_of(**PAST, load_type="follower")
    result = solve(state, Detail.COARSE)
    drawn = result.charts["instability"].layer("boundary").columns
    static, reference = result.numbers["static_load"], result.numbers["reference"]
    low = bolotin_chart(
        lumped(state.rotor(), state.spin_speed, 1.0, stiffness="exact"), static, 0.3 * reference
    )
    for name, column in zip(low.names, low.frequency.T, strict=True):
        which = drawn["name"].index(f"{name} boundary")
        x, y = (np.asarray(drawn[key][which]) for key in ("xs", "ys"))
        at = np.interp(0.3, y, x) * result.numbers["fundamental"]
        assert at == pytest.approx(column[-1], rel=1e-3)


@pytest.mark.parametrize("law", ["linear", "exact"])
def test_a_flutter_load_past_the_pole_is_no_reference(law):
    state = state_of(**STIFF, law=law)
    with pytest.raises(ValueError, match=f"no flutter load below p̄ = 7.979, {CLAMPED}"):
        solve(state, Detail.COARSE)
    assert state.change({"reference": "buckling"}) == {}
    assert solve(state, Detail.COARSE).numbers["flutter"] is None
    inputs = state_of(**STIFF).inputs()
    assert evaluate("flutter", inputs) == math.inf
    with pytest.raises(ValueError, match=f"no flutter load below p̄ = 7.979, {CLAMPED}"):
        evaluate("static_load", inputs)


def test_a_static_load_that_leaves_no_room_below_the_pole_is_refused_in_words():
    # flutter at 0.98 of the pole
    stiff = {"shear": 0.1, "diametral_inertia": 0.3, "polar_inertia": 0.0, "reference": "flutter"}
    state = state_of(**stiff, static_load_factor=0.95, law="exact")
    with pytest.raises(ValueError, match=rf"must stay below p̄ = 7\.971, {CLAMPED}.* choose a smal"):
        solve(state, Detail.COARSE)
    assert state.change({"static_load_factor": 0.5}) == {}
    assert solve(state, Detail.COARSE).floquet.largest_computed_factor < 1


def test_a_marker_past_the_pole_is_refused_in_words():
    state = state_of(**PAST, marker=True, marker_factor=2.0)
    with pytest.raises(
        ValueError, match=rf"{CLAMPED}.* the load reaches .*: choose a smaller load"
    ):
        inspect(state, solve(state, Detail.COARSE))
    session = Session({key: [value] for key, value in LINK.items()})
    answer = session.respond({"type": "change", "values": {"marker": True, "marker_factor": 2.0}})
    assert answer["notice"] == ""
    assert CLAMPED in answer["inspector"]["sentence"]


def test_every_page_export_and_pin_of_such_a_state_has_an_answer():
    session = Session({key: [value] for key, value in LINK.items()})
    for message in (
        {"type": "settle"},
        {"type": "pin", "label": "past"},
        {"type": "python"},
        *({"type": "page", "name": name} for name in ("stiffness", "paper", "lessons", "explore")),
        {"type": "change", "values": {"stiffness": "exact", "units": "SI"}},
    ):
        answer = session.respond(message)
        assert answer["notice"] == ""
        assert "pole" not in answer.get("toast", "")
    assert len(session.pages["explore"].pins) == 1


LINK = {"v": "1", "ref": "flutter", "law": "exact", "phi": "0.05", "bmax": "2", "fmax": "3"}


def test_a_link_to_a_reference_past_the_pole_says_why():
    link = {"v": "1", "ref": "flutter", "phi": "0.1", "md": "9", "id": "0.02"}
    session = Session({key: [value] for key, value in link.items()})
    assert CLAMPED in session.notice
    told = [
        session.respond({"type": kind}).get("toast", "") for kind in ("python", "report", "pin")
    ]
    assert all(CLAMPED in one for one in told)
    answer = session.respond({"type": "change", "values": {"reference": "buckling"}})
    assert answer["notice"] == ""


def test_regions_of_the_command_line_past_the_pole_are_one_clear_line(capsys):
    assert main(["regions", "--stiffness", "exact", "--largest-factor", "20"]) != 0
    words = capsys.readouterr().err
    assert re.search(
        r"must be below 9\.52\d*, where the exact stiffness has its pole, got 20", words
    )


def test_a_chart_of_the_library_refuses_what_it_cannot_draw():
    system = lumped(ShaftDisk(), 1.0, stiffness="exact")
    with pytest.raises(ValueError, match=r"`static_load` \+ \|`pulsating_load`\| must be below"):
        bolotin_chart(system, 1.0, 25.0)
