"""The smallest destabilising load: at one frequency, and over a band."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.bench_margin import judged, random_case
from rotorstab import (
    BASE_CASE,
    ShaftDisk,
    critical_load,
    critical_pulsation,
    finite_element,
    fundamental_frequency,
    growth_rate,
    lumped,
    resonances,
    stability_margin,
)
from tests.testing.example_rotors import P, W, reference_growth


def crosses(system, static, load, frequency, step=1e-6):
    """Tell whether growth starts at a load: none just below, some just above."""
    below, above = growth_rate(system, static, load * np.array([1 - step, 1 + step]), frequency)
    return below < 0 < above


def test_margin_of_the_lightly_damped_base_case():
    system = lumped(BASE_CASE, 2.0, external_damping=1e-4)
    margin = stability_margin(system, 0.5 * P, 0.5 * W, 8 * W, P)
    # 2 √(σ_i σ_j / g) by hand: 0.000238031 p̄_cr, and the load shifts it by its square only
    assert margin.pulsating_load / P == pytest.approx(0.00023803105, rel=1e-6)
    assert margin.excitation_frequency / W == pytest.approx(1.676805, abs=2e-6)
    assert (margin.pair, margin.order) == ("1B+1F", 1)
    below, above = (
        reference_growth(system, 0.5 * P, margin.pulsating_load * part, margin.excitation_frequency)
        for part in (0.999, 1.001)
    )
    assert below < 0 < above


def test_margin_of_a_rotor_whose_tongue_slipped_through_the_scan():
    rotor = ShaftDisk(shear=0.068, disk_mass=1.166, diametral_inertia=1.432, polar_inertia=2.864)
    system = lumped(rotor, 3.964, external_damping=0.002)
    load, frequency = float(critical_load(rotor.shear)), fundamental_frequency(system)
    margin = stability_margin(system, 0.54 * load, 0.5 * frequency, 8 * frequency, load)
    assert margin.pulsating_load / load == pytest.approx(0.00215988, rel=1e-5)
    assert margin.pulsating_load <= 0.00216 * load
    assert crosses(system, 0.54 * load, margin.pulsating_load, margin.excitation_frequency)


@pytest.mark.parametrize(
    ("damping", "band", "load", "pair", "order"),
    [
        (1e-4, (0.5, 1.6), 0.0208492, "1B+1F", 2),
        (1e-4, (2.0, 3.0), 0.0537129, "2B+1F", 2),
        (0.2, (0.5, 8.0), 0.4723977, "1B+1F", 1),
    ],
)
def test_margin_beyond_the_first_order(damping, band, load, pair, order):
    system = lumped(BASE_CASE, 2.0, external_damping=damping)
    margin = stability_margin(system, 0.5 * P, band[0] * W, band[1] * W, P)
    assert margin.pulsating_load / P == pytest.approx(load, rel=1e-5)
    assert (margin.pair, margin.order) == (pair, order)
    place = margin.excitation_frequency
    assert crosses(system, 0.5 * P, margin.pulsating_load, place)
    # a true minimum: the load that destabilises is larger on both sides
    beside = critical_pulsation(system, 0.5 * P, place * np.array([1 - 1e-4, 1 + 1e-4]), P)
    assert (beside.pulsating_load > margin.pulsating_load).all()


def test_margin_at_the_end_of_a_band_beside_a_tongue():
    system = lumped(BASE_CASE, 2.0, external_damping=1e-4)
    margin = stability_margin(system, 0.5 * P, 1.7 * W, 3.9 * W, P)
    edge = critical_pulsation(system, 0.5 * P, [1.7 * W], P)
    assert margin.excitation_frequency == pytest.approx(1.7 * W)
    assert margin.pulsating_load == pytest.approx(edge.pulsating_load[0], rel=1e-8)
    assert margin.pulsating_load / P == pytest.approx(0.0373274, rel=1e-5)
    assert (margin.pair, margin.order) == ("1B+1F", 1)


def test_margin_without_damping():
    system = lumped(BASE_CASE, 2.0)
    rooted = stability_margin(system, 0.5 * P, 1.0 * W, 11 * W, P)
    assert (rooted.pulsating_load, rooted.pair, rooted.order) == (0.0, "1B+1F", 1)
    # a tongue of second order counts from a growth of 1e-6
    second = stability_margin(system, 0.5 * P, 0.7 * W, 0.95 * W, P)
    assert (second.pair, second.order) == ("1B+1F", 2)
    growth = growth_rate(system, 0.5 * P, second.pulsating_load, second.excitation_frequency)
    assert growth == pytest.approx(1e-6, rel=1e-2)


def test_margin_of_the_exact_law_and_of_finite_elements():
    exact = lumped(BASE_CASE, 2.0, external_damping=0.01, stiffness="exact")
    elements = finite_element(BASE_CASE, 2.0, external_damping=0.001, modes=3)
    for system in (exact, elements):
        margin = stability_margin(system, 0.5 * P, 1.2 * W, 2.2 * W, 0.1 * P)
        row = resonances(system, 0.5 * P, 0.0)["1B+1F"]
        assert margin.pulsating_load == pytest.approx(row.threshold, rel=0.02)
        assert crosses(system, 0.5 * P, margin.pulsating_load, margin.excitation_frequency)
    with pytest.raises(ValueError, match="below the pole of the exact stiffness"):
        stability_margin(exact, 0.5 * P, 1.2 * W, 2.2 * W, 30.0)


def test_no_margin_an_unstable_mean_and_bad_input():
    system = lumped(BASE_CASE, 2.0, external_damping=0.02)
    nothing = stability_margin(system, 0.5 * P, 5.0 * W, 5.5 * W, 0.1 * P)
    assert (nothing.pulsating_load, nothing.pair, nothing.order) == (np.inf, "", 0)
    assert np.isnan(nothing.excitation_frequency)
    unstable = lumped(BASE_CASE, 3.0, internal_damping=0.05)
    assert stability_margin(unstable, 0.5 * P, W, 2 * W, P).pulsating_load == 0
    assert critical_pulsation(unstable, 0.5 * P, [W], P).pulsating_load.tolist() == [0]
    with pytest.raises(ValueError, match="`highest_frequency` must be in"):
        stability_margin(system, 0.0, 2.0, 1.0, 0.1)
    with pytest.raises(ValueError, match="`excitation_frequencies` must be a list"):
        critical_pulsation(system, 0.0, 2.0, 0.1)


@pytest.mark.parametrize(
    "seed", [0, 1, *(pytest.param(one, marks=pytest.mark.long) for one in (2, 3))]
)
def test_margins_of_random_rotors_against_a_search_of_its_own(seed):
    """`python -m benchmarks margin` is the long form."""
    margin, word = judged(*random_case(np.random.default_rng(seed)))
    assert word in ("right", "unstable mean"), margin


def test_critical_pulsation_is_where_growth_starts():
    system = lumped(BASE_CASE, 2.0)
    theta = np.array([1.5, 1.65, 3.9, 5.0]) * W
    result = critical_pulsation(system, 0.5 * P, theta, P)
    assert np.isinf(result.pulsating_load[3])
    assert result.pairs == ("1B+1F", "1B+1F", "2B+1F", "")
    for load, frequency in zip(result.pulsating_load[:3], theta, strict=False):
        below, above = growth_rate(system, 0.5 * P, load * np.array([0.9999, 1.0001]), frequency)
        assert below < 1e-8 < above


@pytest.mark.parametrize(
    ("spin", "tangency", "damping", "static", "frequency", "load"),
    [
        (1.0, 0.0, 1e-4, 0.5, 4.0, 0.1928376),
        (2.0, 0.0, 1e-4, 0.5, 0.6, 0.8223157),
        (2.0, 0.0, 1e-4, 0.0, 8.0, 0.4269463),
        (2.0, 1.0, 1e-3, 0.3, 0.7, 0.3180199),
        (0.0, 0.0, 0.0, 0.3, 1.1, 0.8634774),  # closed again within 1/160 of the largest load
    ],
)
def test_critical_pulsation_alone_and_among_others(
    spin, tangency, damping, static, frequency, load
):
    system = lumped(BASE_CASE, spin, tangency, external_damping=damping)
    others = np.array([0.6, 1.0, 1.7, 2.4, 3.9, 5.0, 8.5])
    among = np.insert(others, 3, frequency) * W
    alone = critical_pulsation(system, static * P, [frequency * W], P).pulsating_load[0]
    many = critical_pulsation(system, static * P, among, P).pulsating_load[3]
    assert alone / P == pytest.approx(load, rel=1e-4)
    assert many == pytest.approx(alone, rel=1e-8)
    below, above = growth_rate(
        system, static * P, alone * np.array([0.9999, 1.0001]), frequency * W
    )
    assert below < 1e-8
    assert above > below


def test_a_summit_just_inside_a_tongue_bounds_the_crossing():
    """The answer was the next load of the scan, 0.4, where growth is 0.0019 already."""
    rotor = ShaftDisk(0.0497781277782105, 12.3037315106806, 1.23149463472083, 0.588850522064857)
    system = lumped(rotor, 3.321324982899102)
    load, theta = float(critical_load(rotor.shear)), 6.344314410182857
    theta *= fundamental_frequency(system)
    static = 0.6058987326419655 * load
    (found,) = critical_pulsation(system, static, [theta], load).pulsating_load
    assert found / load == pytest.approx(0.36175, abs=3e-4)
    below, above = growth_rate(system, static, found * np.array([0.9999, 1.0001]), theta)
    assert below < 1e-8 < above


@pytest.mark.parametrize("offset", [-2e-3, 0.0, 2e-3])
def test_a_pair_that_meets_between_two_loads_and_parts_faster_is_found(offset):
    """Closeness rose over the interval, so that no summit was seen: the answer was 0.80285."""
    rotor = ShaftDisk(0.04338192444725234, 5.343563171984274, 0.14022599130236005, 0.28004999572257)
    system = lumped(rotor, 1.67518751581302)
    load, theta = float(critical_load(rotor.shear)), 1.9763509969645627 + offset
    theta *= fundamental_frequency(system)
    static = 0.43306469551830795 * load
    (found,) = critical_pulsation(system, static, [theta], load).pulsating_load
    loads = np.linspace(0.77, 0.80, 1201) * load
    grown = loads[growth_rate(system, static, loads, theta) > 2e-6]
    assert len(grown) > 10
    assert found == pytest.approx(grown[0], abs=3e-5 * load)
    below, above = growth_rate(system, static, found * np.array([0.9999, 1.0001]), theta)
    assert below < 1e-8 < above


@settings(max_examples=3)
@given(
    st.integers(0, 10**6),
    st.lists(st.floats(0.5, 9.0), min_size=2, max_size=4),
    st.sampled_from([0.0, 1e-4, 1e-2]),
)
def test_one_frequency_does_not_depend_on_the_others(seed, frequencies, damping):
    rng = np.random.default_rng(seed)
    system = lumped(
        BASE_CASE, rng.uniform(0, 3), float(rng.choice([0.0, 1.0])), external_damping=damping
    )
    static, theta = rng.uniform(0, 0.5) * P, np.array(frequencies) * W
    together = critical_pulsation(system, static, theta, P).pulsating_load
    alone = [critical_pulsation(system, static, [f], P).pulsating_load[0] for f in theta]
    np.testing.assert_allclose(together, alone, rtol=1e-7, atol=1e-7 * P)


@pytest.mark.parametrize(("tangency", "damping"), [(0.0, 1e-4), (0.0, 5e-3), (1.0, 0.0)])
def test_nothing_grows_below_the_critical_pulsation(tangency, damping):
    system = lumped(BASE_CASE, 1.3, tangency, external_damping=damping)
    theta = np.array([0.55, 0.8, 1.3, 1.9, 4.1]) * W
    found = critical_pulsation(system, 0.4 * P, theta, P).pulsating_load
    loads = np.linspace(0, P, 401)[1:]
    growth = growth_rate(system, 0.4 * P, loads[:, None], theta)
    grows = (growth > 2e-6) & (loads[:, None] < found * (1 - 1e-6))
    assert not grows.any()
