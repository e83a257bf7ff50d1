"""Numbers in words: no exponent where plain digits do, loads in the unit that suits the shaft."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.pages.explore import Explore
from app.results.analysis import CHARTS
from app.state import State
from rotorstab import TABLE_1_SI, ShaftDisk
from rotorstab.charts import LOAD_UNITS, load_unit, written
from rotorstab.drawing import screen

GAP = "\u202f"
THICK = {"shaft_diameter": 200.0, "shaft_length": 1.0}  # buckles at 38 MN
EXPONENT = re.compile(r"\d[eE][+−-]?\d")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1532.04, "1532"),
        (-4596.0, "−4596"),
        (12345.0, f"12{GAP}340"),
        (9999.7, f"10{GAP}000"),
        (2.298e7, f"22{GAP}980{GAP}000"),
        (0.08489, "0.08489"),
        (0.0001, "0.0001"),
        (1.0, "1"),
        (3.83e-7, "3.83 × 10⁻⁷"),
        (-2.5e12, "−2.5 × 10¹²"),
    ],
)
def test_a_number_has_no_exponent_where_plain_digits_do(value, text):
    assert written(value) == text


@given(st.floats(1e-15, 1e15), st.integers(1, 8), st.sampled_from([1, -1]))
def test_what_is_written_is_the_number(value, digits, sign):
    text = written(sign * value, digits).replace(GAP, "").replace("−", "-")
    mantissa, _, power = text.partition(" × 10")
    power = power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    assert float(f"{mantissa}e{power or 0}") == float(f"{sign * value:.{digits}g}")


@pytest.mark.parametrize("name", LOAD_UNITS)
def test_the_unit_of_load_leaves_axes_without_exponents(name):
    scales = ShaftDisk.from_si(**TABLE_1_SI)[1]
    for euler in (20.1, 19_900.0):  # of that unit
        load = euler * LOAD_UNITS[name] * 4 / math.pi**2
        assert load_unit(type(scales)(**{**vars(scales), "load": load})) == name


def explored(**values):
    state = State()
    assert state.change({"units": "SI", **values}) == {}
    return state, Explore()


def texts_of(page, state):
    """Every text that the page and its charts show of these settings."""
    answer = page.answer(state)
    pins = answer["pins"] or {"rows": []}
    point = answer["inspector"]
    found = [
        answer["verdict"],
        point["sentence"],
        point["explanation"],
        *map(" ".join, point["facts"]),
    ]
    found += [" ".join(row) for row in pins["rows"]]
    found += list(answer["si"]["hints"].values())
    charts = page.compute(state)
    for key in CHARTS:
        found += [charts[key].x_label, charts[key].y_label, *screen.hover_names(charts[key])]
        for layer in charts[key].layers:
            found += layer.columns.get("name", ())
    return found


@pytest.mark.parametrize("shaft", [{}, THICK], ids=["table 1", "thick"])
def test_nothing_in_si_is_non_dimensional_or_has_an_exponent(shaft):
    state, page = explored(**shaft, marker=True, external_damping=0.01)
    for name, value in [("spin_speed", 1.5), ("disk_mass", 8.0), ("polar_inertia", 0.7)]:
        page.handle({"type": "pin", "label": name}, state)
        state.change({name: value})
    texts = texts_of(page, state)
    assert not [text for text in texts if "\u0304" in text or EXPONENT.search(text)]
    unit = "MN" if shaft else "N"
    assert page.answer(state)["si"]["load_unit"] == unit
    words = [text for text in texts if "P_t = " in text or "static load P [" in text]
    assert len(words) >= 3
    for text in words:
        assert re.search(rf"[\d.{GAP}]+\xa0{unit}\b|\[{unit}\]", text), text


def test_the_pins_table_is_in_si_with_the_scales_of_each_pins_own_shaft():
    state, page = explored()
    page.handle({"type": "pin", "label": "thin"}, state)
    state.change(THICK | {"spin_speed": 1.0})
    rows = {row[0]: row[1:] for row in page.answer(state)["pins"]["rows"]}
    thin = State().scales()
    thick = state.scales()
    for label, one, old in [
        ("Spin speed Ω [rpm]", 1.0, 2.0),
        ("Disk mass M_D [kg]", 5.0, 5.0),
    ]:
        by = [
            scale.mass if "kg" in label else scale.frequency * 30 / math.pi
            for scale in (thick, thin)
        ]
        assert rows[label] == [written(one * by[0], 5), written(old * by[1], 5)]
    # the shafts differ in their inertias too, which are named as quantities with dimensions
    assert {"Diametral inertia I_D [kg m²]", "Polar inertia I_P [kg m²]"} <= set(rows)
    # one unit in one row: that of the present shaft
    buckling = page.answer(state)["numbers"]["buckling"]
    assert rows["Buckling load P_cr [MN]"] == [
        written(buckling * scale.load / 1e6, 5) for scale in (thick, thin)
    ]


def test_pinned_curves_of_a_thin_shaft_stand_in_the_unit_of_the_thick_one():
    state, page = explored()
    page.handle({"type": "pin", "label": "thin"}, state)
    before = page.compute(state)["load-frequency"]
    state.change(THICK)
    after = page.compute(state)["load-frequency"]
    assert before.x.unit == "N"
    assert after.x.unit == "MN"
    kept = [max(one) for one in after.layer("pins").columns["xs"]]
    drawn = [max(one) for one in before.layer("whirl").columns["xs"]]
    assert max(kept) == pytest.approx(max(drawn) / 1e6)


def test_a_thicker_shaft_renames_the_axes():
    state, page = explored()
    page.show(state)
    state.change(THICK)
    page.show(state)
    figure = page.charts["load-frequency"].figure
    assert figure.xaxis[0].axis_label == "static load P [MN]"
    assert figure.x_range.end == pytest.approx(page.compute(state)["load-frequency"].x_range[1])
