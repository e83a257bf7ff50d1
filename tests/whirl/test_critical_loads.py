"""Buckling, and flutter of the lumped rotor."""

import numpy as np
import pytest
from hypothesis import given, settings

import rotorstab as rs
from rotorstab.model.stiffness import largest_exact_load
from tests.testing.strategies import rotors, spin_speeds

BASE = rs.BASE_CASE


def test_published_buckling_loads():
    # 2.3557973; the text prints 2.3558. π²/4 is Euler's column
    assert rs.critical_load(0.0192) == pytest.approx(2.3557973, abs=5e-8)
    assert rs.critical_load(0.0) == pytest.approx(np.pi**2 / 4, rel=1e-15)
    assert rs.critical_load([[0.0], [0.0192]]).shape == (2, 1)


@pytest.mark.parametrize("shear", [0.0, 0.0192, 0.1, 0.5])
def test_buckling_is_the_first_zero_of_the_exact_determinant(shear):
    load = float(rs.critical_load(shear))
    loads = np.linspace(0.0, load * (1 - 1e-6), 500)
    assert (np.linalg.det(rs.exact_stiffness(loads, shear)) > 0).all()
    assert np.linalg.det(rs.exact_stiffness(load * (1 + 1e-6), shear)) < 0


@pytest.mark.parametrize(("stiffness", "expected"), [("linear", 6.29010), ("exact", 5.97797)])
def test_published_flutter_loads_at_rest(stiffness, expected):
    # merging roots by a separate program (docs/validation.md): base case at rest, follower load
    system = rs.lumped(BASE, 0.0, tangency=1.0, stiffness=stiffness)
    assert rs.flutter_load(system) == pytest.approx(expected, abs=5.1e-6)


@settings(max_examples=60)
@given(rotor=rotors)
def test_flutter_at_rest_is_the_zero_of_a_discriminant(rotor):
    """At rest ω² solves a quadratic; its discriminant is a quadratic in p̄."""
    system = rs.lumped(rotor, 0.0, tangency=1.0)
    m, inertia = np.diag(system.mass)
    a, b = system.elastic, system.geometric
    trace = np.poly1d([inertia * b[0, 0] + m * b[1, 1], inertia * a[0, 0] + m * a[1, 1]])
    entry = [[np.poly1d([b[i, j], a[i, j]]) for j in range(2)] for i in range(2)]
    determinant = entry[0][0] * entry[1][1] - entry[0][1] * entry[1][0]
    roots = (trace**2 - 4 * m * inertia * determinant).roots
    end = float(largest_exact_load(0.0))
    real = np.sort(roots[np.abs(roots.imag) < 1e-9 * np.abs(roots)].real)
    real = real[(real > 1e-6) & (real < end)]
    found = rs.flutter_load(system)
    if real.size == 2 and np.diff(real)[0] < end / 100:
        return  # a window narrower than the scan's step may be missed
    expected = real[0] if real.size else np.inf
    if trace(expected if np.isfinite(expected) else 0.0) > 0:  # meets at ω² > 0
        assert found == pytest.approx(expected, abs=2e-8, rel=1e-9)


@settings(max_examples=40)
@given(rotor=rotors, speed=spin_speeds)
def test_flutter_is_where_the_spectrum_turns_complex(rotor, speed):
    system = rs.lumped(rotor, speed, tangency=1.0)
    load = rs.flutter_load(system)
    if np.isfinite(load):
        before, after = rs.whirl_frequencies(system, [load - 1e-6, load + 1e-6])
        assert not before.imag.any()
        assert after.imag.any()


def test_no_flutter_of_an_axial_load_at_rest():
    assert rs.flutter_load(rs.lumped(BASE, 0.0)) == np.inf
    assert rs.flutter_load(rs.lumped(BASE, 0.0, tangency=1.0), largest_load=6.0) == np.inf
    assert rs.flutter_load(rs.lumped(BASE, 0.0, 1.0), largest_load=7.0) == pytest.approx(
        6.29010, abs=5.1e-6
    )


def test_spin_makes_an_axially_loaded_rotor_flutter_past_buckling():
    system = rs.lumped(BASE, 1.0)
    load = rs.flutter_load(system)
    assert load > float(rs.critical_load(BASE.shear))
    assert rs.whirl_frequencies(system, load + 1e-4).imag.any()


@pytest.mark.parametrize(
    ("system", "largest", "message"),
    [
        (rs.lumped(BASE, 0.0, external_damping=0.1), None, "`system` must be undamped"),
        (rs.lumped(BASE, [0.0, 1.0]), None, r"`system` must have one spin speed, .*\(2,\)"),
        (rs.lumped(BASE, 0.0), -1.0, r"`largest_load` must be in \(0, inf\), got -1"),
        (rs.lumped(BASE, 0.0), np.nan, r"`largest_load` must be in \(0, inf\), got nan"),
        (rs.lumped(BASE, 0.0), True, r"`largest_load` must be a real number"),
        (rs.lumped(BASE, 0.0, stiffness="exact"), 50.0, "`load` must be below the pole"),
    ],
)
def test_bad_arguments_are_named(system, largest, message):
    with pytest.raises(ValueError, match=message):
        rs.flutter_load(system, largest)


@pytest.mark.parametrize("bad", [1.0, -1e-3, np.nan, "0", 1j, False])
def test_buckling_refuses_a_bad_shear(bad):
    with pytest.raises(ValueError, match=r"`shear` must be (a real number )?in \[0, 1\), got"):
        rs.critical_load(bad)
