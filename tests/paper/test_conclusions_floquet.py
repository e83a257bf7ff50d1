"""What Floquet upholds of the paper's five conclusions, on numbers computed here as well.

Peak growth is per β_d; widths and places are in θ/ω_n; the base case, p̄_cr = 2.3558.
"""

from functools import cache

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
    resonances,
    stability_chart,
    tongue_edges,
    whirl_frequencies,
)
from rotorstab.paper import CONCLUSIONS
from tests.testing.paper import floquet_conclusion

BUCKLING = float(critical_load(BASE_CASE.shear))
FREQUENCY = fundamental_frequency(lumped(BASE_CASE, 0.0))
SPINS = (0.0, 1.0, 2.0)
FACTORS = (0.0, 0.2, 0.5)


@cache
def table(spin, tangency=0.0, factor=0.5, rotor=BASE_CASE):
    return resonances(lumped(rotor, spin, tangency), factor * BUCKLING, BUCKLING)


def growth(*case, name="1B+1F"):
    return BUCKLING * {row.name: row.growth_per_load for row in table(*case)}.get(name, 0.0)


def root(*case, name="1B+1F"):
    return table(*case)[name].centre / FREQUENCY


def width(spin, tangency, factor, name, beta):
    """Return the width of a tongue between its exact edges."""
    system = lumped(BASE_CASE, spin, tangency)
    edges = tongue_edges(system, factor * BUCKLING, [beta * BUCKLING], (name,))
    return float((edges.right - edges.left)[0, 0] / FREQUENCY)


@cache
def unstable_share(spin, tangency):
    """Return the unstable share of θ/ω_n 0.2 to 8, β_d 0 to 1, at α_s = 0.5, from a map."""
    theta = (0.2 + (np.arange(400) + 0.5) / 400 * 7.8) * FREQUENCY
    loads = (np.arange(80) + 0.5) / 80 * BUCKLING
    chart = stability_chart(
        lumped(BASE_CASE, spin, tangency), 0.5 * BUCKLING, loads, theta, seed=False
    )
    return float(chart.unstable.mean())


@pytest.mark.parametrize(
    ("letter", "verdict"),
    [
        ("a", "does not survive"),
        ("b", "survives in part"),
        ("c", "survives"),
        ("d", "does not survive"),
        ("e", "survives"),
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
def test_a_boundaries_of_a_spinning_rotor_lie_in_stable_ground(spin, tangency):
    """At α_s = 0.5, β_d = 0.1 the rotor is stable 1 % left and right of every boundary."""
    system = lumped(BASE_CASE, spin, tangency)
    theta = boundary_frequencies(system, 0.5 * BUCKLING, 0.1 * BUCKLING)[:4]
    sides = growth_rate(system, 0.5 * BUCKLING, 0.1 * BUCKLING, theta * [[0.99], [1.01]])
    assert np.abs(sides).max() < 1e-7


def test_a_the_true_tongue_has_one_root_and_both_edges():
    assert root(1.0) == pytest.approx(1.5347, abs=1e-4)
    whirl = whirl_frequencies(lumped(BASE_CASE, 1.0), 0.5 * BUCKLING).real
    assert root(1.0) * FREQUENCY == pytest.approx(whirl[2] - whirl[1])
    assert width(1.0, 0.0, 0.5, "1B+1F", 0.1) == pytest.approx(0.1143, abs=1e-4)


def test_b_shear_is_destabilising():
    """Every tongue roots lower, the principal one grows faster."""
    for spin in SPINS:
        for name in ("1B+1F", "2B+1F", "1B+2F", "2B+2F"):
            assert root(spin, name=name) < root(spin, 0.0, 0.5, EULER_BERNOULLI_TWIN, name=name)
    assert [growth(spin, 0.0, 0.5, EULER_BERNOULLI_TWIN) for spin in SPINS] == pytest.approx(
        [0.2139, 0.1768, 0.1303], abs=1e-4
    )


def test_b_the_gyroscopic_moment_is_not():
    """The principal tongue weakens and narrows, and less of the plane is unstable."""
    assert [growth(spin) for spin in SPINS] == pytest.approx([0.2232, 0.1848, 0.1370], abs=1e-4)
    assert [width(spin, 0.0, 0.5, "1B+1F", 0.1) for spin in SPINS] == pytest.approx(
        [0.1380, 0.1143, 0.0847], abs=1e-4
    )
    shares = [unstable_share(spin, 0.0) for spin in SPINS]
    assert shares == pytest.approx([0.150, 0.132, 0.113], abs=3e-3)
    bolotin = []
    for spin in SPINS:
        system = lumped(BASE_CASE, spin)
        left, right = boundary_frequencies(system, 0.5 * BUCKLING, 0.1 * BUCKLING)[:2]
        bolotin.append((right - left) / FREQUENCY)
    assert bolotin[0] < 0.15
    assert bolotin[0] < bolotin[1] < bolotin[2]
    # 1.5 and 2.4 wide: 13 and 28 times the true tongue
    assert bolotin[1] / 0.1143 > 13
    assert bolotin[2] / 0.0847 > 28


def test_c_every_tongue_moves_left_and_the_principal_one_grows_faster():
    for spin in SPINS:
        for name in ("1B+1F", "2B+1F", "1B+2F", "2B+2F"):
            places = [root(spin, 0.0, factor, name=name) for factor in FACTORS]
            assert places[0] > places[1] > places[2]
        rates = [growth(spin, 0.0, factor) for factor in FACTORS]
        assert rates[0] < rates[1] < rates[2]
    assert [root(1.0, 0.0, factor) for factor in FACTORS] == pytest.approx(
        [2.0308, 1.8490, 1.5347], abs=1e-4
    )


def test_d_the_first_region_holds_no_principal_tongue():
    """Except a weak one at Ω̄ = 1, α_s = 0.5; what grows is 1B+2B, and it moves left."""
    rates = [[growth(spin, 1.0, factor) for factor in FACTORS] for spin in (1.0, 2.0)]
    assert np.ravel(rates) == pytest.approx([0, 0, 0.0105, 0, 0, 0], abs=1e-4)
    for spin, places in ((1.0, (2.3670, 2.2539, 2.0678)), (2.0, (2.2689, 2.1627, 1.9877))):
        assert [root(spin, 1.0, f, name="1B+2B") for f in FACTORS] == pytest.approx(
            places, abs=1e-4
        )
        widths = [width(spin, 1.0, f, "1B+2B", 0.1) for f in FACTORS]
        assert widths[0] < widths[1] < widths[2]


def test_d_where_the_principal_tongue_would_be_the_rotor_is_stable():
    system = lumped(BASE_CASE, 2.0, 1.0)
    whirl = whirl_frequencies(system, 0.5 * BUCKLING).real
    theta = (whirl[2] - whirl[1]) * np.linspace(0.985, 1.015, 61)
    assert np.abs(growth_rate(system, 0.5 * BUCKLING, 0.05 * BUCKLING, theta)).max() < 1e-7


def test_e_an_axial_load_is_worse_by_growth_place_and_area():
    strongest = [
        [max(row.growth_per_load for row in table(spin, mu)) * BUCKLING for mu in (0.0, 1.0)]
        for spin in SPINS
    ]
    assert np.ravel(strongest) == pytest.approx(
        [0.2232, 0.1130, 0.1848, 0.1146, 0.1370, 0.1032], abs=1e-4
    )
    for spin in SPINS:
        lowest = [min(row.centre for row in table(spin, mu).tongues) for mu in (0.0, 1.0)]
        assert lowest[0] < lowest[1]
        assert unstable_share(spin, 0.0) > unstable_share(spin, 1.0)


def test_damping_takes_gyroscopic_stability_away():
    """Note of Fig. 8: past buckling a spinning rotor stands, but not with external damping."""
    load = 2.8
    assert not whirl_frequencies(lumped(BASE_CASE, 2.0), load).imag.any()
    assert whirl_frequencies(lumped(BASE_CASE, 0.0), load).imag.min() < -0.1
    damped = lumped(BASE_CASE, 2.0, external_damping=0.01)
    assert whirl_frequencies(damped, load).imag.min() < -1e-4
