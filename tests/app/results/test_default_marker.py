"""The marker that a page places by rule: inside the tongue 1B+1F until the user moves it."""

import pytest

from app.reading.user_error import UserError
from app.results.default_marker import default_marker, place_marker
from app.results.model import model_of
from app.session import Session
from app.state import State
from rotorstab import (
    critical_load,
    fundamental_frequency,
    growth_rate,
    lumped,
    resonances,
)


def state_of(**values):
    state = State()
    assert state.change(values) == {}
    return state


def growth(state):
    """The growth rate at the marker of a state whose load factors refer to buckling."""
    system = model_of(state).system(state.spin_speed, state.effective_tangency())
    reference = float(critical_load(state.rotor().shear))
    return growth_rate(
        system,
        state.static_load_factor * reference,
        state.marker_factor * reference,
        state.marker_frequency * fundamental_frequency(lumped(state.rotor(), 0.0)),
    )


def centre(state):
    """θ/ω_n of the resonance 1B+1F."""
    system = model_of(state).system(state.spin_speed, state.effective_tangency())
    static = state.static_load_factor * float(critical_load(state.rotor().shear))
    return resonances(system, static, 0.1)["1B+1F"].centre / fundamental_frequency(
        lumped(state.rotor(), 0.0)
    )


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"spin_speed": 0.0},
        {"spin_speed": 4.0},
        {"static_load_factor": 0.9},
        {"shear": 0.1, "disk_mass": 1.0},
        {"external_damping": 0.03},
        {"external_damping": 0.02, "internal_damping": 0.01},
        {"law": "exact", "static_load_factor": 0.2},
        {"model": "finite elements"},
        {"largest_factor": 0.1},
        {"highest_frequency": 6.0},
    ],
)
def test_the_rule_finds_the_tongue(values):
    state = state_of(**values)
    place_marker(state)
    assert growth(state) > 1e-4
    assert state.marker_frequency == pytest.approx(centre(state), abs=0.006)
    assert 0 < state.marker_factor <= state.largest_factor / 2


def test_the_inputs_begin_where_the_rule_places_the_marker():
    state = State()
    assert default_marker(state) == (state.marker_frequency, state.marker_factor)


@pytest.mark.parametrize(
    ("values", "centre"),
    [
        ({"lowest_frequency": 3.0, "highest_frequency": 5.0}, 4.0),  # 2B+1F
        ({"load_type": "follower", "static_load_factor": 0.2}, 2.16),  # 1B+2B
    ],
)
def test_another_tongue_is_taken_where_1b_1f_makes_none_in_the_chart(values, centre):
    state = state_of(**values)
    place_marker(state)
    assert growth(state) > 1e-4
    assert state.marker_frequency == pytest.approx(centre, abs=0.1)


def test_a_chart_without_a_tongue_has_a_marker_inside():
    state = state_of(lowest_frequency=12.0, highest_frequency=13.0)
    place_marker(state)
    assert 12 <= state.marker_frequency <= 13


def test_it_follows_the_sliders_until_it_is_moved():
    session = Session()
    answer = session.respond({"type": "change", "values": {"spin_speed": 1.0}})
    assert answer["values"]["marker_frequency"] == pytest.approx(centre(session.state), abs=0.006)
    moved = {"marker_frequency": 2.5}
    assert not session.respond({"type": "change", "values": moved})["values"]["marker_follows"]
    answer = session.respond({"type": "change", "values": {"spin_speed": 2.0}})
    assert answer["values"]["marker_frequency"] == 2.5
    answer = session.respond({"type": "change", "values": {"marker_follows": True}})
    assert answer["values"]["marker_frequency"] == 1.68
    session.respond({"type": "change", "values": moved})
    assert session.respond({"type": "reset"})["values"]["marker_follows"]


@pytest.mark.parametrize(
    ("query", "wanted"),
    [
        ({}, (True, True, 1.68, 0.5)),
        ({"spin": "1"}, (True, True, 1.53, 0.5)),
        # links of earlier versions, without a marker and with one
        ({"at": "0", "f": "2.5", "b": "0.3"}, (True, True, 1.68, 0.5)),
        ({"at": "1", "f": "2.5", "b": "0.3"}, (True, False, 2.5, 0.3)),
        # removed by the user
        ({"at": "0", "follow": "1", "f": "1.68", "b": "0.5"}, (False, True, 1.68, 0.5)),
    ],
)
def test_a_link_has_the_marker_that_it_names_or_the_default_one(query, wanted):
    session = Session({"v": ["1"]} | {key: [value] for key, value in query.items()})
    state = session.state
    found = state.marker, state.marker_follows, state.marker_frequency, state.marker_factor
    assert found == pytest.approx(wanted, abs=0.05)
    again = Session({k: [v] for k, v in (one.split("=") for one in session.query().split("&"))})
    assert again.query() == session.query()


def test_a_rotor_without_a_chart_leaves_the_marker_where_it_is():
    # the flutter load is 0.98 of the load at which the exact law ends
    stiff = {"shear": 0.1, "diametral_inertia": 0.3, "polar_inertia": 0.0, "reference": "flutter"}
    state = state_of(**stiff, law="exact", static_load_factor=0.95)
    with pytest.raises(UserError, match="stiffness law ends"):
        default_marker(state)
    before = state.inputs()
    place_marker(state)
    assert state.inputs() == before
