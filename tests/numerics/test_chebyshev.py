"""Chebyshev interpolation and cosine sums."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev

from rotorstab._numerics.chebyshev import (
    chebyshev_angles,
    chebyshev_nodes,
    chebyshev_transform,
    chebyshev_values,
    coefficient_weights,
)


@pytest.mark.parametrize("count", [1, 2, 7, 30])
def test_a_polynomial_is_rebuilt_from_its_values_at_the_nodes(count):
    low, high = -0.5, 2.0
    polynomial = chebyshev.Chebyshev(np.random.default_rng(6).normal(size=count), [low, high])
    coefficients = chebyshev_transform(count) @ polynomial(chebyshev_nodes(count, low, high))
    assert coefficients == pytest.approx(polynomial.coef, abs=1e-12)
    points = np.linspace(low, high, 41).reshape(1, 41)
    values = chebyshev_values(points, low, high, count)
    assert values.shape == (1, 41, count)
    assert values @ coefficients == pytest.approx(polynomial(points), abs=1e-11)


def test_interpolation_of_a_smooth_function_converges_geometrically():
    points = np.linspace(0.0, 1.0, 101)
    errors = []
    for count in (4, 8, 12):
        coefficients = chebyshev_transform(count) @ np.exp(chebyshev_nodes(count, 0.0, 1.0))
        found = chebyshev_values(points, 0.0, 1.0, count) @ coefficients
        errors.append(np.abs(found - np.exp(points)).max())
    assert errors[0] < 1e-3
    assert errors[1] < 1e-4 * errors[0]
    assert errors[2] < 1e-12


def test_cosine_coefficients_of_a_periodic_function():
    # 1/(a − b cos φ) = (1 + 2 Σ zᵐ cos mφ)/√(a² − b²)
    a, b = 2.0, 1.2
    root = np.sqrt(a * a - b * b)
    z = b / (a + root)
    found = coefficient_weights(5, 60) @ (1 / (a - b * np.cos(chebyshev_angles(60))))
    assert found == pytest.approx(np.array([1, 2 * z, 2 * z**2, 2 * z**3, 2 * z**4]) / root)


def test_an_interval_without_width_holds_its_one_point():
    assert chebyshev_nodes(3, 0.7, 0.7) == pytest.approx([0.7] * 3)
    assert chebyshev_values(np.array([0.7]), 0.7, 0.7, 3).tolist() == [[1.0, 0.0, -1.0]]


def test_the_shared_matrix_is_read_only():
    with pytest.raises(ValueError, match="read-only"):
        chebyshev_transform(4)[0, 0] = 1.0
