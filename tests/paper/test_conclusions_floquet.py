"""What Floquet upholds of the paper's five conclusions, against numbers made in another way.

Roots are sums and differences of whirl frequencies, growth and edges are growth rates at single
points, areas and some values are those of separate programs. The product takes them from its table
of resonances and from outlines.
"""

import re

import numpy as np
import pytest

from rotorstab import (
    BASE_CASE,
    EULER_BERNOULLI_TWIN,
    boundary_frequencies,
    critical_load,
    fundamental_frequency,
    growth_rate,
    lumped,
    whirl_frequencies,
)
from rotorstab.paper import CONCLUSIONS
from tests.testing.paper import floquet_conclusion

BUCKLING = float(critical_load(BASE_CASE.shear))
FREQUENCY = fundamental_frequency(lumped(BASE_CASE, 0.0))
SPINS = (0.0, 1.0, 2.0)
FACTORS = (0.0, 0.2, 0.5)
# columns of the whirl frequencies in ascending order, 2B, 1B, 1F, 2F
PAIRS = {"1B+1F": (1, 2), "2B+1F": (0, 2), "1B+2F": (1, 3), "2B+2F": (0, 3), "1B+2B": (0, 1)}
NUMBERS = r"((?:\d+(?:\.\d+)?(?:[,;]? )?)+)"


def ours(letter):
    return floquet_conclusion(letter).ours


def after(letter, words):
    """Return the numbers that follow some words in a statement."""
    (found,) = re.findall(re.escape(words) + NUMBERS, ours(letter))[:1]
    return [float(number) for number in re.split("[,; ]+", found.strip(" ,;"))]


def root(spin, tangency=0.0, factor=0.5, rotor=BASE_CASE, pair="1B+1F"):
    """Return θ̄ = ω_j − ω_i from the whirl frequencies of the rotor under its static load."""
    whirl = whirl_frequencies(lumped(rotor, spin, tangency), factor * BUCKLING).real
    low, high = PAIRS[pair]
    return float(whirl[high] - whirl[low])


def rates(spin, tangency, factor, beta, theta, rotor=BASE_CASE):
    system = lumped(rotor, spin, tangency)
    return growth_rate(system, factor * BUCKLING, beta * BUCKLING, np.asarray(theta))


def peak(spin, tangency=0.0, factor=0.5, rotor=BASE_CASE, pair="1B+1F"):
    """Return the largest growth rate around a root at β_d = 0.05, per β_d."""
    theta = root(spin, tangency, factor, rotor, pair) * np.linspace(0.99, 1.01, 81)
    return float(rates(spin, tangency, factor, 0.05, theta, rotor).max() / 0.05)


# Unstable share of θ/ω_n 0.2 to 8, β_d 0 to 1, at α_s = 0.5, by spin speed 0, 1, 2 and tangency.
# A separate program integrated the equations of motion over one period with the classical
# Runge–Kutta method, at least 40 steps in each cycle of the fastest whirl, at the centres of
# 200 × 40 pixels, and counted those with a multiplier beyond 1.0001.
UNSTABLE_SHARES = {
    0.0: (0.1510, 0.1335, 0.1130),
    1.0: (0.1085, 0.0986, 0.0820),
}


@pytest.mark.parametrize(
    ("letter", "verdict"),
    [
        ("a", "not confirmed"),
        ("b", "partly confirmed"),
        ("c", "confirmed"),
        ("d", "not confirmed"),
        ("e", "confirmed"),
    ],
)
def test_verdicts(letter, verdict):
    statement = floquet_conclusion(letter)
    assert statement.verdict == verdict
    assert statement.text == CONCLUSIONS[letter]().text
    assert " nan" not in statement.ours
    assert statement.note


@pytest.mark.parametrize("tangency", [0.0, 1.0])
@pytest.mark.parametrize("spin", [1.0, 2.0])
def test_a_no_boundary_of_a_spinning_rotor_separates_stable_from_unstable(spin, tangency):
    """At α_s = 0.5, β_d = 0.1 the rotor is stable 1 % left and right of every boundary."""
    system = lumped(BASE_CASE, spin, tangency)
    theta = boundary_frequencies(system, 0.5 * BUCKLING, 0.1 * BUCKLING)[:4]
    assert np.abs(rates(spin, tangency, 0.5, 0.1, theta * [[0.99], [1.01]])).max() < 1e-7
    assert "1 of 48 of the spinning cases" in ours("a")


def test_a_the_true_tongue_has_one_root_and_both_edges():
    """Its width at β_d = 0.1 is that between points that grow and points that do not."""
    (place,) = after("a", "has the one root θ/ω_n = ")
    assert place == pytest.approx(1.5347, abs=1e-4)  # a separate code
    assert place * FREQUENCY == pytest.approx(root(1.0), abs=1e-4)
    (width,) = re.findall(r"is (\d\.\d+) wide at β_d = 0\.1", ours("a"))
    theta = root(1.0) + np.linspace(-1, 1, 1201) * 0.09 * FREQUENCY
    grows = rates(1.0, 0.0, 0.5, 0.1, theta) > 1e-6
    assert grows.sum() * (theta[1] - theta[0]) / FREQUENCY == pytest.approx(float(width), abs=2e-4)
    assert np.abs(np.diff(grows.astype(int))).sum() == 2  # one stretch


@pytest.mark.parametrize("spin", SPINS)
def test_b_with_shear_every_tongue_has_a_lower_root(spin):
    for pair in ("1B+1F", "2B+1F", "1B+2F", "2B+2F"):
        assert root(spin, pair=pair) < root(spin, rotor=EULER_BERNOULLI_TWIN, pair=pair)


def test_b_shear_makes_the_principal_tongue_grow_faster_and_the_spin_makes_it_weaker():
    with_shear, without = after("b", "grows at "), after("b", "with and ")
    for stated, rotor in ((with_shear, BASE_CASE), (without, EULER_BERNOULLI_TWIN)):
        assert stated == pytest.approx([peak(spin, rotor=rotor) for spin in SPINS], rel=0.02)
    assert with_shear[1] == pytest.approx(0.18482, abs=5e-4)  # a separate code
    assert all(soft > stiff for soft, stiff in zip(with_shear, without, strict=True))
    assert with_shear == sorted(with_shear, reverse=True)


def test_b_the_spin_narrows_the_tongue_and_widens_the_bolotin_region():
    widths = after("b", "Its width at β_d = 0.1 is ")
    assert widths == sorted(widths, reverse=True)
    for spin, width in zip(SPINS, widths, strict=True):
        theta = root(spin) + np.linspace(-1, 1, 1001) * 0.08 * FREQUENCY
        stretch = (rates(spin, 0.0, 0.5, 0.1, theta) > 1e-6).mean() * 0.16
        assert stretch == pytest.approx(width, abs=4e-4)
    bolotin = []
    for spin in SPINS:
        system = lumped(BASE_CASE, spin)
        left, right = boundary_frequencies(system, 0.5 * BUCKLING, 0.1 * BUCKLING)[:2]
        bolotin.append((right - left) / FREQUENCY)
    assert bolotin[0] == pytest.approx(widths[0], rel=0.02)  # at rest they are one
    assert bolotin[1] / widths[1] > 13
    assert bolotin[2] / widths[2] > 28


def test_b_and_e_less_of_the_window_is_unstable_with_spin_and_under_a_follower_load():
    (words,) = re.findall(r"β_d = 1, ([\d., %]+) is unstable", ours("b"))
    stated = [float(number) / 100 for number in re.findall(r"[\d.]+", words)]
    assert stated == pytest.approx(list(UNSTABLE_SHARES[0.0]), abs=5e-3)
    assert stated == sorted(stated, reverse=True)
    shares = np.reshape(after("e", "θ/ω_n = 8, β_d = 1, "), (3, 2))
    separate = np.transpose([UNSTABLE_SHARES[tangency] for tangency in (0.0, 1.0)])
    np.testing.assert_allclose(shares, separate, atol=5e-3)
    assert (shares[:, 0] > shares[:, 1]).all()


def test_c_every_tongue_moves_left_and_the_principal_one_grows_faster():
    places = np.reshape(after("c", "goes from θ/ω_n "), (3, 3))
    direct = [[root(spin, 0.0, factor) / FREQUENCY for factor in FACTORS] for spin in SPINS]
    np.testing.assert_allclose(places, direct, atol=6e-4)
    stated = np.reshape(after("c", "grows at "), (3, 3))
    peaks = [[peak(spin, 0.0, factor) for factor in FACTORS] for spin in SPINS]
    np.testing.assert_allclose(stated, peaks, rtol=0.02)
    assert (np.diff(stated) > 0).all()
    for pair in ("2B+1F", "1B+2F", "2B+2F"):
        moves = [[root(spin, 0.0, factor, pair=pair) for factor in FACTORS] for spin in SPINS]
        assert (np.diff(moves) < 0).all()


def test_d_what_grows_in_the_first_region_is_a_pair_of_backward_whirls():
    """It shifts left and widens; the principal pair grows in one case only, and weakly."""
    stated = np.reshape(after("d", "the pair 1B+1F grows at "), (2, 3))
    np.testing.assert_allclose(stated, [[0, 0, 0.0105], [0, 0, 0]], atol=6e-4)
    places = np.reshape(after("d", "rooted at θ/ω_n = ")[:6], (2, 3))
    direct = [[root(s, 1.0, f, pair="1B+2B") / FREQUENCY for f in FACTORS] for s in (1.0, 2.0)]
    np.testing.assert_allclose(places, direct, atol=6e-4)
    assert places[1, 2] == pytest.approx(1.9877, abs=6e-4)  # a separate code
    assert peak(2.0, 1.0, pair="1B+2B") > 0.1
    assert abs(peak(2.0, 1.0)) < 1e-5


def test_e_the_strongest_and_the_lowest_tongue_are_the_axial_load_s():
    stated = np.reshape(after("e", "strongest tongue "), (3, 2))
    axial = [peak(spin) for spin in SPINS]
    np.testing.assert_allclose(stated[:, 0], axial, rtol=0.02)
    assert stated[2, 1] == pytest.approx(0.10322, abs=6e-4)  # a separate code
    assert stated[2, 1] == pytest.approx(peak(2.0, 1.0, pair="1B+2B"), rel=0.02)
    assert (stated[:, 0] > stated[:, 1]).all()
    lowest = np.reshape(after("e", "lowest root θ/ω_n "), (3, 2))
    np.testing.assert_allclose(lowest[:, 0], [root(s) / FREQUENCY for s in SPINS], atol=6e-4)
    assert (lowest[:, 0] < lowest[:, 1]).all()


def test_damping_takes_gyroscopic_stability_away():
    """Note of Fig. 8: past buckling a spinning rotor stands, but not with external damping."""
    load = 2.8
    assert not whirl_frequencies(lumped(BASE_CASE, 2.0), load).imag.any()
    assert whirl_frequencies(lumped(BASE_CASE, 0.0), load).imag.min() < -0.1
    damped = lumped(BASE_CASE, 2.0, external_damping=0.01)
    assert whirl_frequencies(damped, load).imag.min() < -1e-4
