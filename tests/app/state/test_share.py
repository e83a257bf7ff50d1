"""The address: state and pins there and back, and whatever else may stand in it."""

from urllib.parse import parse_qs

import param
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.reading.user_error import UserError
from app.session import Session
from app.state.address import (
    MOST_PINS,
    PINNED,
    PinnedInputs,
    describe_problems,
    from_arguments,
    pin_name,
    pins_from_arguments,
    to_query,
)
from app.state.state import State

NAMES = tuple(State().inputs())


def values_of(name):
    """Any value that an input may have."""
    parameter = State.param[name]
    if isinstance(parameter, param.Boolean):
        return st.booleans()
    if isinstance(parameter, param.Selector):
        return st.sampled_from(parameter.objects)
    low, high = parameter.bounds
    return st.floats(low, high, allow_subnormal=False)


def inputs_of(data, names=NAMES):
    """The inputs of a state with some of them moved."""
    state = State()
    moved = data.draw(st.sets(st.sampled_from(sorted(names)), max_size=12))
    values = {name: data.draw(values_of(name)) for name in sorted(moved)}
    values.setdefault("load_type", "axial")
    values.setdefault("material", "own")
    state.change(values)
    return state.inputs()


def arguments(query):
    """What the server makes of a query."""
    found = parse_qs(query, keep_blank_values=True)
    return {key: [one.encode() for one in given] for key, given in found.items()}


def reopened(given):
    """What a session makes of arguments: inputs, pins, and the sentence of what is wrong."""
    state = State()
    values, doubtful = from_arguments(given)
    refused = state.change(values)
    pins, bad = pins_from_arguments(given, state.inputs())
    return state.inputs(), pins, describe_problems([*doubtful, *bad], refused)


def close(one, other):
    return {
        k: pytest.approx(v, rel=1e-9) if isinstance(v, float) else v for k, v in one.items()
    } == {**other}


@settings(max_examples=60)
@given(st.data())
def test_states_with_pins_come_back(data):
    inputs = inputs_of(data)
    names = st.text(max_size=40)
    numbers = sorted(data.draw(st.sets(st.integers(1, MOST_PINS))))
    pins = [
        PinnedInputs(
            pin_name(data.draw(names), number),
            number,
            {name: value for name, value in inputs_of(data, PINNED).items() if name in PINNED},
        )
        for number in numbers
    ]
    query = to_query(inputs, pins)
    assert query.isascii()
    again, found, words = reopened(arguments(query))
    assert words == ""
    assert close(inputs, again)
    assert [(one.name, one.number) for one in found] == [(one.name, one.number) for one in pins]
    for one, other in zip(pins, found, strict=True):
        assert close(one.inputs, other.inputs)
    # what was rounded once stays as it is
    assert to_query(again, found) == query


def test_an_ordinary_address_is_short_and_the_longest_is_bounded():
    state = State()
    kept = {name: state.inputs()[name] for name in PINNED}
    pins = [
        PinnedInputs("slow, heavy disk", 1, kept | {"spin_speed": 0.5, "disk_mass": 12.345}),
        PinnedInputs("Pin B", 2, kept | {"load_type": "follower", "static_load_factor": 0.25}),
        PinnedInputs("Φ = 0,05", 3, kept | {"shear": 0.05, "external_damping": 0.013}),
    ]
    assert len(to_query(state.inputs(), pins)) < 700
    state.change({"marker": True, "units": "SI", "model": "finite elements"})
    long = {name: 1.0 / 3 if isinstance(value, float) else value for name, value in kept.items()}
    worst = [
        PinnedInputs(pin_name("\U0001f600" * 99, number), number, long) for number in (1, 2, 3)
    ]
    assert len(to_query(state.inputs(), worst)) < 3500


def test_a_pin_is_what_differs_from_the_present_state():
    state = State()
    kept = {name: state.inputs()[name] for name in PINNED}
    query = to_query(state.inputs(), [PinnedInputs("slow one", 2, kept | {"spin_speed": 1.5})])
    assert query.endswith("&p2=spin_1.5~~slow+one")


GOOD = "spin_1.5~as_0.2~~good"
BAD = {
    "": "not a pin",
    "spin_1.5": "not a pin",
    "spin_99~~far": "spin must be a number from 0 to 4",
    "spin_nan~~x": "spin must be",
    "spin_inf~~x": "spin must be",
    "spin_1e308~~x": "spin must be",
    "spin_true~~x": "spin must be",
    "spin_" + "9" * 5000 + "~~x": "too long",
    "spin_" + "9" * 50 + "~~x": "no value of spin",
    "spin~~x": "no value of spin",
    "spin_~~x": "no value of spin",
    "nosuch_1~~x": "no input",
    "_1~~x": "no input",
    "at_1~~x": "no input",  # the marker is no pin's
    "u_SI~~x": "no input",
    "load_sideways~~x": "load must be one of",
    "fmin_9~fmax_9.1~~x": "must be below the highest",
    "<script>alert(1)</script>_1~~x": "no input",
    "spin_1~~~~" + "x" * 100_000: "too long",
    "\\x00_\\x00~~": "no input",
}


@pytest.mark.parametrize("text", BAD, ids=range(len(BAD)))
def test_a_bad_pin_is_named_and_dropped_and_all_else_kept(text):
    given = {"v": ["1"], "phi": ["0.03"], "p1": [GOOD], "p2": [text], "p3": [f"{GOOD} too"]}
    inputs, pins, words = reopened(given)
    assert inputs == State().inputs() | {"shear": 0.03}
    assert [(one.number, one.name) for one in pins] == [(1, "good"), (3, "good too")]
    assert [one.inputs["spin_speed"] for one in pins] == [1.5, 1.5]
    assert words.startswith("Ignored in the address: p2 (")
    assert BAD[text] in words
    assert len(words) < 300


def test_repeated_and_unknown_pins_are_named():
    inputs, pins, words = reopened({"p1": [GOOD, GOOD], "p4": [GOOD], "p": ["x"]})
    assert (inputs, pins) == (State().inputs(), [])
    assert "p1 (given more than once)" in words
    assert "p4" in words


@settings(max_examples=150)
@given(
    st.dictionaries(
        st.sampled_from(["v", "p1", "p2", "p3", "spin", "phi", "load", "fmin"])
        | st.text(max_size=9),
        st.lists(st.text(max_size=60) | st.binary(max_size=30), max_size=3),
        max_size=6,
    )
)
def test_whatever_stands_in_an_address_the_state_is_whole(given):
    inputs, pins, words = reopened(given)
    assert State(**inputs).inputs() == inputs
    for one in pins:
        assert set(one.inputs) == set(PINNED)
        assert State(**one.inputs)
        assert one.name.isprintable()
        assert 0 < len(one.name) <= 24
    assert len(words) < 2500
    to_query(inputs, pins).encode("ascii")


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ("  slow \n one ", "slow one"),
        ("", "Pin B"),
        (None, "Pin B"),
        (7, "Pin B"),
        ("\x00\u202e\ud800", "Pin B"),
        ("x" * 99, "x" * 24),
        ("~~a~~b", "~~a~~b"),
    ],
)
def test_names_of_pins_are_short_and_printable(given, name):
    assert pin_name(given, 2) == name


def test_a_session_returns_with_its_pins_and_marker():
    session = Session()
    marked = {"marker": True, "marker_frequency": 1.7}
    session.respond({"type": "change", "values": marked})
    session.respond({"type": "pin", "label": "at \ud800 two~~"})
    session.respond({"type": "change", "values": {"spin_speed": 1.0}})
    session.respond({"type": "settle"})
    session.respond({"type": "pin", "label": ""})
    session.respond({"type": "unpin", "number": 1})
    session.respond({"type": "pin", "label": "slow"})
    session.respond({"type": "change", "values": {"static_load_factor": 0.3}})
    answer = session.respond({"type": "settle"})
    assert [one["number"] for one in answer["pins"]["names"]] == [1, 2]
    again = Session(arguments(answer["query"]))
    assert again.pages["explore"].pins == []  # a bare request solves none
    assert again.query() == answer["query"]  # and loses none
    back = again.respond({"type": "hello"})
    assert (back["query"], back["pins"]) == (answer["query"], answer["pins"])
    assert (back["values"], back["address_notice"]) == (answer["values"], "")
    ghosts = [one.pages["explore"].charts["campbell"].sources["pins"] for one in (session, again)]
    assert len(ghosts[0].data["ys"]) == len(ghosts[1].data["ys"]) > 0


def test_each_pin_of_an_address_is_solved_in_a_turn_of_its_own(monkeypatch):
    turns = []
    monkeypatch.setattr(
        "app.background.threads.Scheduler.call", lambda self, work: turns.append(work)
    )
    session = Session(arguments("spin=1&at=1&p1=spin_2~~a&p3=spin_3~~c"))
    explore = session.pages["explore"]
    assert not set(explore.charts) & {"response", "orbit"}  # the marked point waits too
    for kind in ("hello", "settle"):
        session.respond({"type": kind})
    assert {"response", "orbit"} <= set(explore.charts)
    told = []
    monkeypatch.setattr(session.controls, "send", told.append)
    # a pin that is made meanwhile takes a number and a place that no other has
    session.respond({"type": "pin", "label": "mine"})
    while turns:
        turns.pop(0)()
    assert [[row["name"] for row in one["pins"]["names"]] for one in told] == [
        ["a", "mine"],
        ["a", "mine", "c"],
    ]
    assert len(explore.charts["load-frequency"].sources["pins"].data["ys"]) > 0


def test_a_session_names_a_pin_without_an_answer_and_keeps_the_rest(monkeypatch, caplog):
    import app.pages.pin_list as pin_list

    real = pin_list.solve_pin

    def some(one):
        if one.number == 1:
            raise UserError("this rotor has no flutter load")
        if one.number == 2:
            raise RuntimeError("a detail of the inside")
        return real(one)

    monkeypatch.setattr(pin_list, "solve_pin", some)
    query = "phi=0.03&p1=spin_1~~a&p2=spin_1~~b&p3=spin_1~~c&spin=99"
    answer = Session(arguments(query)).respond({"type": "hello"})
    assert [one["name"] for one in answer["pins"]["names"]] == ["c"]
    assert answer["values"]["shear"] == 0.03
    notice = answer["address_notice"]
    assert "p1 (this rotor has no flutter load)" in notice
    assert "p2 (it could not be computed)" in notice
    assert "spin (must be" in notice
    assert "detail" not in notice
    assert "a detail of the inside" in caplog.text


def test_a_link_takes_numbers_and_names_as_the_boxes_do():
    given = "v=1&as=0,3&spin=1,5&phi=0,0125&load=Follower&u=si&mat=Aluminum&law=EXACT&simd=1 200,5"
    inputs, _, words = reopened(arguments(given.replace(" ", "%C2%A0")))
    assert words == ""
    assert inputs == State().inputs() | {
        "static_load_factor": 0.3,
        "spin_speed": 1.5,
        "shear": 0.0125,
        "load_type": "follower",
        "units": "SI",
        "material": "aluminium",
        "law": "exact",
        "si_disk_mass": 1200.5,
    }
    inputs, (pin,), words = reopened(arguments("p1=spin_0,5~load_Follower~~a"))
    assert (pin.inputs["spin_speed"], pin.inputs["load_type"], words) == (0.5, "follower", "")


def test_a_number_with_two_readings_in_a_link_is_refused_and_both_are_named():
    inputs, pins, words = reopened(arguments("spin=1.5&simd=1,200&p1=simd_1,200~~heavy"))
    assert inputs == State().inputs() | {"spin_speed": 1.5}
    assert pins == []
    assert words.startswith("Ignored in the address: simd ('1,200' can mean 1.2 or 1200: write one")
    inputs, _, words = reopened(arguments("rho=7,850"))
    assert inputs == State().inputs()
    assert "rho ('7,850' can mean 7.85 or 7850" in words


TRACKED = "utm_source utm_medium utm_campaign UTM_Content fbclid gclid msclkid mc_cid mc_eid "
TRACKED += "_hsenc igshid pk_campaign mtm_source yclid gbraid wbraid dclid twclid _gl _ga mkt_tok"


def test_keys_that_other_programs_add_are_ignored_without_a_notice():
    query = "&".join(f"{key}=abc{'x' * 200}" for key in TRACKED.split())
    inputs, pins, words = reopened(arguments(f"spin=1.5&{query}&fbclid=again"))
    assert (inputs, pins, words) == (State().inputs() | {"spin_speed": 1.5}, [], "")
    # none of them is a key of ours
    ours = parse_qs(to_query(State().inputs()), keep_blank_values=True)
    _, doubtful = from_arguments({key: ["x", "y"] for key in ours})
    repeated = [word.removesuffix(" (given more than once)") for word in doubtful]
    assert sorted(repeated) == sorted(ours)


@pytest.mark.parametrize(
    ("query", "words"),
    [
        ("spin=2&spin=3", "spin (given more than once)"),
        (f"spin={'1' * 41}", "spin (too long)"),
        ("v=1&v=2", "v"),
    ],
)
def test_a_value_that_cannot_be_taken_is_named_with_the_reason(query, words):
    inputs, _, sentence = reopened(arguments(query))
    assert inputs == State().inputs()
    assert sentence == f"Ignored in the address: {words}."
