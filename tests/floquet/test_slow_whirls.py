"""Charts of the four slowest whirls of finite elements, against single points of all whirls."""

from dataclasses import replace

import numpy as np
import pytest

from rotorstab import (
    PeriodicLoad,
    ShaftDisk,
    critical_load,
    finite_element,
    floquet_solution,
    fundamental_frequency,
    lumped,
    stability_chart,
)
from rotorstab.floquet.interpolant.slow_whirls import InseparableWhirls

ROTOR = ShaftDisk()
STOUT = ShaftDisk(shear=0.1, disk_mass=2.0, diametral_inertia=0.5, polar_inertia=1.0)
SYSTEMS = {
    "axial": finite_element(ROTOR, 2.0, 0.0, 8, 4),
    "follower": finite_element(ROTOR, 1.0, 1.0, 8, 4),
    "damped": finite_element(ROTOR, 2.0, 0.0, 8, 4, 0.01, 0.002),
}


def chart_of(rotor, system, **options):
    buckling = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    loads, theta = np.linspace(0.0, buckling, 13), np.linspace(0.6, 6.0, 160) * frequency
    static = 0.4 * buckling
    chart = stability_chart(
        system, static, loads, theta, refine=False, find_narrow=False, slow_whirls=True, **options
    )
    return chart, static


@pytest.mark.parametrize("name", SYSTEMS)
def test_growth_is_that_of_all_whirls(name):
    chart, static = chart_of(ROTOR, SYSTEMS[name])
    every = np.s_[1::4], np.s_[::3]
    loads, theta = np.meshgrid(
        chart.pulsating_loads[every[0]], chart.excitation_frequencies[every[1]], indexing="ij"
    )
    exact = floquet_solution(SYSTEMS[name], static, loads, theta).growth_rate
    assert (exact > 1e-3).sum() > 8
    assert np.abs(chart.growth[every] - exact).max() < 3e-4


@pytest.mark.parametrize("name", SYSTEMS)
def test_tongues_of_higher_order_are_found(name):
    chart, _ = chart_of(ROTOR, SYSTEMS[name], edges=True)
    edges = chart.edges
    fundamental = fundamental_frequency(lumped(ROTOR, 0.0))
    slow = edges.excitation_frequencies < 1.1 * fundamental
    seen = (edges.function[:, slow] > 0).any()
    lines = any(line.order > 1 for line in edges.thin)
    assert seen or lines


def test_tongues_of_a_slow_and_a_fast_whirl_are_refused_where_they_are_wide():
    with pytest.raises(InseparableWhirls, match="slow and fast whirls"):
        chart_of(STOUT, finite_element(STOUT, 2.0, 0.0, 8, 4))


def test_a_system_of_two_coordinates_has_slow_whirls_only():
    system = lumped(ROTOR, 2.0)
    chart, static = chart_of(ROTOR, system)
    whole = stability_chart(
        system,
        static,
        chart.pulsating_loads,
        chart.excitation_frequencies,
        refine=False,
        find_narrow=False,
    )
    np.testing.assert_array_equal(chart.growth, whole.growth)


UNEVEN = PeriodicLoad(cosine=[1.0, 0.2], sine=[0.0, 0.3])
MANY_COORDINATES = {
    "axial": finite_element(ROTOR, 2.0, 0.0, 8, 8),
    "follower": finite_element(ROTOR, 2.0, 1.0, 8, 6),
    "damped": finite_element(ROTOR, 2.0, 0.5, 8, 6, 0.01, 0.002),
    "uneven load": replace(finite_element(ROTOR, 1.0, 0.0, 8, 6), pulsation=UNEVEN),
}


@pytest.mark.parametrize("name", MANY_COORDINATES)
def test_growth_of_many_coordinates_is_within_its_error(name):
    system = MANY_COORDINATES[name]
    buckling = float(critical_load(ROTOR.shear))
    fundamental = fundamental_frequency(lumped(ROTOR, 0.0))
    rng = np.random.default_rng(5)
    loads = np.sort(rng.uniform(0.5, 1.0, 4)) * buckling
    theta = np.sort(rng.uniform(1.4, 4.6, 10)) * fundamental
    static = 0.4 * buckling
    chart = stability_chart(
        system, static, loads, theta, refine=False, find_narrow=False, slow_whirls=True
    )
    exact = floquet_solution(system, static, loads[:, None], theta)
    assert (exact.growth_rate > 1e-3).sum() > 2
    error = np.abs(chart.growth - exact.growth_rate)
    assert error.max() < 2e-5
    assert (error <= chart.error + exact.error + 1e-9).all()
