"""Outlines and areas of what is unstable, as they are drawn, against Floquet's single points."""

from itertools import product

import numpy as np
import pytest

from app.results.analysis import GROWTH_TOPS, home_view, solve, window_of
from app.results.limits import Detail
from app.results.views import View
from app.state import State
from rotorstab import floquet_solution
from rotorstab.charts import Layer, fitted_top, with_top
from rotorstab.drawing import contours, screen

PIXELS = 700, 450  # of the plot, on a laptop
STATES = {
    "paper": {},
    "fast": {"spin_speed": 3.1, "static_load_factor": 0.35, "polar_inertia": 1.1},
    "follower": {"load_type": "follower", "static_load_factor": 0.2, "disk_mass": 2.3},
    "damped": {"external_damping": 0.012, "shear": 0.05},
    "rotating damping": {"internal_damping": 0.01, "external_damping": 0.02, "spin_speed": 0.7},
    "exact law": {"law": "exact", "static_load_factor": 0.3},
    "finite elements": {"model": "finite elements", "spin_speed": 1.4},
    "damped finite elements": {"model": "finite elements", "external_damping": 0.015},
    "stout finite elements": {
        "model": "finite elements",
        "shear": 0.1,
        "disk_mass": 2.0,
        "polar_inertia": 1.0,
        "diametral_inertia": 0.5,
    },
}
VIEWS = {
    "whole": None,
    "zoomed": View(1.1, 2.3, 0.35, 0.8),
    "deep": View(1.62, 1.72, 0.02, 0.1),
    "slow loads": View(0.3, 1.0, 0.3, 1.0),
}


def drawn(options, detail, view):
    state = State(**options)
    chart = solve(state, detail, view).charts["instability"]
    data = screen.columns(chart.layer("tongue edge"))
    points = np.column_stack([data["xs"][0], data["ys"][0]])
    return state, chart, points[np.isfinite(points[:, 0])]


def unstable(state, view, points):
    """Return the verdict at points (θ/ω_n, β_d)."""
    operation = window_of(state, view).operation
    theta = operation.excitation_frequency(points[..., 0])
    load = operation.pulsating_load(np.maximum(points[..., 1], 0.0))
    solution = floquet_solution(operation.system, operation.static_load, load, theta)
    return solution.growth_rate > 1e-7


# those of damped finite elements take seconds each: the slow loads are the hardest of them
OUTLINES = [
    pytest.param(
        name,
        view,
        detail,
        marks=pytest.mark.long
        if name == "damped finite elements" and (view, detail) != ("slow loads", Detail.FULL)
        else (),
    )
    for name, view, detail in product(STATES, VIEWS, (Detail.COARSE, Detail.FULL))
]


@pytest.mark.parametrize(("name", "view", "detail"), OUTLINES)
def test_an_outline_lies_within_a_pixel_of_the_edge(name, view, detail):
    state, _, points = drawn(STATES[name], detail, VIEWS[view])
    seen = VIEWS[view] or home_view(state.inputs())
    pixel = np.array([(seen.right - seen.left) / PIXELS[0], (seen.high - seen.low) / PIXELS[1]])
    if not len(points):
        assert (name, view) != ("paper", view)
        return
    points = points[np.random.default_rng(0).permutation(len(points))[:60]]
    # near its tip a tongue is thinner than a pixel
    parts = (-1.0, -0.3, -0.1, 0.1, 0.3, 1.0)
    across, up = ([(part, 0.0) for part in parts], [(0.0, part) for part in parts])
    steps = pixel * np.array([(0.0, 0.0), *across, *up])
    grows = unstable(state, VIEWS[view], points[:, None] + steps)
    assert (grows.any(axis=1) & ~grows.all(axis=1)).mean() > 0.95


@pytest.mark.parametrize("detail", [Detail.COARSE, Detail.FULL])
def test_areas_lie_within_each_other_and_begin_at_the_outline(detail):
    _, chart, points = drawn({}, detail, None)
    chart = with_top(chart, 0.1)
    areas = contours.areas(chart.layer("unstable"))
    assert len(areas) == contours.BANDS
    assert [round(growth, 9) for growth, *_ in areas] == [
        round(0.01 * (band + 0.5), 9) for band in range(contours.BANDS)
    ]
    first = {(x, y) for x, y in zip(*areas[0][1:], strict=True) if np.isfinite(x)}
    assert {tuple(point) for point in points} <= first
    sizes = [sum(map(abs, map(_size, _rings(x, y)))) for _, x, y in areas]
    assert sizes == sorted(sizes, reverse=True)


def _rings(x, y):
    parts = np.split(np.column_stack([x, y]), np.flatnonzero(np.isnan(x)))
    return [part[np.isfinite(part[:, 0])] for part in parts]


def _size(ring):
    x, y = ring.T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def test_the_colours_have_one_scale_that_can_be_fitted():
    _, chart, _ = drawn({}, Detail.COARSE, None)
    bands = chart.layer("unstable").columns
    assert bands["top"] == [GROWTH_TOPS["per time"]]
    assert fitted_top(bands["growth"][0]) == pytest.approx(0.2)
    assert fitted_top(np.zeros(3)) == 1.0
    wide = with_top(chart, 1.0).layer("unstable")
    assert screen.columns(wide)["growth"] == [pytest.approx(0.05), pytest.approx(0.15)]


def test_a_grid_without_unstable_points_has_no_outline():
    grid = np.full((3, 4), -1.0)
    columns = {
        "x": [np.arange(4.0)],
        "y": [np.arange(3.0)],
        "edge": [grid],
        "across": [np.full((3, 3), np.nan)],
        "along": [np.full((2, 4), np.nan)],
        "growth": [np.zeros((3, 4))],
        "top": [1.0],
    }
    layer = Layer("bands", "unstable", columns)
    assert contours.areas(layer) == []
    assert contours.outline(layer)[0].size == 0


def test_a_hole_is_a_ring_of_its_own_and_what_is_not_known_is_left_out():
    grid = np.ones((5, 6))
    grid[2, 2] = -1.0
    grid[:, 5] = np.nan
    columns = {
        "x": [np.arange(6.0)],
        "y": [10 * np.arange(5.0)],
        "edge": [grid],
        "across": [np.full((5, 5), np.nan)],
        "along": [np.full((4, 6), np.nan)],
        "growth": [np.where(grid > 0, 0.35, 0.0)],
        "top": [1.0],
    }
    ((_, x, y), *others) = contours.areas(Layer("bands", "unstable", columns))
    assert len(_rings(x, y)) == 2
    assert np.nanmax(x) == 4.0
    assert len(others) == 3
    x, y = contours.outline(Layer("edges", "edge", columns))
    assert (x.min(), x.max(), y.min(), y.max()) == (1.5, 2.5, 15.0, 25.0)
