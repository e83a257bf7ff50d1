"""Exact and linear stiffness against the shaft's own differential equations."""

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.linalg import expm

import rotorstab as rs
from rotorstab.model.stiffness import largest_exact_load
from tests.testing.strategies import between, shears, tangencies

SHEAR = 0.0192  # the paper's base case


def stiffness_of_the_equations(load, shear, tangency):
    """K from (A4), (A5) with the end conditions (A6)–(A9), by a matrix exponential.

    States v, γ, M = γ′ and the transverse force N = (1/Φ − p̄)v′ − γ/Φ, which is constant.
    """
    slope = 1 / (1 - shear * load)  # v′ = (ΦN + γ)/(1 − Φp̄)
    first_order = np.array(
        [
            [0, slope, 0, shear * slope],
            [0, 0, 1, 0],
            [0, -load * slope, 0, -slope],  # (A4): γ″ = (γ − v′)/Φ
            [0, 0, 0, 0],
        ]
    )
    tip = expm(first_order)[:, 2:]  # clamped root: only M(0) and N are free
    # (A8), (A9): the force is N + μp̄γ, the moment is M
    forces = np.array([tip[3] + tangency * load * tip[1], tip[2]])
    return forces @ np.linalg.inv(tip[:2])


def appendix_a(load, shear, tangency):
    """K from the printed flexibilities, misprints corrected, for p̄ > 0 in extended precision."""
    p, phi = np.longdouble(load), np.longdouble(shear)
    k = np.sqrt(p / (1 - phi * p))
    sin, cos = np.sin(k), np.cos(k)
    if tangency == 0:  # (A11)–(A14)
        c11, c12, c22 = -1 / p + k * sin / (p**2 * cos), (1 - cos) / (p * cos), sin / (k * cos)
        c21 = c12
    else:  # (A16)–(A19)
        c11, c21 = k * sin / p**2 - cos / p, (1 - cos) / p
        c12 = -1 / p + cos / p + k * (1 - phi * p) * sin / p
        c22 = k * (1 - phi * p) * sin / p
    determinant = c11 * c22 - c12 * c21
    return np.array([[c22, -c12], [-c21, c11]], float) / float(determinant)  # (A21)–(A25)


@pytest.mark.parametrize("tangency", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("shear", [0.0, 1e-4, SHEAR, 0.1, 0.5])
@pytest.mark.parametrize("load", [-30.0, -2.1, -1.9, -1e-3, 0.0, 1e-8, 0.5, 1.7, 1.8])
def test_exact_stiffness_solves_the_differential_equations(load, shear, tangency):
    expected = stiffness_of_the_equations(load, shear, tangency)
    exact = rs.exact_stiffness(load, shear, tangency)
    assert exact == pytest.approx(expected, rel=1e-11, abs=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("tangency", [0.0, 1.0])
@pytest.mark.parametrize("load", [0.3, 1.5, 2.3, 6.0, 12.0, 22.0])
def test_exact_stiffness_is_appendix_a(load, tangency):
    expected = appendix_a(load, SHEAR, tangency)
    exact = rs.exact_stiffness(load, SHEAR, tangency)
    assert exact == pytest.approx(expected, rel=1e-10, abs=1e-10 * np.abs(expected).max())


@given(load=between(-50.0, 3.0), shear=shears, tangency=between(0.0, 1.0))
def test_follower_and_axial_differ_by_the_tangency_alone(load, shear, tangency):
    difference = rs.exact_stiffness(load, shear, tangency) - rs.exact_stiffness(load, shear)
    assert difference == pytest.approx(np.array([[0, tangency * load], [0, 0]]), abs=1e-9)


@pytest.mark.parametrize("shear", [0.0, SHEAR, 0.1])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_linear_is_the_value_and_slope_of_exact(shear, tangency):
    elastic, geometric = rs.linear_stiffness(shear, tangency)
    assert rs.exact_stiffness(0.0, shear, tangency) == pytest.approx(elastic, rel=1e-14)
    step = 1e-3
    slope = (
        8 * (rs.exact_stiffness(step, shear, tangency) - rs.exact_stiffness(-step, shear, tangency))
        - (
            rs.exact_stiffness(2 * step, shear, tangency)
            - rs.exact_stiffness(-2 * step, shear, tangency)
        )
    ) / (12 * step)
    assert slope == pytest.approx(geometric, abs=1e-10)


@pytest.mark.parametrize("load", [1e-8, -1e-8, 1e-12, -1e-5])
@pytest.mark.parametrize("shear", [0.0, SHEAR])
def test_no_digits_are_lost_near_no_load(load, shear):
    elastic, geometric = rs.linear_stiffness(shear, 1.0)
    exact = rs.exact_stiffness(load, shear, 1.0)
    # the quadratic term is below 1e-10, rounding below 1e-14
    assert exact - elastic == pytest.approx(load * geometric, rel=1e-7, abs=2e-14 + load**2)


@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_linear_errs_by_the_square_of_the_load(tangency):
    loads = np.geomspace(1e-3, 0.3, 12)
    elastic, geometric = rs.linear_stiffness(SHEAR, tangency)
    for sign in (1, -1):
        exact = rs.exact_stiffness(sign * loads, SHEAR, tangency)
        error = np.abs(exact - elastic - sign * loads[:, None, None] * geometric).max(axis=(1, 2))
        order = np.polyfit(np.log(loads), np.log(error), 1)[0]
        assert order == pytest.approx(2.0, abs=0.05)


def test_the_series_and_the_closed_form_meet():
    # they change over at |k²| = 2
    for x in (2.0, -2.0):
        loads = x / (1 + SHEAR * x) + np.array([-1e-9, 1e-9])
        below, above = rs.exact_stiffness(loads, SHEAR)
        assert above == pytest.approx(below, rel=1e-8)


def test_linear_coefficients_of_the_base_case():
    # (B1)–(B9) at Φ = 0.0192, misprints corrected
    d = 1 + 12 * SHEAR
    elastic, geometric = rs.linear_stiffness(SHEAR)
    assert elastic == pytest.approx(np.array([[12, -6], [-6, 4 * (1 + 3 * SHEAR)]]) / d, rel=1e-15)
    expected = [
        [-6 * (1 + 20 * SHEAR + 120 * SHEAR**2) / 5, 0.1],
        [0.1, -2 * (1 + 15 * SHEAR + 90 * SHEAR**2) / 15],
    ]
    assert geometric == pytest.approx(np.array(expected) / d**2, rel=1e-15)
    follower = rs.linear_stiffness(SHEAR, 1.0)[1]
    # (B9)
    assert follower[0, 1] == pytest.approx(
        (11 + 240 * SHEAR + 1440 * SHEAR**2) / (10 * d**2), rel=1e-14
    )


@pytest.mark.parametrize("shear", [0.0, SHEAR, 0.1])
def test_the_exact_determinant_vanishes_at_buckling(shear):
    load = float(rs.critical_load(shear))
    matrix = rs.exact_stiffness(load, shear)
    assert np.linalg.det(matrix) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("shear", [0.0, SHEAR, 0.1])
def test_at_and_past_the_pole_is_an_error(shear):
    pole = float(largest_exact_load(shear))
    assert np.isfinite(rs.exact_stiffness(pole * (1 - 1e-9), shear)).all()
    # k = 2π
    assert pole / (1 - shear * pole) == pytest.approx(4 * np.pi**2, rel=1e-12)
    for load in (pole, 1.5 * pole, [0.0, pole]):
        with pytest.raises(ValueError, match=r"`load` must be below the pole of the exact stiff"):
            rs.exact_stiffness(load, shear)


def test_strong_tension_does_not_overflow():
    stiffness = rs.exact_stiffness([-1e4, -1e8], 0.0)
    # a string: k₁₁ → |p̄|
    assert stiffness[:, 0, 0] == pytest.approx([1e4, 1e8], rel=0.03)
    assert np.isfinite(stiffness).all()


@settings(max_examples=30)
@given(tangency=tangencies)
def test_vector_call_equals_scalar_loop(tangency):
    loads, shears_ = np.linspace(-9, 7, 5), np.array([[0.0], [SHEAR], [0.1]])
    exact = rs.exact_stiffness(loads, shears_, tangency)
    assert exact.shape == (3, 5, 2, 2)
    for i, j in np.ndindex(3, 5):
        single = rs.exact_stiffness(float(loads[j]), float(shears_[i, 0]), tangency)
        assert exact[i, j] == pytest.approx(single, rel=1e-13)
    elastic, geometric = rs.linear_stiffness(shears_, [0.0, 1.0])
    assert elastic.shape == geometric.shape == (3, 2, 2, 2)


def test_empty_input_gives_empty_output():
    assert rs.exact_stiffness([], 0.01).shape == (0, 2, 2)
    assert rs.linear_stiffness(np.empty((3, 0)))[0].shape == (3, 0, 2, 2)
    assert rs.critical_load([]).shape == (0,)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.nan, 0.0), r"`load` must be in \(-inf, inf\), got nan"),
        (([0.0, np.inf], 0.0), r"`load` must be in \(-inf, inf\), got inf"),
        ((0.0, -0.1), r"`shear` must be in \[0, 1\), got -0.1"),
        ((0.0, 1.0), r"`shear` must be in \[0, 1\), got 1"),
        ((0.0, 0.0, 1.5), r"`tangency` must be in \[0, 1\], got 1.5"),
        ((True, 0.0), r"`load` must be a real number in \(-inf, inf\), got True"),
        (("1", 0.0), r"`load` must be a real number in \(-inf, inf\), got '1'"),
        ((1j, 0.0), r"`load` must be a real number in \(-inf, inf\), got 1j"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        rs.exact_stiffness(*arguments)
    if "load" not in message:
        with pytest.raises(ValueError, match=message):
            rs.linear_stiffness(*arguments[1:])
