"""Bolotin's boundary frequencies and the sign of Eq. (24)."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rotorstab as rs
from rotorstab.model.stiffness import largest_exact_load
from tests.testing.strategies import between, rotors, spin_speeds, tangencies

BASE = rs.BASE_CASE
REFERENCE = float(rs.critical_load(BASE.shear))
NATURAL = rs.fundamental_frequency(rs.lumped(BASE, 0.0))


def polynomial_24(system, static, pulsating):
    """Eq. (24) in λ by multiplying polynomials, as the paper writes it."""
    mass, inertia = np.diag(system.mass)
    gyroscopic = (float(system.spin_speed) * system.gyroscopic[1, 1]) ** 2
    determinants, first = [], []
    for sign in (-1, 1):
        k = system.elastic + (static + sign * pulsating / 2) * system.geometric
        determinant = k[0, 0] * k[1, 1] - k[0, 1] * k[1, 0]
        determinants.append([mass * inertia, -mass * k[1, 1] - inertia * k[0, 0], determinant])
        first.append([-mass, k[0, 0]])
    coupling = np.polymul([gyroscopic, 0.0], np.polymul(*first))
    return np.polysub(np.polymul(*determinants), coupling)


@pytest.mark.parametrize(
    ("speed", "static_factor", "factor", "expected"),
    [
        # θ/ω_n of a separate solution of Eq. (24) (docs/validation.md): axial load, base case
        (0.0, 0.0, 0.5, [1.73774, 2.23094]),
        (0.0, 0.0, 1.0, [1.42699, 2.43947]),
        (0.0, 0.5, 0.0, [1.42699, 1.42699]),
        (0.0, 0.5, 0.5, [1.02453, 1.73774]),
        (2.0, 0.5, 0.0, [0.48821, 2.86540]),
        (2.0, 0.5, 0.5, [0.42637, 2.86513]),
    ],
)
def test_published_boundaries(speed, static_factor, factor, expected):
    found = rs.boundary_frequencies(
        rs.lumped(BASE, speed), static_factor * REFERENCE, factor * REFERENCE
    )
    assert found[:2] / NATURAL == pytest.approx(expected, abs=5.1e-6)


@settings(max_examples=80)
@given(
    rotor=rotors,
    speed=between(-4.0, 4.0),
    tangency=tangencies,
    static=between(0.0, 2.5),
    pulsating=between(-4.0, 4.0),
)
def test_boundaries_are_the_roots_of_eq_24(rotor, speed, tangency, static, pulsating):
    system = rs.lumped(rotor, speed, tangency)
    polynomial = polynomial_24(system, static, pulsating)
    frequencies = rs.boundary_frequencies(system, static, pulsating)
    values = (frequencies[np.isfinite(frequencies)] / 2) ** 2
    terms = np.abs(polynomial) * values[:, None] ** np.arange(4, -1, -1)
    residual = np.polyval(polynomial, values)
    # a double root may be off by 1e-7 of itself
    assert (np.abs(residual) <= 1e-10 * terms.sum(axis=1)).all()
    assert (np.diff(frequencies[np.isfinite(frequencies)]) >= 0).all()
    simple = np.roots(polynomial)
    gap = np.abs(np.subtract.outer(simple, simple) + 1e9 * np.eye(4)).min()
    assume(gap > 1e-3 * np.abs(simple).max())
    expected = np.sort(simple[(simple.imag == 0) & (simple.real > 0)].real)
    assert values == pytest.approx(expected, rel=1e-8)


@given(rotor=rotors, speed=spin_speeds, tangency=tangencies, static=between(0.0, 1.0))
def test_without_pulsation_boundaries_are_twice_the_whirl_frequencies(
    rotor, speed, tangency, static
):
    system = rs.lumped(rotor, speed, tangency)
    whirl = np.sort(2 * np.abs(rs.whirl_frequencies(system, static).real))
    assert rs.boundary_frequencies(system, static, 0.0) == pytest.approx(whirl, rel=1e-7)


@pytest.mark.parametrize("stiffness", ["linear", "exact"])
@settings(max_examples=60)
@given(
    rotor=rotors, speed=spin_speeds, tangency=tangencies, static=between(0, 2), load=between(0, 3)
)
def test_signs_of_pulsation_and_spin_do_not_matter(stiffness, rotor, speed, tangency, static, load):
    system = rs.lumped(rotor, speed, tangency, stiffness=stiffness)
    assume(stiffness == "linear" or static + load < 0.95 * largest_exact_load(rotor.shear))
    there = rs.boundary_frequencies(system, static, load)
    for other in (
        rs.boundary_frequencies(system, static, -load),
        rs.boundary_frequencies(system.at_speed(-speed), static, load),
    ):
        assert other == pytest.approx(there, rel=1e-6, nan_ok=True)


@given(rotor=rotors, speed=between(-3.0, 3.0), tangency=tangencies)
def test_vector_call_equals_scalar_loop(rotor, speed, tangency):
    speeds, static = np.array([[[0.0]], [[speed]]]), np.array([[0.3], [1.4]])
    loads = np.array([0.0, 0.4, 2.0])
    found = rs.boundary_frequencies(rs.lumped(rotor, speeds, tangency), static, loads)
    assert found.shape == (2, 2, 3, 4)
    for i, j, k in np.ndindex(2, 2, 3):
        system = rs.lumped(rotor, speeds[i, 0, 0], tangency)
        single = rs.boundary_frequencies(system, static[j, 0], loads[k])
        assert found[i, j, k] == pytest.approx(single, rel=1e-7, nan_ok=True)


@settings(max_examples=60)
@given(
    rotor=rotors,
    speed=spin_speeds,
    tangency=tangencies,
    static=between(0.0, 2.0),
    load=between(0.0, 3.0),
)
def test_boundaries_do_not_depend_on_the_coordinates(rotor, speed, tangency, static, load):
    """In skew coordinates Eq. (24) is solved by eigenvalues, not as a quartic."""
    system = rs.lumped(rotor, speed, tangency)
    basis = np.array([[0.8, 0.3], [-0.5, 1.1]])
    skew = system.projected(basis)
    squares = rs.boundary_frequencies(system, static, load) ** 2
    by_eigenvalues = rs.boundary_frequencies(skew, static, load) ** 2
    # a double root is known to half the digits, and may be real for the one and not for the other
    gap = np.abs(np.diff(squares)).min(initial=np.inf)
    assume(gap > 1e-6 * np.nanmax(squares, initial=0.0))
    assert by_eigenvalues == pytest.approx(
        squares, abs=1e-7 * np.nanmax(squares, initial=0.0), nan_ok=True
    )


def damped_sigma(system, static, load, s):
    """Smallest singular value of Eq. (24)'s matrix with the full damping, at θ = 2s."""
    mean, first = system.load_harmonics(static, load)
    k = [mean - first / 2 - s * s * system.mass, mean + first / 2 - s * s * system.mass]
    coupling = s * system.damping()
    matrix = np.block([[k[0], -coupling], [coupling, k[1]]])
    return np.linalg.svd(matrix, compute_uv=False)[-1]


def test_a_damped_rotor_at_rest_has_boundaries_and_one_that_spins_has_none():
    at_rest = rs.lumped(BASE, 0.0, external_damping=0.01)
    found = rs.boundary_frequencies(at_rest, 0.0, 0.5 * REFERENCE)
    assert np.isfinite(found).any()
    for theta in found[np.isfinite(found)]:
        assert damped_sigma(at_rest, 0.0, 0.5 * REFERENCE, theta / 2) < 1e-9
    spinning = rs.lumped(BASE, 1.0, external_damping=0.01)
    assert np.isnan(rs.boundary_frequencies(spinning, 0.0, 0.5 * REFERENCE)).all()
    chart = rs.bolotin_chart(spinning, 0.0, REFERENCE)
    assert np.isnan(chart.frequency).all()
    assert chart.regions == ()


@settings(max_examples=60)
@given(
    rotor=rotors,
    speed=spin_speeds,
    tangency=tangencies,
    static=between(0.0, 2.5),
    load=between(0.0, 4.0),
    data=st.data(),
)
def test_region_is_the_sign_of_eq_24(rotor, speed, tangency, static, load, data):
    system = rs.lumped(rotor, speed, tangency)
    polynomial = polynomial_24(system, static, load)
    theta = data.draw(between(0.0, 10.0))
    terms = polynomial * (theta**2 / 4) ** np.arange(4, -1, -1)
    assume(abs(terms.sum()) > 1e-9 * np.abs(terms).sum())
    assert bool(rs.in_bolotin_region(system, static, load, theta)) == (terms.sum() < 0)
