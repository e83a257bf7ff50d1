"""The interpolated characteristic polynomial: step counts, minors, error bounds."""

from itertools import combinations

import numpy as np
import pytest

from rotorstab import BASE_CASE, finite_element, floquet_multipliers, floquet_solution, lumped
from rotorstab.floquet.integrator import propagate
from rotorstab.floquet.interpolant.characteristic import reversed_coefficients
from rotorstab.floquet.interpolant.chart_interpolant import ChartInterpolant
from rotorstab.floquet.interpolant.growth import self_inversive_growth
from rotorstab.floquet.schemes import MAP_SCHEME
from rotorstab.model.modal import splitting_basis
from tests.testing.example_rotors import P, W

SYSTEMS = {
    "axial": lumped(BASE_CASE, 2.0),
    "follower": lumped(BASE_CASE, 2.0, 1.0),
    "exact": lumped(BASE_CASE, 1.0, 0.5, stiffness="exact"),
    "damped": lumped(BASE_CASE, 2.0, external_damping=0.01, internal_damping=0.002),
    "finite elements": finite_element(BASE_CASE, 1.0, 1.0, modes=3),
    "finite elements, damped": finite_element(BASE_CASE, 1.0, modes=3, external_damping=0.01),
}


@pytest.mark.parametrize("steps", [21, 28, 39])
def test_a_grid_takes_the_steps_asked_for(steps):
    # extrapolation relies on it: a grid once took 22 steps in place of 21
    system = SYSTEMS["axial"]
    basis = splitting_basis(system, 0.5 * P)
    span, load = np.linspace(1, 3, 32)[:, None], np.linspace(0.1, 1, 6)[None] * P
    static = np.full((1, 1), 0.5 * P)
    every = propagate(system, basis, (static, load), span, np.pi, steps, MAP_SCHEME)
    for i, j in ((0, 0), (31, 5), (13, 2)):
        one = propagate(system, basis, (static, load[:, [j]]), span[[i]], np.pi, steps, MAP_SCHEME)
        np.testing.assert_allclose(every[..., i, j], one[..., 0, 0], atol=1e-12)


def test_reversed_coefficients_are_those_of_the_monodromy():
    rng = np.random.default_rng(0)
    half = rng.normal(size=(4, 4, 7)) + 1j * rng.normal(size=(4, 4, 7))
    determinant = np.linalg.det(np.moveaxis(half, -1, 0))
    half /= np.abs(determinant) ** 0.25
    scale = np.sqrt(determinant / np.abs(determinant))
    found = reversed_coefficients(half, scale)
    for k in range(7):
        y = half[..., k]
        one = np.poly(np.linalg.solve(y.conj(), y) / scale[k])
        expected = [-one[1].real, -one[1].imag, one[2].real]
        np.testing.assert_allclose(found[:, k], expected, rtol=1e-10, atol=1e-10)


LOADS = np.linspace(0, 1, 15) * P
PERIODS = np.linspace(2 * np.pi / 8, 2 * np.pi / 0.4, 40) / W


@pytest.mark.parametrize("name", [name for name in SYSTEMS if SYSTEMS[name].size == 2])
@pytest.mark.parametrize("density", [0.6, 1.0])
def test_coefficients_are_those_of_the_multipliers_within_their_errors(name, density):
    interpolant = ChartInterpolant(SYSTEMS[name], 0.4 * P, P, PERIODS, density)
    values, error = interpolant.on_grid(LOADS, PERIODS)
    # the coefficients are those of the multipliers less the drift that all of them share
    mu = floquet_multipliers(SYSTEMS[name], 0.4 * P, LOADS[:, None], 2 * np.pi / PERIODS)
    mu = mu / np.exp(1j * interpolant.sampler.drift * PERIODS)[:, None]
    sums = [sum(np.prod(c, axis=0) for c in combinations(mu.T, k)).T for k in (1, 2, 3)]
    damped = SYSTEMS[name].is_damped
    expected = np.array(sums if damped else [sums[0].real, sums[0].imag, sums[1].real])
    assert (np.abs(values - expected) <= error + 1e-9 * np.abs(mu[..., 0]) ** 3).all()


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("density", [0.6, 1.0])
def test_growth_is_that_of_single_points_within_its_error(name, density):
    interpolant = ChartInterpolant(SYSTEMS[name], 0.4 * P, P, PERIODS, density)
    growth, error, _ = interpolant.growth(*interpolant.on_grid(LOADS, PERIODS), PERIODS)
    exact = floquet_solution(SYSTEMS[name], 0.4 * P, LOADS[:, None], 2 * np.pi / PERIODS)
    assert (np.abs(growth - exact.growth_rate) <= error + exact.error + 1e-9).all()


@pytest.mark.parametrize("error", [1e-10, 1e-7, 1e-3])
def test_pixels_skipped_are_those_that_cannot_grow(error):
    rng = np.random.default_rng(1)
    angle = rng.uniform(0, 2 * np.pi, (3, 20000))
    # half on the circle, half with a pair off it by any amount
    split = np.where(np.arange(20000) < 10000, 0.0, 10 ** rng.uniform(-6, 0.5, 20000))
    log = np.array([1j * angle[0] + split, 1j * angle[0] - split, 1j * angle[1], 1j * angle[2]])
    mu = np.exp(log - 1j * (2 * angle[0] + angle[1] + angle[2]) / 4)
    c1, c2 = mu.sum(axis=0), (mu.sum(axis=0) ** 2 - (mu**2).sum(axis=0)) / 2
    coefficients = np.array([c1.real, c1.imag, c2.real])
    error = np.full_like(coefficients, error)
    growth, slack, _ = self_inversive_growth(coefficients, error)
    full, _, _ = self_inversive_growth(coefficients, error, with_approach=True)
    np.testing.assert_allclose(growth, full, atol=1e-6)
    assert (np.abs(growth - split) <= slack + 1e-6).all()
    # and with errors as large as allowed
    moved = coefficients + error * rng.uniform(-1, 1, coefficients.shape)
    other, _, _ = self_inversive_growth(moved, 0 * error, with_approach=True)
    assert (other[slack == 0] <= growth[slack == 0] + 1e-6).all()
