"""Whirl frequencies against published values, the determinant and eigenvalues."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.linalg import block_diag

import rotorstab as rs
from tests.testing.strategies import between, rotors, tangencies

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
        # a separate solution of the quartic (docs/validation.md) for the base case of Figs 6–8
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
