"""Real roots told from complex ones, and bracketed roots of many functions at once."""

import numpy as np
import pytest
from hypothesis import given

from rotorstab._numerics.roots import bracketed_roots, is_real
from tests.testing.strategies import between


@given(centre=between(-5.0, 5.0), other=between(6.0, 9.0))
def test_a_double_eigenvalue_is_real_whatever_rounding_makes_of_it(centre, other):
    # a Jordan block in random coordinates: LAPACK parts its eigenvalues by some 1e-8
    basis = np.random.default_rng(2).normal(size=(3, 3))
    matrix = np.array([[centre, 1.0, 0.0], [0.0, centre, 0.0], [0.0, 0.0, other]])
    roots = np.linalg.eigvals(basis @ matrix @ np.linalg.inv(basis))
    if np.abs(centre) > 1.0:
        assert is_real(roots).all()


def test_complex_roots_and_rounding_about_zero():
    assert is_real(np.array([3.0, 1e-3j, -1e-3j, 1e-13j])).tolist() == [True, False, False, True]
    assert is_real(np.array([[1 + 1j, 1 - 1j], [1.0, 2.0]])).tolist() == [[False] * 2, [True] * 2]
    # the largest finite root is the measure; an infinite one is as real as its imaginary part
    assert is_real(np.array([np.inf, 1e-13j, 1.0])).tolist() == [True, True, True]
    assert is_real(np.empty((3, 0))).shape == (3, 0)


FUNCTIONS = {
    "line": lambda x, r: r - x,
    "cube": lambda x, r: r**3 - x**3,
    "flat at the root": lambda x, r: -((x - r) ** 3),
    "exponential": lambda x, r: np.exp(5 * r) - np.exp(5 * x),
    "square root": lambda x, r: np.sign(r - x) * np.sqrt(np.abs(r - x)),
    "step": lambda x, r: np.where(x < r, 1.0, -1.0),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("swap", [False, True])
def test_roots_are_found_to_the_tolerance(name, swap):
    roots = np.linspace(0.3, 2.7, 25)
    low, high = np.zeros(25), np.full(25, 3.0)
    sign = -1 if swap else 1

    def function(x, index):
        return sign * FUNCTIONS[name](x, roots[index])

    ends = (high, low) if swap else (low, high)
    assert bracketed_roots(function, *ends, 1e-9) == pytest.approx(roots, rel=2e-9)


def test_smooth_functions_take_few_evaluations():
    calls = []

    def function(x, index):
        calls.append(len(x))
        return np.cos(x)

    found = bracketed_roots(function, np.array([0.0]), np.array([3.0]), 1e-12)
    assert found == pytest.approx([np.pi / 2], rel=1e-12)
    assert sum(calls) < 15  # bisection would take 40


def test_no_sign_change_is_no_root():
    def function(x, index):
        return np.array([1.0, -1.0, np.nan, -1.0])[index] * np.ones_like(x)

    zeros = np.zeros(4)
    assert np.isnan(bracketed_roots(function, zeros, zeros + 1, 1e-9)).all()
    assert bracketed_roots(function, np.empty(0), np.empty(0), 1e-9).shape == (0,)


def test_each_function_is_asked_about_its_own_points():
    roots = np.array([0.2, 0.9, 0.5])

    def function(x, index):
        assert len(x) == len(index)
        return (roots[index] - x) * (1 + index)

    found = bracketed_roots(function, np.zeros(3), np.ones(3), 1e-9)
    assert found == pytest.approx(roots, rel=1e-9)
