"""Whirl frequencies, curves followed by continuity, and critical speeds."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.linalg import block_diag

import rotorstab as rs
from rotorstab.whirl.mode_names import mode_names, named_frequencies
from rotorstab.whirl.tracking import track
from tests.testing.strategies import between, rotors, spin_speeds, tangencies

BASE = rs.BASE_CASE
REFERENCE = 2.3557973  # p̄_cr of the base case


def spectrum_of_the_first_order_matrix(system, load, speed):
    """ω of M q̈ + D q̇ + K q = 0 at one point, the plain way."""
    system = system.at_speed(speed)
    inverse = np.linalg.inv(system.mass)
    matrix = np.block(
        [
            [np.zeros((2, 2)), np.eye(2)],
            [-inverse @ system.stiffness(load), -inverse @ system.damping()],
        ]
    )
    return np.sort_complex(np.linalg.eigvals(matrix) / 1j)


def distance(a, b):
    """Largest distance of a root of `a` from the nearest of `b`, the last axis."""
    return np.abs(a[..., :, None] - b[..., None, :]).min(axis=-1).max(initial=0.0)


@pytest.mark.parametrize(
    ("speed", "tangency", "load", "expected"),
    [
        # theory notes §4, from the paper's base case (Figs 6–8)
        (0.0, 0.0, 0.0, [-2.41457, -0.64669, 0.64669, 2.41457]),
        (1.0, 0.0, 0.0, [-1.93485, -0.40411, 0.90922, 3.42974]),
        (2.0, 0.0, 0.0, [-1.73338, -0.26610, 1.07302, 4.92646]),
        (2.0, 0.0, 0.5 * REFERENCE, [-1.66431, -0.15786, 0.92652, 4.89565]),
        (2.0, 1.0, 0.5 * REFERENCE, [-1.60497, -0.31956, 1.03969, 4.88484]),
    ],
)
def test_published_whirl_frequencies(speed, tangency, load, expected):
    found = rs.whirl_frequencies(rs.lumped(BASE, speed, tangency), load)
    assert found.real == pytest.approx(expected, abs=5.1e-6)
    assert not found.imag.any()


def test_the_text_on_1f_under_follower_load():
    # Fig. 8(b): the text says 1F rises at Ω̄ = 2; the model gives a fall, and a rise at Ω̄ = 1
    at_two = rs.whirl_frequencies(rs.lumped(BASE, 2.0, 1.0), [0.0, 2.3558]).real[:, 2]
    assert at_two == pytest.approx([1.0730, 1.0084], abs=5e-5)
    at_one = rs.whirl_frequencies(rs.lumped(BASE, 1.0, 1.0), [0.0, 2.3558]).real[:, 2]
    assert at_one[1] > at_one[0]


@pytest.mark.parametrize("stiffness", ["linear", "exact"])
@settings(max_examples=60)
@given(rotor=rotors, speed=between(-4.0, 4.0), tangency=tangencies, load=between(-5.0, 6.0))
def test_quartic_path_equals_eigenvalues(stiffness, rotor, speed, tangency, load):
    system = rs.lumped(rotor, speed, tangency, stiffness=stiffness)
    found = rs.whirl_frequencies(system, load)
    by_matrix = spectrum_of_the_first_order_matrix(system, load, speed)
    # a double root is known to half the digits
    assert distance(found, by_matrix) < 1e-6 * np.abs(found).max()
    gaps = np.abs(np.subtract.outer(found, found) + 1e9 * np.eye(4)).min()
    if gaps > 1e-2 * np.abs(found).max():
        assert distance(found, by_matrix) < 1e-11 * np.abs(found).max()


@given(rotor=rotors, speed=between(0.0, 4.0), tangency=tangencies, load=between(-5.0, 6.0))
def test_opposite_spin_mirrors_the_spectrum(rotor, speed, tangency, load):
    there = rs.whirl_frequencies(rs.lumped(rotor, speed, tangency), load)
    back = rs.whirl_frequencies(rs.lumped(rotor, -speed, tangency), load)
    assert distance(-there, back) < 1e-7 * np.abs(there).max()


@given(rotor=rotors, speed=between(-4.0, 4.0), tangency=tangencies)
def test_vector_call_equals_scalar_loop(rotor, speed, tangency):
    loads, speeds = np.linspace(-2.0, 1.5, 5), np.array([[0.0], [speed], [1.0]])
    found = rs.whirl_frequencies(rs.lumped(rotor, speeds, tangency), loads)
    assert found.shape == (3, 5, 4)
    for i, j in np.ndindex(3, 5):
        single = rs.whirl_frequencies(rs.lumped(rotor, speeds[i, 0], tangency), loads[j])
        assert distance(found[i, j], single) < 1e-9 * np.abs(single).max()


@given(rotor=rotors, speed=between(-4.0, 4.0), tangency=tangencies, load=between(-5.0, 6.0))
def test_a_coordinate_of_its_own_adds_its_frequencies_and_changes_no_other(
    rotor, speed, tangency, load
):
    """Three coordinates are solved by eigenvalues, two by a quartic."""
    system = rs.lumped(rotor, speed, tangency)
    names = ("mass", "gyroscopic", "external_damping", "internal_damping", "elastic", "geometric")
    single = {"mass": 1.0, "elastic": 400.0}
    wider = replace(
        system,
        **{name: block_diag(getattr(system, name), single.get(name, 0.0)) for name in names},
    )
    found = rs.whirl_frequencies(wider, load)
    expected = np.append(rs.whirl_frequencies(system, load), [-20.0, 20.0])
    # a double root is known to half the digits
    assert distance(found, expected) < 1e-6 * np.abs(expected).max()
    assert distance(expected, found) < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("damping", [{}, {"external_damping": 0.02}, {"internal_damping": 0.02}])
def test_damped_frequencies_satisfy_the_determinant(damping):
    system = rs.lumped(BASE, 2.0, 1.0, **damping)
    for omega in rs.whirl_frequencies(system, 1.0):
        matrix = system.stiffness(1.0) + 1j * omega * system.damping() - omega**2 * system.mass
        assert abs(np.linalg.det(matrix)) < 1e-10


def test_external_damping_damps_and_internal_damping_does_so_below_a_threshold_speed():
    external = rs.whirl_frequencies(rs.lumped(BASE, 0.0, external_damping=0.01), 0.0)
    assert (external.imag > 0).all()
    # at rest the first mode's ratio is ζ: Im ω = ζ_e ω_n
    assert external.imag.min() == pytest.approx(0.01 * 0.6466913, rel=1e-6)
    speeds = np.array([0.3, 3.0])
    internal = rs.whirl_frequencies(rs.lumped(BASE, speeds, internal_damping=0.01), 0.0)
    first_forward = internal[:, 2]
    # rotating damping drives a forward whirl that is slower than the spin
    assert first_forward.real[0] > speeds[0]
    assert first_forward.imag[0] > 0
    assert first_forward.real[1] < speeds[1]
    assert first_forward.imag[1] < 0


# curves


def assert_continuous(curves):
    """No other pairing of two neighbouring rows is shorter, and jumps go as a square root."""
    frequencies = curves.frequencies / np.abs(curves.frequencies).max()
    before, after = frequencies[:-1], frequencies[1:]
    orders = np.array(list(itertools.permutations(range(4))))
    cost = (np.abs(after[:, orders] - before[:, None]) ** 2).sum(axis=2)
    assert (cost[:, 0] <= cost.min(axis=1) + 1e-13).all()
    fraction = np.diff(curves.parameter) / np.ptp(curves.parameter)
    assert (np.abs(after - before) < 8 * np.sqrt(fraction)[:, None]).all()


@pytest.mark.parametrize("tangency", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("speed", [0.0, 0.05, 0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("stiffness", ["linear", "exact"])
def test_load_curves_pass_buckling_and_flutter_without_jumps(speed, tangency, stiffness):
    system = rs.lumped(BASE, speed, tangency, stiffness=stiffness)
    loads = np.linspace(-2.0, 10.0, 1201)
    curves = rs.load_frequency_curves(system, loads)
    assert curves.names == ("2B", "1B", "1F", "2F")
    assert_continuous(curves)
    at_rest_load = curves.frequencies[200]
    assert (np.diff(at_rest_load.real) > 0).all()  # names hold where p̄ = 0
    sorted_rows = rs.whirl_frequencies(system, loads)
    assert (np.sort(curves.frequencies) == sorted_rows).all()


@settings(max_examples=40)
@given(rotor=rotors, speed=spin_speeds, tangency=tangencies)
def test_curves_of_random_rotors_are_continuous(rotor, speed, tangency):
    curves = rs.load_frequency_curves(rs.lumped(rotor, speed, tangency), np.linspace(0, 12, 4001))
    assert_continuous(curves)


@pytest.mark.parametrize("load", [0.0, 1.2, 3.0])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_campbell_diagram(load, tangency):
    speeds = np.linspace(0.0, 4.0, 801)
    system = rs.lumped(BASE, 123.0, tangency)
    curves = rs.campbell_diagram(system, speeds, load)
    assert_continuous(curves)
    for index in (0, 400, 800):
        single = rs.whirl_frequencies(rs.lumped(BASE, speeds[index], tangency), load)
        assert distance(curves.frequencies[index], single) < 1e-12


def test_a_complex_pair_that_passes_a_real_root_keeps_its_columns():
    x = np.linspace(-1, 1, 41)
    pair = x + 0.3j
    rows = np.sort(np.stack([np.full(41, -2.0), 0 * x + 0j, pair, pair.conj()], axis=1), axis=1)
    for start in (0, 40):
        tracked = track(rows, start)
        assert (tracked[start] == rows[start]).all()
        assert np.abs(np.diff(tracked, axis=0)).max() < 0.11
        assert (np.ptp(tracked.imag, axis=0) < 1e-12).all()


def test_names():
    assert mode_names(3) == ("3B", "2B", "1B", "1F", "2F", "3F")
    frequencies = rs.whirl_frequencies(rs.lumped(BASE, 1.0), 0.0).real
    assert [name[1] for name in mode_names(2)] == ["B" if w < 0 else "F" for w in frequencies]


# critical speeds


@settings(max_examples=60)
@given(rotor=rotors, load=between(-3.0, 1.9), tangency=tangencies)
def test_critical_speeds_are_synchronous_whirls(rotor, load, tangency):
    system = rs.lumped(rotor, 0.0, tangency)
    speeds = rs.critical_speeds(system, load)
    for sign, values in ((1, speeds.forward), (-1, speeds.backward)):
        assert (np.diff(values) >= 0).all()
        for speed in values:
            whirl = rs.whirl_frequencies(system.at_speed(speed), load)
            assert np.abs(whirl - sign * speed).min() < 1e-6 * np.abs(whirl).max()
            stiffness = system.stiffness(load)
            matrix = stiffness - speed**2 * (system.mass - sign * system.gyroscopic)
            scale = np.abs(stiffness).max() * max(np.abs(matrix).max(), np.abs(stiffness).max())
            assert abs(np.linalg.det(matrix)) < 1e-9 * scale


def test_number_of_critical_speeds():
    # a thin disk, Ī_P = 2 Ī_D > Ī_D, has no second forward critical speed
    speeds = rs.critical_speeds(rs.lumped(BASE, 0.0))
    assert (speeds.forward.size, speeds.backward.size) == (1, 2)
    long_disk = rs.lumped(rs.ShaftDisk(polar_inertia=0.4), 0.0)
    assert rs.critical_speeds(long_disk).forward.size == 2
    sphere = rs.lumped(rs.ShaftDisk(polar_inertia=0.8), 0.0)  # M − H is singular
    assert rs.critical_speeds(sphere).forward.size == 1
    without_gyroscopics = rs.critical_speeds(rs.lumped(rs.ShaftDisk(polar_inertia=0.0), 0.0))
    assert without_gyroscopics.forward == pytest.approx([0.64669, 2.41457], abs=5e-6)
    assert without_gyroscopics.backward == pytest.approx(without_gyroscopics.forward)


def test_critical_speeds_at_and_past_buckling():
    load = float(rs.critical_load(0.0))
    exact = rs.lumped(rs.EULER_BERNOULLI_TWIN, 0.0, stiffness="exact")
    for value in (load, 1.2 * load):
        speeds = rs.critical_speeds(exact, value)
        assert np.isfinite(speeds.forward).all()
        assert np.isfinite(speeds.backward).all()
    assert rs.critical_speeds(exact, 1.2 * load).backward.size == 1


# shapes and errors


def test_empty_input_gives_empty_output():
    system = rs.lumped(BASE, 1.0)
    assert rs.whirl_frequencies(system, []).shape == (0, 4)
    assert rs.whirl_frequencies(rs.lumped(BASE, []), 1.0).shape == (0, 4)
    assert rs.whirl_frequencies(rs.lumped(BASE, [], external_damping=0.1), 1.0).shape == (0, 4)
    exact = rs.lumped(BASE, 1.0, stiffness="exact")
    assert rs.whirl_frequencies(exact, []).shape == (0, 4)
    assert rs.load_frequency_curves(system, []).frequencies.shape == (0, 4)
    assert rs.campbell_diagram(system, []).frequencies.shape == (0, 4)


@pytest.mark.parametrize("bad", [np.nan, np.inf, True, "1", 1j, None, [1.0, "a"]])
def test_bad_loads_are_refused(bad):
    system = rs.lumped(BASE, 1.0)
    message = r"`{}` must be (a real number )?in (\(-inf, inf\)|\[-1e\+09, 1e\+09\]), got"
    with pytest.raises(ValueError, match=message.format("load")):
        rs.whirl_frequencies(system, bad)
    with pytest.raises(ValueError, match=message.format("loads")):
        rs.load_frequency_curves(system, bad)
    with pytest.raises(ValueError, match=message.format("spin_speeds")):
        rs.campbell_diagram(system, bad)
    with pytest.raises(ValueError, match=message.format("load")):
        rs.campbell_diagram(system, [0.0, 1.0], bad)
    with pytest.raises(ValueError, match=message.format("load")):
        rs.critical_speeds(system, bad)


def test_shapes_that_make_no_curve_are_refused():
    with pytest.raises(ValueError, match=r"`loads` must be one-dimensional, .*\(2, 1\)"):
        rs.load_frequency_curves(rs.lumped(BASE, 1.0), [[0.0], [1.0]])
    with pytest.raises(ValueError, match=r"`spin_speeds` must be one-dimensional, .*\(\)"):
        rs.campbell_diagram(rs.lumped(BASE, 1.0), 1.0)
    with pytest.raises(ValueError, match=r"`system` must have one spin speed, .*\(3,\)"):
        rs.load_frequency_curves(rs.lumped(BASE, [0.0, 1.0, 2.0]), [0.0, 1.0])
    with pytest.raises(ValueError, match=r"`load` must be a single number, .*\(2,\)"):
        rs.critical_speeds(rs.lumped(BASE, 1.0), [0.0, 1.0])
    with pytest.raises(ValueError, match="`load` must be below the pole of the exact stiffness"):
        rs.whirl_frequencies(rs.lumped(BASE, 1.0, stiffness="exact"), 40.0)


def damped_by_elements(speed):
    return rs.finite_element(BASE, speed, 0.0, 20, 4, 0.05, 0.1)


def test_overdamped_modes_do_not_take_the_names_of_the_slow_ones():
    # the third and fourth modes are overdamped: their Re ω lies among those of the first two
    load, names = 0.5 * REFERENCE, mode_names(4)
    found = dict(zip(names, named_frequencies(damped_by_elements(4.0), load), strict=True))
    undamped = rs.whirl_frequencies(rs.finite_element(BASE, 4.0, 0.0, 20, 4), load).real
    bare = dict(zip(names, undamped, strict=True))
    for name in ("2B", "1B", "1F", "2F"):
        assert abs(found[name].real - bare[name]) < 0.2
    curves = rs.campbell_diagram(damped_by_elements(0.0), np.linspace(0, 4, 200), load)
    assert curves.frequencies[-1] == pytest.approx([found[name] for name in names], abs=1e-9)
    table = rs.resonances(damped_by_elements(4.0), load, 0.1)
    for name, one in zip(table.modes, table.frequencies, strict=True):
        assert one == pytest.approx(found[name], abs=1e-6)


def test_curves_of_damped_modes_carry_one_name_over_spin_and_load():
    for external, internal in [(0.05, 0.0), (0.02, 0.1), (0.2, 0.2)]:
        system = rs.lumped(BASE, 2.0, 1.0, external, internal)
        spun = rs.campbell_diagram(system, np.linspace(0, 4, 201), 1.0).frequencies[100]
        loaded = rs.load_frequency_curves(system, np.linspace(-1, 1, 201)).frequencies[-1]
        named = named_frequencies(system, 1.0)
        assert spun == pytest.approx(named, abs=1e-9)
        assert loaded == pytest.approx(named, abs=1e-9)


def test_rounding_is_no_frequency():
    rotor = rs.ShaftDisk(shear=0.1, disk_mass=0.5, diametral_inertia=0.01, polar_inertia=6.0)
    found = named_frequencies(rs.lumped(rotor, 0.0, 0.0, 0.2, 0.2, stiffness="exact"), 1.8)
    assert not found.real.any()
    assert (found.imag > 0).all()
