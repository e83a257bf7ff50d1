"""The stability chart against single points: accuracy, verdicts and thin tongues."""

import numpy as np
import pytest

from rotorstab import BASE_CASE, finite_element, lumped
from rotorstab.floquet.interpolant.characteristic import (
    characteristic_coefficients,
    quartic_multipliers,
    self_inversive_multipliers,
)
from rotorstab.floquet.interpolant.growth import self_inversive_growth
from rotorstab.floquet.point import floquet_solution, growth_rate
from rotorstab.floquet.resonance import resonances
from rotorstab.floquet.tongues.edges import tongue_edges
from rotorstab.maps.stability_map import stability_chart, stability_map
from tests.testing.example_rotors import P, W, random_lumped

LOADS = np.linspace(0, 1, 25) * P
THETA = np.linspace(0.2, 8, 60) * W
SYSTEMS = {
    "no spin": lumped(BASE_CASE, 0.0),
    "axial": lumped(BASE_CASE, 2.0),
    "follower": lumped(BASE_CASE, 2.0, 1.0),
    "exact": lumped(BASE_CASE, 1.0, 0.5, stiffness="exact"),
    "damped": lumped(BASE_CASE, 2.0, external_damping=0.01, internal_damping=0.002),
}
# random rotors: some of them in every run, the others among the long tests
FEW, MORE = list(range(6)), [pytest.param(seed, marks=pytest.mark.long) for seed in range(6, 20)]


@pytest.mark.parametrize("name", SYSTEMS)
def test_map_against_points(name):
    chart = stability_chart(SYSTEMS[name], 0.5 * P, LOADS, THETA)
    exact = growth_rate(SYSTEMS[name], 0.5 * P, LOADS[:, None], THETA)
    error = np.abs(chart.growth - exact)
    assert error.max() < 1e-5
    assert (error <= chart.error).all()
    assert (chart.unstable | (exact < 1e-5)).all()


@pytest.mark.parametrize("name", ["axial", "damped"])
def test_many_columns_use_nodes_in_the_period(name):
    theta = np.linspace(0.6, 6, 400) * W
    chart = stability_chart(SYSTEMS[name], 0.3 * P, LOADS[::6], theta)
    exact = growth_rate(SYSTEMS[name], 0.3 * P, LOADS[::6, None], theta[::7])
    np.testing.assert_allclose(chart.growth[:, ::7], exact, atol=1e-5)


def test_coarse_chart_knows_that_it_is_coarse():
    chart = stability_chart(SYSTEMS["axial"], 0.5 * P, LOADS, THETA, density=0.6, refine=False)
    exact = growth_rate(SYSTEMS["axial"], 0.5 * P, LOADS[:, None], THETA)
    assert (np.abs(chart.growth - exact) <= chart.error).all()


def test_finite_element_chart():
    system = finite_element(BASE_CASE, 1.0, modes=3)
    loads, theta = LOADS[::6], np.linspace(0.8, 5, 30) * W
    chart = stability_chart(system, 0.5 * P, loads, theta)
    exact = growth_rate(system, 0.5 * P, loads[:, None], theta)
    np.testing.assert_allclose(chart.growth, exact, atol=1e-5)


@pytest.mark.parametrize("seed", FEW + MORE)
def test_no_tongue_slips_through(seed):
    system, static, load = random_lumped(seed)
    largest = 0.5 * load
    table = resonances(system, static, largest)
    theta = np.linspace(0.4, 1.1 * max(row.centre for row in table), 70)
    loads = largest * np.array([0.0, 0.05, 0.3, 1.0])
    chart = stability_chart(system, static, loads, theta)
    checked = 0
    edges = tongue_edges(system, static, loads)
    for k, name in enumerate(edges.names):
        for index in (1, 2):
            centre = edges.centre[k, index]
            if not theta[0] < centre < theta[-1]:
                continue
            # single points about the true centre; the width is the table's
            half = 2 * table[name].growth_per_load * loads[index]
            fine = centre + half * np.linspace(-0.9, 0.9, 41)
            solution = floquet_solution(system, static, loads[index], fine)
            hit = fine[solution.growth_rate > 1e-6 + solution.error]
            assert hit.size, name
            # marked where it is, or in the neighbour if it straddles a border
            columns = np.abs(theta - hit[:, None]).argmin(axis=1)
            assert chart.unstable[index, np.unique(columns)].any(), name
            checked += 1
    assert checked


def test_thin_tongue_is_marked_with_its_peak_growth():
    system = SYSTEMS["axial"]
    row = resonances(system, 0.5 * P, 0.01 * P)["1B+2F"]
    theta = np.linspace(7.0, 9.0, 40) * W
    chart = stability_chart(system, 0.5 * P, [0.0, 0.01 * P], theta)
    column = np.abs(theta - row.centre).argmin()
    assert chart.unstable[1, column]
    assert chart.peak_growth[1, column] == pytest.approx(row.growth, rel=1e-2)
    assert not chart.unstable[0].any()
    assert chart.narrow_only >= 1


def test_order_sign_and_plain_map():
    forward = stability_map(SYSTEMS["axial"], 0.5 * P, LOADS, THETA)
    backward = stability_map(SYSTEMS["axial"], 0.5 * P, -LOADS[::-1], THETA[::-1])
    np.testing.assert_allclose(forward, backward[::-1, ::-1], atol=1e-6)
    assert forward.shape == (25, 60)
    one = stability_map(SYSTEMS["axial"], 0.5 * P, [0.3 * P], [1.6 * W])
    assert one[0, 0] == pytest.approx(
        float(growth_rate(SYSTEMS["axial"], 0.5 * P, 0.3 * P, 1.6 * W))
    )


def test_rows_past_the_pole_are_nan():
    chart = stability_chart(SYSTEMS["exact"], 1.0, [0.1, 50.0], [1.0, 1.1, 1.2])
    assert np.isfinite(chart.growth[0]).all()
    assert np.isnan(chart.growth[1]).all()
    assert not chart.unstable[1].any()


def test_the_number_of_pixels_computed_again_is_bounded():
    # strong growth, of which the interpolated polynomial knows little
    system, loads = lumped(BASE_CASE, 0.5), np.linspace(0, 2, 9) * P
    theta = np.linspace(0.1, 5, 24) * W
    full, some, none = (
        stability_chart(system, 0.9 * P, loads, theta, find_narrow=False, **options)
        for options in ({}, {"most_refined": 3}, {"refine": False})
    )
    assert full.refined > 3
    assert (some.refined, none.refined) == (3, 0)
    changed = (some.growth != none.growth) & ~(np.isnan(some.growth) & np.isnan(none.growth))
    assert changed.sum() <= 3
    fast = stability_chart(system, 0.9 * P, loads, theta, find_narrow=False, refine_from=2.0 * W)
    np.testing.assert_array_equal(fast.growth[:, theta >= 2 * W], full.growth[:, theta >= 2 * W])
    slow = fast.growth[:, theta < 2 * W]
    good = none.error[:, theta < 2 * W] <= np.maximum(1e-5, 0.01 * np.abs(slow))
    good &= none.error[:, theta < 2 * W] * 2 * np.pi / theta[theta < 2 * W] < 1
    np.testing.assert_array_equal(slow[good], none.growth[:, theta < 2 * W][good])
    assert np.isnan(slow[~good]).all()
    assert 0 < fast.refined < full.refined


def test_bad_input():
    with pytest.raises(ValueError, match="`refine` must be True or False, got 600; `most_refined`"):
        stability_chart(SYSTEMS["axial"], 0.0, [0.1], [1.0], refine=600)
    with pytest.raises(ValueError, match="`most_refined` must be a whole number"):
        stability_chart(SYSTEMS["axial"], 0.0, [0.1], [1.0], most_refined=2.5)
    with pytest.raises(ValueError, match="`density` must be in"):
        stability_chart(SYSTEMS["axial"], 0.0, [0.1], [1.0], density=9)
    with pytest.raises(ValueError, match="`excitation_frequencies` must be in"):
        stability_map(SYSTEMS["axial"], 0.0, [0.1], [0.0])
    with pytest.raises(ValueError, match="`pulsating_loads` must be a list"):
        stability_map(SYSTEMS["axial"], 0.0, [[0.1]], [1.0])
    with pytest.raises(ValueError, match="one spin speed"):
        stability_map(lumped(BASE_CASE, [0.0, 1.0]), 0.0, [0.1], [1.0])


def circle(*angles):
    return np.exp(1j * np.array(angles))


@pytest.mark.parametrize(
    "roots",
    [
        circle(0.3, 1.1, -0.9, -0.5),
        np.concatenate([np.array([1.2, 1 / 1.2]) * circle(0.7, 0.7), circle(0.4, -1.8)]),
        np.concatenate([[1.5, 1 / 1.5], circle(0.8, -0.8)]),
        np.array([1.3, 1 / 1.3, 1.7, 1 / 1.7]) * circle(0.5, 0.5, -0.5, -0.5),
        np.array([1.3, 1 / 1.3, 1.3, 1 / 1.3]) * circle(1.1, 1.1, -1.1, -1.1),
        circle(0.8, -0.8, 0.8, -0.8),
    ],
)
def test_closed_form_multipliers(roots):
    c1, c2, c3 = characteristic_coefficients(np.diag(roots), np.complex128(1))
    coefficients = np.array([[c1.real], [c1.imag], [c2.real]])
    growth, _, _ = self_inversive_growth(coefficients, np.zeros((3, 1)))
    expected = np.log(np.abs(roots)).max()
    assert growth[0] == pytest.approx(expected, abs=1e-7)
    for found in (
        self_inversive_multipliers(np.array([[c1.real], [c1.imag], [c2.real]])),
        quartic_multipliers(np.array([[c1], [c2], [c3]]))[0],
    ):
        gap = np.abs(found.ravel()[:, None] - roots)
        assert gap.min(axis=1).max() < 1e-6
        assert gap.min(axis=0).max() < 1e-6


@pytest.mark.parametrize(
    ("system", "static", "largest", "low"),
    [
        (lumped(BASE_CASE, 0.5), 0.9, 2.0, 0.1),  # growth by 1e13 in half a period
        (lumped(BASE_CASE, 0.0, 1.0), 2.67, 0.5, 0.3),  # mean system at its flutter load
        (lumped(BASE_CASE, 0.0), 1.0, 1.0, 0.3),  # and at buckling
        (lumped(BASE_CASE, 6.0, internal_damping=0.05), 0.5, 1.0, 0.3),  # whirling by itself
    ],
)
def test_bounds_hold_at_the_extremes(system, static, largest, low):
    loads, theta = np.linspace(0, largest, 9) * P, np.linspace(low, 5, 24) * W
    chart = stability_chart(system, static * P, loads, theta)
    exact = floquet_solution(system, static * P, loads[:, None], theta)
    assert (np.abs(chart.growth - exact.growth_rate) <= chart.error + exact.error).all()
    assert np.abs(chart.growth - exact.growth_rate).max() < 1e-5
