"""Charts in SI: axes, marks, maps and hover texts against the scales of the shaft."""

import math
import re

import numpy as np
import pytest

from app.exports.report import report_html
from app.lessons.markdown import plain as as_html
from app.pages.marked_point import inspect
from app.results.analysis import CHARTS, solve
from app.results.limits import Detail
from app.state import State
from app.words.units import Units
from app.words.verdict import verdict
from rotorstab import BASE_CASE, TABLE_1_SI, ShaftDisk, floquet_solution, lumped
from rotorstab.charts import chart_factors, chart_figure, in_si, multiplier_chart, written
from rotorstab.drawing import screen
from rotorstab.drawing.tables import figure_csv

ROTOR, SCALES = ShaftDisk.from_si(**TABLE_1_SI)
HERTZ = SCALES.frequency / (2 * math.pi)


def table_1(detail=Detail.FULL, **values):
    state = State()
    state.apply_preset("Table 1, 1000 rpm")
    assert state.change(values) == {}
    return solve(state, detail)


def both(result, key):
    numbers = result.numbers
    scale = SCALES, numbers["fundamental"], numbers["reference"]
    return result.charts[key], in_si(result.charts[key], *scale), chart_factors(key, *scale)


@pytest.fixture(scope="module")
def result():
    return table_1()


def test_the_factors_are_those_of_the_quantities(result):
    numbers = result.numbers
    assert both(result, "campbell")[2] == pytest.approx((60 * HERTZ, HERTZ))
    assert both(result, "load-frequency")[2] == pytest.approx((SCALES.load, HERTZ))
    instability = (numbers["fundamental"] * HERTZ, numbers["reference"] * SCALES.load)
    assert both(result, "instability")[2] == pytest.approx(instability)
    assert chart_factors("multipliers", SCALES, 1.0, 1.0) == (1.0, 1.0)


def test_table_1_turns_at_1000_rpm_below_euler_s_load(result):
    campbell = both(result, "campbell")[1]
    (line,) = campbell.layer("marks").columns["xs"]
    assert line == pytest.approx(1000)
    assert campbell.layer("marks").columns["name"] == ["present spin speed, Ω = 1000 rpm"]
    # π²EI/4L² of the shaft, less a little for shear
    bending = 207e9 * math.pi * 0.02**4 / 64
    euler = math.pi**2 * bending / (4 * 0.5**2)
    load = both(result, "load-frequency")[1].layer("marks").columns
    buckling = next(
        x[0] for x, name in zip(load["xs"], load["name"], strict=True) if "buckling" in name
    )
    assert buckling == pytest.approx(euler, rel=1e-3)


@pytest.mark.parametrize("key", CHARTS)
def test_every_mark_is_scaled_and_none_lost(result, key):
    plain, si, (x, y) = both(result, key)
    assert [one.label for one in si.layers] == [one.label for one in plain.layers]
    assert si.x_range == pytest.approx(np.multiply(plain.x_range, x))
    assert si.y_range == pytest.approx(np.multiply(plain.y_range, y))
    for one, other in zip(plain.layers, si.layers, strict=True):
        assert list(one.columns) == list(other.columns)
        for name, factor in (("x", x), ("y", y), ("xs", x), ("ys", y), ("dw", x), ("dh", y)):
            if name in one.columns:
                for a, b in zip(one.columns[name], other.columns[name], strict=True):
                    np.testing.assert_allclose(np.asarray(b), np.asarray(a) * factor)
        assert screen.columns(other)


@pytest.mark.parametrize("key", CHARTS)
def test_no_text_of_a_chart_in_si_is_non_dimensional(result, key):
    si = both(result, key)[1]
    texts = [si.x_label, si.y_label, *screen.hover_names(si)]
    texts += [name for layer in si.layers for name in layer.columns.get("name", ())]
    assert not [text for text in texts if "\u0304" in text]
    assert all(axis.unit in ("Hz", "rpm", "N") for axis in (si.x, si.y))


def test_growth_is_per_second_and_its_product_with_the_period_is_the_same(result):
    plain, si, _ = both(result, "instability")
    one, other = plain.layer("growth").columns, si.layer("growth").columns
    for name in ("image", "rate"):
        np.testing.assert_allclose(other[name][0], one[name][0] * SCALES.frequency, rtol=1e-6)
    # the hover multiplies by 2π/(abscissa · frequency)
    middle = np.mean(plain.x_range), np.mean(si.x_range)
    periods = [
        2 * math.pi / (x * c["frequency"][0]) for x, c in zip(middle, (one, other), strict=True)
    ]
    assert periods[1] * SCALES.frequency == pytest.approx(periods[0])


def test_growth_per_period_is_left_as_it_is():
    plain, si, _ = both(table_1(growth_unit="per period", largest_factor=0.5), "instability")
    np.testing.assert_array_equal(
        plain.layer("growth").columns["image"][0], si.layer("growth").columns["image"][0]
    )


def test_conversion_happens_once_and_only_where_there_are_dimensions(result):
    si = both(result, "campbell")[1]
    assert in_si(si, SCALES, 1.0, 1.0) is si
    circle = multiplier_chart(floquet_solution(lumped(BASE_CASE, 2.0), 1.0, 0.1, 1.3))
    assert in_si(circle, SCALES, 1.0, 1.0) is circle


def test_a_table_of_a_chart_in_si_names_its_units(result):
    text = figure_csv(chart_figure(both(result, "campbell")[1], {}))
    assert "x = Ω [rpm], y = ω/2π [Hz]" in text
    row = next(line for line in text.splitlines() if "present spin speed" in line)
    assert float(re.split(",", row)[-2]) == pytest.approx(1000)


def numbers_of(text, pattern):
    return [float(one.replace("−", "-")) for one in re.findall(pattern, text)]


def test_the_verdict_names_tongues_in_hertz_and_loads_in_newtons(result):
    table = result.floquet.table
    plain, words = verdict(result.floquet), verdict(result.floquet, SCALES)
    assert "Hz" not in plain
    assert "\u0304" not in words
    assert "θ/ωₙ" not in words
    low, high = result.floquet.frequency_range
    inside = [
        one.centre * HERTZ
        for one in table.tongues
        if low <= one.centre / result.numbers["fundamental"] <= high
    ]
    assert inside
    assert numbers_of(words, r"at ([\d.]+)\u00a0Hz") == pytest.approx(inside[:6], rel=1e-3)
    load = 0.1 * result.numbers["reference"] * SCALES.load
    assert numbers_of(words, r"β_d = 0.1 \(P_t = ([\d.]+)\u00a0N\)") == pytest.approx(
        [load], rel=1e-3
    )


def test_the_verdict_gives_thresholds_and_growth_in_si():
    damped = table_1(Detail.COARSE, external_damping=0.02).floquet
    first = min(damped.table, key=lambda row: row.threshold)
    found = numbers_of(verdict(damped, SCALES), r"up to β_d = [\d.]+ \(P_t = ([\d.]+)\u00a0N\)")
    assert found == pytest.approx([first.threshold * SCALES.load], rel=1e-3)
    whirling = table_1(Detail.COARSE, internal_damping=0.2, spin_speed=4.0).floquet
    assert whirling.table.mean_growth > 0
    found = numbers_of(verdict(whirling, SCALES), r"σ = ([\d.e+-]+) per second")
    assert found == pytest.approx([whirling.table.mean_growth * SCALES.frequency], rel=1e-2)


POINT = {"marker": True, "marker_frequency": 2.0, "marker_factor": 0.4}


@pytest.mark.parametrize("extra", [{}, {"external_damping": 0.15}, {"marker_factor": 0.0}])
def test_a_point_is_told_in_hertz_newtons_and_seconds(extra):
    state = State()
    state.apply_preset("Table 1, 1000 rpm")
    assert state.change(POINT | extra) == {}
    plain = inspect(state, solve(state, Detail.COARSE))
    state.change({"units": "SI"})
    result = solve(state, Detail.COARSE)
    si = inspect(state, result)
    facts, old = dict(si.facts), dict(plain.facts)
    texts = [si.sentence, si.explanation, *facts, *facts.values(), si.charts["response"].x_label]
    assert not [text for text in texts if "\u0304" in text or "θ/ωₙ" in text]
    excitation = state.marker_frequency * result.numbers["fundamental"]
    assert numbers_of(si.explanation, r"At θ/2π = ([\d.]+)\u00a0Hz") == pytest.approx(
        [excitation * HERTZ], rel=1e-3
    )
    load = state.marker_factor * result.numbers["reference"] * SCALES.load
    assert numbers_of(si.explanation, r"P_t = ([\d.]+)\u00a0N")[0] == pytest.approx(load, rel=1e-3)
    period = numbers_of(facts["Period T of the load"], r"([\d.]+)\u00a0s")
    assert period == pytest.approx([1 / (excitation * HERTZ)], rel=1e-3)
    for name, factor, unit in (("Doubles in", 1, "s"), ("Halves in", 1, "s")):
        if "periods" in old.get(name, ""):
            (count,) = numbers_of(facts[name], r"([\d.e+-]+) periods")
            assert numbers_of(facts[name], rf"\(([\d.]+)\u00a0{unit}\)") == pytest.approx(
                [factor * count * period[0]], rel=6e-3
            )
    if "1/s" in facts["Growth rate σ"]:
        (growth,) = numbers_of(facts["Growth rate σ"], r"([−\d.e]+)\u00a01/s")
        (before,) = numbers_of(old["Growth rate σ̄"], r"([−\d.e]+)")
        assert growth == pytest.approx(before * SCALES.frequency, rel=1e-3)
    # the same motion, over seconds
    seconds, periods = (one.charts["response"].layer("motion").columns for one in (si, plain))
    for new, was in zip(seconds["xs"], periods["xs"], strict=True):
        np.testing.assert_allclose(new, was * 2 * math.pi / excitation / SCALES.frequency)
    assert si.motion["load"] == ["P", " N"]
    assert si.motion["static"] == pytest.approx(plain.motion["static"] * SCALES.load)
    assert screen.hover_names(si.charts["response"])[0] == "t [s]"


def test_units_of_a_difference_keep_its_sign():
    assert Units(1.5, 1.0, SCALES).offset(-0.1) == f"−{0.15 * HERTZ:.3g}\u00a0Hz"
    assert Units(1.5, 1.0, None).offset(-0.1) == "−0.100"


def test_the_report_in_si_holds_the_verdict_in_si(result):
    state = State()
    state.apply_preset("Table 1, 1000 rpm")
    state.change({"units": "SI"})
    words = verdict(result.floquet, SCALES)
    page = report_html(state, result.numbers, [words], {"a": "<svg></svg>"}, "v=1")
    assert as_html(words) in page
    buckling = result.numbers["buckling"] * SCALES.load
    assert written(buckling, 6) in page


def test_the_colours_of_an_exported_map_name_the_unit_of_their_numbers():
    state = State()
    result = solve(state, Detail.COARSE)
    chart = result.charts["instability"]
    numbers = result.numbers["fundamental"], result.numbers["reference"]
    labels = [
        figure.panels[0].layer("growth").quantity.label(with_unit=figure.panels[0].in_si)
        for figure in (
            chart_figure(chart, {}),
            chart_figure(in_si(chart, state.scales(), *numbers), {}),
        )
    ]
    assert labels == ["growth rate σ̄", "growth rate σ [1/s]"]
