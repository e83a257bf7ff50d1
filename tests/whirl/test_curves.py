"""Whirl frequencies followed and named over the load and the spin speed."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings

import rotorstab as rs
from rotorstab.whirl.mode_names import mode_names, named_frequencies
from rotorstab.whirl.tracking import track
from tests.testing.strategies import rotors, spin_speeds, tangencies

BASE = rs.BASE_CASE
REFERENCE = 2.3557973  # p̄_cr of the base case


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
        assert np.sort(curves.frequencies[index]) == pytest.approx(single, abs=1e-12)


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
