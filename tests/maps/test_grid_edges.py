"""Edges of the unstable set on a grid, against single points on both sides of them."""

from itertools import pairwise

import numpy as np
import pytest

from rotorstab import (
    ShaftDisk,
    critical_load,
    finite_element,
    floquet_solution,
    fundamental_frequency,
    lumped,
    resonances,
    stability_chart,
)

ROTOR = ShaftDisk()
OTHER = ShaftDisk(shear=0.05, disk_mass=2.0, diametral_inertia=0.5, polar_inertia=0.2)
BUCKLING = float(critical_load(ROTOR.shear))
FREQUENCY = fundamental_frequency(lumped(ROTOR, 0.0, 1.0))
SYSTEMS = {
    "undamped": lumped(ROTOR, 2.0),
    "follower": lumped(OTHER, 1.0, 1.0),
    "external damping": lumped(ROTOR, 2.0, 0.0, 0.01),
    "both dampings": lumped(OTHER, 0.3, 0.5, 0.02, 0.01),
    "exact stiffness": lumped(ROTOR, 1.0, stiffness="exact"),
    "finite elements": finite_element(ROTOR, 2.0, 0.0, 8, 3),
    "damped finite elements": finite_element(ROTOR, 2.0, 0.0, 8, 3, 0.01),
}


def edges_of(system, columns=120, rows=24):
    loads = np.linspace(0.0, 0.9 * BUCKLING, rows)
    theta = np.linspace(0.6, 5.0, columns) * FREQUENCY
    chart = stability_chart(
        system, 0.3 * BUCKLING, loads, theta, refine=False, find_narrow=False, edges=True
    )
    return chart, chart.edges


def crossings(edges):
    """Return load and frequency of each crossing, and of points a tenth of a cell on its sides."""
    loads, theta = edges.pulsating_loads, edges.excitation_frequencies
    found = []
    for part, step in ((edges.across, (0, 1)), (edges.along, (1, 0))):
        row, column = np.nonzero(np.isfinite(part))
        for shift in (-0.1, 0.1):
            at = np.clip(part[row, column] + shift, 0.0, 1.0)
            load = loads[row] + at * step[0] * (loads[row + step[0]] - loads[row])
            frequency = theta[column] + at * step[1] * (theta[column + step[1]] - theta[column])
            found.append(np.stack([load, frequency]))
    return [np.concatenate(pair, axis=1) for pair in (found[::2], found[1::2])]


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_edge_has_stable_and_unstable_ground_beside_it(name):
    system = SYSTEMS[name]
    _, edges = edges_of(system)
    before, after = crossings(edges)
    assert before.shape[1] > 30
    sides = [
        floquet_solution(system, 0.3 * BUCKLING, *side).growth_rate > 1e-8
        for side in (before, after)
    ]
    assert (sides[0] != sides[1]).mean() > 0.98


def test_without_damping_the_edge_function_is_the_square_of_the_growth():
    chart, edges = edges_of(SYSTEMS["undamped"])
    inside = edges.function > 0
    assert inside.any()
    np.testing.assert_allclose(edges.function[inside], chart.growth[inside] ** 2, rtol=1e-9)


def test_rows_past_the_pole_of_the_exact_law_have_no_edges():
    system = SYSTEMS["exact stiffness"]
    room = system.largest_load - 0.3 * BUCKLING
    loads = np.linspace(0.0, 1.5 * room, 16)
    chart = stability_chart(
        system, 0.3 * BUCKLING, loads, [1.0, 1.1], refine=False, find_narrow=False, edges=True
    )
    assert chart.edges.pulsating_loads.max() < room < loads.max()
    nothing = stability_chart(
        system, 0.3 * BUCKLING, [2 * room], [1.0], refine=False, find_narrow=False, edges=True
    )
    assert nothing.edges is None


@pytest.mark.parametrize("grid", [([-0.1, 0.1], [1.0, 2.0]), ([0.0, 0.1], [2.0, 1.0])])
def test_a_grid_that_does_not_rise_is_refused(grid):
    with pytest.raises(ValueError, match="in rising order"):
        stability_chart(SYSTEMS["undamped"], 0.3, *grid, edges=True)


def test_edges_are_found_only_when_asked_for():
    assert stability_chart(SYSTEMS["undamped"], 0.3, [0.1], [1.0]).edges is None


@pytest.mark.parametrize("name", ["undamped", "follower"])
def test_a_thin_tongue_is_a_line_of_unstable_points(name):
    system, static = SYSTEMS[name], 0.3 * BUCKLING
    loads, theta = np.linspace(0.0, BUCKLING, 41), np.linspace(0.5, 16.0, 240) * FREQUENCY
    chart = stability_chart(
        system, static, loads, theta, refine=False, find_narrow=False, edges=True
    )
    assert len(chart.edges.thin) > 4
    for line in chart.edges.thin:
        at = np.isin(line.pulsating_loads, loads[1:]) & np.isfinite(line.excitation_frequencies)
        points = line.pulsating_loads[at], line.excitation_frequencies[at]
        unstable = floquet_solution(system, static, *points).growth_rate > 1e-7
        assert unstable.sum() >= 0.9 * unstable.size, (line.name, line.order)


@pytest.mark.parametrize("name", ["undamped", "external damping", "exact stiffness"])
def test_no_tongue_of_the_resonance_table_is_missing_at_small_loads(name):
    system, static = SYSTEMS[name], 0.3 * BUCKLING
    loads, theta = np.linspace(0.0, 0.4 * BUCKLING, 31), np.linspace(0.5, 16.0, 480) * FREQUENCY
    chart = stability_chart(
        system, static, loads, theta, refine=False, find_narrow=False, edges=True
    )
    table = resonances(system, static, 0.1 * BUCKLING)
    rows = [row for row in table if row.threshold < 0.1 * BUCKLING and row.growth_per_load > 0]
    assert rows
    for row in rows:
        lines = [line for line in chart.edges.thin if line.order == 1 and line.name == row.name]
        near = np.abs(theta - row.centre).argmin()
        seen = (chart.edges.function[:, near - 3 : near + 4] > 0).any()
        assert lines or seen, row.name
        feet = [line.pulsating_loads[0] for line in lines]
        assert not feet or abs(min(feet) - row.threshold) <= loads[1]


def test_tongues_of_finite_elements_are_followed_only_where_points_may_be_refined():
    system, static = SYSTEMS["finite elements"], 0.3 * BUCKLING
    grid = np.linspace(0.0, 0.9 * BUCKLING, 9), np.linspace(1.0, 6.0, 16) * FREQUENCY
    quick, exact = (
        stability_chart(
            system, static, *grid, refine=refine, most_refined=0, find_narrow=False, edges=True
        ).edges.thin
        for refine in (False, True)
    )
    assert [line.name for line in quick] == [line.name for line in exact] != []
    for line in quick:
        assert len(set(line.excitation_frequencies)) == 1
    for line in exact:
        points = line.pulsating_loads[1:], line.excitation_frequencies[1:]
        assert (floquet_solution(system, static, *points).growth_rate > 0).all()


def test_a_line_of_a_thin_tongue_joins_no_two_tongues():
    """On this coarse grid a line left its tongue by ten columns, through stable ground."""
    rotor = ShaftDisk(0.0192, 3.2027, 0.9567, 1.5461)
    buckling = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    system, static = lumped(rotor, 2.4298), 0.4713 * buckling
    loads = np.concatenate([[0.0], (np.arange(40) + 0.5) / 40, [1.0]]) * buckling
    frequencies = (np.arange(230, 324) + 0.5) / 324 * 6 * frequency
    step = frequencies[1] - frequencies[0]
    chart = stability_chart(system, static, loads, frequencies, edges=True)

    def growth(load, theta):
        near = theta + 1.5 * step * np.linspace(-1, 1, 2001)
        rates = floquet_solution(system, static, np.full(near.size, load), near).growth_rate
        return rates.max()

    checked = 0
    for line in chart.edges.thin:
        points = np.column_stack([line.pulsating_loads, line.excitation_frequencies])
        for first, second in pairwise(points):
            # a tongue widens with the load: where the lower end is wide enough, the middle is
            if np.isfinite([first, second]).all() and first[0] > 0 and growth(*first) > 1e-4:
                assert growth(*(first + second) / 2) > 1e-4, (line.name, line.order)
                checked += 1
    assert checked > 3
