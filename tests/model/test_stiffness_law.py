"""A stiffness law that is not the linear one: every analysis takes it, whatever its formula."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotorstab import (
    BASE_CASE,
    STIFFNESS_LAWS,
    PastPole,
    ShaftDisk,
    StiffnessLaw,
    boundary_frequencies,
    flutter_load,
    growth_rate,
    hill_boundary_frequencies,
    linear_stiffness,
    lumped,
    resonances,
    stability_chart,
    stability_margin,
    unstable_outlines,
    whirl_frequencies,
)

SHEAR, TANGENCY = BASE_CASE.shear, 1.0
ELASTIC, GEOMETRIC = linear_stiffness(SHEAR, TANGENCY)
FAR = 200.0  # polynomials in the load are smooth everywhere


def linear_again(load):
    return ELASTIC + np.asarray(load)[..., None, None] * GEOMETRIC


def cubic(load):
    load = np.asarray(load)[..., None, None]
    return ELASTIC + load * GEOMETRIC + (0.01 * load**2 - 0.002 * load**3) * ELASTIC


LINEAR = lumped(BASE_CASE, 2.0, TANGENCY)
AGAIN = replace(LINEAR, law=StiffnessLaw("linear again", linear_again, FAR))
CUBIC = replace(LINEAR, law=StiffnessLaw("cubic", cubic, FAR))


@pytest.mark.parametrize(
    "analysis",
    [
        lambda system: whirl_frequencies(system, np.linspace(-1.0, 3.0, 9)),
        lambda system: boundary_frequencies(system, 1.0, np.linspace(0.0, 1.5, 6)),
        lambda system: hill_boundary_frequencies(system, 1.0, 0.8, 2),
        lambda system: flutter_load(system),
        lambda system: growth_rate(system, 1.0, [[0.2], [1.1]], [0.9, 1.3, 2.2]),
        lambda system: stability_margin(system, 1.0, 0.6, 3.0, 1.5).pulsating_load,
        lambda system: [row.growth_per_load for row in resonances(system, 1.0, 1.0)],
    ],
    ids=["whirl", "Bolotin", "Hill", "flutter", "growth", "margin", "resonances"],
)
def test_the_linear_law_as_any_law_gives_what_its_own_formulas_give(analysis):
    np.testing.assert_allclose(analysis(AGAIN), analysis(LINEAR), rtol=1e-7, atol=1e-9)


def test_so_do_a_map_and_the_outlines_of_its_tongues():
    loads, frequencies = np.linspace(0.0, 1.5, 9), np.linspace(0.6, 3.0, 25)
    found, known = (stability_chart(one, 1.0, loads, frequencies) for one in (AGAIN, LINEAR))
    np.testing.assert_allclose(found.growth, known.growth, rtol=0, atol=2e-5)
    found, known = (unstable_outlines(one, 1.0, 1.5, 0.6, 3.0, 11) for one in (AGAIN, LINEAR))
    assert [one.name for one in found] == [one.name for one in known]
    for one, other in zip(found, known, strict=True):
        assert one.area == pytest.approx(other.area, rel=1e-4)


@pytest.mark.parametrize(("pulsating", "frequency"), [(0.4, 1.31), (1.2, 2.05), (0.9, 3.7)])
def test_growth_under_a_law_that_is_added_is_that_of_an_integrator(pulsating, frequency):
    period = 2 * math.pi / frequency
    inverse, damping = np.linalg.inv(CUBIC.mass), CUBIC.damping()

    def rate(time, flat):
        state = flat.reshape(4, 4)
        stiffness = cubic(1.0 + pulsating * math.cos(frequency * time))
        force = -stiffness @ state[:2] - damping @ state[2:]
        return np.concatenate([state[2:], inverse @ force]).ravel()

    start = np.eye(4, dtype=complex).ravel()
    end = solve_ivp(rate, (0, period), start, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    largest = np.abs(np.linalg.eigvals(end.reshape(4, 4))).max()
    found = growth_rate(CUBIC, 1.0, pulsating, frequency)
    assert found == pytest.approx(math.log(largest) / period, abs=1e-7)


def test_a_law_without_a_pole_has_no_largest_load():
    assert CUBIC.pole == CUBIC.largest_load == math.inf
    assert not CUBIC.is_linear
    assert lumped(BASE_CASE, 0.0, stiffness="exact").pole < 40


def test_the_pole_of_a_law_is_named_with_the_law():
    law = replace(CUBIC.law, name="softening", pole=3.0, residue=0.1)
    system = replace(LINEAR, law=law)
    message = r"below the pole of the softening stiffness, 3 at this shear, got 3.5"
    with pytest.raises(PastPole, match=message):
        growth_rate(system, 2.5, 1.0, 1.3)
    with pytest.raises(ValueError, match="linear stiffness law, got the softening one"):
        system.projected(np.eye(2))


def test_a_law_is_found_by_its_name(monkeypatch):
    monkeypatch.setitem(STIFFNESS_LAWS, "cubic", lambda shear, tangency: CUBIC.law)
    system = lumped(ShaftDisk(), 2.0, TANGENCY, stiffness="cubic")
    np.testing.assert_array_equal(system.load_stiffness(1.5), cubic(1.5))
    with pytest.raises(ValueError, match="must be one of 'linear', 'exact', 'cubic', got 'no'"):
        lumped(ShaftDisk(), 2.0, stiffness="no")
