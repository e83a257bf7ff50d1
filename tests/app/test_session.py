"""One user's session without a server: messages in, answers and patched Bokeh sources out."""

import base64
import json
import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from bokeh.models import HoverTool
from hypothesis import given, settings
from hypothesis import strategies as st

import rotorstab as rs
from app.live.controls import GROUPS, OWN_GROUP, Controls
from app.pages import PAGES, explore
from app.pages.warming import Warming
from app.reading.user_error import UserError
from app.results.analysis import CHARTS, solve
from app.results.caches import cache_infos
from app.results.limits import Detail
from app.session import Session
from app.state import PRESETS, State
from app.words.si import displayed
from rotorstab.drawing import screen

# a value of every input of the sidebar away from its default, and the charts that it moves
MOVES = {
    "load_type": ("follower", {"instability", "campbell"}),
    "tangency": (0.25, set(CHARTS)),
    "static_load_factor": (0.3, set(CHARTS)),
    "spin_speed": (1.3, set(CHARTS)),
    "shear": (0.05, set(CHARTS)),
    "disk_mass": (7.5, set(CHARTS)),
    "diametral_inertia": (1.2, set(CHARTS)),
    "polar_inertia": (0.7, set(CHARTS)),
    "reference": ("flutter", set(CHARTS)),
    "largest_factor": (0.6, {"instability"}),
    "lowest_frequency": (3.0, {"instability"}),
    "highest_frequency": (9.0, {"instability"}),
    "stiffness": ("both", {"load-frequency"}),
    "external_damping": (0.05, set(CHARTS)),
    "internal_damping": (0.01, set(CHARTS)),
    "law": ("exact", {"instability", "campbell"}),
    "model": ("finite elements", set(CHARTS)),
    "growth_unit": ("per period", {"instability"}),
    "show_growth": (False, set()),
    "show_bolotin": (False, set()),
    "show_disagreement": (True, set()),
    "units": ("SI", set(CHARTS)),
    # the shaft in SI counts once it is used, or as the scale of charts in SI
    "shaft_length": (0.8, set()),
    "shaft_diameter": (25.0, set()),
    "material": ("steel", set()),
    "youngs_modulus": (190.0, set()),
    "shear_modulus": (70.0, set()),
    "density": (8000.0, set()),
    "shear_coefficient": (0.8, set()),
    "si_disk_mass": (2.0, set()),
    "si_diametral_inertia": (0.02, set()),
    "si_polar_inertia": (0.03, set()),
}
# coarser while inputs move
FLOQUET = ("growth", "unstable", "disagreement", "tongue", "tongue edge", "thin tongue")
INSPECTOR = {
    "marker",
    "marker_follows",
    "marker_frequency",
    "marker_factor",
    "initial",
    "seed",
    "periods",
}
FLOATS = ("static_load_factor", "spin_speed", "shear", "disk_mass", "polar_inertia", "tangency")


@pytest.fixture(scope="module")
def shared():
    return Session()


@pytest.fixture
def session(shared):
    """A session at its start; building one takes half a second."""
    shared.respond({"type": "page", "name": "explore"})
    shared.respond({"type": "reset"})
    return shared


def differing(one, other):
    """Which columns of which layers differ: a short account of two pictures."""
    return [
        (key, label, name)
        for key in CHARTS
        for label, columns in one[key][0].items()
        for name in columns
        if columns[name] != other[key][0][label].get(name)
    ]


def change(session, **values):
    return session.respond({"type": "change", "values": values})


def charts(session):
    """The three charts that are always there; test_inspector looks at the others."""
    return {key: session.pages["explore"].charts[key] for key in CHARTS}


def ranges(chart):
    figure = chart.figure
    return [(axis.start, axis.end) for axis in (figure.x_range, figure.y_range)]


def plain(value):
    """Columns as values that can be compared, NaN with NaN."""
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    return value


def shown(layers):
    """Columns by label, without layers that are empty: pins and edges come and go.

    test_marked_point looks at the marks of the marked point.
    """
    return {
        label: plain(columns)
        for label, columns in layers.items()
        if any(len(column) for column in columns.values()) and not label.startswith("marker")
    }


def picture(session):
    """Everything that the three figures show."""
    return {
        key: (
            shown({label: dict(source.data) for label, source in chart.sources.items()}),
            ranges(chart),
        )
        for key, chart in charts(session).items()
        if key in CHARTS
    }


def expected(detail=Detail.FULL, **values):
    """What the figures must show for these inputs, straight from the solver."""
    state = State()
    assert state.change(values) == {}
    result = solve(state, detail)
    return {
        key: (
            shown({layer.label: screen.columns(layer) for layer in chart.layers}),
            [chart.x_range, chart.y_range],
        )
        for key, chart in displayed(result.charts, state, result.numbers).items()
    }


def assert_key_numbers(numbers, state):
    """Compare key numbers with the library's own functions."""
    rotor = state.rotor()
    tangency = {"axial": 0.0, "follower": 1.0}.get(state.load_type, state.tangency)
    damping = state.external_damping, state.internal_damping
    if state.model == "lumped":
        system = rs.lumped(rotor, state.spin_speed, tangency, *damping, stiffness=state.law)
    else:
        system = rs.finite_element(rotor, state.spin_speed, tangency, 20, 4, *damping)
    reference = float(rs.critical_load(rotor.shear))
    if state.reference == "flutter":
        reference = rs.flutter_load(rs.lumped(rotor, 0.0, 1.0))
    static = state.static_load_factor * reference
    assert numbers["buckling"] == pytest.approx(rs.critical_load(rotor.shear))
    assert numbers["fundamental"] == pytest.approx(rs.fundamental_frequency(rs.lumped(rotor, 0.0)))
    assert (numbers["reference"], numbers["static_load"]) == pytest.approx((reference, static))
    whirl = [complex(*parts) for parts in numbers["whirl"].values()]
    np.testing.assert_allclose(
        sorted(whirl, key=lambda frequency: frequency.real),
        np.asarray(rs.whirl_frequencies(system, static), complex),
        rtol=1e-9,
        atol=1e-12,
    )


def test_every_input_is_moved_by_a_test_and_has_a_control():
    placed = {name for _, _, names in GROUPS for name in names}
    assert placed == set(MOVES)
    # the others are the inspector's own, the choice among the pins, and those of another page
    assert set(State().inputs()) - placed == INSPECTOR | {"compared", *OWN_GROUP}


def test_a_session_starts_with_the_solvers_picture(session):
    assert picture(session) == expected()
    assert set(charts(session)) == set(CHARTS)


@pytest.mark.parametrize("name", MOVES)
def test_each_input_moves_its_charts_to_what_the_solver_returns(session, name):
    value, moved = MOVES[name]
    before = picture(session)
    answer = change(session, **{name: value})
    assert differing(picture(session), expected(detail=Detail.COARSE, **{name: value})) == []
    assert picture(session) == expected(detail=Detail.COARSE, **{name: value})
    assert answer["values"][name] == value
    assert (answer["errors"], answer["notice"]) == ({}, "")
    assert_key_numbers(answer["numbers"], session.state)
    session.respond({"type": "settle"})
    after = picture(session)
    assert after == expected(**{name: value})
    assert {key for key in CHARTS if before[key] != after[key]} == moved


@settings(max_examples=8)
@given(st.data())
def test_any_sequence_of_changes_ends_in_the_picture_of_its_last_state(shared, data):
    shared.respond({"type": "reset"})
    for _ in range(data.draw(st.integers(1, 3))):
        name = data.draw(st.sampled_from(FLOATS))
        low, high = State.param[name].bounds
        change(shared, **{name: data.draw(st.floats(low, high).map(lambda x: round(x, 2)))})
    assert picture(shared) == expected(detail=Detail.COARSE, **shared.state.inputs())
    assert shared.notice == ""


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_and_reset(session, preset):
    answer = session.respond({"type": "preset", "name": preset})
    assert answer["values"].items() >= PRESETS[preset].items()
    assert picture(session) == expected(**PRESETS[preset])
    answer = session.respond({"type": "reset"})
    assert answer["values"] == State().inputs()
    assert picture(session) == expected()


def test_good_values_are_drawn_while_bad_ones_are_refused(session):
    answer = change(session, shear=0.03, spin_speed=99, polar_inertia=math.nan)
    assert set(answer["errors"]) == {"spin_speed", "polar_inertia"}
    assert picture(session) == expected(detail=Detail.COARSE, shear=0.03)


def test_answers_are_plain_json(session):
    """Without NaN and infinity, which a browser's JSON refuses."""
    for name in PRESETS:
        json.dumps(session.respond({"type": "preset", "name": name}), allow_nan=False)
    rigid = session.respond({"type": "change", "values": {"polar_inertia": 6, "shear": 0}})
    json.dumps(rigid, allow_nan=False)


GARBAGE = [
    {},
    {"type": None},
    {"type": "nothing"},
    {"type": 7, "values": 7},
    {"type": []},
    {"type": {}},
    {"type": np.array([1.0, 2.0])},
    {"type": np.array(["change", "reset"])},
    {"type": "change"},
    {"type": "change", "values": None},
    {"type": "change", "values": []},
    {"type": "change", "values": "shear"},
    {"type": "change", "values": [["shear", 0.01]]},
    {"type": "change", "values": np.ones(3)},
    {"type": "change", "values": {"shear": np.ones(3)}},
    {"type": "change", "values": {"shear": {"type": "number", "value": "nan"}}},
    {"type": "change", "values": {None: 1, 3: 2, ("a",): 4, 10**5000: 5}},
    {"type": "change", "values": {"shear": 10**5000}},
    {"type": "change", "values": {"load_type": np.array(["axial", "follower"])}},
    {"type": "change", "values": {"load_type": "sideways"}},
    {"type": "preset"},
    {"type": "preset", "name": np.array(["a", "b"])},
    {"type": "preset", "name": {}},
    {"type": "preset", "name": 10**5000},
    {"type": "page"},
    {"type": "page", "name": "nowhere"},
    {"type": "page", "name": []},
    {"type": "page", "name": np.array([1, 2])},
    {"type": "figure", "number": []},
    {"type": "figure", "number": np.ones(2)},
    {"type": "export"},
    {"type": "export", "format": []},
    {"type": "export", "format": "pdf", "chart": []},
    {"type": "export", "format": "pdf", "chart": {}, "number": {}},
    {"type": "export", "format": "pdf", "number": np.ones(2)},
    {"type": "export", "format": "pdf", "number": 10**400},
    {"type": "export", "format": "../../x", "number": 2},
]


@pytest.mark.parametrize("message", GARBAGE, ids=range(len(GARBAGE)))
def test_garbage_raises_nothing_and_loses_nothing(session, message):
    change(session, shear=0.03)
    session.respond({"type": "settle"})
    before = session.state.inputs(), picture(session), session.active
    answer = session.respond(message)
    session.respond({"type": "settle"})
    assert (session.state.inputs(), picture(session), session.active) == before
    assert set(answer) >= {"values", "errors", "notice", "numbers", "page"}
    assert answer["values"] == session.state.inputs()
    json.dumps(answer, allow_nan=False)


def test_nothing_is_patched_before_the_browser_has_built_the_page(monkeypatch):
    """BokehJS drops patches that come earlier, and the map would stay coarse for ever."""
    session = Session({})
    page, drawn = session.pages[session.active], []
    monkeypatch.setattr(page, "show", lambda state, detail: drawn.append(detail))
    monkeypatch.setattr(session.controls, "send", drawn.append)
    session.show_finer(Detail.FULL)
    session.show_finer(Detail.FULL)
    assert drawn == []
    session.respond({"type": "hello"})
    assert drawn == [Detail.FULL]


def test_a_rest_whose_full_picture_is_being_made_repeats_nothing(session, monkeypatch):
    change(session, shear=0.03)
    monkeypatch.setattr(session.settling, "detail", lambda window: Detail.COARSE)
    page = session.pages[session.active]
    monkeypatch.setattr(page, "show", lambda *given: pytest.fail("drawn again"))
    assert session.respond({"type": "settle"}) == {"resting": True}
    monkeypatch.undo()
    answer = session.respond({"type": "settle"})
    assert answer["settled"]
    assert answer["values"]["shear"] == 0.03


def test_a_picture_that_is_there_is_not_compared_again(session, monkeypatch):
    drawn = []
    page = session.pages[session.active]
    show = page.show
    monkeypatch.setattr(page, "show", lambda *given: (drawn.append(given[1]), show(*given)))
    change(session, shear=0.03)
    session.respond({"type": "settle"})
    session.respond({"type": "settle"})
    assert drawn == [Detail.COARSE, Detail.FULL]
    session.respond({"type": "view"})
    assert drawn == [Detail.COARSE, Detail.FULL, Detail.FULL]


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=10), inner, max_size=3)
    ),
    max_leaves=6,
)
messages = st.fixed_dictionaries(
    {},
    optional={
        "type": st.sampled_from(["change", "preset", "view", "export", "figure"]) | json_values,
        "values": st.dictionaries(st.sampled_from(list(MOVES)), json_values) | json_values,
        "name": st.sampled_from(list(PRESETS)) | json_values,
        "seq": json_values,
    },
)


@settings(max_examples=16)
@given(messages)
def test_no_message_of_any_form_raises(shared, message):
    answer = shared.respond(message)
    json.dumps(answer, allow_nan=False)
    assert answer["values"] == shared.state.inputs()


@pytest.mark.parametrize("data", [None, 1, "text", [], [{}], b"", np.ones(2), {"seq": 1}])
@pytest.mark.parametrize("seq", [None, 5, "5", [], math.nan, 10**400])
def test_the_component_answers_mappings_with_their_number_and_ignores_the_rest(
    monkeypatch, data, seq
):
    sent = []
    controls = Controls(lambda message: {"values": {}})
    monkeypatch.setattr(controls, "send", sent.append)
    if isinstance(data, dict):
        data = data | {"seq": seq}
    controls.receive(data)
    if isinstance(data, dict):
        ((answer),) = sent
        assert answer["seq"] == (seq if isinstance(seq, int) else 0)
    else:
        assert sent == []


def test_a_value_without_an_answer_keeps_the_picture_and_says_why(session, monkeypatch):
    change(session, shear=0.03)
    before = picture(session)

    def no_answer(state, detail=Detail.FULL, view=None):
        raise UserError("this rotor has no such load")

    monkeypatch.setattr(explore, "solve", no_answer)
    answer = change(session, shear=0.04)
    assert answer["notice"] == "this rotor has no such load"
    assert answer["values"]["shear"] == 0.04
    assert picture(session) == before

    monkeypatch.undo()
    answer = change(session, shear=0.05)
    assert answer["notice"] == ""
    assert picture(session) == expected(detail=Detail.COARSE, shear=0.05)


def test_a_failure_keeps_the_picture_and_tells_no_detail(session, monkeypatch, caplog):
    before = picture(session)

    def failure(state, detail=Detail.FULL, view=None):
        raise RuntimeError("a detail of the inside")

    monkeypatch.setattr(explore, "solve", failure)
    answer = change(session, shear=0.04)
    assert "could not be computed" in answer["notice"]
    assert "detail" not in answer["notice"]
    assert picture(session) == before
    assert "a detail of the inside" in caplog.text
    assert "0.04" in caplog.text


def zoom(chart, x, y):
    """What the browser sends when a user zooms."""
    chart.figure.x_range.update(start=x[0], end=x[1])
    chart.figure.y_range.update(start=y[0], end=y[1])


def test_zoom_is_kept_while_a_slider_moves_and_lost_on_request(session):
    live = charts(session)["instability"]
    zoom(live, (2.0, 4.0), (0.1, 0.3))
    change(session, static_load_factor=0.2)
    change(session, largest_factor=0.5, highest_frequency=12.0)
    assert ranges(live) == [(2.0, 4.0), (0.1, 0.3)]
    figure = live.figure
    assert (figure.x_range.reset_start, figure.x_range.reset_end) == (0.0, 12.0)
    assert (figure.y_range.reset_start, figure.y_range.reset_end) == (0.0, 0.5)
    session.respond({"type": "view"})
    assert ranges(live) == [(0.0, 12.0), (0.0, 0.5)]
    # and the ranges follow again
    change(session, highest_frequency=10.0)
    assert ranges(live) == [(0.0, 10.0), (0.0, 0.5)]


def test_a_zoom_along_one_axis_leaves_the_other_following(session):
    live = charts(session)["instability"]
    live.figure.x_range.update(start=2.0, end=4.0)
    change(session, largest_factor=0.5)
    assert ranges(live) == [(2.0, 4.0), (0.0, 0.5)]
    session.respond({"type": "reset"})
    assert ranges(live) == [(0.0, 6.0), (0.0, 1.0)]


def test_a_zoom_computes_what_is_seen(session):
    live = charts(session)["instability"]
    window = {"left": 1.2, "right": 2.2, "low": 0.6, "high": 0.9}
    zoom(live, (1.2, 2.2), (0.6, 0.9))
    answer = session.respond({"type": "window", "chart": "instability", **window})
    assert not answer["at_rest"]
    data = live.sources["tongue edge"].data
    x, y = (np.concatenate(data[axis]) for axis in ("xs", "ys"))
    assert (np.nanmin(x), np.nanmax(x)) >= (1.2, 1.2)
    assert np.nanmax(x) <= 2.2
    assert (np.nanmin(y), np.nanmax(y)) == pytest.approx((0.6, 0.9))
    # the reset still leads to the whole window, and a new value keeps the zoom
    assert live.figure.x_range.reset_end == 6.0
    change(session, spin_speed=1.9)
    assert np.nanmin(np.concatenate(live.sources["tongue edge"].data["ys"])) >= 0.6
    session.respond({"type": "view"})
    assert np.nanmin(np.concatenate(live.sources["tongue edge"].data["ys"])) < 0.1


@pytest.mark.parametrize("key", ["load-frequency", "campbell"])
def test_a_zoom_computes_the_whirl_that_is_seen_and_leaves_the_map(session, key):
    live = charts(session)[key]
    before = picture(session)["instability"]
    window = {"left": 1.0, "right": 1.1, "low": -1.0, "high": 1.0}
    zoom(live, (1.0, 1.1), (-1.0, 1.0))
    answer = session.respond({"type": "window", "chart": key, **window})
    assert answer["settled"]
    x = live.sources["whirl"].data["xs"][0]
    assert np.sum((x >= 1.0) & (x <= 1.1)) > 100
    assert picture(session)["instability"] == before
    # a new value keeps the zoom, and a reset leads back to the whole chart
    change(session, disk_mass=1.2)
    x = live.sources["whirl"].data["xs"][0]
    assert np.sum((x >= 1.0) & (x <= 1.1)) > 100
    assert live.figure.x_range.reset_end > 2.0
    session.respond({"type": "view"})
    assert live.sources["whirl"].data["xs"][0][-1] == live.figure.x_range.end


def test_a_window_in_SI_is_that_of_the_rotor(session):
    change(session, units="SI")
    live = charts(session)["campbell"]
    factor = session.respond({"type": "settle"})["si"]["factors"]["campbell"][0]
    window = {"left": 1.0, "right": 1.1, "low": -1.0, "high": 1.0}
    zoom(live, (factor, 1.1 * factor), (-30.0, 30.0))
    session.respond({"type": "window", "chart": "campbell", **window})
    x = live.sources["whirl"].data["xs"][0] / factor
    assert np.sum((x >= 1.0) & (x <= 1.1)) > 100
    # nothing beyond the bounds can be seen
    assert live.figure.x_range.bounds[0] == 0.0
    assert live.figure.x_range.bounds[1] > live.figure.x_range.reset_end


@pytest.mark.parametrize("key", ["instability", "load-frequency", "campbell"])
@pytest.mark.parametrize(
    "window",
    [
        {},
        {"left": 2.0, "right": 1.0, "low": 0.0, "high": 1.0},
        {"left": math.nan, "right": 1.0, "low": 0.0, "high": 1.0},
        {"left": -500.0, "right": -100.0, "low": 0.0, "high": 1.0},
        {"left": 0.0, "right": 6.0, "low": "0", "high": 1.0},
        {"left": True, "right": 6.0, "low": 0.0, "high": 1.0},
        {"left": 1.0, "right": 1.0 + 1e-9, "low": 0.0, "high": 1.0},
        {"left": 0.0, "right": math.inf, "low": 0.0, "high": 1.0},
    ],
)
def test_a_window_that_cannot_be_shown_is_not_taken(session, key, window):
    before = picture(session)
    session.respond({"type": "window", "chart": key, **window})
    assert not session.pages["explore"].views
    assert picture(session)["campbell"] == before["campbell"]


def columns_of_the_map(session):
    return len(charts(session)["instability"].sources["growth"].data["image"][0][0])


def test_a_large_screen_has_a_finer_map_at_rest(session):
    usual = columns_of_the_map(session)
    session.respond({"type": "settle", "width": 1130, "height": 640})
    assert columns_of_the_map(session) == 2 * usual
    change(session, spin_speed=1.7)
    assert columns_of_the_map(session) < usual  # while a slider moves, it costs the same everywhere
    session.respond({"type": "settle", "width": 99_999.0, "height": 1})
    assert columns_of_the_map(session) == 2 * usual  # however large it says that it is
    session.respond({"type": "settle"})
    assert columns_of_the_map(session) == 2 * usual
    session.respond({"type": "settle", "width": 610, "height": 330})
    assert columns_of_the_map(session) == usual


@pytest.mark.parametrize(
    "size",
    [math.nan, math.inf, -math.inf, 0, -5, 0.5, 1e308, 10**400, "700", "", True, False, 100_001],
)
def test_a_size_that_no_screen_has_changes_nothing(session, size):
    before = session.pages["explore"].fineness
    for sizes in ({"width": size, "height": 600}, {"width": 600, "height": size}, {"width": size}):
        session.respond({"type": "settle", **sizes})
        assert session.pages["explore"].fineness == before


def test_colours_are_fitted_on_demand_only(session):
    scale = charts(session)["instability"].renderers["unstable"].glyph.fill_color.transform
    change(session, spin_speed=1.0, disk_mass=2.0)
    assert scale.high == 0.2
    assert session.respond({"type": "colours", "fit": True})["colours_fitted"]
    fitted = scale.high
    assert fitted != 0.2
    change(session, disk_mass=1.0)
    assert scale.high == fitted
    assert not session.respond({"type": "colours", "fit": False})["colours_fitted"]
    assert scale.high == 0.2


def test_ranges_follow_where_nobody_zoomed(session):
    for values in ({"disk_mass": 0.5, "spin_speed": 4.0}, {"disk_mass": 20.0}, {"shear": 0.1}):
        change(session, **values)
        result = solve(session.state).charts
        for key in CHARTS:
            live = charts(session)[key]
            assert ranges(live) == [result[key].x_range, result[key].y_range]


def test_charts_are_built_once(session, monkeypatch):
    def models():
        return {
            key: {model.id for model in live.figure.references()}
            for key, live in charts(session).items()
        }

    before = models()
    monkeypatch.setattr(screen, "element", lambda chart: pytest.fail("a chart was built anew"))
    for name, (value, _) in MOVES.items():
        change(session, **{name: value})
    for preset in PRESETS:
        session.respond({"type": "preset", "name": preset})
    assert models() == before


def test_unchanged_columns_are_not_sent_again(session):
    patched = []

    def note(where, attr, old, new):
        patched.append(where)

    for key, live in charts(session).items():
        for label, source in live.sources.items():
            source.on_change("data", partial(note, (key, label)))
    change(session, stiffness="both")
    # the map of growth and its edges are coarser while inputs move
    curves = {key for key, label in patched if label in ("boundary", "whirl")}
    assert curves == {"load-frequency"}
    patched.clear()
    change(session, spin_speed=1.0)
    assert ("campbell", "marks") in patched
    assert ("campbell", "whirl") not in patched
    patched.clear()
    change(session, spin_speed=1.0)
    assert patched == []


def test_sessions_share_arrays_but_not_state(session):
    other = Session()
    assert solve(other.state) is solve(session.state)
    change(other, shear=0.07)
    assert session.state.shear == State().shear
    assert picture(session) == expected()
    assert picture(other) == expected(detail=Detail.COARSE, shear=0.07)
    for key, live in charts(session).items():
        assert live.figure is not charts(other)[key].figure


def arrays(value):
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, dict):
        for one in value.values():
            yield from arrays(one)
    elif isinstance(value, list | tuple):
        for one in value:
            yield from arrays(one)


def test_shared_arrays_cannot_be_written():
    for chart in solve(State()).charts.values():
        for layer in chart.layers:
            for array in arrays(dict(layer.columns)):
                assert not array.flags.writeable, (chart.key, layer.label)


def test_caches_are_bounded():
    caches = dict(cache_infos())
    parts = {"analysis", "curves", "comparisons", "growth_maps", "evaluation", "drawing"}
    assert {name.split(".")[0] for name in caches} >= parts
    for name, info in caches.items():
        assert 0 <= info.currsize <= info.maxsize <= 1024, name


def test_pages_are_built_when_first_opened():
    session = Session()
    for page in PAGES[1:]:
        assert session.pages[page.key].charts == {}
        answer = session.respond({"type": "page", "name": page.key})
        assert (answer["page"], answer["notice"]) == (page.key, "")
        # the page asks for a figure of the paper with a message of its own
        built = () if page.key == "paper" else page.chart_keys
        assert set(session.pages[page.key].charts) == set(built)
    change(session, shear=0.05)
    session.respond({"type": "page", "name": "explore"})
    assert picture(session) == expected(shear=0.05)


ROTOR_FILE = Path(__file__).parents[2].joinpath("docs", "table_1.toml")


def test_a_rotor_file_is_taken_whole(session):
    answer = session.respond({"type": "rotor_file", "text": ROTOR_FILE.read_text("utf-8")})
    assert (answer["shaft_error"], answer["errors"], answer["notice"]) == ("", {}, "")
    assert answer["shaft"]["in_use"]
    assert answer["values"]["units"] == "SI"
    assert answer["values"]["shear"] == pytest.approx(2.92191e-4, rel=1e-5)
    assert answer["si"]["hints"]["spin_speed"] == "1000\N{NO-BREAK SPACE}rpm"
    assert answer["si"]["numbers"]["whirl"]["1F"][0] == pytest.approx(
        answer["numbers"]["whirl"]["1F"][0] * session.state.scales().frequency / (2 * math.pi)
    )
    values = {k: v for k, v in session.state.inputs().items() if v != State().inputs()[k]}
    assert picture(session) == expected(**values)


@pytest.mark.parametrize(
    "text", ["", "nonsense", '[shaft]\nlength = "1 kg"', 7, None, "[" * 70_000]
)
def test_a_bad_rotor_file_loses_nothing(session, text):
    change(session, shear=0.03)
    before = session.state.inputs()
    answer = session.respond({"type": "rotor_file", "text": text})
    assert answer["shaft_error"]
    assert "\n" not in answer["shaft_error"]
    assert session.state.inputs() == before
    json.dumps(answer, allow_nan=False)


def test_a_saved_rotor_file_opens_to_the_same_state(session):
    session.respond({"type": "rotor_file", "text": ROTOR_FILE.read_text("utf-8")})
    change(session, disk_mass=2.5)  # no longer the disk of the file
    before = session.state.inputs()
    answer = session.respond({"type": "save_rotor_file"})
    assert answer["file"]["name"].endswith(".toml")
    text = base64.b64decode(answer["file"]["base64"]).decode()
    session.respond({"type": "reset"})
    assert session.respond({"type": "rotor_file", "text": text})["shaft_error"] == ""
    after = session.state.inputs()
    assert after == before


def test_a_shaft_is_used_whole_or_not_at_all(session):
    change(session, shaft_length=0.5, shaft_diameter=40.0, si_disk_mass=20.0)
    answer = session.respond({"type": "use_shaft"})
    assert (answer["shaft_error"], answer["shaft"]["in_use"]) == ("", True)
    rotor = session.state.si_rotor()[0]
    assert session.state.disk_mass == rotor.disk_mass
    before = session.state.inputs() | {"si_disk_mass": 1e5}
    change(session, si_disk_mass=1e5)
    answer = session.respond({"type": "use_shaft"})
    assert "M̄_D of this shaft is" in answer["shaft_error"]
    assert session.state.inputs() == before


def test_the_switch_of_units_renames_the_axes_and_undoes_a_zoom(session):
    live = charts(session)["campbell"]
    zoom(live, (1.0, 2.0), (0.0, 1.0))
    change(session, units="SI")
    assert live.figure.xaxis[0].axis_label == "spin speed Ω [rpm]"
    assert ranges(live) == expected(detail=Detail.COARSE, units="SI")["campbell"][1]
    names = {name for tool in live.figure.select(type=HoverTool) for name, _ in tool.tooltips}
    assert names >= {"Ω [rpm]", "ω/2π [Hz]"}
    assert "Ω̄" not in names
    change(session, units="non-dimensional")
    assert live.figure.xaxis[0].axis_label == "spin speed Ω̄"
    assert picture(session) == expected(detail=Detail.COARSE)


def test_a_shaft_too_thick_for_its_length_is_told(session):
    answer = change(session, units="SI", shaft_length=0.02, shaft_diameter=500.0)
    assert "too thick" in answer["notice"]
    assert change(session, shaft_diameter=1.0)["notice"] == ""


def test_sessions_share_no_part_of_a_chart():
    first, second = Session(), Session({"spin": [b"1.25"]})
    pairs = zip(*(one.pages["explore"].charts.values() for one in (first, second)), strict=True)
    for one, other in pairs:
        assert not one.figure.references() & other.figure.references()
    second.respond({"type": "change", "values": {"spin_speed": 2.5}})
    fresh = Session()
    for key, chart in first.pages["explore"].charts.items():
        for label, source in chart.sources.items():
            other = fresh.pages["explore"].charts[key].sources[label]
            assert plain(dict(source.data)) == plain(dict(other.data))


def figures_drawn():
    return dict(cache_infos())["drawing.drawn"].misses


def test_what_is_drawn_at_the_start_is_only_copied_for_users():
    session = Session()  # as a worker does before it serves
    for kind in ("hello", "settle"):
        session.respond({"type": kind})
    made = figures_drawn()
    for query in ({"at": [b"1"], "f": [b"1.7"]}, {"u": [b"SI"], "at": [b"1"]}, {"ze": [b"0.02"]}):
        session = Session(query)
        session.respond({"type": "pin", "label": "a"})
        session.respond({"type": "change", "values": {"marker": True, "shear": 0.05}})
    assert figures_drawn() == made


def test_pages_that_nobody_has_opened_are_drawn_ahead_one_chart_at_a_time():
    ahead = Warming()
    while not ahead.done:
        before = figures_drawn()
        ahead.step()
        assert figures_drawn() - before <= 1
    made = figures_drawn()
    session = Session()
    session.respond({"type": "page", "name": "stiffness"})
    session.respond({"type": "page", "name": "paper"})
    for number in (2, 3, 6, 9):
        session.respond({"type": "figure", "number": number, "floquet": False})
    session.respond({"type": "page", "name": "explore"})
    session.respond({"type": "pin", "label": "a"})
    session.respond({"type": "change", "values": {"compared": "pin 1"}})
    assert set(session.pages["explore"].charts) >= {"comparison"}
    assert figures_drawn() == made


def test_no_two_charts_of_a_user_share_a_model():
    session = Session({"at": [b"1"]})
    seen = {}
    for page in session.pages.values():
        session.respond({"type": "page", "name": page.key})
        for key, chart in page.charts.items():
            for model in chart.figure.references():
                assert seen.setdefault(model.id, key) == key, (model, key)
    assert set(seen.values()) > {"instability", "orbit", "k11", "k22", "errors"}


def test_a_rotor_file_whose_speed_is_beyond_the_slider_is_taken_but_for_the_speed(session):
    change(session, spin_speed=1.0)
    text = ROTOR_FILE.read_text("utf-8").replace("1000 rpm", "30000 rpm")
    answer = session.respond({"type": "rotor_file", "text": text})
    assert "shaft_error" not in answer
    assert answer["shaft_notice"].startswith("The rotor was taken, but not line ")
    assert "operation.spin_speed gives Ω̄ = 30." in answer["shaft_notice"]
    assert answer["values"]["spin_speed"] == 1.0
    assert answer["shaft"]["in_use"]
    json.dumps(answer, allow_nan=False)


@pytest.mark.parametrize("kind", ["figure", "export", "report"])
def test_the_page_hears_that_a_figure_is_not_drawn(monkeypatch, kind):
    session = Session()
    monkeypatch.setattr(session.files, "full", lambda: True)
    answer = session.respond({"type": kind, "number": 9, "format": "svg"})
    assert "wait for one" in answer["toast"]
    assert ("wait for one" in answer.get("not_drawn", "")) is (kind == "figure")
