"""The bound of the distance to a root holds for quadratics of any phase."""

import numpy as np
import pytest
from hypothesis import given

from rotorstab._numerics.angles import wrapped
from rotorstab._numerics.root_bounds import root_distance
from tests.testing.strategies import between


@given(
    value=between(1e-12, 1.0),
    slope=between(0.0, 10.0),
    bend=between(0.0, 10.0),
    first=between(0.0, 7.0),
    second=between(0.0, 7.0),
)
def test_the_nearest_root_of_a_quadratic_lies_within_the_bound(value, slope, bend, first, second):
    if slope + bend < 1e-3:
        return  # no root is near
    # the reciprocals of the roots: bend may be 0
    reciprocals = np.roots([value, slope * np.exp(1j * first), bend * np.exp(1j * second)])
    nearest = 1 / np.abs(reciprocals).max()
    bound = float(root_distance(np.array(value), np.array(slope), bend))
    assert nearest <= bound * (1 + 1e-9)


def test_simple_and_double_roots():
    assert root_distance(np.array(1e-8), np.array(2.0), 0.0) == pytest.approx(1e-8)
    assert root_distance(np.array(1e-8), np.array(0.0), 1.0) == pytest.approx(2e-4)


@given(angle=between(-50.0, 50.0))
def test_wrapped_angles_differ_by_whole_turns(angle):
    found = float(wrapped(np.array(angle)))
    assert abs(found) <= np.pi * (1 + 1e-12)
    turns = (angle - found) / (2 * np.pi)
    assert turns == pytest.approx(round(turns), abs=1e-9)
