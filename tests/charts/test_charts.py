"""Charts as data, and what HoloViews and Bokeh make of them."""

import math
import re
from itertools import combinations, pairwise
from pathlib import Path

import holoviews as hv
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.live.chart import LiveChart
from app.results.analysis import CHARTS, solve
from app.results.limits import Detail
from app.state import PRESETS, State
from rotorstab import BASE_CASE, critical_load, load_frequency_curves, lumped
from rotorstab.charts import ROLES
from rotorstab.charts.columns import Lines, around_zero
from rotorstab.charts.quantities import Quantity
from rotorstab.charts.structure import Chart, Layer
from rotorstab.charts.tongues import tongue_labels
from rotorstab.drawing import screen

ASSETS = Path(__file__).parents[2] / "app" / "assets"
KINDS = {"blanks", "regions", "outlines", "lines", "points", "labels", "map", "bands", "edges"}
PAST_FLUTTER = {"load_type": "follower", "reference": "flutter", "static_load_factor": 0.95}


def solved(values=None, detail=Detail.COARSE):
    state = State()
    assert state.change(values or {}) == {}
    return solve(state, detail).charts


def sound(chart):
    """Check what every chart promises."""
    assert len({layer.label for layer in chart.layers}) == len(chart.layers)
    for low, high in (chart.x_range, chart.y_range):
        assert math.isfinite(low)
        assert math.isfinite(high)
        assert low < high
    for layer in chart.layers:
        where = chart.key, layer.label
        assert layer.kind in KINDS, where
        assert len({len(column) for column in layer.columns.values()}) == 1, where
        if layer.kind not in ("map", "bands"):
            assert all(layer.columns["name"]), where
        if layer.kind in ("lines", "outlines"):
            assert set(layer.columns["role"]) <= set(ROLES), where
            for xs, ys in zip(layer.columns["xs"], layer.columns["ys"], strict=True):
                assert len(xs) == len(ys) > 1, where
                assert not np.isinf([xs, ys]).any(), where  # NaN is a gap
        if layer.kind == "labels":
            for axis, (low, high) in (("x", chart.x_range), ("y", chart.y_range)):
                inside = (layer.columns[axis] >= low) & (layer.columns[axis] <= high)
                assert inside.all(), where
    return True


@pytest.mark.parametrize("stiffness", ["linear", "both"])
@pytest.mark.parametrize("spin", [0.0, 2.0, 4.0])
def test_labels_of_limits_stay_inside_and_apart(spin, stiffness):
    chart = solved({"spin_speed": spin, "stiffness": stiffness})["load-frequency"]
    labels = chart.layer("limit").columns
    low, high = chart.x_range
    rows = [
        (float(x), float(y), side, len(name))
        for x, y, name, side in zip(
            *(labels[key] for key in ("x", "y", "name", "side")), strict=True
        )
        if name.partition(",")[0] in ("buckling", "flutter")
    ]
    assert len(rows) == len(labels["name"]) > 0
    # a letter takes some 3 % of a phone's chart
    boxes = []
    for x, y, side, letters in rows:
        width = 0.03 * letters * (high - low)
        start = x if side.endswith("right") else x - width
        assert low <= start <= start + width <= high
        boxes.append((y, start, start + width))
    boxes.sort()
    for (line, _, end), (next_line, start, _) in pairwise(boxes):
        assert next_line > line or start >= end


@pytest.mark.parametrize("preset", [*PRESETS, None])
@pytest.mark.parametrize("detail", [Detail.COARSE, Detail.FULL])
def test_the_charts_of_every_preset_are_sound(preset, detail):
    found = solved(PRESETS.get(preset, PAST_FLUTTER), detail)
    assert tuple(found) == CHARTS
    assert all(sound(chart) for chart in found.values())


@settings(max_examples=6)
@given(
    st.fixed_dictionaries(
        {
            "load_type": st.sampled_from(["axial", "follower", "partly"]),
            "static_load_factor": st.floats(0, 0.95),
            "spin_speed": st.floats(0, 4),
            "shear": st.floats(0, 0.1),
            "disk_mass": st.floats(0.5, 20),
            "diametral_inertia": st.floats(0.01, 3),
            "polar_inertia": st.floats(0, 6),
            "stiffness": st.sampled_from(["linear", "exact", "both"]),
            "largest_factor": st.floats(0.05, 2),
        }
    )
)
def test_the_charts_are_sound_wherever_the_sliders_stand(values):
    assert all(sound(chart) for chart in solved(values).values())


def test_complex_stretches_are_drawn_apart_from_real_ones():
    loads = np.linspace(0, 3 * float(critical_load(BASE_CASE.shear)), 300)
    curves = load_frequency_curves(lumped(BASE_CASE, 1.0), loads)
    lines = Lines()
    lines.whirl(curves, ("axial", "axial"), "{}")
    rows = list(zip(*(lines.columns[key] for key in ("xs", "ys", "name", "role")), strict=True))
    assert any(role == "growing" for *_, role in rows)
    for name, column in zip(curves.names, curves.frequencies.T, strict=True):
        is_complex = np.abs(column.imag) > 1e-9 * np.abs(column)
        ((_, real, _, role),) = [row for row in rows if row[2] == name]
        assert role == "axial"
        np.testing.assert_array_equal(np.isnan(real), is_complex)
        np.testing.assert_array_equal(real[~is_complex], column.real[~is_complex])
        pairs = [row for row in rows if row[2] == f"{name}, growing"]
        assert len(pairs) == is_complex.any()
        for _, pair, _, _ in pairs:
            assert np.isfinite(pair[is_complex]).all()
            # the two stretches meet, and share no more than that
            both = np.isfinite(pair) & np.isfinite(real)
            changes = int(np.abs(np.diff(is_complex.astype(int))).sum())
            assert 1 <= both.sum() <= changes


def test_only_whirls_that_grow_are_drawn_as_growing():
    calm = solved({"external_damping": 0.05, "spin_speed": 2.0, "load_type": "follower"})
    assert "growing" not in calm["campbell"].layer("whirl").columns["role"]
    whirls = calm["load-frequency"].layer("whirl").columns
    for name, role in zip(whirls["name"], whirls["role"], strict=True):
        assert role == ("growing" if name.endswith("growing") else name.split(", ")[1])
    # internal damping drives the forward whirl beyond its critical speed, and no other
    driven = solved({"external_damping": 0.01, "internal_damping": 0.05})["campbell"]
    columns = driven.layer("whirl").columns
    rows = zip(columns["name"], columns["role"], strict=True)
    assert [name for name, role in rows if role == "growing"] == ["1F, growing"]


def test_the_present_values_are_marked():
    found = solved({"static_load_factor": 0.3, "spin_speed": 1.7})
    marks = found["load-frequency"].layer("marks").columns
    static = 0.3 * float(critical_load(BASE_CASE.shear))
    assert marks["xs"][marks["role"].index("current")] == pytest.approx([static, static])
    marks = found["campbell"].layer("marks").columns
    assert marks["xs"][marks["role"].index("current")] == pytest.approx([1.7, 1.7])


def test_critical_speeds_lie_on_the_synchronous_lines():
    points = solved()["campbell"].layer("critical speeds").columns
    assert len(points["x"])
    np.testing.assert_allclose(np.abs(points["y"]), points["x"])


@given(st.floats(-1e3, 0.0), st.floats(0.0, 1e3))
def test_a_range_around_zero_holds_its_ends_with_room(least, largest):
    low, high = around_zero(least, largest)
    room = 0.15 * (largest - least)  # for a label beyond each end
    for end, edge in ((-least, -low), (largest, high)):
        assert end + room <= edge * (1 + 1e-12)
        assert edge <= max(0.5, end + room + 2)


def test_roles_differ_by_more_than_colour():
    for group in (
        ("backward", "forward"),
        ("axial", "follower", "axial exact", "follower exact", "growing"),
        ("axial", "partly", "follower", "growing", "partly exact", "axial exact"),
        ("backward", "forward", "growing", "synchronous"),
        ("exact", "linear"),
    ):
        assert len({(ROLES[name].dash) for name in group}) == len(group), group


def test_a_colour_has_one_meaning_on_the_first_page():
    meanings = (
        ("backward",),
        ("forward",),
        ("axial", "axial exact"),
        ("follower", "follower exact"),
        ("partly", "partly exact"),
        ("edge", "growing", "envelope"),
        ("current",),
        ("marker", "tip V", "orbit"),
        ("tip W",),
        ("synchronous", "limit", "unit circle"),
        ("pin 1",),
        ("pin 2",),
        ("pin 3",),
    )
    colours = [{ROLES[name].color for name in names} for names in meanings]
    assert all(len(colour) == 1 for colour in colours)
    assert len(set().union(*colours)) == len(colours)


def _luminance(color):
    values = np.array([int(color[at : at + 2], 16) for at in (1, 3, 5)]) / 255
    linear = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    return linear @ (0.2126, 0.7152, 0.0722)  # WCAG 2.1


@pytest.mark.parametrize("ground", ["#ffffff", "#171e27"], ids=["light", "dark"])
def test_lines_have_a_contrast_of_three_on_both_grounds(ground):
    for name, role in ROLES.items():
        low, high = sorted((_luminance(role.color), _luminance(ground)))
        assert (high + 0.05) / (low + 0.05) >= 3, name


@pytest.mark.parametrize("key", CHARTS)
def test_what_holoviews_draws_is_the_charts_own_data(key):
    chart = solved()[key]
    overlay = screen.element(chart)
    assert isinstance(overlay, hv.Overlay)
    assert [element.label for element in overlay] == [layer.label for layer in chart.layers]
    assert (overlay.opts["xlabel"], overlay.opts["ylabel"]) == (chart.x_label, chart.y_label)
    for layer, element in zip(chart.layers, overlay, strict=True):
        if layer.kind in ("lines", "outlines"):
            paths = element.split(datatype="columns")
            for path, xs, ys in zip(paths, layer.columns["xs"], layer.columns["ys"], strict=True):
                np.testing.assert_array_equal(path["x"], xs)
                np.testing.assert_array_equal(path["y"], ys)
        elif layer.kind in ("points", "labels"):
            np.testing.assert_array_equal(element.dimension_values("x"), layer.columns["x"])
            np.testing.assert_array_equal(element.dimension_values("y"), layer.columns["y"])


@pytest.mark.parametrize("key", CHARTS)
def test_a_patched_chart_equals_one_built_anew(key):
    """What is patched has no column fewer, and no other order, than HoloViews' first drawing."""
    one, other = solved()[key], solved(PAST_FLUTTER)[key]
    patched, built = LiveChart(one), LiveChart(other)
    patched.show(other)
    for label, source in built.sources.items():
        got = patched.sources[label].data
        assert list(got) == list(source.data), label
        for name, column in source.data.items():
            np.testing.assert_equal(got[name], column, err_msg=f"{label} {name}")
    for axis in ("x_range", "y_range"):
        assert getattr(patched.figure, axis).start == getattr(built.figure, axis).start
        assert getattr(patched.figure, axis).end == getattr(built.figure, axis).end


def test_the_legend_of_the_map_shows_the_colours_of_the_map():
    """Growth lies over the shading, so that its colours are those of the colour bar everywhere."""
    labels = [layer.label for layer in solve(State()).charts["instability"].layers]
    assert labels[:4] == ["disagreement", "growth", "unstable", "Bolotin region"]
    css = (ASSETS / "page.css").read_text(encoding="utf-8")
    (stops,) = re.findall(r"--growth: linear-gradient\(to right, ([^)]*)\)", css)
    palette = screen.GROWTH_COLOURS
    places = [0, len(palette) // 3, 2 * len(palette) // 3, -1]
    assert stops.split(", ") == [palette[place] for place in places]
    over, under = (f"{colour}66" for colour in screen.DISAGREEMENT_COLOURS)  # 0x66 is 40 %
    assert (
        f".swatch.over {{ background: linear-gradient(to right, {over} 50%, {under} 50%); }}" in css
    )


def test_ticks_of_a_large_orbit_are_few_and_short():
    circle = np.exp(1j * np.linspace(0, 7, 50)) * 8e7
    lines = Lines()
    lines.add(circle.real, circle.imag, "path", "orbit")
    reach = (-1e8, 1e8)
    layers = (Layer("lines", "orbit", lines.columns),)
    chart = Chart(
        "orbit", "", Quantity("", "V"), Quantity("", "W"), reach, reach, layers, square=True
    )
    for axis in hv.render(screen.element(chart), backend="bokeh").axis:
        assert axis.ticker.desired_num_ticks <= 4
        assert "toExponential" in axis.formatter.code


# below the normal numbers a share of the window rounds to 0
@given(
    st.lists(st.floats(0.0, 12.0, allow_subnormal=False), max_size=8),
    st.floats(0.0, 3.0, allow_subnormal=False),
    st.floats(5.0, 14.0),
)
def test_names_of_tongues_stay_inside_and_clear_of_each_other(places, low, high):
    columns = tongue_labels([(x, "1B+1F") for x in places], (low, high), (0.0, 1.0)).columns
    rows = list(zip(columns["x"], columns["y"], columns["side"], strict=True))
    assert len(rows) == sum(low <= x <= high for x in places)
    spans = []
    for x, y, side in rows:
        share = (x - low) / (high - low)
        start, end = (share, share + 0.11) if side == "right" else (share - 0.11, share)
        assert start >= 0
        assert end <= 1 + 1e-12
        spans.append((start, end, y))
    for (a, b, y), (c, d, z) in combinations(spans, 2):
        assert min(b, d) - max(a, c) < 1e-9 or abs(y - z) > 0.03
