"""The maximum of a parabola through three points."""

import numpy as np
import pytest
from hypothesis import given

from rotorstab._numerics.parabola import parabola_maximum
from tests.testing.strategies import between


@given(place=between(-3.0, 3.0), value=between(-5.0, 5.0), bend=between(-4.0, -0.1))
def test_any_three_points_of_a_parabola_give_its_maximum(place, value, bend):
    x = np.array([[-1.0, 0.5, 2.0], [3.0, -2.0, 1.0]])
    found = parabola_maximum(x, value + bend * (x - place) ** 2)
    for number, expected in zip(found, (place, value, bend), strict=True):
        assert number == pytest.approx(np.full(2, expected), abs=1e-10)


@pytest.mark.parametrize("ordinates", [[1.0, 0.0, 1.0], [0.0, 1.0, 2.0], [2.0, 2.0, 2.0]])
def test_a_valley_and_a_line_have_no_maximum(ordinates):
    place, value, bend = parabola_maximum(np.array([-1.0, 0.0, 1.0]), np.array(ordinates))
    assert np.isnan(place)
    assert np.isnan(value)
    assert bend >= 0


def test_points_that_fall_together_raise_no_warning():
    place, _, _ = parabola_maximum(np.array([1.0, 1.0, 1.0]), np.array([1.0, 2.0, 3.0]))
    assert np.isnan(place)
