"""The time response against an integrator and closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rotorstab import (
    ShaftDisk,
    critical_load,
    finite_element,
    fundamental_frequency,
    growth_rate,
    initial_conditions,
    lumped,
    time_response,
    whirl_frequencies,
)
from rotorstab.floquet.point import floquet_solution
from rotorstab.floquet.schemes import divisible

ROTOR = ShaftDisk()
CRITICAL = float(critical_load(ROTOR.shear))


def integrate(system, static, pulsating, frequency, initial, times):
    """The same motion by scipy's DOP853."""
    n = system.size
    damping, inverse = system.damping(), np.linalg.inv(system.mass)

    def rate(time, state):
        stiffness = system.stiffness(static + pulsating * math.cos(frequency * time))
        force = -stiffness @ state[:n] - damping @ state[n:]
        return np.concatenate([state[n:], inverse @ force])

    return solve_ivp(
        rate, (0, times[-1]), initial, "DOP853", times, rtol=1e-12, atol=1e-14 * abs(initial).max()
    ).y


rotors = st.builds(
    ShaftDisk,
    shear=st.floats(0, 0.1),
    disk_mass=st.floats(0.5, 20),
    diametral_inertia=st.floats(0.2, 3),
    polar_inertia=st.floats(0, 3),
    slenderness=st.just(0.08),
)


@settings(max_examples=6)
@given(
    rotor=rotors,
    spin=st.floats(0, 4),
    tangency=st.sampled_from([0.0, 0.4, 1.0]),
    damping=st.sampled_from([(0.0, 0.0), (0.02, 0.0), (0.01, 0.03)]),
    law=st.sampled_from(["linear", "exact"]),
    factors=st.tuples(st.floats(-0.5, 0.9), st.floats(0, 1)),
    frequency=st.floats(1.5, 12),
    kind=st.sampled_from(["knock", "noise"]),
)
def test_response_is_that_of_an_integrator(
    rotor, spin, tangency, damping, law, factors, frequency, kind
):
    system = lumped(rotor, spin, tangency, *damping, stiffness=law)
    static, pulsating = np.array(factors) * float(critical_load(rotor.shear))
    start = initial_conditions(system, static, kind, seed=3)
    motion = time_response(system, static, pulsating, frequency, start, 3, 7)
    reference = integrate(system, static, pulsating, frequency, start, motion.time)
    size = np.abs(reference[:2]).max()
    np.testing.assert_allclose(motion.displacement, reference[0], rtol=0, atol=2e-8 * size)
    np.testing.assert_allclose(motion.slope, reference[1], rtol=0, atol=2e-8 * size)


@pytest.mark.parametrize(("modes", "tip"), [(4, (0, 1)), (None, (-2, -1))])
def test_response_of_a_distributed_shaft(modes, tip):
    system = finite_element(ROTOR, 1.0, 1.0, elements=3, modes=modes)
    start = np.zeros(2 * system.size, complex)
    start[tip[0] % system.size] = 1.0
    motion = time_response(system, 0.5, 1.0, 3.0, start, 3, 9, tip=tip)
    reference = integrate(system, 0.5, 1.0, 3.0, start, motion.time)
    reference = reference[[index % system.size for index in tip]]
    np.testing.assert_allclose(motion.displacement, reference[0], rtol=0, atol=1e-8)
    np.testing.assert_allclose(motion.slope, reference[1], rtol=0, atol=1e-8)


@pytest.mark.parametrize("name", ["1B", "1F", "2B", "2F"])
def test_a_mode_without_pulsation_is_a_circle_at_its_frequency(name):
    system = lumped(ROTOR, 2.0)
    start = initial_conditions(system, 0.5 * CRITICAL, f"mode:{name}")
    motion = time_response(system, 0.5 * CRITICAL, 0.0, 1.1, start, 50, 16)
    frequencies = whirl_frequencies(system, 0.5 * CRITICAL).real
    frequency = dict(zip(("2B", "1B", "1F", "2F"), frequencies, strict=True))[name]
    circle = np.exp(1j * frequency * motion.time)
    np.testing.assert_allclose(motion.displacement, circle, rtol=0, atol=1e-10)
    assert motion.growth_rate == 0
    assert motion.doubling_time == math.inf
    np.testing.assert_allclose(motion.envelope, 1, rtol=1e-10)


def test_ten_thousand_periods_do_not_drift():
    system = lumped(ROTOR, 1.0)
    static, frequency = 0.5 * CRITICAL, 1.1
    start = initial_conditions(system, static, "mode:1F")
    motion = time_response(system, static, 0.0, frequency, start, 10_000, 5)
    assert abs(abs(motion.displacement) - 1).max() < 1e-9
    phase = motion.displacement[-1] / np.exp(
        1j * whirl_frequencies(system, static).real[2] * motion.time[-1]
    )
    assert abs(phase - 1) < 1e-8
    pulsated = time_response(system, static, 0.1 * CRITICAL, 2.3, start, 10_000, 5)
    sizes = abs(pulsated.displacement)
    assert abs(sizes[-2000:].max() / sizes[:2000].max() - 1) < 0.02


def test_doubling_time_is_that_of_the_growth_rate_and_of_the_motion():
    system = lumped(ROTOR, 1.0)
    static, pulsating, frequency = 0.5 * CRITICAL, 0.1 * CRITICAL, 0.99244
    rate = float(growth_rate(system, static, pulsating, frequency))
    start = initial_conditions(system, static, "noise", seed=1)
    motion = time_response(system, static, pulsating, frequency, start, 400, 24)
    assert motion.growth_rate == pytest.approx(rate, rel=1e-7)
    assert motion.doubling_time == pytest.approx(math.log(2) / rate, rel=1e-7)
    sizes = abs(motion.displacement).reshape(-1)[:-1].reshape(400, 24).max(axis=1)
    late = np.polyfit(np.arange(200, 400) * motion.period, np.log(sizes[200:]), 1)[0]
    assert late == pytest.approx(rate, rel=1e-2)
    late = slice(len(motion.time) // 2, None)
    share = abs(motion.displacement[late]) / motion.envelope[late]
    assert share.max() == pytest.approx(1, abs=1e-9)


def test_a_response_ends_where_it_exceeds_a_displacement():
    system, static = lumped(ROTOR, 2.0), 0.5 * CRITICAL
    start = initial_conditions(system, static, "knock")
    frequency = 1.68 * fundamental_frequency(system)
    motion = time_response(system, static, 0.5 * CRITICAL, frequency, start, 20, 24)
    ended = motion.until(5.0)
    assert abs(ended.displacement[-1]) > 5 >= abs(ended.displacement[:-1]).max()
    np.testing.assert_array_equal(ended.displacement, motion.displacement[: len(ended.time)])
    assert len(ended.load) == len(ended.slope) == len(ended.time) < len(motion.time)
    assert motion.until(1e9) is motion
    assert len(motion.until(0.0).time) == 2


def test_damping_halves_the_motion():
    system = lumped(ROTOR, 0.0, external_damping=0.05)
    start = initial_conditions(system, 0.0, "mode:1F")
    motion = time_response(system, 0.0, 0.0, 1.0, start, 3)
    assert motion.doubling_time < 0
    assert motion.envelope[0] == pytest.approx(1, abs=1e-9)


def test_an_overflow_is_scaled_and_reported():
    system = lumped(ROTOR, 2.0)
    start = initial_conditions(system, 0.0, "knock")
    motion = time_response(system, 3 * CRITICAL, 0.0, 0.5, start, 300, 12)
    assert motion.log_scale > 0
    assert np.isfinite(motion.displacement).all()
    assert np.isfinite(motion.envelope).all()
    total = motion.log_scale + math.log(abs(motion.displacement[-1]))
    assert total == pytest.approx(motion.growth_rate * motion.time[-1], rel=1e-2)
    shorter = time_response(system, 3 * CRITICAL, 0.0, 0.5, start, 20, 12)
    assert shorter.log_scale == 0


def test_start_and_load_are_what_was_asked_for():
    system = lumped(ROTOR, 2.0)
    knock = initial_conditions(system, 1.0, "knock")
    assert (knock[[0, 1, 3]] == 0).all()
    motion = time_response(system, 1.0, 0.5, 1.0, knock, 2, 8)
    assert motion.displacement[0] == pytest.approx(0, abs=1e-14)
    assert motion.time[8] == pytest.approx(motion.period)
    np.testing.assert_allclose(motion.load, 1 + 0.5 * np.cos(motion.time), atol=1e-14)
    noise = [initial_conditions(system, 1.0, "noise", seed) for seed in (1, 1, 2)]
    assert (noise[0] == noise[1]).all()
    assert (noise[0] != noise[2]).all()


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"excitation_frequency": 0.0}, "`excitation_frequency` must be in"),
        ({"periods": 0}, "`periods` must be in"),
        ({"samples_per_period": 3}, "`samples_per_period` must be in"),
        ({"periods": 10**6, "samples_per_period": 100}, "at most"),
        ({"initial": [1.0, 2.0]}, "`initial` must hold 4"),
        ({"initial": [np.nan] * 4}, "`initial` must hold 4"),
        ({"static_load": 30.0, "excitation_frequency": 0.01}, "overflows"),
    ],
)
def test_bad_values_are_refused(values, words):
    good = {"static_load": 1.0, "pulsating_load": 0.1, "excitation_frequency": 1.0}
    system = lumped(ROTOR, 2.0)
    with pytest.raises(ValueError, match=words):
        time_response(system, **({"initial": np.ones(4)} | good | values))
    with pytest.raises(ValueError, match="'mode:1B'"):
        initial_conditions(system, 1.0, "mode:9F")
    with pytest.raises(ValueError, match="one spin speed"):
        initial_conditions(system.at_speed([1.0, 2.0]), 1.0)


def test_the_work_of_a_period_can_be_bounded():
    system = lumped(ROTOR, 2.0)
    start = initial_conditions(system, 1.0)
    few = {"initial": start, "periods": 2, "most_steps": 300}
    with pytest.raises(ValueError, match="more than `most_steps`, 300"):
        time_response(system, 1.0, 0.5, 0.01, **few)
    assert time_response(system, 1.0, 0.5, 1.3, **few).error < 1e-9
    solution = floquet_solution(system, 1.0, 0.5, [0.001, 1.3], most_steps=300)
    assert solution.converged.tolist() == [False, True]


@pytest.mark.parametrize("count", [1, 31, 63, 593, 997, 65_537])
def test_steps_are_made_divisible(count):
    better = divisible(count)
    assert count <= better <= count * 17 / 16
    assert better % (1 << max(0, count.bit_length() - 5)) == 0


@pytest.mark.parametrize("kind", ["mode:1F", "mode:2B", "knock", "noise"])
@pytest.mark.parametrize(("modes", "tip"), [(4, (0, 1)), (None, (-2, -1))])
def test_a_start_is_of_the_tip_wherever_its_coordinates_are(kind, modes, tip):
    system = finite_element(ROTOR, 1.0, elements=6, modes=modes)
    start = initial_conditions(system, 0.5, kind, seed=2, tip=tip)
    displacement, speed = start[tip[0] % system.size], start[system.size + tip[0] % system.size]
    if kind.startswith("mode"):
        assert displacement == pytest.approx(1.0)
    elif kind == "knock":
        assert speed == pytest.approx(fundamental_frequency(system))
        assert not start[: system.size].any()
    else:
        assert 0 < abs(displacement) < 3


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"periods": 2.7}, r"`periods` must be a whole number in \[1, inf\), got 2.7"),
        ({"samples_per_period": 8.5}, r"`samples_per_period` must be a whole number .*got 8.5"),
        ({"most_steps": 1e3 + 0.5}, r"`most_steps` must be a whole number .*got 1000.5"),
        ({"tip": (5, 7)}, r"`tip` must be in \[-2, 1\], got 5"),
        ({"tip": (0, 0.5)}, r"`tip` must be a whole number in \[-2, 1\], got 0.5"),
        ({"tip": (0,)}, r"`tip` must hold two coordinates, got \(0,\)"),
    ],
)
def test_what_is_no_whole_number_or_no_coordinate_is_refused(change, message):
    system = lumped(ROTOR, 1.0)
    start = initial_conditions(system, 0.5)
    with pytest.raises(ValueError, match=message):
        time_response(system, 0.5, 0.1, 2.0, start, **change)


def test_the_seed_and_the_coordinate_of_a_start_are_whole_numbers_too():
    system = lumped(ROTOR, 1.0)
    with pytest.raises(ValueError, match="`seed` must be a whole number"):
        initial_conditions(system, 0.5, "noise", seed=1.5)
    with pytest.raises(ValueError, match=r"`tip` must be in \[-2, 1\], got 2"):
        initial_conditions(system, 0.5, "knock", tip=(2, 1))
    start = initial_conditions(system, 0.5, "noise", seed=np.int64(3))
    assert (start == initial_conditions(system, 0.5, "noise", seed=3)).all()
    motion = time_response(system, 0.5, 0.1, 2.0, start, np.int32(2), 8.0)
    assert motion.time.shape == (17,)
