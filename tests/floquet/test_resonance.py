"""The resonance table against published numbers, Floquet and closed forms."""

import numpy as np
import pytest

from rotorstab import BASE_CASE, critical_load, finite_element, lumped
from rotorstab.floquet.averaging import averaged_tongue
from rotorstab.floquet.point import growth_rate
from rotorstab.floquet.resonance import resonances
from tests.testing.example_rotors import P, W, one_dof

# speed, tangency, then pair: centre/ω_n, growth per β_d (theory, base case, α_s = 0.5)
TABLE = {
    (1.0, 0.0): {
        "1B+1F": (1.5347, 0.18482),
        "2B+1F": (4.0422, 0.06944),
        "2B+2F": (8.1423, 0.03991),
        "1B+2F": (5.6348, 0.00613),
    },
    (2.0, 1.0): {
        "1B+2B": (1.9877, 0.10322),
        "2B+1F": (4.0895, 0.05647),
        "2B+2F": (10.0354, 0.07071),
        "1F+2F": (5.9459, 0.02536),
    },
}


@pytest.mark.parametrize(("speed", "tangency"), TABLE)
def test_published_tongues(speed, tangency):
    table = resonances(lumped(BASE_CASE, speed, tangency), 0.5 * P, 0.05 * P)
    assert {row.name for row in table.tongues} == set(TABLE[speed, tangency])
    for name, (centre, growth) in TABLE[speed, tangency].items():
        assert table[name].centre / W == pytest.approx(centre, abs=6e-5)
        assert table[name].growth_per_load * P == pytest.approx(growth, abs=6e-6)
    assert len(table) == 6


@pytest.mark.parametrize(("speed", "tangency"), TABLE)
def test_growth_at_small_load_is_floquets(speed, tangency):
    system = lumped(BASE_CASE, speed, tangency)
    load = 1e-3 * P
    for row in resonances(system, 0.5 * P, load).tongues:
        growth = growth_rate(system, 0.5 * P, load, row.centre)
        assert growth == pytest.approx(row.growth, rel=2e-3)
        for side in (-1, 1):
            outside = row.centre + 1.1 * side * row.half_width
            assert growth_rate(system, 0.5 * P, load, outside) < 1e-10


def test_follower_has_no_principal_tongue_where_bolotin_draws_one():
    table = resonances(lumped(BASE_CASE, 2.0, 1.0), 0.5 * P, 0.05 * P)
    row = table["1B+1F"]
    assert (row.unstable, row.kind, row.precession) == (False, "principal", "opposite")
    assert row.threshold == np.inf
    assert row.half_width == 0


def test_kinds_and_precession():
    kinds = {r.name: (r.kind, r.precession) for r in resonances(lumped(BASE_CASE, 1.0), 0.0, 0.1)}
    assert kinds == {
        "1B+1F": ("principal", "opposite"),
        "2B+2F": ("principal", "opposite"),
        "2B+1F": ("sum", "opposite"),
        "1B+2F": ("sum", "opposite"),
        "1B+2B": ("difference", "same"),
        "1F+2F": ("difference", "same"),
    }


def test_axial_pulsation_couples_opposite_precession_only():
    for speed in (0.3, 1.0, 2.5):
        for row in resonances(lumped(BASE_CASE, speed), 0.3 * P, 0.1).tongues:
            assert row.precession == "opposite"


def test_no_spin_doubles_the_combination_tongue():
    table = resonances(lumped(BASE_CASE, 0.0), 0.5 * P, 0.1)
    assert table["1B+2F"].centre == pytest.approx(table["2B+1F"].centre, rel=1e-12)
    assert table["1B+1F"].centre / W == pytest.approx(1.42699, abs=1e-5)


def test_spin_reversal_swaps_precession():
    forward = resonances(lumped(BASE_CASE, 1.3), 0.5 * P, 0.1)
    backward = resonances(lumped(BASE_CASE, -1.3), 0.5 * P, 0.1)
    assert forward["1B+2F"].centre == pytest.approx(backward["2B+1F"].centre, rel=1e-12)
    assert forward["1B+2F"].growth == pytest.approx(backward["2B+1F"].growth, rel=1e-9)


def test_threshold_is_where_growth_starts():
    system = lumped(BASE_CASE, 1.0, external_damping=0.005)
    for row in resonances(system, 0.5 * P, 0.05 * P):
        if row.name in ("1B+1F", "2B+1F"):
            below, above = growth_rate(
                system, 0.5 * P, row.threshold * np.array([0.98, 1.02]), row.centre
            )
            assert below < 0 < above


def test_damped_width_closed_form():
    # ẍ + 2ζẋ + (1 + ε cos θt)x: |θ − 2| < √(ε²/4 − 4ζ²) to first order
    damping, load = 0.01, 0.1
    system = one_dof(external=2 * damping)
    row = resonances(system, 0.0, load)["1B+1F"]
    assert row.threshold == pytest.approx(4 * damping, rel=1e-3)
    assert row.half_width == pytest.approx(np.sqrt(load**2 / 4 - 4 * damping**2), rel=1e-3)


def test_finite_elements_and_bad_input():
    table = resonances(finite_element(BASE_CASE, 1.0, modes=3), 0.5 * P, 0.1)
    assert len(table) == 15
    lump = resonances(lumped(BASE_CASE, 1.0), 0.5 * P, 0.1)
    assert table["1B+1F"].centre == pytest.approx(lump["1B+1F"].centre, rel=0.05)
    with pytest.raises(ValueError, match="`pulsating_load` must be in"):
        resonances(lumped(BASE_CASE, 1.0), 0.0, -0.1)
    with pytest.raises(ValueError, match="one spin speed"):
        resonances(lumped(BASE_CASE, [0.0, 1.0]), 0.0, 0.1)
    with pytest.raises(KeyError):
        table["9B+9F"]


def test_mean_system_past_buckling_is_flagged():
    table = resonances(lumped(BASE_CASE, 0.0), 1.2 * float(critical_load(BASE_CASE.shear)), 0.1)
    assert table.mean_growth > 0
    assert not table.tongues


@pytest.mark.parametrize("decay", [(0.0, 0.1), (1e-200, 1e-180), (5e-324, 5e-324)])
def test_a_decay_that_underflows_is_none(decay):
    per_load, growth, width, threshold = averaged_tongue(4.0 + 0j, decay, 0.5)
    assert (per_load, width, threshold) == pytest.approx((1.0, 1.0, 0.0))
    assert growth == pytest.approx(0.5, rel=0.11)
