"""The companion matrix against the quadratic eigenvalue problem itself."""

import numpy as np
import pytest

from rotorstab._numerics.companion import companion_matrix


@pytest.mark.parametrize("imaginary", [0.0, 1.0])
def test_eigenpairs_solve_the_quadratic_problem(imaginary):
    random = np.random.default_rng(3)
    a, b = random.normal(size=(2, 3, 3)) + 1j * imaginary * random.normal(size=(2, 3, 3))
    if not imaginary:
        a, b = a.real, b.real
    values, vectors = np.linalg.eig(companion_matrix(a, b))
    for x, vector in zip(values, vectors.T, strict=True):
        q = vector[:3]
        assert x**2 * q == pytest.approx(a @ q + x * (b @ q), abs=1e-12)
        assert vector[3:] == pytest.approx(x * q, abs=1e-12)


def test_shapes_broadcast():
    matrix = companion_matrix(np.ones((5, 2, 2)), 1j * np.ones((4, 1, 2, 2)))
    assert matrix.shape == (4, 5, 4, 4)
    assert matrix.dtype == np.complex128
    assert companion_matrix(np.ones((2, 2)), np.ones((2, 2))).dtype == np.float64
