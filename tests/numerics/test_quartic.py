"""Roots of quartics of every kind against the polynomial itself and numpy.roots."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorstab._numerics.quartic import quadratic_roots, quartic_roots
from tests.testing.strategies import between

RANDOM = np.random.default_rng(1)


def polynomials(roots):
    """Return coefficients (5, k) of monic quartics with the roots (k, 4)."""
    return np.array([np.poly(row).real for row in roots]).T


def backward_error(roots, coefficients):
    """Return |Σ c xᵏ| / Σ |c| |x|ᵏ: the relative change of coefficients that x answers to."""
    coefficients = np.asarray(coefficients)[..., None]
    value = size = 0.0
    for c in coefficients:
        value, size = value * roots + c, size * np.abs(roots) + np.abs(c)
    return np.abs(value) / np.where(size > 0, size, 1.0)


def random_roots(kind, count=400):
    real = RANDOM.uniform(-3, 3, (count, 4))
    pairs = RANDOM.normal(size=(count, 2)) + 1j * RANDOM.normal(size=(count, 2))
    if kind == "four real":
        return real + 0j
    if kind == "one pair":
        return np.concatenate([pairs[:, :1], pairs[:, :1].conj(), real[:, :2]], axis=1)
    if kind == "two pairs":
        return np.concatenate([pairs, pairs.conj()], axis=1)
    if kind == "biquadratic":
        return np.concatenate([real[:, :2], -real[:, :2]], axis=1) + 0j
    if kind == "biquadratic pairs":
        return np.concatenate(
            [pairs[:, :1], -pairs[:, :1], pairs[:, :1].conj(), -pairs[:, :1].conj()], 1
        )
    if kind == "imaginary":
        return 1j * np.concatenate([real[:, :2], -real[:, :2]], axis=1)
    signs = RANDOM.choice([-1.0, 1.0], (count, 4))
    return signs * 10 ** RANDOM.uniform(-4, 3, (count, 4)) + 0j  # "graded"


KINDS = [
    "four real",
    "one pair",
    "two pairs",
    "biquadratic",
    "biquadratic pairs",
    "imaginary",
    "graded",
]


@pytest.mark.parametrize("kind", KINDS)
def test_roots_of_every_kind(kind):
    roots = random_roots(kind)
    coefficients = polynomials(roots)
    found = quartic_roots(*coefficients)
    assert backward_error(found, coefficients).max() < 1e-12
    # forward: no worse than a hundred times LAPACK on the same coefficients, row by row
    exact = np.sort_complex(roots)
    lapack = np.array([np.sort_complex(np.roots(c)) for c in coefficients.T])

    def distance(x):
        return np.abs(np.abs(x[:, :, None] - exact[:, None, :]).min(axis=1)).max(axis=1)

    scale = np.abs(exact).max(axis=1)
    assert (distance(found) <= 100 * distance(lapack) + 1e-13 * scale).all()


@pytest.mark.parametrize("kind", KINDS)
def test_complex_roots_are_exact_pairs_in_order(kind):
    found = quartic_roots(*polynomials(random_roots(kind)))
    assert (np.sort_complex(found.conj()) == found).all()
    assert (np.diff(found.real) >= 0).all()


def test_a_small_root_keeps_its_digits():
    roots = np.array([[-1e-7, 0.3, 2.0, 900.0], [-5e-4, 2e-4, 3e-4, 2400.0]])
    found = quartic_roots(*polynomials(roots)).real
    assert found == pytest.approx(np.sort(roots), rel=1e-9)


@pytest.mark.parametrize(
    ("roots", "digits"),
    [
        ([1, 1, 2, 3], 1e-7),
        ([-1, 2, 2, 3], 1e-7),
        ([-2, -1, 4, 4], 1e-7),
        ([1, 1, 2, 2], 1e-7),
        ([-1, -1, 1, 1], 1e-7),
        ([0, 0, 1, 2], 1e-7),
        ([0, 0, 0, 1], 1e-4),
        ([1, 1, 1, 2], 2e-4),
        ([3, 3, 3, 3], 1e-3),
        ([0, 0, 0, 0], 0.0),
        ([1j, 1j, -1j, -1j], 1e-7),
        ([1 + 1j, 1 + 1j, 1 - 1j, 1 - 1j], 1e-7),
    ],
)
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_multiple_roots(roots, digits, scale):
    exact = np.sort_complex(np.array(roots, complex) * scale)
    found = quartic_roots(*np.poly(exact).real)
    assert np.isfinite(found).all()
    nearest = np.abs(found[:, None] - exact).min(axis=1)
    assert nearest.max() <= digits * scale
    assert np.sum(found).real == pytest.approx(np.sum(exact).real, abs=1e-9 * scale)


@settings(max_examples=300)
@given(
    leading=between(-12.0, 12.0),
    rest=st.lists(
        st.one_of(st.just(0.0), between(1e-12, 1e12), between(-1e12, -1e-12), between(-1.0, 1.0)),
        min_size=4,
        max_size=4,
    ),
)
def test_never_a_nan_over_24_decades(leading, rest):
    found = quartic_roots(10.0**leading, *rest)
    assert np.isfinite(found).all()


def test_backward_error_over_many_decades():
    size = RANDOM.uniform(-6, 6, (5, 2000))
    coefficients = RANDOM.choice([-1.0, 1.0], size.shape) * 10.0**size
    found = quartic_roots(*coefficients)
    error = backward_error(found, coefficients)
    lapack = np.array([backward_error(np.roots(c), c) for c in coefficients.T])
    assert np.quantile(error.max(axis=1), 0.95) < 2e-11
    assert error.max() < 1e3 * lapack.max()


@given(shift=between(-3.0, 3.0), scale=between(0.1, 10.0))
def test_roots_move_with_shift_and_scale(shift, scale):
    roots = np.array([-2.0, -0.5, 1.0, 3.0])
    found = quartic_roots(*np.poly(roots * scale + shift))
    assert found.real == pytest.approx(roots * scale + shift, abs=1e-9 * (1 + scale))
    assert not found.imag.any()


def test_the_leading_coefficient_may_be_negative():
    assert quartic_roots(-2.0, 0.0, 10.0, 0.0, -8.0).real == pytest.approx([-2, -1, 1, 2])


def test_shapes_broadcast_and_scalars_and_empties_work():
    c0, c2 = np.linspace(1, 4, 5), np.array([[-5.0], [-6.0], [-7.0]])
    found = quartic_roots(1.0, 0.0, c2, 0.0, c0)
    assert found.shape == (3, 5, 4)
    for i, j in np.ndindex(3, 5):
        single = quartic_roots(1.0, 0.0, c2[i, 0], 0.0, c0[j])
        assert single.shape == (4,)
        assert found[i, j] == pytest.approx(single, rel=1e-14)
    empty = np.empty((0,))
    assert quartic_roots(1.0, empty, empty, empty, empty).shape == (0, 4)
    assert quadratic_roots(1.0, empty, empty).shape == (0, 2)


def test_quadratics_lose_no_digits():
    found = quadratic_roots(2.0, [-2e8, 2e8, 0.0, 0.0, -4.0, 2.0], [2.0, 2.0, -8.0, 8.0, 2.0, 1.0])
    expected = [[1e-8, 1e8], [-1e8, -1e-8], [-2, 2], [-2j, 2j], [1, 1], [-0.5 - 0.5j, -0.5 + 0.5j]]
    assert found == pytest.approx(np.array(expected), rel=1e-14)
    assert quadratic_roots(1.0, 0.0, 0.0).tolist() == [0, 0]
