"""The inspector: a marked point, its charts and words, the marks on the other charts, pins."""

import json
from base64 import b64decode
from types import SimpleNamespace

import numpy as np
import pytest

from app.live.overlay import TEMPORARY_LAYERS
from app.pages.animation import mean_angular_speed
from app.pages.marked_point import INSPECTOR_CHARTS, inspect
from app.reading.user_error import UserError
from app.results.analysis import CHARTS, solve
from app.results.limits import Detail
from app.results.marked_point import EDGE, marked_point, solve_point
from app.session import Session
from app.state import State
from app.state.address import from_arguments, to_query
from rotorstab import floquet_multipliers, growth_rate, initial_conditions, lumped, time_response
from rotorstab.drawing import screen
from rotorstab.floquet import integrator, sampled_period
from tests.testing.page import settle, wait_for_value

UNSTABLE = {"marker": True, "marker_frequency": 1.68, "marker_factor": 0.5}
# Bolotin's region without a tongue: the multipliers cross −1 and live
FALSE = {"marker": True, "marker_frequency": 12.0, "marker_factor": 0.3}


@pytest.fixture(scope="module")
def shared():
    return Session()


@pytest.fixture
def session(shared):
    """A session at its start, though its charts may have been made; a new one takes long."""
    for number in (1, 2, 3):
        shared.respond({"type": "unpin", "number": number})
    shared.respond({"type": "reset"})
    return shared


def change(session, **values):
    return session.respond({"type": "change", "values": values})


def data(session, chart, layer):
    return session.pages["explore"].charts[chart].sources[layer].data


def floats(text):
    return np.frombuffer(b64decode(text), "<f4").reshape(4, -1)


def fact(answer, name):
    return dict(answer["inspector"]["facts"])[name]


def test_without_a_marker_nothing_of_it_is_made():
    session = Session({"at": ["0"], "follow": ["0"]})
    for kind in ("hello", "settle"):
        answer = session.respond({"type": kind})
    assert answer["inspector"] is None
    assert answer["pins"] is None
    assert set(session.pages["explore"].charts) == set(CHARTS)
    for chart in session.pages["explore"].charts.values():
        assert not TEMPORARY_LAYERS & set(chart.sources)


def test_a_page_opens_with_a_moving_shaft_and_its_charts_come_with_the_second_message():
    session = Session()
    assert set(session.pages["explore"].charts) == set(CHARTS)
    answer = session.respond({"type": "hello"})
    assert answer["inspector"]["sentence"].startswith("Unstable: the whirl doubles every ")
    assert answer["inspector"]["sentence"].endswith(" periods of the load. Tongue 1B+1F.")
    assert answer["inspector"]["motion"]["cut"]
    assert set(session.pages["explore"].charts) == set(CHARTS)
    session.respond({"type": "settle"})
    assert set(session.pages["explore"].charts) == {*CHARTS, *INSPECTOR_CHARTS}
    assert list(data(session, "instability", "marker")["x"]) == [
        answer["values"]["marker_frequency"]
    ]


def test_the_marked_point_shows_what_the_solver_returns(session):
    answer = change(session, **UNSTABLE)
    state, numbers = session.state, answer["numbers"]
    system = lumped(state.rotor(), state.spin_speed)
    point = (numbers["static_load"], 0.5 * numbers["reference"], 1.68 * numbers["fundamental"])
    multipliers = floquet_multipliers(system, *point)
    drawn = [data(session, "multipliers", f"{kind}multipliers") for kind in ("", "growing ")]
    shown = np.concatenate([np.asarray(one["x"]) + 1j * np.asarray(one["y"]) for one in drawn])
    assert sorted(shown, key=abs) == pytest.approx(sorted(multipliers, key=abs))
    assert len(drawn[1]["x"]) == (abs(multipliers) > 1 + 1e-6).sum() == 1

    lines = data(session, "response", "motion")
    w, v = lines["ys"][2:]
    samples = (lines["xs"][3] < 1 - 1e-9).sum()
    motion = time_response(
        system, *point, initial_conditions(system, point[0], "knock"), 12, samples
    ).until(EDGE)
    assert abs(motion.displacement[-1]) > EDGE > abs(motion.displacement[:-1]).max()
    np.testing.assert_allclose(v + 1j * w, motion.displacement, rtol=1e-12, atol=1e-12)
    orbit = data(session, "orbit", "orbit")
    np.testing.assert_array_equal(orbit["xs"][0], v)

    rate = float(growth_rate(system, *point))
    assert float(fact(answer, "Growth rate σ̄")) == pytest.approx(rate, rel=1e-3)
    assert fact(answer, "Floquet") == "unstable"
    assert fact(answer, "Doubles in").startswith(f"{np.log(2) / rate / motion.period:.3g} periods")
    assert "Bolotin’s method says the same" in answer["inspector"]["explanation"]


def test_a_bolotin_region_without_a_tongue_is_told_as_such(session):
    answer = change(session, **FALSE)
    assert fact(answer, "Floquet") == "stable"
    assert fact(answer, "Bolotin") == "inside a Bolotin region"
    assert "no multiplier has left the unit circle" in answer["inspector"]["explanation"]
    assert data(session, "multipliers", "growing multipliers")["x"].size == 0


def test_damping_is_told_as_decay(session):
    answer = change(session, **FALSE, external_damping=0.05)
    assert fact(answer, "Floquet") == "stable: it decays"
    assert "Halves in" in dict(answer["inspector"]["facts"])


def test_the_marker_stays_in_its_units_and_marks_every_chart(session):
    change(session, **UNSTABLE)
    answer = change(session, spin_speed=1.0, static_load_factor=0.2)
    marker = data(session, "instability", "marker")
    assert (list(marker["x"]), list(marker["y"])) == ([1.68], [0.5])
    result = solve(session.state, Detail.COARSE)
    excitation = 1.68 * answer["numbers"]["fundamental"]
    load, campbell = (data(session, key, "marker") for key in ("load-frequency", "campbell"))
    assert list(load["x"]) == [result.numbers["static_load"]] * 2
    assert list(campbell["x"]) == [1.0] * 2
    assert list(load["y"]) == list(campbell["y"])
    frequencies = [real for real, _ in result.numbers["whirl"].values()]
    gaps = [abs(a - b) for a in frequencies for b in frequencies]
    nearest = min(gaps, key=lambda gap: abs(gap - excitation))
    assert abs(load["y"][1] - load["y"][0]) == pytest.approx(nearest, abs=1e-9)
    ruler = data(session, "campbell", "marker ruler")["ys"][0]
    assert ruler[1] - ruler[0] == pytest.approx(excitation)


def test_the_full_map_stays_while_only_the_point_moves(session):
    change(session, **UNSTABLE)
    assert session.respond({"type": "settle"})["settled"]
    whole = data(session, "instability", "growth")["image"][0]
    answer = change(session, marker_frequency=1.7)
    assert (answer["settled"], answer["at_rest"]) == (True, False)
    assert data(session, "instability", "growth")["image"][0] is whole
    assert not change(session, spin_speed=1.913)["settled"]
    # the full map of this speed is not known yet
    assert not change(session, marker_frequency=1.71)["settled"]


def test_the_motion_comes_with_every_change_and_equals_the_chart(session):
    motion = change(session, **UNSTABLE)["inspector"]["motion"]
    assert motion == session.respond({"type": "settle"})["inspector"]["motion"]
    tip = floats(motion["tip"])
    w, v = data(session, "response", "motion")["ys"][2:]
    np.testing.assert_allclose(tip[0] * EDGE, v, rtol=0, atol=1e-5)
    np.testing.assert_allclose(tip[1] * EDGE, w, rtol=0, atol=1e-5)
    assert motion["edge"] == EDGE
    # the shapes are clamped at the root and meet the tip
    assert [row[0] for row in motion["shapes"]] == [0, 0]
    assert [row[-1] for row in motion["shapes"]] == pytest.approx([1, 0], abs=1e-6)
    assert len(json.dumps(motion)) < 150_000


def test_the_scale_is_fixed_growth_reaches_the_edge_and_a_stable_motion_stays_small(session):
    sizes = {}
    for name, values in (("unstable", UNSTABLE), ("stable", UNSTABLE | {"marker_frequency": 3.0})):
        motion = change(session, **values)["inspector"]["motion"]
        sizes[name] = np.hypot(*floats(motion["tip"])[:2])
        assert motion["cut"] == (name == "unstable")
    first = motion["samples"]
    assert sizes["unstable"][:first].max() < 0.2
    assert sizes["unstable"][-1] > 1 > sizes["unstable"][:-1].max()
    assert sizes["stable"].max() < 0.2


def test_a_number_of_periods_is_shown_as_a_whole(session):
    change(session, **UNSTABLE, periods=12)
    lines = data(session, "response", "motion")
    assert lines["xs"][3][-1] == pytest.approx(12)
    assert abs(lines["ys"][3]).max() > EDGE


@pytest.mark.parametrize("initial", State.param.initial.objects)
def test_every_start_has_a_motion(session, initial):
    answer = change(session, **UNSTABLE, initial=initial, periods=3)
    assert answer["notice"] == ""
    assert fact(answer, "Floquet") == "unstable"


def test_a_seed_gives_one_noise(session):
    change(session, **UNSTABLE, initial="noise", seed=4, periods=3)
    first = np.array(data(session, "response", "motion")["ys"][3])
    change(session, seed=5)
    assert (np.array(data(session, "response", "motion")["ys"][3]) != first).any()
    change(session, seed=4)
    np.testing.assert_array_equal(data(session, "response", "motion")["ys"][3], first)


@pytest.mark.parametrize(
    "corner",
    [
        {"marker_frequency": 0.05, "periods": 400},
        {"marker_frequency": 40.0, "marker_factor": 2.0},
        {"marker_factor": 0.0},
        {"marker_factor": 2.0, "static_load_factor": 0.95, "load_type": "follower"},
        {"model": "finite elements", "initial": "mode 2F"},
        # a map of ten seconds; tests/app/exports/test_snippet.py has this law up to its pole
        pytest.param(
            {"law": "exact", "load_type": "follower", "reference": "flutter", "marker_factor": 2.0},
            marks=pytest.mark.long,
        ),
        {"spin_speed": 0.0, "initial": "mode 1B"},
        {"shear": 0.0, "polar_inertia": 0.0, "initial": "noise"},
        {"reference": "flutter", "static_load_factor": 0.95, "initial": "mode 1F"},
    ],
)
def test_corners_answer_and_stay_small(session, corner):
    answer = change(session, **(UNSTABLE | corner))
    assert answer["inspector"]["sentence"]
    answer = session.respond({"type": "settle"})
    assert len(json.dumps(answer)) < 250_000
    json.loads(json.dumps(answer, allow_nan=False))


def test_a_point_without_an_answer_leaves_the_charts(session, monkeypatch):
    def refuse(*_):
        raise UserError("no answer here")

    monkeypatch.setattr("app.pages.explore.inspect", refuse)
    answer = change(session, **UNSTABLE)
    assert answer["inspector"]["sentence"] == "no answer here"
    assert answer["notice"] == ""
    assert list(data(session, "instability", "marker")["x"]) == [1.68]


def test_removing_the_marker_clears_its_marks(session):
    change(session, **UNSTABLE)
    answer = change(session, marker=False)
    assert answer["inspector"] is None
    for key in CHARTS:
        assert len(data(session, key, "marker")["x"]) == 0
    assert len(data(session, "campbell", "marker ruler")["xs"]) == 0
    change(session, marker=True)
    assert list(data(session, "instability", "marker")["x"]) == [1.68]
    export = {"type": "export", "chart": "orbit", "format": "csv"}
    change(session, marker=False)
    assert session.respond(export)["toast"] == "no such chart"


def test_the_address_holds_the_point_and_its_start():
    state = State()
    values = UNSTABLE | {"initial": "mode 2B", "seed": 7.0, "periods": 33.0}
    assert state.change(values) == {}
    query = to_query(state.inputs())
    arguments = {key: [value] for key, value in (pair.split("=") for pair in query.split("&"))}
    arguments["ic"] = ["mode 2B"]
    again, doubtful = from_arguments(arguments)
    assert doubtful == []
    assert again.items() >= values.items()
    assert again["marker_follows"] is False


@pytest.mark.parametrize(
    "values",
    [
        {"marker_frequency": float("nan")},
        {"marker_factor": 1e308},
        {"marker": 1},
        {"initial": "mode 9F"},
        {"periods": -1},
        {"seed": "<b>"},
    ],
)
def test_forged_values_are_refused(session, values):
    before = session.state.inputs()
    answer = change(session, **values)
    assert set(answer["errors"]) == set(values)
    assert session.state.inputs() == before


def test_charts_equal_their_layers(session):
    change(session, **UNSTABLE)
    session.respond({"type": "settle"})
    found = inspect(session.state, solve(session.state))
    assert set(found.charts) == set(INSPECTOR_CHARTS)
    for key, chart in found.charts.items():
        for layer in chart.layers:
            for name, column in screen.columns(layer).items():
                shown = data(session, key, layer.label)[name]
                assert all(map(np.array_equal, shown, column)), (key, layer.label, name)


def test_pins_keep_curves_and_tell_what_differs(session):
    before = [np.array(ys) for ys in data(session, "campbell", "whirl")["ys"]]
    answer = session.respond({"type": "pin", "label": "  slow \n one "})
    assert answer["pins"]["names"] == [{"name": "slow one", "number": 1}]
    assert answer["pins"]["rows"] == []
    answer = change(session, static_load_factor=0.2)
    rows = {row[0]: row[1:] for row in answer["pins"]["rows"]}
    assert rows["Static load factor α_s"] == ["0.2", "0.5"]
    assert {"Static load p̄_0", "Whirl 1F ω̄"} <= set(rows)
    ghosts = data(session, "campbell", "pins")
    assert len(ghosts["ys"]) == 4  # not the synchronous lines
    for ghost, line in zip(ghosts["ys"], before, strict=False):
        np.testing.assert_array_equal(ghost, line)
    # where a pin's curve is the present one there is no ghost
    assert len(data(session, "load-frequency", "pins")["ys"]) == 0
    for label in ("", None):
        session.respond({"type": "pin", "label": label})
    answer = session.respond({"type": "pin", "label": "too many"})
    assert "at most 3" in answer["toast"]
    assert [one["name"] for one in answer["pins"]["names"]] == ["slow one", "Pin B", "Pin C"]
    assert answer["pins"]["full"]
    for number in (1, 2, 3, 9):
        answer = session.respond({"type": "unpin", "number": number})
    assert answer["pins"] is None
    for key, label in (
        ("instability", "pinned boundary"),
        ("instability", "pinned edge"),
        ("instability", "pin name"),
        ("load-frequency", "pins"),
        ("campbell", "pins"),
    ):
        assert all(len(column) == 0 for column in data(session, key, label).values())


# -- in a browser --------------------------------------------------------------------------------


def drawn(page, chart, layer_key, column):
    """A column of a chart's source in the browser, by one of its line names."""
    return page.evaluate(
        """([chart, name, column]) => {
          const figure = Bokeh.documents[0].roots().flatMap((root) => [...root.references()])
            .find((model) => model.name === chart && model.renderers);
          for (const renderer of figure.renderers) {
            const data = renderer.data_source.data;
            const at = [...(data.name ?? [])].indexOf(name);
            if (at >= 0) return Array.from(data[column][at]);
          }
          return null;
        }""",
        [chart, layer_key, column],
    )


def settled(page):
    page.wait_for_function("rotorstab.last?.settled && rotorstab.last.inspector?.motion")


@pytest.mark.browser
def test_click_keys_and_boxes_move_the_marker_and_the_panel_follows(page):
    box = page.locator("[data-page=explore] .plot.tall").bounding_box()
    page.mouse.click(box["x"] + 0.2 * box["width"], box["y"] + 0.6 * box["height"])
    settled(page)
    page.wait_for_function("!rotorstab.last.values.marker_follows")
    values = page.evaluate("rotorstab.last.values")
    assert 0.5 < values["marker_frequency"] < 6
    assert 0.1 < values["marker_factor"] < 0.9

    page.locator("[data-marker=marker_frequency]").fill("1.67")
    page.locator("[data-marker=marker_frequency]").press("Enter")
    page.locator("[data-marker=marker_factor]").fill("0.49")
    page.locator("[data-marker=marker_factor]").press("Enter")
    wait_for_value(page, "marker_factor", 0.49)
    settle(page, "marker_frequency", 1.67)
    page.wait_for_function("rotorstab.messages.waited() === 0")
    assert page.locator("[data-point]").inner_text().startswith("Unstable: ")

    state = State()
    state.change(page.evaluate("rotorstab.last.values"))
    motion = solve_point(*marked_point(state)).response
    # the charts of the point may come after its words
    for _ in range(100):
        if len(drawn(page, "response", "V of the tip", "ys")) == motion.displacement.size:
            break
        page.wait_for_timeout(50)
    page.wait_for_function("Bokeh.documents[0].is_idle")
    np.testing.assert_allclose(
        drawn(page, "response", "V of the tip", "ys"), motion.displacement.real, atol=1e-12
    )
    np.testing.assert_allclose(
        drawn(page, "orbit", "path of the tip", "ys"), motion.displacement.imag, atol=1e-12
    )
    # the animation: paused for those who want no motion; a step moves it
    assert page.evaluate("rotorstab.motion.state.playing") is False
    page.locator(".shaft-side").scroll_into_view_if_needed()
    page.locator(".shaft-side").press("ArrowRight")
    assert page.evaluate("rotorstab.motion.state.index") > 0
    tip = page.evaluate("Array.from(rotorstab.motion.state.rows[0])")
    np.testing.assert_allclose(np.array(tip) * EDGE, motion.displacement.real, rtol=0, atol=1e-5)
    page.locator(".shaft-play").click()
    page.wait_for_function("rotorstab.motion.state.playing")
    page.locator("a[href='#stiffness']").click()
    page.wait_for_function("!rotorstab.motion.state.playing")
    page.locator("a[href='#explore']").click()
    page.locator(".marker-remove").click()
    page.wait_for_function("rotorstab.last.inspector === null")
    assert page.locator(".shaft").is_hidden()
    assert page.locator("[data-point]").inner_text().startswith("No point is marked")
    page.locator(".marker-keys").click()
    page.locator(".shaft").wait_for(state="visible")


@pytest.mark.parametrize(
    "values",
    [
        # found by a random search of the sliders' ranges: 6 to 30 s of the server's one thread
        {"model": "finite elements", "internal_damping": 0.2, "marker_frequency": 0.05},
        {"model": "finite elements", "external_damping": 0.2, "marker_frequency": 0.2,
         "disk_mass": 0.5, "diametral_inertia": 0.01},
        {"law": "exact", "internal_damping": 0.2, "marker_frequency": 0.05,
         "diametral_inertia": 0.01},
        {"law": "exact", "static_load_factor": 0.95, "marker_factor": 1, "marker_frequency": 0.2},
        {"marker_frequency": 0.05, "external_damping": 0.1},
    ],
)  # fmt: skip
def test_no_point_costs_more_than_a_bounded_number_of_steps(monkeypatch, values):
    """And where it is not shown, it is said why and what to do."""
    spent, whole = [], integrator.segment_propagators

    def counted(*arguments):
        spent.append(arguments[5] * arguments[7])
        return whole(*arguments)

    state = State()
    assert state.change(values | {"marker": True}) == {}
    solve(state, detail=Detail.COARSE)  # these inputs have charts
    monkeypatch.setattr(integrator, "segment_propagators", counted)
    monkeypatch.setattr(sampled_period, "segment_propagators", counted)
    try:
        assert solve_point(*marked_point(state)).response.error < 1e-6
    except ValueError as error:
        problem = str(error)
    else:
        problem = ""
    assert not problem or "Choose a higher θ/ωₙ" in problem
    # multipliers and motion, with doublings, three levels each
    assert bool(spent) or problem
    assert sum(spent) < 2 * 2 * 12 / 5 * 5000


def test_the_usual_points_are_all_shown():
    """Down to θ/ωₙ = 0.3 for the base case, with either law and either model."""
    for values in ({}, {"law": "exact"}, {"model": "finite elements"}, {"external_damping": 0.05}):
        state = State()
        state.change(values | {"marker": True, "marker_frequency": 0.3})
        assert inspect(state, solve(state, detail=Detail.COARSE)).sentence


def test_the_pace_of_a_motion_near_the_end_of_double_precision():
    time = np.linspace(0, 10, 200)
    for size in (1.0, 1e200, 0.0):
        motion = SimpleNamespace(time=time, displacement=size * np.exp(1.5j * time))
        assert mean_angular_speed(motion) == pytest.approx(1.5 if size else 0.0)
