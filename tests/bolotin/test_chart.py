"""Bolotin's boundaries as curves with names, and his regions as polygons."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rotorstab as rs
from tests.testing.strategies import between, rotors, spin_speeds, tangencies

BASE = rs.BASE_CASE
REFERENCE = float(rs.critical_load(BASE.shear))


CHARTS = {
    "axial": (rs.lumped(BASE, 1.0), 0.5, 1.0),
    "follower": (rs.lumped(BASE, 1.0, 1.0), 0.5, 1.0),
    "at rest": (rs.lumped(BASE, 0.0), 0.5, 0.9),
    "at rest past buckling": (rs.lumped(BASE, 0.0), 0.8, 2.0),
    "past buckling": (rs.lumped(BASE, 1.0), 0.8, 3.0),
    "follower towards flutter": (rs.lumped(BASE, 0.0, 1.0), 1.5, 4.0),
    "follower past flutter": (rs.lumped(BASE, 0.5, 1.0), 2.9, 3.0),
    "no gyroscopics": (rs.lumped(rs.ShaftDisk(polar_inertia=0.0), 2.0), 0.5, 1.5),
    "slow": (rs.lumped(BASE, 0.01), 0.3, 2.0),
    "fast": (rs.lumped(BASE, 4.0, 1.0), 0.9, 3.0),
    "exact": (rs.lumped(BASE, 1.0, stiffness="exact"), 0.5, 1.2),
    "exact follower": (rs.lumped(BASE, 0.3, 1.0, stiffness="exact"), 1.0, 4.0),
    "buckled": (rs.lumped(BASE, 0.0), 1.3, 1.0),
    "buckled, spinning": (rs.lumped(BASE, 0.5), 1.3, 1.0),
}


@pytest.fixture(params=CHARTS, name="case")
def _case(request):
    system, static, largest = CHARTS[request.param]
    chart = rs.bolotin_chart(system, static * REFERENCE, largest * REFERENCE)
    return system, static * REFERENCE, chart


def test_chart_holds_the_boundary_frequencies(case):
    system, static, chart = case
    expected = rs.boundary_frequencies(system, static, chart.pulsating_load)
    assert np.sort(chart.frequency) == pytest.approx(expected, abs=2e-6, nan_ok=True)
    assert (np.diff(chart.pulsating_load) > 0).all()
    assert sorted(chart.names) == ["1B", "1F", "2B", "2F"]


def winding(points, polygon):
    """Whether each point lies in a polygon, by counting edges to its right."""
    x, y = points[:, :1], points[:, 1:]
    x0, y0 = polygon.T
    x1, y1 = np.roll(polygon, -1, axis=0).T
    crossing = (y0 <= y) != (y1 <= y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = x0 + (y - y0) * (x1 - x0) / (y1 - y0)
    return (crossing & (at > x)).sum(axis=1) % 2 == 1


def assert_no_spurious_line(chart):
    """Neighbours differ by no more than the boundary's own slope and turning explain."""
    frequency, load = chart.frequency, chart.pulsating_load
    scale = np.nanmax(frequency, initial=0.0)
    for column in frequency.T:
        real = np.isfinite(column)
        inside = np.flatnonzero(real[1:] & real[:-1])
        step = np.abs(column[inside + 1] - column[inside])
        fraction = (load[inside + 1] - load[inside]) / load[-1]
        assert (step <= 3 * scale * np.sqrt(fraction)).all()


def ends(chart):
    """Yield row, column where a boundary starts or ends inside the chart."""
    real = np.isfinite(chart.frequency)
    for row, column in zip(*np.nonzero(real[1:] != real[:-1]), strict=True):
        yield (row if real[row, column] else row + 1), column


def test_no_spurious_lines_and_every_end_is_closed(case):
    chart = case[2]
    assert_no_spurious_line(chart)
    scale = np.nanmax(chart.frequency)
    for row, column in ends(chart):
        here = chart.frequency[row]
        others = np.delete(here, column)
        # either two boundaries meet, or one reaches θ̄ = 0
        meets = np.nanmin(np.abs(others - here[column]), initial=np.inf)
        assert min(meets, here[column]) < 2e-4 * scale


def test_polygons_are_the_region(case):
    system, static, chart = case
    random = np.random.default_rng(5)
    right = 1.2 * np.nanmax(chart.frequency)
    points = random.uniform([0, 0], [right, chart.pulsating_load[-1]], (4000, 2))
    inside = np.zeros(4000, bool)
    for polygon in chart.regions:
        assert np.isfinite(polygon).all()
        inside ^= winding(points, polygon)
    expected = rs.in_bolotin_region(system, static, points[:, 1], points[:, 0])
    wrong = np.flatnonzero(inside != expected)
    # chords cut off a sliver between rows
    assert wrong.size <= 8
    for x, y in points[wrong]:
        around = x + 2e-3 * right * np.array([-1, 1])
        assert np.ptp(rs.in_bolotin_region(system, static, y, around).astype(int)) == 1


@settings(max_examples=100)
@given(
    rotor=rotors,
    speed=spin_speeds,
    tangency=tangencies,
    static=between(0.0, 1.5),
    largest=between(0.1, 4.0),
    seed=st.integers(0, 1000),
)
def test_polygons_of_random_rotors(rotor, speed, tangency, static, largest, seed):
    reference = float(rs.critical_load(rotor.shear))
    system = rs.lumped(rotor, speed, tangency)
    chart = rs.bolotin_chart(system, static * reference, largest * reference)
    assert_no_spurious_line(chart)
    right = 1.1 * np.nanmax(chart.frequency, initial=1e-3)
    points = np.random.default_rng(seed).uniform(
        [0, 0], [right, chart.pulsating_load[-1]], (300, 2)
    )
    inside = np.zeros(300, bool)
    for polygon in chart.regions:
        inside ^= winding(points, polygon)
    expected = rs.in_bolotin_region(system, static * reference, points[:, 1], points[:, 0])
    for x, y in points[inside != expected]:
        # only within a sliver of a boundary
        boundaries = rs.boundary_frequencies(system, static * reference, y)
        load_step = chart.pulsating_load[-1] / 119
        near = rs.boundary_frequencies(
            system, static * reference, y + load_step * np.array([-1, 1])
        )
        close = np.nanmin(np.abs(np.append(boundaries, near) - x), initial=np.inf)
        assert close < 5e-3 * right


@pytest.mark.parametrize("speed", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_names_order_by_whirl_frequency(speed, tangency):
    system = rs.lumped(BASE, speed, tangency)
    static = 0.4 * REFERENCE
    chart = rs.bolotin_chart(system, static, REFERENCE)
    whirl = dict(
        zip(("2B", "1B", "1F", "2F"), rs.whirl_frequencies(system, static).real, strict=True)
    )
    for name, theta in zip(chart.names, chart.frequency[0], strict=True):
        assert theta == pytest.approx(2 * abs(whirl[name]), rel=1e-9)


@pytest.mark.parametrize("tangency", [0.0, 0.5, 1.0])
def test_at_rest_backward_is_the_left_boundary(tangency):
    chart = rs.bolotin_chart(rs.lumped(BASE, 0.0, tangency), 0.3 * REFERENCE, 0.5 * REFERENCE)
    columns = dict(zip(chart.names, chart.frequency.T, strict=True))
    for number in "12":
        left, right = columns[number + "B"], columns[number + "F"]
        assert left[0] == pytest.approx(right[0], rel=1e-9)
        assert (left[1:] < right[1:]).all()
    assert columns["1F"].max() < columns["2B"].min()


def test_at_rest_boundaries_cross_without_changing_names():
    # K∓ come apart so far that the right boundary of 1 crosses the left one of 2
    rotor = rs.ShaftDisk(disk_mass=2.0, diametral_inertia=2.0)
    chart = rs.bolotin_chart(rs.lumped(rotor, 0.0), 0.0, 6.0, rows=400)
    for column in chart.frequency.T:
        column = column[np.isfinite(column)]
        # smooth: the second difference stays small where no end is near
        bend = np.abs(np.diff(column, 2))[:-40]
        assert np.quantile(bend, 0.9) < 1e-3


@pytest.mark.parametrize("speed", [0.0, 0.2, 1.0])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
@pytest.mark.parametrize("factor", [1.2, 2.8, 4.0])
def test_names_past_buckling_and_flutter_come_from_no_load(speed, tangency, factor):
    system = rs.lumped(BASE, speed, tangency)
    static = factor * REFERENCE
    chart = rs.bolotin_chart(system, static, REFERENCE)
    curves = rs.load_frequency_curves(system, np.linspace(0, static, 400))
    whirl = dict(zip(curves.names, curves.frequencies[-1], strict=True))
    for name, theta in zip(chart.names, chart.frequency[0], strict=True):
        square = whirl[name] ** 2
        if np.isfinite(theta):
            assert theta == pytest.approx(2 * np.sqrt(square.real), rel=1e-6)
        else:
            assert square.real <= 0 or abs(square.imag) > 0


def test_a_finite_element_rotor_goes_the_same_way():
    lumped = rs.bolotin_chart(rs.lumped(BASE, 1.0), 0.0, REFERENCE)
    heavy = rs.ShaftDisk(disk_mass=5e4, diametral_inertia=8e3, polar_inertia=1.6e4)
    system = rs.finite_element(heavy, 1e-2, elements=4)
    # a disk 1e4 times heavier makes the shaft massless and time 100 times slower
    chart = rs.bolotin_chart(system, 0.0, REFERENCE, rows=8)
    expected = rs.boundary_frequencies(rs.lumped(heavy, 1e-2), 0.0, REFERENCE)
    assert chart.frequency.shape[1] == 2 * system.size
    assert np.sort(chart.frequency[-1])[:2] == pytest.approx(expected[:2], rel=1e-2)
    assert set(lumped.names) <= set(chart.names)


def test_rows():
    chart = rs.bolotin_chart(rs.lumped(BASE, 1.0), 0.0, 0.5, rows=8)
    assert chart.pulsating_load == pytest.approx(np.linspace(0, 0.5, 8))
