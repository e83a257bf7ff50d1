"""Whatever a client sends, the solver sees finite numbers within State's bounds.

Seeded streams in a short form; `python -m benchmarks abuse` sends the long one over a socket.
"""

import json
import math
import random
from urllib.parse import parse_qs

import numpy as np
import pytest

from app.pages.marked_point import inspect
from app.results import analysis, limits, window
from app.results.limits import Detail
from app.results.model import model_of
from app.session import Session
from app.state import State
from app.state.address import from_arguments, pins_from_arguments
from app.state.rotor_file import read_rotor_file, write_rotor_file
from app.words.verdict import verdict
from rotorstab import BASE_CASE, lumped, stability_chart, whirl_frequencies
from tests.testing import hostile, spy
from tests.testing.wire import encoded

SEED = 20260601


@pytest.fixture(scope="module")
def watched():
    """A session whose solver is spied on."""
    with pytest.MonkeyPatch.context() as patch:
        calls, violations = spy.watch(patch.setattr)
        yield Session(), calls, violations


@pytest.fixture
def session(watched):
    """The session at its start; any violation during the test fails it."""
    session, calls, violations = watched
    session.respond({"type": "page", "name": "explore"})
    session.respond({"type": "reset"})
    yield session
    assert violations == []
    assert sum(calls.values()) > 50


def in_bounds(state):
    """Whether every input is a value that its control can give."""
    for name, value in state.inputs().items():
        bounds = getattr(State.param[name], "bounds", None)
        if bounds:
            assert isinstance(value, float)
            assert bounds[0] <= value <= bounds[1]
        else:
            assert value in getattr(State.param[name], "objects", (True, False))


def test_the_spy_sees_every_way_into_the_solver():
    points = {(module.__name__, name) for module, name, _ in spy.entry_points()}
    assert {
        ("app.results.window", "stability_chart"),
        ("app.results.curves", "lumped"),
        ("app.results.curves", "campbell_diagram"),
        ("app.results.analysis", "bolotin_chart"),
        ("app.results.marked_point", "time_response"),
        ("app.results.marked_point", "floquet_solution"),
        ("app.lessons.situation", "whirl_frequencies"),
    } <= points


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("spin_speed", math.nan),
        ("spin_speed", 4.001),
        ("spin_speed", -1e308),
        ("loads", np.array([0.0, math.inf])),
        ("pulsating_loads", [-0.1]),
        ("tangency", 1.5),
        ("anything", 1e7),
        ("rotor", {"shear": complex(0, math.nan)}),
    ],
)
def test_the_spy_finds_what_it_is_for(name, value):
    with pytest.raises(spy.Unclamped):
        spy.check(name, value)


def test_the_spy_keeps_its_own_account():
    calls, found = {}, []
    watched = spy.spied(lumped, calls, found)
    watched(BASE_CASE, 2.0)
    with pytest.raises(spy.Unclamped):
        watched(BASE_CASE, spin_speed=9.0)
    assert calls == {"lumped": 2}
    assert len(found) == 1


LONG = pytest.mark.long  # more of the same stream


@pytest.mark.parametrize("count", [16, pytest.param(40, marks=LONG)])
def test_hostile_values_never_reach_the_solver(session, count):
    rng = random.Random(SEED)
    for number in range(count):  # messages of 30 values each
        answer = session.respond({"type": "change", "values": hostile.values(rng, 30)})
        in_bounds(session.state)
        json.dumps(answer, allow_nan=False)
        if number % 20 == 0:
            session.respond({"type": "settle"})
            session.respond({"type": "reset"})


@pytest.mark.parametrize("count", [40, pytest.param(100, marks=LONG)])
def test_hostile_messages_never_reach_the_solver(session, count):
    rng = random.Random(SEED + 1)
    for _ in range(count):
        message = hostile.message(rng)
        before = session.state.inputs()
        answer = session.respond(message)
        in_bounds(session.state)
        json.dumps(answer, allow_nan=False)
        assert set(answer) >= {"values", "errors", "page"}
        assert "Traceback" not in str(answer)
        assert set(before) == set(answer["values"])


def test_hostile_queries_never_reach_the_solver(session):
    rng = random.Random(SEED + 2)
    taken = refused_pins = 0
    for number in range(150):
        arguments = parse_qs(hostile.query(rng), keep_blank_values=True, errors="replace")
        given = {
            key: [one.encode("utf-8", "replace") for one in texts]
            for key, texts in arguments.items()
        }
        values, doubtful = from_arguments(given)
        state = State()
        refused = state.change(values)
        in_bounds(state)
        pins, bad = pins_from_arguments(given, state.inputs())
        assert len(pins) + len(bad) == sum(key in given for key in ("p1", "p2", "p3"))
        for one in pins:
            kept = State()
            assert kept.change(one.inputs) == {}
            in_bounds(kept)
            assert one.name.isprintable()
            assert len(one.name) <= 24
        # solving is dear: some of them, through a session of that address
        if pins and number % 15 == 0:
            answer = Session(given).respond({"type": "hello"})
            json.dumps(answer, allow_nan=False)
        taken += len(pins)
        refused_pins += len(bad)
        assert all(len(key) <= 40 for key in doubtful)  # the key, cut, and the reason
        assert all(len(one) < 200 for one in [*refused.values(), *bad])
    assert taken > 10
    assert refused_pins > 10  # the stream holds both sorts


def test_hostile_rotor_files_never_reach_the_solver(session):
    rng = random.Random(SEED + 3)
    session.respond({"type": "change", "values": {"units": "SI", "material": "steel"}})
    session.respond({"type": "use_shaft"})
    plain, in_si = write_rotor_file(State()), write_rotor_file(session.state)
    taken = 0
    for number in range(150):
        text = hostile.rotor_file(rng, plain if number % 2 else in_si)
        state = State()
        before = state.inputs()
        try:
            values, left_out = read_rotor_file(text)
        except ValueError as error:
            words = str(error)
            assert len(words) < 400
            assert "\n" not in words
            assert state.inputs() == before
        else:
            taken += 1
            assert all(len(one) < 400 for one in left_out)
            assert state.change(values) == {}
            in_bounds(state)
    assert 0 < taken < 150  # the stream holds both sorts


def test_what_the_browser_writes_is_encoded_as_bokeh_does():
    assert encoded({"a": [1, math.nan]}) == {
        "type": "map",
        "entries": [["a", [1, {"type": "number", "value": "nan"}]]],
    }
    assert encoded(-math.inf)["value"] == "-inf"


@pytest.mark.parametrize(
    "values",
    [
        {"highest_frequency": 0.5},
        {"highest_frequency": 0.5, "diametral_inertia": 0.01, "spin_speed": 4, "polar_inertia": 6},
        {"diametral_inertia": 0.01, "spin_speed": 4, "polar_inertia": 6},
        {"highest_frequency": 0.5, "model": "finite elements", "external_damping": 0.01},
    ],
)
def test_no_window_costs_more_than_a_bounded_number_of_whirl_cycles(monkeypatch, values):
    """A minute for one picture would hold up a whole class; what is left out is said."""
    spent = []

    def note(system, static, loads, frequencies, **options):
        # a chart is of the four slowest whirls
        fastest = np.sort(np.abs(whirl_frequencies(system, static)))[3]
        assert options["slow_whirls"]
        spent.append(float((fastest / frequencies).sum()))
        assert options["most_refined"] <= max(limits.MOST_REFINED.values())
        return stability_chart(system, static, loads, frequencies, **options)

    monkeypatch.setattr(window, "stability_chart", note)
    state = State()
    assert state.change(values) == {}
    answer = analysis.solve(state, Detail.FULL).floquet
    size = limits.map_size(model_of(state), Detail.FULL)
    columns = size.columns * size.finer + 2
    most = limits.MOST_WORK[limits.POLYNOMIALS, model_of(state).is_damped] * columns
    assert all(one <= most for one in spent)
    assert answer.lowest_computed_ratio > 0
    assert "the map is blank" in verdict(answer)


def test_the_default_window_is_whole():
    result = analysis.solve(State(), detail=Detail.FULL)
    assert result.floquet.lowest_computed_ratio == 0
    assert "blank" not in verdict(result.floquet)


@pytest.mark.parametrize(
    "values", [{}, {"spin_speed": 4.0}, {"highest_frequency": 4.0}, {"model": "finite elements"}]
)
def test_a_map_that_moves_leaves_at_most_a_tenth_of_the_columns_for_rest(values):
    state = State()
    assert state.change(values) == {}
    growth = window.floquet_map(analysis.window_of(state), detail=Detail.COARSE).growth.growth
    known = np.isfinite(growth).all(axis=0)
    assert known.mean() >= 0.9 - 1 / len(known)  # the tenth need not be a whole number of columns
    assert known[known.argmax() :].all()
    moving = analysis.solve(state, detail=Detail.COARSE).floquet
    assert "blank" not in verdict(moving)
    assert "lowest frequencies are computed when the sliders rest" in verdict(moving)


def test_a_marker_that_cannot_be_followed_is_refused_in_words():
    state = State()
    values = {"marker": True, "marker_frequency": 0.05, "diametral_inertia": 0.01}
    state.change(values | {"spin_speed": 4, "polar_inertia": 6})
    with pytest.raises(ValueError, match=r"cycles in one period of this load, more than"):
        inspect(state, analysis.solve(state, detail=Detail.COARSE))
