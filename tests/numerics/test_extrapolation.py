"""Richardson's weights cancel the errors that they are made for."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from rotorstab._numerics.extrapolation import extrapolation_weights


@pytest.mark.parametrize("order", [2, 4, 6])
@pytest.mark.parametrize("steps", [(1, 2), (3, 4, 5), (4, 3, 2), (1, 2, 4, 8)])
def test_low_errors_cancel_and_the_value_stays(order, steps):
    weights = extrapolation_weights(steps, order)
    sizes = 1 / np.array(steps, dtype=float)
    assert weights.sum() == pytest.approx(1.0, rel=1e-12)
    for k in range(len(steps) - 1):
        assert weights @ sizes ** (order + 2 * k) == pytest.approx(0.0, abs=1e-12)
    terms = weights * sizes ** (order + 2 * len(steps) - 2)
    assert abs(terms.sum()) > 1e-3 * np.abs(terms).max()


def test_the_trapezoidal_rule_becomes_romberg_s():
    def integral(count):
        x = np.linspace(0.0, 1.0, count + 1)
        return trapezoid(np.exp(x), x)

    steps = (2, 4, 8)
    values = np.array([integral(count) for count in steps])
    exact = np.e - 1
    assert abs(values[-1] - exact) > 1e-3
    assert extrapolation_weights(steps, 2) @ values == pytest.approx(exact, abs=1e-7)


def test_one_result_stands_alone():
    assert extrapolation_weights((5,), 2).tolist() == [1.0]
