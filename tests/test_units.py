"""Charts in SI: axes, marks, maps and hover texts against the scales of the shaft."""

import math
import re

import numpy as np
import pytest

from app.analysis import CHARTS, solve
from app.state import State
from rotorstab import TABLE_1_SI, ShaftDisk, plots
from rotorstab.charts import axis_symbol, chart_factors, chart_figure, in_si, multiplier_chart
from rotorstab.export import figure_csv

ROTOR, SCALES = ShaftDisk.from_si(**TABLE_1_SI)
HERTZ = SCALES.frequency / (2 * math.pi)


def table_1(**values):
    state = State()
    state.apply_preset("Table 1, 1000 rpm")
    assert state.change(values) == {}
    return solve(state)


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
        assert plots.columns(other)


@pytest.mark.parametrize("key", CHARTS)
def test_no_text_of_a_chart_in_si_is_non_dimensional(result, key):
    si = both(result, key)[1]
    texts = [si.x_label, si.y_label, *plots.hover_names(si)]
    texts += [name for layer in si.layers for name in layer.columns.get("name", ())]
    assert not [text for text in texts if "\u0304" in text]
    assert all(axis_symbol(label)[1] in ("Hz", "rpm", "N") for label in (si.x_label, si.y_label))


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
    circle = multiplier_chart(np.array([1.0 + 0j]))
    assert in_si(circle, SCALES, 1.0, 1.0) is circle


def test_a_table_of_a_chart_in_si_names_its_units(result):
    text = figure_csv(chart_figure(both(result, "campbell")[1], {}))
    assert "x = Ω [rpm], y = ω/2π [Hz]" in text
    row = next(line for line in text.splitlines() if "present spin speed" in line)
    assert float(re.split(",", row)[-2]) == pytest.approx(1000)
