"""Periodic loads: Fourier coefficients, fits to samples and files, and what every analysis makes
of them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rotorstab as rs
from rotorstab import PeriodicLoad
from tests.testing.example_rotors import reference_growth

coefficients = st.lists(st.floats(-2.0, 2.0, allow_subnormal=False), min_size=1, max_size=5)


def test_a_cosine_is_the_default():
    assert PeriodicLoad() == rs.lumped(rs.ShaftDisk(), 1.0).pulsation
    phase = np.linspace(0, 7, 50)
    np.testing.assert_array_equal(PeriodicLoad().at(phase), np.cos(phase))


@given(coefficients, coefficients)
def test_at_is_the_fourier_series(cosine, sine):
    if not any(cosine) and not any(sine):
        return
    load = PeriodicLoad(cosine, sine)
    phase = np.linspace(-3, 9, 40)
    expected = sum(c * np.cos(k * phase) for k, c in enumerate(cosine, 1))
    expected = expected + sum(s * np.sin(k * phase) for k, s in enumerate(sine, 1))
    np.testing.assert_allclose(load.at(phase), expected, atol=1e-12)
    amplitudes = np.array(load.amplitudes)
    turning = np.exp(1j * np.outer(phase, np.arange(1, len(amplitudes) + 1)))
    np.testing.assert_allclose((turning @ amplitudes).real, expected, atol=1e-12)
    assert load.largest <= sum(map(abs, amplitudes)) + 1e-12
    assert np.abs(expected).max() <= load.largest * (1 + 1e-3) + 1e-12
    if load.is_even:
        np.testing.assert_allclose(load.at(-phase), load.at(phase), atol=1e-12)
    if load.is_antiperiodic:
        np.testing.assert_allclose(load.at(phase + np.pi), -load.at(phase), atol=1e-11)


@given(coefficients, coefficients, st.floats(-5, 5), st.floats(0.1, 9))
def test_samples_give_back_the_series(cosine, sine, mean, scale):
    if max(map(abs, cosine + sine)) < 0.1:
        return
    load = PeriodicLoad(cosine, sine)
    phase = 2 * np.pi * np.arange(16) / 16
    fit = PeriodicLoad.from_samples(mean + scale * load.at(phase))
    assert fit.static_load == pytest.approx(mean, abs=1e-9)
    assert fit.residual < 1e-9
    again = fit.pulsating_load * fit.shape.at(phase + 0.1)
    np.testing.assert_allclose(again, scale * load.at(phase + 0.1), atol=1e-8)
    assert max(map(abs, fit.shape.amplitudes)) == pytest.approx(1.0)


def test_a_history_of_several_periods_is_fitted_with_its_residual(tmp_path):
    time = np.linspace(0.0, 7.3, 400)
    force = 50.0 + 20 * np.cos(2 * np.pi * time / 2.5) + 6 * np.sin(6 * np.pi * time / 2.5)
    file = tmp_path / "load.csv"
    rows = "\n".join(f"{t},{f}" for t, f in zip(time, force, strict=True))
    file.write_text("time [s],load [N]\n" + rows + "\n")
    fit = PeriodicLoad.from_csv(file, period=2.5, harmonics=3)
    assert (fit.static_load, fit.pulsating_load) == pytest.approx((50.0, 20.0))
    assert fit.shape.harmonics == (1, 3)
    assert fit.residual < 1e-9
    # without the third harmonic its share of the variation is left out
    poor = PeriodicLoad.from_csv(file, period=2.5, harmonics=2)
    assert poor.residual == pytest.approx(6 / np.hypot(20, 6), rel=0.05)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PeriodicLoad([0.0]), "must not both be zero"),
        (lambda: PeriodicLoad([np.nan]), "`cosine` must be in"),
        (lambda: PeriodicLoad(np.ones(65)), "at most 64 numbers"),
        (lambda: PeriodicLoad.from_samples([1.0, 2.0]), "3 numbers or more"),
        (lambda: PeriodicLoad.from_samples([1.0, 1.0, 1.0, 1.0]), "must vary with the period"),
        (lambda: PeriodicLoad.from_samples([1.0, 2.0, 4.0, 0.0], harmonics=2), "`harmonics`"),
        (lambda: PeriodicLoad.from_history([0, 1], [1.0, 2.0, 3.0], 1.0), "one length"),
        (lambda: PeriodicLoad.from_history([0, 1], [1.0, 2.0], 0.0), "`period`"),
        (lambda: PeriodicLoad.from_history([0, 1, 2], [1.0, 2, 3], 1.0), "determine them"),
    ],
)
def test_what_is_no_load_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_bad_line_of_a_file_is_named(tmp_path):
    file = tmp_path / "load.csv"
    file.write_text("t;p\n0;1\n1;two\n2;3\n")
    with pytest.raises(ValueError, match="line 3"):
        PeriodicLoad.from_csv(file, 1.0)
    file.write_text("nothing\n")
    with pytest.raises(ValueError, match="lines of two numbers"):
        PeriodicLoad.from_csv(file, 1.0)


def test_the_exact_stiffness_takes_a_cosine_only():
    system = rs.lumped(rs.ShaftDisk(), 1.0, stiffness="exact")
    with pytest.raises(ValueError, match="`pulsation` must be a cosine"):
        replace(system, pulsation=PeriodicLoad([1.0, 0.5]))


SHAPES = {
    "even": PeriodicLoad([1.0, 0.5, 0.0, 0.3]),
    "second harmonic": PeriodicLoad([0.0, 1.0]),
    "uneven": PeriodicLoad([1.0, 0.2], [0.5, -0.3, 0.2]),
}


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("options", [{}, {"external_damping": 0.01}, {"tangency": 1.0}], ids=str)
def test_growth_of_points_and_maps_is_that_of_an_integrator(shape, options):
    system = rs.lumped(rs.ShaftDisk(), 2.0, **options)
    system = replace(system, pulsation=SHAPES[shape])
    theta = np.array([0.6, 1.3, 2.7])
    expected = [reference_growth(system, 1.0, 0.5, one, tolerance=1e-10) for one in theta]
    points = rs.growth_rate(system, 1.0, 0.5, theta)
    np.testing.assert_allclose(points, expected, atol=1e-8)
    chart = rs.stability_map(system, 1.0, np.array([0.25, 0.5]), theta)
    np.testing.assert_allclose(np.asarray(chart)[1], points, atol=1e-6)


def test_maps_of_many_coordinates_take_it_too():
    system = rs.finite_element(rs.ShaftDisk(), 1.0, elements=4, modes=3, external_damping=0.01)
    system = replace(system, pulsation=SHAPES["uneven"])
    theta = np.array([0.9, 1.05, 2.1])
    chart = rs.stability_map(system, 1.0, np.array([0.2, 0.4]), theta)
    points = rs.growth_rate(system, 1.0, np.array([[0.2], [0.4]]), theta)
    np.testing.assert_allclose(np.asarray(chart), points, atol=2e-5)


def test_each_harmonic_has_its_resonances():
    cosine = rs.lumped(rs.ShaftDisk(), 1.0)
    system = replace(cosine, pulsation=PeriodicLoad([1.0, 0.4], [0.0, 0.3]))
    table, plain = rs.resonances(system, 1.0, 0.05), rs.resonances(cosine, 1.0, 0.05)
    first, second = table["1B+1F"], table["(1B+1F)/2"]
    assert first.centre == plain["1B+1F"].centre
    assert second.centre == pytest.approx(first.centre / 2)
    # |a₂| = 0.5
    assert second.growth == pytest.approx(first.growth / 2)
    assert second.half_width == pytest.approx(first.half_width / 4)
    for row in (first, second):
        found = rs.growth_rate(system, 1.0, 0.02, row.centre)
        assert found == pytest.approx(row.growth * 0.02 / 0.05, rel=0.05)
    edges = rs.tongue_edges(system, 1.0, [0.02], ("1B+1F",))
    region = next(
        region
        for region in rs.first_order_regions(rs.resonances(system, 1.0, 0.02), 0.02)
        if region.name == "1B+1F"
    )
    assert edges.right[0, 0] - edges.left[0, 0] == pytest.approx(region.width, rel=0.02)


def test_a_response_follows_its_load():
    system = replace(rs.lumped(rs.ShaftDisk(), 1.0), pulsation=SHAPES["uneven"])
    start = rs.initial_conditions(system, 1.0)
    motion = rs.time_response(system, 1.0, 0.3, 1.3, start, periods=3)
    np.testing.assert_allclose(motion.load, 1.0 + 0.3 * system.pulsation.at(1.3 * motion.time))
    assert motion.growth_rate == pytest.approx(
        max(float(rs.growth_rate(system, 1.0, 0.3, 1.3)), 0.0), abs=1e-9
    )


def test_bolotins_first_approximation_sees_the_first_harmonic_only():
    cosine = rs.lumped(rs.ShaftDisk(), 1.0)
    turned = replace(cosine, pulsation=PeriodicLoad([0.6, 0.5], [0.8]))
    np.testing.assert_allclose(
        rs.boundary_frequencies(turned, 1.0, 0.3), rs.boundary_frequencies(cosine, 1.0, 0.3)
    )
    with pytest.raises(ValueError, match="even pulsation"):
        rs.hill_boundary_frequencies(turned, 1.0, 0.3)
