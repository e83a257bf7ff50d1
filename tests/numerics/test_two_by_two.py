"""Determinants of sums of 2 × 2 matrices."""

import numpy as np
import pytest

from rotorstab._numerics.two_by_two import determinant, entries, mixed_determinant


@pytest.mark.parametrize("shape", [(), (1,), (3, 4)])
def test_the_determinant_of_a_sum_is_a_polynomial(shape):
    a, b = np.random.default_rng(5).normal(size=(2, *shape, 2, 2))
    t = 0.7
    x, y = entries(a), entries(b)
    found = determinant(x) + t * mixed_determinant(x, y) + t**2 * determinant(y)
    assert found == pytest.approx(np.linalg.det(a + t * b))


def test_one_matrix_gives_plain_numbers():
    assert all(type(x) is float for x in entries(np.eye(2)))
    assert entries(np.ones((5, 2, 2)))[0].shape == (5,)
