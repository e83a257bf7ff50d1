"""Figures 4 to 9 with Floquet: outlines against exact edges and points, words, files."""

import csv
import json
import pickle
from functools import cache
from io import StringIO

import numpy as np
import pytest

from rotorstab import (
    BASE_CASE,
    TABLE_1_SI,
    ShaftDisk,
    critical_load,
    finite_element,
    fundamental_frequency,
    growth_rate,
    in_bolotin_region,
    lumped,
    stability_chart,
    tongue_edges,
    whirl_frequencies,
)
from rotorstab.drawing.tables import figure_csv, figure_json
from rotorstab.floquet.tongues.outlines import unstable_outlines
from rotorstab.model.finite_element import first_modes
from rotorstab.paper import FIGURES, FLOQUET_FIGURES
from tests.testing.paper import floquet_figure as figure

BUCKLING = float(critical_load(BASE_CASE.shear))
FREQUENCY = fundamental_frequency(lumped(BASE_CASE, 0.0))


@cache
def outlines(spin, tangency, factor):
    system = lumped(BASE_CASE, spin, tangency)
    limits = BUCKLING, 0.2 * FREQUENCY, 16 * FREQUENCY
    return unstable_outlines(system, factor * BUCKLING, *limits)


CASES = [(1.0, 0.0, 0.5), (2.0, 0.0, 0.2), (2.0, 1.0, 0.5)]


@pytest.mark.parametrize(
    ("case", "name"), [(CASES[0], "1B+1F"), (CASES[1], "2B+2F"), (CASES[2], "1F+2F")]
)
def test_outlines_have_the_exact_edges(case, name):
    spin, tangency, factor = case
    piece = next(one for one in outlines(*case) if one.name == name and one.order == 1)
    assert piece.pulsating_loads[0] == 0
    rows = [1, 8, 20]
    system = lumped(BASE_CASE, spin, tangency)
    exact = tongue_edges(system, factor * BUCKLING, piece.pulsating_loads[rows], (name,))
    assert piece.left[rows] == pytest.approx(exact.left[0], rel=1e-4)
    assert piece.right[rows] == pytest.approx(exact.right[0], rel=1e-4)


@pytest.mark.parametrize("case", CASES)
def test_points_inside_grow_and_points_outside_do_not(case):
    """Against a map of other columns: where they differ is the width of an edge."""
    spin, tangency, factor = case
    theta = (0.5 + (np.arange(300) + 0.5) / 300 * 11) * FREQUENCY
    loads = (np.arange(30) + 0.5) / 30 * BUCKLING
    chart = stability_chart(
        lumped(BASE_CASE, spin, tangency), factor * BUCKLING, loads, theta, find_narrow=False
    )
    inside = np.zeros(chart.unstable.shape, dtype=bool)
    for one in outlines(*case):
        rows = np.flatnonzero(
            (loads >= one.pulsating_loads[0]) & (loads <= one.pulsating_loads[-1])
        )
        left, right = (
            np.interp(loads[rows], one.pulsating_loads, edge)[:, None]
            for edge in (one.left, one.right)
        )
        inside[rows] |= (theta >= left) & (theta <= right)
    assert (inside != chart.unstable).mean() < 4e-3
    assert abs(inside.mean() - chart.unstable.mean()) < 2e-3


def test_outline_of_mathieu_at_rest_without_pulsation_is_a_point():
    first = next(one for one in outlines(1.0, 0.0, 0.5) if one.order == 1)
    assert first.left[0] == first.right[0]
    assert first.area > 0


def test_bad_arguments_are_refused():
    with pytest.raises(ValueError, match="`system` must have two coordinates and one spin speed"):
        unstable_outlines(lumped(BASE_CASE, [0.0, 1.0]), 0.0, 1.0, 0.5, 1.0)
    with pytest.raises(ValueError, match="`largest_load` must be"):
        unstable_outlines(lumped(BASE_CASE, 0.0), 0.0, 0.0, 0.5, 1.0)


def test_two_modes_of_the_finite_elements_are_enough():
    """Fig. 4's Floquet part: whirls within 1e-4, tongue edges where the whole model has them."""
    rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
    load = 0.5 * float(critical_load(rotor.shear))
    full = finite_element(rotor, 1000 * 2 * np.pi / 60 / scales.frequency, elements=20, modes=6)
    small = first_modes(full, load)
    whirl = whirl_frequencies(full, load).real
    whirl = whirl[np.argsort(np.abs(whirl))[:4]]
    reduced = whirl_frequencies(small, load).real
    assert np.sort(reduced) == pytest.approx(np.sort(whirl), rel=1e-3)
    edges = tongue_edges(small, load, [0.4 * load], ("1B+1F",))
    left, right = edges.left[0, 0], edges.right[0, 0]
    step = 0.02 * (right - left)
    theta = np.array([left - step, left + step, right - step, right + step])
    assert (growth_rate(full, load, 0.4 * load, theta) > 1e-6).tolist() == [
        False,
        True,
        True,
        False,
    ]


VERDICTS = {
    4: ["partly confirmed", "confirmed", "confirmed"],
    5: ["partly confirmed", "confirmed", "not confirmed", "not confirmed"],
    6: ["partly confirmed", "confirmed", "confirmed"],
    7: ["partly confirmed", "confirmed", "not confirmed", "not confirmed"],
    8: ["confirmed", "not confirmed", "partly confirmed"],
    9: ["partly confirmed", "confirmed", "confirmed"],
}


@pytest.mark.parametrize("number", FLOQUET_FIGURES)
def test_readings_say_what_is_confirmed(number):
    drawn, plain = figure(number), FIGURES[number]()
    count = len(plain.reading)
    assert drawn.reading[:count] == plain.reading
    assert [one.verdict for one in drawn.reading[count:]] == VERDICTS[number]
    for one in drawn.reading[count:]:
        assert one.text
        assert one.ours
        assert " nan" not in one.ours + one.note
    assert drawn.has_floquet
    assert not plain.has_floquet


@pytest.mark.parametrize("number", FLOQUET_FIGURES)
def test_bolotin_s_part_is_left_as_it_is(number):
    for drawn, plain in zip(figure(number).panels, FIGURES[number]().panels, strict=True):
        for one, other in zip(drawn.series, plain.series, strict=False):
            np.testing.assert_array_equal(one.x, other.x)
            np.testing.assert_array_equal(one.y, other.y)
        assert len(drawn.regions) == len(plain.regions)
        names = [one.name for one in (*drawn.series, *drawn.regions, *drawn.unstable)]
        assert len(set(names)) == len(names)
        # a Bolotin region is never called unstable
        assert not any("unstable" in one.name for one in drawn.regions)


def test_the_true_wedge_is_not_bolotin_s_band():
    """Fig. 6(c): ground inside the band that is stable, and a tongue outside every band."""
    system = lumped(BASE_CASE, 2.0)
    load, pulsating = 0.5 * BUCKLING, 0.3 * BUCKLING
    stable, tongue = 2.5 * FREQUENCY, 4.0 * FREQUENCY
    assert in_bolotin_region(system, load, pulsating, stable)
    assert not in_bolotin_region(system, load, pulsating, tongue)
    assert growth_rate(system, load, pulsating, stable) < 1e-8
    assert growth_rate(system, load, pulsating, tongue) > 0.02
    panel = figure(6).panel("c")
    found = [
        one.pair
        for one in panel.unstable
        if one.group == "α_s = 0.5"
        for y, left, right in [one.edges]
        if y[0] <= 0.3 <= y[-1] and np.interp(0.3, y, left) <= 4.0 <= np.interp(0.3, y, right)
    ]
    assert found == ["2B+1F"]
    assert set(panel.layer("tongue").columns["name"]) == {"1B+1F", "2B+1F", "1B+2F", "2B+2F"}


def test_figure_8_marks_pairs_between_their_whirls_and_unstable_loads():
    for panel, spin in zip(figure(8).panels, (0.0, 2.0), strict=True):
        pairs = [one for one in panel.series if one.pair]
        assert len(pairs) == 8
        for one in pairs:
            system = lumped(BASE_CASE, spin, float(one.group.startswith("follower")))
            whirl = whirl_frequencies(system, one.x[0]).real
            assert np.abs(whirl[:, None] - one.y).min(axis=0).max() < 1e-12
        for one in panel.unstable:
            system = lumped(BASE_CASE, spin, float(one.group.startswith("follower")))
            steps = whirl_frequencies(system, one.x[0] + np.array([-1e-4, 1e-4])).imag
            assert steps[0].min() > -1e-9
            assert steps[1].min() < -1e-5
    starts = [float(one.x[0]) for one in figure(8).panel("b").unstable]
    assert starts == pytest.approx([3.3712, 4.6471], abs=1e-4)


def test_figures_travel_to_another_process():
    for number in (6, 8):
        again = pickle.loads(pickle.dumps(figure(number)))
        assert figure_csv(again) == figure_csv(figure(number))


@pytest.mark.parametrize("number", [6, 8])
def test_tables_hold_the_outlines(number):
    drawn = figure(number)
    text = "".join(x for x in figure_csv(drawn).splitlines(keepends=True) if x[0] != "#")
    rows = [row for row in csv.DictReader(StringIO(text)) if row["kind"] == "unstable"]
    regions = [(panel, one) for panel in drawn.panels for one in panel.unstable]
    assert [float(row["x"]) for row in rows] == [
        x for _, one in regions for x in one.polygon[0].tolist()
    ]
    loaded = json.loads(figure_json(drawn))
    for panel, given in zip(drawn.panels, loaded["panels"], strict=True):
        assert [one["y"] for one in given["unstable"]] == [
            one.polygon[1].tolist() for one in panel.unstable
        ]


def test_other_parameters_have_words_too():
    """One panel, a rotor at rest, one factor: nothing breaks and nothing is NaN."""
    for number in (6, 7):
        drawn = FIGURES[number](spin_speeds=(0.5,), static_factors=(0.3,), floquet=True)
        assert all(" nan" not in one.ours + one.note for one in drawn.reading)


def test_drawn_with_matplotlib_and_bokeh():
    hv = pytest.importorskip("holoviews")
    pytest.importorskip("matplotlib")
    from matplotlib import pyplot
    from matplotlib.collections import PolyCollection

    from rotorstab.drawing.printed import paper_layout

    drawn = FIGURES[6](spin_speeds=(2.0,), static_factors=(0.5,), floquet=True)
    before = hv.Store.current_backend
    picture = hv.render(paper_layout(drawn), backend="matplotlib")
    filled = [
        path.vertices[:-1]
        for axes in picture.axes
        for one in axes.collections
        if isinstance(one, PolyCollection) and one.get_zorder() == 1
        for path in one.get_paths()
    ]
    pyplot.close(picture)
    assert len(filled) == len(drawn.panels[0].unstable)
    for vertices, region in zip(filled, drawn.panels[0].unstable, strict=True):
        np.testing.assert_array_equal(vertices, np.column_stack(region.polygon))
    hv.render(drawn.plot(), backend="bokeh")
    hv.Store.set_current_backend(before or "matplotlib")


def test_figure_8_with_floquet_has_a_panel_for_each_of_seven_speeds():
    figure = FIGURES[8](spin_speeds=tuple(np.linspace(0.0, 2.0, 7)), points=21, floquet=True)
    assert len(figure.panels) == 7
    assert all(f"Ω̄ = {speed:g}" in figure.reading[-1].ours for speed in np.linspace(0.0, 2.0, 7))
