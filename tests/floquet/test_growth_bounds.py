"""The bounds on the error of a growth rate: never below the true error, and close to it."""

import numpy as np
import pytest

from rotorstab.floquet.interpolant.growth import largest_modulus, self_inversive_growth
from rotorstab.floquet.interpolant.matrix_growth import matrix_growth, reversed_growth


@pytest.mark.parametrize("seed", range(5))
def test_quartics_moved_by_their_errors(seed):
    """Roots of a perturbed quartic stay within the claim, double roots and damped ones too."""
    rng = np.random.default_rng(seed)
    count = 4000
    mu = np.exp(rng.uniform(-30, 0, (4, count)) * rng.integers(0, 2, (4, count)))
    mu = mu * np.exp(1j * rng.uniform(0, 2 * np.pi, (4, count)))
    mu[1] = np.where(rng.uniform(size=count) < 0.5, mu[1], mu[0] * (1 + 1e-4 * mu[2]))
    powers = np.array([np.poly(one) for one in mu.T]).T
    signs = np.array([-1, 1, -1]).reshape(3, 1)
    coefficients, last = signs * powers[1:4], powers[4].real
    last = np.abs(powers[4])
    turn = np.exp(-0.25j * np.angle(powers[4]))
    mu, coefficients = mu * turn, coefficients * turn ** np.arange(1, 4).reshape(3, 1)
    error = 10 ** rng.uniform(-12, -1, (3, count))
    moved = coefficients + error * np.exp(2j * np.pi * rng.uniform(size=(3, count)))
    growth, claim, _ = largest_modulus(moved, last, error)
    exact = np.log(np.abs(mu)).max(axis=0)
    assert (np.abs(growth - exact) <= claim + 1e-7).all()
    # and the claims are not idle
    assert np.median(claim / error.max(axis=0)) < 100


@pytest.mark.parametrize("seed", range(3))
def test_eigenvalues_moved_by_their_errors(seed):
    """As above for matrices, by the complex eigenproblem and by the real one of half a period."""
    rng = np.random.default_rng(seed)
    count, size = 400, 6

    def normal(*shape):
        return rng.normal(size=shape) + 1j * rng.normal(size=shape)

    # R and S with eigenvalues t real, nearly double or complex; conj(Y)⁻¹Y has the multipliers
    t = rng.normal(size=(count, size)) + 0j
    t[::4, 0] = t[::4, 1] + 10 ** rng.uniform(-7, -2, len(t[::4]))
    t[1::4, 0] = t[1::4, 1].conj() + 1j * 10 ** rng.uniform(-5, 0, len(t[1::4]))
    t[1::4, 1] = t[1::4, 0].conj()
    basis = rng.normal(size=(count, size, size)) + 0j
    basis[1::4, :, 0] += 1j * basis[1::4, :, 1]
    basis[1::4, :, 1] = basis[1::4, :, 0].conj()
    operator = (basis * t[:, None]) @ np.linalg.inv(basis)
    half = rng.normal(size=(count, size, size)) @ (np.eye(size) + 1j * operator.real)
    exact = np.log(np.abs((1 + 1j * t) / (1 - 1j * t))).max(axis=1)
    error = 10 ** rng.uniform(-12, -5, (count, 1, 1)) * rng.uniform(size=half.shape)
    moved = half + error * np.exp(2j * np.pi * rng.uniform(size=half.shape))
    growth, claim, _ = reversed_growth(moved, error)
    assert (np.abs(growth - exact) <= claim + 1e-9).all()
    assert (claim == 0).mean() > 0.3

    values = np.exp(1j * normal(count, size))
    values[::2, 0] = values[::2, 1] * (1 + 1e-6 * normal(count // 2))
    basis = normal(count, size, size)
    monodromy = (basis * values[:, None]) @ np.linalg.inv(basis)
    moved = monodromy + error * np.exp(2j * np.pi * rng.uniform(size=half.shape))
    growth, claim, _ = matrix_growth(moved, error)
    exact = np.log(np.abs(values)).max(axis=1)
    assert (np.abs(growth - exact) <= claim + 1e-9).all()
    moved[0, 0, 0] = np.nan
    lost = matrix_growth(moved, error)[0]
    assert np.isnan(lost[0])
    np.testing.assert_allclose(lost[1:], growth[1:])


@pytest.mark.parametrize("growth", [2.0, 6.0, 9.5, 14.0])
def test_two_pairs_that_grow_alike(growth):
    """Two pairs e^{±jα/2}(u, 1/u) with growth of the same size: as near as the quartic tells."""
    rng = np.random.default_rng(3)
    count = 2000
    first = growth + rng.uniform(0, 0.5, count)
    second = growth + rng.uniform(0, 0.5, count)
    half = np.where(rng.uniform(size=count) < 0.5, 0.0, rng.uniform(0, np.pi / 2, count))
    second = np.where(half == 0, second, first)
    pairs = 2 * np.cosh([first, second])
    middle = np.exp(1j * half) * pairs[0] + np.exp(-1j * half) * pairs[1]
    coefficients = np.array([middle.real, middle.imag, 2 * np.cos(2 * half) + pairs[0] * pairs[1]])
    error = 1e-14 * np.array([np.abs(middle), np.abs(middle), np.abs(coefficients[2])])
    found, uncertainty, _ = self_inversive_growth(coefficients, error)
    off = np.abs(found - np.maximum(first, second))
    assert off.max() < 1e-4  # rounding, at nearly double multipliers
    assert (off <= uncertainty + 1e-9).mean() > 0.9
    assert np.median(off) < 1e-12
