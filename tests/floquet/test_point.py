"""Floquet multipliers at points against DOP853, closed forms and invariants."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import mathieu_a, mathieu_b

from rotorstab import BASE_CASE, ShaftDisk, finite_element, lumped
from rotorstab.floquet.point import floquet_multipliers, floquet_solution, growth_rate
from rotorstab.floquet.tongues.edges import tongue_edges
from rotorstab.floquet.tongues.outlines import unstable_outlines
from rotorstab.model.modal import state_matrix
from rotorstab.model.stiffness import largest_exact_load
from tests.testing.example_rotors import P, W, lumped_systems, one_dof, reference_growth

LOADS = st.floats(0, 0.8)
SYSTEMS = {
    "axial": lumped(BASE_CASE, 2.0),
    "follower": lumped(BASE_CASE, 2.0, 1.0),
    "exact follower": lumped(BASE_CASE, 1.0, 1.0, stiffness="exact"),
    "damped": lumped(BASE_CASE, 2.0, external_damping=0.01, internal_damping=0.004),
    "finite element": finite_element(BASE_CASE, 1.0, modes=3),
}


@settings(max_examples=12)
@given(lumped_systems(), LOADS, st.floats(0, 1.0), st.floats(0.4, 8))
def test_against_dop853(system, static, pulsating, theta):
    solution = floquet_solution(system, static * P, pulsating * P, theta * W)
    expected = reference_growth(system, static * P, pulsating * P, theta * W)
    # DOP853 itself loses √ε at a double multiplier
    assert solution.growth_rate == pytest.approx(expected, abs=1e-6)
    assert solution.converged


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("theta", [pytest.param(0.31, marks=pytest.mark.long), 1.57, 4.04])
def test_growth_to_1e9_inside_and_off_tongues(name, theta):
    system = SYSTEMS[name]
    expected = reference_growth(system, 0.5 * P, 0.6 * P, theta * W)
    assert growth_rate(system, 0.5 * P, 0.6 * P, theta * W) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("name", SYSTEMS)
def test_liouville(name):
    system, theta = SYSTEMS[name], np.array([0.5, 1.3, 5.0]) * W
    trace = np.trace(state_matrix(system, system.stiffness(0.5 * P)))
    mu = floquet_multipliers(system, 0.5 * P, 0.7 * P, theta)
    expected = np.exp(2j * np.pi / theta * trace)
    np.testing.assert_allclose(mu.prod(axis=-1), expected, rtol=1e-8)


@pytest.mark.parametrize("name", ["axial", "follower", "exact follower", "finite element"])
def test_pairs_without_damping(name):
    mu = floquet_multipliers(SYSTEMS[name], 0.5 * P, 0.6 * P, np.array([1.6, 2.0, 4.05]) * W)
    for row in mu:
        mirrored = 1 / row.conj()
        gap = np.abs(mirrored[:, None] - row).min(axis=1)
        assert gap.max() < 1e-9


@pytest.mark.parametrize("name", ["axial", "follower", "finite element"])
def test_no_pulsation_no_growth(name):
    mu = floquet_multipliers(SYSTEMS[name], 0.5 * P, 0.0, np.linspace(0.3, 9, 40) * W)
    np.testing.assert_allclose(np.abs(mu), 1, atol=1e-9)


@settings(max_examples=6)
@given(lumped_systems(), LOADS, st.floats(0.4, 8))
def test_spin_reversal_conjugates(system, pulsating, theta):
    forward = growth_rate(system, 0.3 * P, pulsating * P, theta * W)
    backward = growth_rate(system.at_speed(-system.spin_speed), 0.3 * P, pulsating * P, theta * W)
    assert forward == pytest.approx(backward, abs=3e-7)


@pytest.mark.parametrize("name", SYSTEMS)
def test_sign_of_pulsation_is_a_shift_of_time(name):
    system = SYSTEMS[name]
    plus, minus = growth_rate(system, 0.4 * P, np.array([0.5, -0.5]) * P, 1.6 * W)
    assert plus == pytest.approx(minus, abs=1e-10)


def test_array_equals_scalar_loop():
    speeds = np.array([0.0, 1.0, 2.0])
    system = lumped(BASE_CASE, speeds[:, None])
    static, load, theta = np.array([0.2, 0.5]) * P, 0.4 * P, 1.5 * W
    together = growth_rate(system, static, load, theta)
    assert together.shape == (3, 2)
    alone = [[growth_rate(lumped(BASE_CASE, s), a, load, theta) for a in static] for s in speeds]
    np.testing.assert_allclose(together, alone, atol=1e-9)
    assert floquet_multipliers(system, static, load, theta).shape == (3, 2, 4)
    assert growth_rate(system, static, np.zeros((0, 1, 1)), theta).shape == (0, 3, 2)


def test_mathieu_edges():
    # q̈ + (1 + p cos θt)q = 0 is Mathieu's with a = 4/θ², q = 2p/θ²
    loads = np.array([0.05, 0.2, 0.5, 0.8])
    edges = tongue_edges(one_dof(), 0.0, loads)
    for left, right, load in zip(edges.left[0], edges.right[0], loads, strict=True):
        assert mathieu_a(1, 2 * load / left**2) == pytest.approx(4 / left**2, abs=1e-8)
        assert mathieu_b(1, 2 * load / right**2) == pytest.approx(4 / right**2, abs=1e-8)


def test_gyroscopic_band_in_closed_form():
    edges = tongue_edges(one_dof(spin=0.4), 0.0, [0.4])
    assert edges.left[0, 0] == pytest.approx(1.8396583, abs=1e-7)
    assert edges.right[0, 0] == pytest.approx(2.2306405, abs=1e-7)
    # outside it, inside Bolotin's first-order band, the rotor is stable
    assert growth_rate(one_dof(spin=0.4), 0.0, 0.4, [1.6, 1.8, 2.26, 2.45]).max() < 1e-10


def test_rotating_damping_threshold_speed():
    # forward whirl of the one-mass rotor loses stability at Ω = ω(1 + c_e/c_i)
    external, internal = 0.02, 0.01
    threshold = 1 + external / internal
    for factor, sign in ((0.99, -1), (1.0, 0), (1.01, 1)):
        spin = factor * threshold
        # no gyroscopic term: H acts through spin only, so cancel it
        system = one_dof(spin=spin, external=external, internal=internal)
        system = type(system)(
            **{
                **{k: getattr(system, k) for k in system.__dataclass_fields__},
                "gyroscopic": [[0.0]],
            }
        )
        growth = float(growth_rate(system, 0.0, 0.0, 1.7))
        assert np.sign(np.round(growth, 12)) == sign


def test_reduced_elements_approach_each_other_and_the_lumped_model():
    growth = []
    for system in (
        lumped(BASE_CASE, 1.0),
        finite_element(BASE_CASE, 1.0, modes=2),
        finite_element(BASE_CASE, 1.0, modes=3),
        finite_element(BASE_CASE, 1.0, modes=4),
    ):
        theta = np.linspace(1.3, 1.7, 161) * W
        growth.append(growth_rate(system, 0.5 * P, 0.3 * P, theta).max())
    assert growth[0] == pytest.approx(growth[3], rel=0.03)
    assert growth[1] == pytest.approx(growth[3], rel=2e-2)
    assert growth[2] == pytest.approx(growth[3], rel=5e-3)


def test_growth_just_below_the_pole():
    rotor = ShaftDisk(
        shear=0.0407798219500689, disk_mass=5.58, diametral_inertia=0.3019, polar_inertia=0.9698
    )
    system = lumped(rotor, 2.857, tangency=1.0, stiffness="exact")
    pulsating = float(largest_exact_load(rotor.shear)) * (1 - 1e-5) - 1.7
    solution = floquet_solution(system, 1.7, [pulsating, -pulsating], 3.0)
    assert solution.converged.all()
    # DOP853 on the exact stiffness, tolerance 1e-12
    assert solution.growth_rate == pytest.approx(4.4979713298, abs=1e-9)


@pytest.mark.parametrize(
    ("shear", "static", "room", "theta", "damping"),
    [
        (0.0, 3.0, 1e-6, 5.0, (0.0, 0.0)),
        (0.1, 0.5, 1e-5, 2.0, (0.02, 0.0)),
        (0.03, 14.0, 1e-3, 3.0, (0.0, 0.05)),
        (0.05, -40.0, 1e-4, 6.0, (0.0, 0.0)),
        (0.06, -900.0, 1e-2, 30.0, (0.0, 0.0)),  # too many harmonics for a series
    ],
)
def test_the_exact_law_against_dop853_near_its_pole(shear, static, room, theta, damping):
    rotor = ShaftDisk(shear, 5.0, 0.4, 0.7)
    system = lumped(rotor, 1.3, 0.6, *damping, stiffness="exact")
    pulsating = float(largest_exact_load(shear)) * (1 - room) - static
    solution = floquet_solution(system, static, pulsating, theta)
    expected = reference_growth(system, static, pulsating, theta, 1e-11)
    assert solution.growth_rate == pytest.approx(expected, abs=1e-8)
    assert solution.converged


def test_bad_input():
    system = SYSTEMS["axial"]
    with pytest.raises(ValueError, match=r"`excitation_frequency` must be in \(0, inf\), got 0"):
        growth_rate(system, 0.0, 0.1, 0.0)
    with pytest.raises(ValueError, match="`pulsating_load` must be in"):
        growth_rate(system, 0.0, np.nan, 1.0)
    with pytest.raises(
        ValueError,
        match=r"`static_load` \+ \|`pulsating_load`\| must be below the pole .* got 60",
    ):
        growth_rate(SYSTEMS["exact follower"], 10.0, -50.0, 1.0)


def test_results_are_read_only():
    solution = floquet_solution(SYSTEMS["axial"], 0.0, 0.1, [1.0, 2.0])
    with pytest.raises(ValueError, match="read-only"):
        solution.growth_rate[0] = 1


def test_a_part_of_a_step_or_of_a_row_is_refused():
    with pytest.raises(ValueError, match="`most_steps` must be a whole number"):
        floquet_solution(lumped(BASE_CASE, 1.0), 0.5, 0.1, 2.0, most_steps=10.5)
    with pytest.raises(ValueError, match="`rows` must be a whole number"):
        unstable_outlines(lumped(BASE_CASE, 1.0), 0.5, 0.1, 2.0, 3.0, rows=8.5)
