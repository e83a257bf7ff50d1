"""The dashboard's inputs, without Panel: what is taken, what is refused, and in what words."""

import math
import subprocess
import sys

import numpy as np
import param
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.state import PRESETS, SYMBOLS, State
from rotorstab import BASE_CASE, EULER_BERNOULLI_TWIN, TABLE_1_SI, ShaftDisk

NAMES = tuple(State().inputs())
CHOICES = {n: State.param[n].objects for n in NAMES if isinstance(State.param[n], param.Selector)}
SWITCHES = tuple(name for name in NAMES if isinstance(State.param[name], param.Boolean))
BOUNDS = {n: State.param[n].bounds for n in NAMES if n not in CHOICES and n not in SWITCHES}
GARBAGE = [
    math.nan,
    math.inf,
    -math.inf,
    1e308,
    -1e308,
    int("9" * 309),
    -int("9" * 309),
    10**5000,
    True,
    False,
    None,
    "",
    "0.5",
    "nan",
    "<img src=x onerror=alert(1)>",
    b"0.5",
    [],
    [0.5],
    (0.5,),
    {},
    {"value": 0.5},
    0.5j,
    np.array([0.5]),
    np.array([0.5, 0.6]),
    np.array(["axial", "follower"]),
    object(),
]


def type_name(value):
    return type(value).__name__


def valid(name):
    """Values of one input that are in its range."""
    if name in CHOICES:
        return st.sampled_from(CHOICES[name])
    if name in SWITCHES:
        return st.booleans()
    return st.floats(*BOUNDS[name])


any_value = st.one_of(
    st.floats(),
    st.integers(),
    st.booleans(),
    st.none(),
    st.text(),
    st.binary(),
    st.lists(st.floats(), max_size=3),
    st.sampled_from([word for words in CHOICES.values() for word in words]),
)


def holds(state):
    """Whether every input is what `State` promises: typed, finite, in range, fit for a chart."""
    inputs = state.inputs()
    assert tuple(inputs) == NAMES
    for name, value in inputs.items():
        if name in CHOICES:
            assert value in CHOICES[name]
        elif name in SWITCHES:
            assert type(value) is bool
        else:
            assert type(value) is float
            assert BOUNDS[name][0] <= value <= BOUNDS[name][1]
    assert state.highest_frequency - state.lowest_frequency >= 0.4
    hash(tuple(inputs.items()))
    return True


def test_panel_is_not_needed():
    code = "import sys, app.state; sys.exit(not {'panel', 'bokeh'}.isdisjoint(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_the_start_is_the_papers_base_case():
    state = State()
    assert holds(state)
    assert state.rotor() == BASE_CASE
    assert (state.static_load_factor, state.spin_speed, state.load_type) == (0.5, 2.0, "axial")


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("static_load_factor", 0, 0.95),
        ("spin_speed", 0, 4),
        ("shear", 0, 0.1),
        ("disk_mass", 0.5, 20),
        ("diametral_inertia", 0.01, 3),
        ("polar_inertia", 0, 6),
        ("tangency", 0, 1),
    ],
)
def test_bounds_are_those_that_the_page_promises(name, low, high):
    assert BOUNDS[name] == (low, high)


@pytest.mark.parametrize("name", NAMES)
def test_every_input_says_what_it_means(name):
    parameter = State.param[name]
    assert parameter.label
    assert len(parameter.doc) > 20
    assert "\n" not in parameter.doc
    if name in BOUNDS:
        assert SYMBOLS.get(name) or name in ("seed", "periods")
        assert 0 < parameter.step <= BOUNDS[name][1] - BOUNDS[name][0]


@pytest.mark.parametrize("name", BOUNDS)
def test_both_bounds_are_taken_and_their_neighbours_refused(name):
    low, high = BOUNDS[name]
    for value in (low, high):
        state = State(lowest_frequency=0.0, highest_frequency=40.0)
        assert state.change({name: value}) == {}
        assert getattr(state, name) == value
    state = State()
    before = state.inputs()
    for value in (math.nextafter(low, -math.inf), math.nextafter(high, math.inf)):
        assert state.change({name: value}) == {name: f"must be a number from {low:g} to {high:g}"}
        assert state.inputs() == before


@pytest.mark.parametrize("name", NAMES)
def test_garbage_is_refused_with_the_range(name):
    state = State()
    before = state.inputs()
    for value in GARBAGE:
        if name in SWITCHES and isinstance(value, bool):
            continue
        errors = state.change({name: value})
        assert list(errors) == [name]
        assert errors[name].startswith("must be")
        assert state.inputs() == before


@pytest.mark.parametrize(
    "name",
    ["", "name", "rotor", "param", "__class__", "x" * 10_000, 7, None, 1.5, (1,), 10**5000],
    ids=type_name,
)
def test_names_that_are_not_inputs_are_refused(name):
    state = State()
    before = state.inputs()
    errors = state.change({name: 0.5, "shear": 0.01})
    assert list(errors.values()) == ["unknown parameter"]
    assert all(isinstance(key, str) and len(key) <= 40 for key in errors)
    assert state.inputs() == before | {"shear": 0.01}


def test_integers_become_floats():
    state = State()
    assert state.change({"spin_speed": 3, "disk_mass": np.float64(4)}) == {}
    assert [type(state.spin_speed), state.spin_speed, state.disk_mass] == [float, 3.0, 4.0]
    assert holds(state)


def test_good_values_are_kept_while_bad_ones_are_refused():
    state = State()
    errors = state.change({"shear": 0.05, "spin_speed": math.nan, "polar_inertia": 2, "no": 1})
    assert set(errors) == {"spin_speed", "no"}
    assert (state.shear, state.spin_speed, state.polar_inertia) == (0.05, 2.0, 2.0)


@pytest.mark.parametrize(
    ("values", "refused"),
    [
        ({"lowest_frequency": 6.0}, {"lowest_frequency"}),
        ({"lowest_frequency": 5.7}, {"lowest_frequency"}),
        ({"lowest_frequency": 5.5}, set()),
        ({"lowest_frequency": 20.0, "highest_frequency": 30.0}, set()),
        (
            {"lowest_frequency": 20.0, "highest_frequency": 10.0},
            {"lowest_frequency", "highest_frequency"},
        ),
        ({"lowest_frequency": 20.0, "shear": 0.02}, {"lowest_frequency"}),
    ],
)
def test_the_ends_of_the_chart_are_checked_against_each_other(values, refused):
    state = State()
    errors = state.change(values)
    assert set(errors) == refused
    rules = {
        "lowest_frequency": "must be below the highest by 0.4 or more",
        "highest_frequency": "must exceed the lowest by 0.4 or more",
    }
    assert errors == {name: rules[name] for name in refused}
    assert holds(state)
    for name in set(values) - refused:
        assert getattr(state, name) == values[name]


def test_moving_the_tangency_means_a_partly_follower_load():
    state = State()
    assert state.effective_tangency() == 0.0
    state.change({"tangency": 0.3})
    assert (state.load_type, state.effective_tangency()) == ("partly", 0.3)
    state.change({"load_type": "follower"})
    assert state.effective_tangency() == 1.0
    state.change({"load_type": "axial", "tangency": 0.4})
    assert (state.effective_tangency(), state.tangency) == (0.0, 0.4)


@pytest.mark.parametrize(
    ("preset", "rotor"),
    [
        ("Base case", BASE_CASE),
        ("Euler–Bernoulli twin", EULER_BERNOULLI_TWIN),
        ("Table 1, at rest", ShaftDisk.from_si(**TABLE_1_SI)[0]),
        ("Table 1, 1000 rpm", ShaftDisk.from_si(**TABLE_1_SI)[0]),
    ],
)
def test_presets_bring_their_rotor_and_leave_the_ranges_of_the_charts(preset, rotor):
    state = State()
    state.change({"highest_frequency": 20.0, "shear": 0.09, "load_type": "follower"})
    state.change({"internal_damping": 0.1, "law": "exact", "model": "finite elements"})
    assert state.apply_preset(preset) == {}
    assert holds(state)
    got = state.rotor()
    for name in ("shear", "disk_mass", "diametral_inertia", "polar_inertia"):
        assert getattr(got, name) == getattr(rotor, name)
    assert (state.external_damping, state.internal_damping) == (0.0, 0.0)
    assert (state.model, state.law) == ("lumped", "linear")
    assert (state.highest_frequency, state.load_type) == (20.0, "axial")


def test_the_speeds_of_table_1():
    state = State()
    state.apply_preset("Table 1, at rest")
    assert state.spin_speed == 0.0
    state.apply_preset("Table 1, 1000 rpm")
    frequency = ShaftDisk.from_si(**TABLE_1_SI)[1].frequency
    assert state.spin_speed * frequency * 60 / (2 * math.pi) == pytest.approx(1000)


def test_every_preset_is_tested_and_named_in_the_state():
    tested = {"Base case", "Euler–Bernoulli twin", "Table 1, at rest", "Table 1, 1000 rpm"}
    assert set(PRESETS) == tested
    assert all(set(values) <= set(NAMES) for values in PRESETS.values())


@pytest.mark.parametrize(
    "name", ["", "base case", None, 1, [], {}, "x" * 10_000, 10**5000], ids=type_name
)
def test_a_preset_that_is_not_there_is_refused(name):
    state = State()
    before = state.inputs()
    (words,) = state.apply_preset(name).values()
    assert words.startswith("no preset named")
    assert len(words) < 80
    assert state.inputs() == before


def test_reset_brings_every_default_back():
    state = State()
    state.change({name: BOUNDS[name][0] for name in BOUNDS} | {"load_type": "follower"})
    state.change({"lowest_frequency": 20.0, "highest_frequency": 30.0})
    state.reset()
    assert state.inputs() == State().inputs()


@given(st.dictionaries(st.sampled_from(NAMES), any_value))
def test_whatever_comes_the_state_holds_and_only_good_values_move_it(values):
    state = State()
    before = state.inputs()
    errors = state.change(values)
    assert holds(state)
    assert set(errors) <= set(values)
    # moving the tangency means a partly follower load, moving E, G, ρ or κ an own material
    own = {"youngs_modulus", "shear_modulus", "density", "shear_coefficient"}
    place = {"marker_frequency", "marker_factor"}  # a moved marker follows no tongue
    for name, value in state.inputs().items():
        moved = name in values and name not in errors
        followed = name == "load_type" and "tangency" in values and "tangency" not in errors
        followed |= name == "material" and bool((own & set(values)) - set(errors))
        followed |= name == "marker_follows" and bool((place & set(values)) - set(errors))
        if moved:
            assert value == values[name]
        elif not followed:
            assert value == before[name]


@given(st.data())
def test_what_is_in_range_is_taken_as_it_is(data):
    names = data.draw(st.sets(st.sampled_from(NAMES)))
    values = {name: data.draw(valid(name)) for name in sorted(names)}
    values |= {"lowest_frequency": 1.0, "highest_frequency": 9.0}
    state = State()
    assert state.change(values) == {}
    assert state.inputs().items() >= values.items()
    assert State(**state.inputs()).inputs() == state.inputs()


@pytest.mark.parametrize("ends", [(0.2, 0.6), (1.0, 1.4), (15.6, 16.0), (0.1, 0.5)])
def test_a_range_of_just_0_4_is_taken(ends):
    state = State()
    low, high = ends
    assert state.change({"lowest_frequency": low, "highest_frequency": high}) == {}
    assert state.change({"highest_frequency": high - 0.001}) != {}


def test_numpy_s_numbers_and_truth_values_are_taken():
    state = State()
    values = {
        "spin_speed": np.int64(2),
        "shear": np.float32(0.05),
        "show_bolotin": np.True_,
    }
    assert state.change(values) == {}
    assert type(state.spin_speed) is float
    assert state.show_bolotin is True
    assert set(state.change({"spin_speed": np.True_, "show_growth": np.int64(1)})) == {
        "spin_speed",
        "show_growth",
    }
