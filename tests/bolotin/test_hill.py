"""Boundaries of Hill's determinant against Bolotin's first approximation and Floquet's edges."""

import numpy as np
import pytest

from rotorstab import (
    BASE_CASE,
    boundary_frequencies,
    growth_rate,
    hill_boundary_frequencies,
    lumped,
    tongue_edges,
)
from tests.testing.example_rotors import P, W


@pytest.mark.parametrize("speed", [0.0, 1.0, 2.0])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_one_harmonic_is_bolotins_first_approximation(speed, tangency):
    system = lumped(BASE_CASE, speed, tangency)
    loads = np.array([0.1, 0.5]) * P
    np.testing.assert_allclose(
        hill_boundary_frequencies(system, 0.3 * P, loads),
        boundary_frequencies(system, 0.3 * P, loads),
        rtol=1e-7,
    )


@pytest.mark.parametrize(("harmonics", "low", "high"), [(1, 0.1, 0.2), (2, 0.2, 0.4)])
def test_order_of_the_hill_boundaries_without_spin(harmonics, low, high):
    system = lumped(BASE_CASE, 0.0)
    error = []
    for factor in (low, high):
        edges = tongue_edges(system, 0.0, [factor * P], ("1B+1F",))
        found = hill_boundary_frequencies(system, 0.0, factor * P, harmonics)
        error.append(np.nanmin(np.abs(found - edges.right[0, 0])))
    order = np.log(error[1] / error[0]) / np.log(high / low)
    assert order == pytest.approx(2 * harmonics, abs=0.35)


def test_three_harmonics_and_period_t_agree_with_floquet():
    system = lumped(BASE_CASE, 0.0)
    edges = tongue_edges(system, 0.0, [0.4 * P], ("1B+1F",))
    three = hill_boundary_frequencies(system, 0.0, 0.4 * P, 3)
    assert np.nanmin(np.abs(three - edges.left[0, 0])) < 1e-8
    # the second-order tongue at ω: stable outside, unstable inside a pair of period T
    second = hill_boundary_frequencies(system, 0.0, 0.4 * P, 4, "T")
    pair = np.sort(second[np.argsort(np.abs(second - W))[:2]])
    inside = growth_rate(system, 0.0, 0.4 * P, pair.mean())
    outside = growth_rate(system, 0.0, 0.4 * P, pair + np.array([-1e-4, 1e-4]))
    assert inside > 1e-4
    assert outside.max() < 1e-9


def test_hill_bad_input():
    system = lumped(BASE_CASE, 0.0)
    with pytest.raises(ValueError, match=r"`harmonics` must be in \[1, 20\], got 0"):
        hill_boundary_frequencies(system, 0.0, 0.1, 0)
    with pytest.raises(ValueError, match="`period` must be one of"):
        hill_boundary_frequencies(system, 0.0, 0.1, 1, "3T")
    assert hill_boundary_frequencies(system, np.zeros((3, 1)), 0.1, 2).shape == (3, 1, 8)
