"""Systems of two planes, cross coupling, and rest positions that are not stable, against the real
equations of motion, which are assembled and integrated here."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import rotorstab as rs
from rotorstab.model.damping import with_damping_ratios
from tests.testing.example_rotors import one_dof, reference_growth

DISK = np.diag([1.0, 0.0])  # acts on the disk's displacement


def in_planes(system, kxx=0.0, kyy=0.0, kxy=0.0, kyx=0.0, cxx=0.0, cyy=0.0, cxy=0.0, cyx=0.0):
    """The same rotor in two planes, with a bearing at its disk."""
    zero = np.zeros_like(system.mass)

    def both(first, second=None):
        return np.block([[first, zero], [zero, first if second is None else second]])

    def across(first, second):
        return np.block([[zero, first], [second, zero]])

    return rs.System(
        mass=both(system.mass),
        gyroscopic=across(system.gyroscopic, system.gyroscopic),
        external_damping=both(
            system.external_damping + cxx * DISK, system.external_damping + cyy * DISK
        ),
        internal_damping=both(system.internal_damping),
        elastic=both(system.elastic + kxx * DISK, system.elastic + kyy * DISK),
        geometric=both(system.geometric),
        spin_speed=system.spin_speed,
        cross_stiffness=across(kxy * DISK, -kyx * DISK) if kxy or kyx else None,
        cross_damping=across(cxy * DISK, -cyx * DISK) if cxy or cyx else None,
        planes=True,
    )


def real_matrices(system, kxx=0.0, kyy=0.0, kxy=0.0, kyx=0.0, cxx=0.0, cyy=0.0, cxy=0.0, cyx=0.0):
    """M, D, K and Kb of (x, y), real, of an undamped lumped rotor with the same bearing."""
    zero = np.zeros_like(system.mass)
    h = float(system.spin_speed) * system.gyroscopic
    mass = np.block([[system.mass, zero], [zero, system.mass]])
    # m ẍ + Ωh ẏ and m ÿ − Ωh ẋ
    damping = np.block([[cxx * DISK, h + cxy * DISK], [-h + cyx * DISK, cyy * DISK]])
    stiffness = np.block(
        [[system.elastic + kxx * DISK, kxy * DISK], [kyx * DISK, system.elastic + kyy * DISK]]
    )
    geometric = np.block([[system.geometric, zero], [zero, system.geometric]])
    return mass, damping, stiffness, geometric


def real_growth(matrices, static, pulsating, theta):
    """ln max|μ|/T of the real equations by DOP853."""
    mass, damping, stiffness, geometric = matrices
    inverse, n = np.linalg.inv(mass), len(mass)

    def rate(t, z):
        q, v = z.reshape(2, n, 2 * n)
        force = damping @ v + (stiffness + (static + pulsating * np.cos(theta * t)) * geometric) @ q
        return np.concatenate([v, -inverse @ force]).ravel()

    period = 2 * np.pi / theta
    run = solve_ivp(rate, (0, period), np.eye(2 * n).ravel(), "DOP853", rtol=1e-11, atol=1e-11)
    return np.log(np.abs(np.linalg.eigvals(run.y[:, -1].reshape(2 * n, 2 * n))).max()) / period


def real_frequencies(matrices, load):
    """Roots ω of the real equations, sorted."""
    mass, damping, stiffness, geometric = matrices
    inverse, n = np.linalg.inv(mass), len(mass)
    state = np.block(
        [
            [np.zeros((n, n)), np.eye(n)],
            [-inverse @ (stiffness + load * geometric), -inverse @ damping],
        ]
    )
    return np.sort_complex(-1j * np.linalg.eigvals(state))


small = st.floats(-0.2, 0.2, allow_subnormal=False)
bearings = st.fixed_dictionaries(
    {"kxx": st.floats(0, 0.5), "kyy": st.floats(0, 0.5), "kxy": small, "kyx": small}
    | {"cxx": st.floats(0, 0.3), "cyy": st.floats(0, 0.3), "cxy": small, "cyx": small}
)


@settings(max_examples=16)
@given(bearings, st.floats(0, 3), st.floats(0, 1.5))
def test_frequencies_of_two_planes_are_those_of_the_real_equations(bearing, speed, load):
    system = rs.lumped(rs.ShaftDisk(), speed)
    found = rs.whirl_frequencies(in_planes(system, **bearing), load)
    expected = real_frequencies(real_matrices(system, **bearing), load)
    # sums of powers are free of the order; double roots are known to half of the digits
    for power in (1, 2, 3, 4):
        assert (found**power).sum() == pytest.approx((expected**power).sum(), rel=1e-8, abs=1e-8)
    mirrored = np.sort_complex(-found.conj())
    assert np.abs(np.sort(mirrored.imag) - np.sort(found.imag)).max() < 1e-6


@settings(max_examples=4)
@given(bearings, st.floats(0, 2), st.floats(0.4, 4))
def test_growth_of_two_planes_is_that_of_the_real_equations(bearing, speed, theta):
    system = rs.lumped(rs.ShaftDisk(), speed)
    found = rs.growth_rate(in_planes(system, **bearing), 0.8, 0.4, theta)
    expected = real_growth(real_matrices(system, **bearing), 0.8, 0.4, theta)
    assert found == pytest.approx(expected, abs=1e-7)


@pytest.mark.parametrize("cross", [{"kxy": 0.05, "kyx": -0.05}, {"cxy": 0.1, "cyx": -0.1}], ids=str)
def test_cross_coupling_that_is_the_same_in_all_directions_keeps_complex_coordinates(cross):
    rotor = rs.lumped(rs.ShaftDisk(), 1.0)
    damped = {"cxx": 0.2, "cyy": 0.2} | cross
    system = replace(
        rotor,
        external_damping=0.2 * DISK,
        cross_stiffness=cross.get("kxy", 0.0) * DISK,
        cross_damping=cross.get("cxy", 0.0) * DISK,
    )
    expected = real_growth(real_matrices(rotor, **damped), 0.8, 0.4, 1.1)
    assert rs.growth_rate(system, 0.8, 0.4, 1.1) == pytest.approx(expected, abs=1e-9)
    assert rs.growth_rate(in_planes(rotor, **damped), 0.8, 0.4, 1.1) == pytest.approx(
        expected, abs=1e-9
    )


def test_cross_stiffness_makes_a_forward_whirl_grow_without_pulsation():
    """Oil whirl: k_xy = −k_yx > 0 feeds the forward whirl, damping takes from it."""
    rotor = rs.lumped(rs.ShaftDisk(), 1.0)
    weak = replace(rotor, external_damping=0.05 * DISK, cross_stiffness=0.1 * DISK)
    strong = replace(rotor, external_damping=0.5 * DISK, cross_stiffness=0.1 * DISK)
    for system, unstable in ((weak, True), (strong, False)):
        found = rs.whirl_frequencies(system, 0.0)
        assert bool(rs.mean_is_unstable(found)) is unstable
    grows = rs.whirl_frequencies(weak, 0.0)
    assert grows[grows.imag.argmin()].real > 0


@pytest.mark.parametrize("static", [0.0, 1.0])
def test_isotropic_bearings_in_two_planes_change_nothing(static):
    rotor = rs.lumped(rs.ShaftDisk(), 1.5)
    planes = in_planes(rotor)
    one = rs.whirl_frequencies(rotor, static).real
    np.testing.assert_allclose(
        rs.whirl_frequencies(planes, static).real, np.sort([*one, *-one]), atol=1e-10
    )
    theta = np.array([0.7, 1.04, 1.1, 2.65])
    np.testing.assert_allclose(
        rs.growth_rate(planes, static, 0.3, theta),
        rs.growth_rate(rotor, static, 0.3, theta),
        atol=1e-9,
    )
    known = {row.name: row for row in rs.resonances(rotor, static, 0.1).tongues}
    found = {row.name: row for row in rs.resonances(planes, static, 0.1).tongues}
    assert known.keys() == found.keys() == {"1B+1F", "2B+1F", "1B+2F", "2B+2F"}
    for name, row in known.items():
        assert found[name].centre == pytest.approx(row.centre)
        assert found[name].growth == pytest.approx(row.growth)


def test_anisotropy_brings_back_twice_the_frequency_and_closes_the_sum_tongue():
    """A soft and a stiff direction: tongues at 2ω_1 and 2ω_2 that the round rotor does not have."""
    round_one = rs.lumped(rs.ShaftDisk(), 0.0)
    rotor = in_planes(round_one, kyy=0.6)
    table = rs.resonances(rotor, 0.5, 0.1)
    assert {"1S+1S", "2S+2S"} <= {row.name for row in table.tongues}
    assert table["1S+2S"].growth_per_load == pytest.approx(0.0, abs=1e-9)
    spinning = in_planes(rs.lumped(rs.ShaftDisk(), 0.03), kyy=0.6)
    tongues = {row.name: row for row in rs.resonances(spinning, 0.5, 0.1).tongues}
    low, high = sorted(
        (row for row in tongues.values() if row.kind == "principal"), key=lambda row: row.centre
    )[:2]
    # at rest the two planes do not know of each other: the sum tongue opens with the speed only
    both = next(row for row in tongues.values() if row.kind == "sum")
    assert both.growth < 0.5 * min(low.growth, high.growth)
    for row in (low, high):
        matrices = real_matrices(rs.lumped(rs.ShaftDisk(), 0.03), kyy=0.6)
        found = real_growth(matrices, 0.5, 0.1, row.centre)
        assert found == pytest.approx(row.growth, rel=0.1)
    for row in rs.resonances(rs.lumped(rs.ShaftDisk(), 0.03), 0.5, 0.1).tongues:
        assert row.kind != "principal" or row.first != row.second


def test_first_order_regions_of_two_planes_are_where_growth_is():
    rotor = in_planes(rs.lumped(rs.ShaftDisk(), 1.0), kyy=0.3)
    regions = rs.first_order_regions(rs.resonances(rotor, 1.0, 0.02), 0.02)
    wide = [region for region in regions if region.width > 1e-4]
    assert len(wide) >= 3
    for region in wide:
        inside = region.left + region.width * np.array([0.2, 0.5, 0.8])
        assert (rs.growth_rate(rotor, 1.0, 0.02, inside) > 0).all(), region.name
        outside = region.centre + region.width * np.array([-1.5, 1.5])
        assert (rs.growth_rate(rotor, 1.0, 0.02, outside) < 1e-8).all(), region.name


def test_the_orbit_names_a_whirl():
    rotor = in_planes(rs.lumped(rs.ShaftDisk(), 1.0), kyy=0.3)
    curves = rs.load_frequency_curves(rotor, [0.0, 0.5])
    assert curves.names == ("−2F", "−2B", "−1F", "−1B", "1B", "1F", "2B", "2F")
    assert rs.campbell_diagram(rotor, [0.0, 0.5, 1.0]).names == curves.names
    at_rest = rs.load_frequency_curves(in_planes(rs.lumped(rs.ShaftDisk(), 0.0), kyy=0.3), [0.0])
    assert at_rest.names[4:] == ("1S", "2S", "3S", "4S")
    with pytest.raises(ValueError, match="complex coordinates"):
        rs.named_frequencies(rotor)


def test_bolotins_boundaries_of_two_planes_are_edges_of_tongues():
    """With two planes Bolotin's 2ω is true: his boundaries enclose the tongue at 2ω_1."""
    rotor = in_planes(rs.lumped(rs.ShaftDisk(), 1.0), kyy=0.3)
    chart = rs.bolotin_chart(rotor, 0.5, 0.1)
    assert sorted(chart.names) == sorted(2 * ("1B", "1F", "2B", "2F"))
    edges = rs.tongue_edges(rotor, 0.5, [0.05], ("1F+1F",))
    bounds = rs.boundary_frequencies(rotor, 0.5, 0.05)
    for edge in (edges.left[0, 0], edges.right[0, 0]):
        assert np.abs(bounds - edge).min() < 0.1 * (edges.right[0, 0] - edges.left[0, 0])


@pytest.mark.parametrize("elastic", [-25.0, -1.0, 0.0])
def test_a_rest_position_that_is_not_stable_has_a_growth_rate(elastic):
    """Negative stiffness, and none: a free body."""
    system = one_dof(elastic=elastic, spin=0.4)
    for theta in (0.7, 1.3):
        expected = reference_growth(system, 0.1, 0.2, theta)
        assert rs.growth_rate(system, 0.1, 0.2, theta) == pytest.approx(expected, abs=1e-8)
    assert len(rs.resonances(system, 0.0, 0.1)) == 1
    assert rs.whirl_frequencies(system, 0.0).shape == (2,)


def test_a_pulsation_can_hold_up_what_falls():
    """Kapitza's pendulum: q̈ + (−0.1 + 12 cos 5t) q = 0 is stable, as Mathieu's chart says."""
    system = one_dof(elastic=-0.1)
    assert rs.growth_rate(system, 0.0, 3.0, 5.0) < 1e-8 < rs.growth_rate(system, 0.0, 0.5, 5.0)


@pytest.mark.parametrize(("external", "internal"), [(0.1, 0.0), (0.0, 0.05), (0.02, 0.03)])
def test_damping_ratios_are_the_same_in_two_planes_and_seen_from_the_shaft(external, internal):
    rotor = rs.lumped(rs.ShaftDisk(), 0.7)
    damped = with_damping_ratios(rotor, external, internal)
    whirl = rs.whirl_frequencies(damped, 0.8)
    for other, shift in ((in_planes(rotor), 0.0), (in_rotating_coordinates(rotor), 0.7)):
        seen = whirl - shift
        expected = np.concatenate([seen, -seen.conj()])
        found = rs.whirl_frequencies(with_damping_ratios(other, external, internal), 0.8)
        assert np.abs(expected[:, None] - found).min(axis=1).max() < 1e-6


def test_rotating_damping_as_such_is_refused_in_two_planes():
    planes = in_planes(rs.lumped(rs.ShaftDisk(), 0.7))
    with pytest.raises(ValueError, match="`internal_damping` must be zero with two planes"):
        replace(planes, internal_damping=planes.elastic)


def in_rotating_coordinates(system, soft=0.0, stiff=0.0, damping=0.0):
    """The rotor on a shaft with two second moments, seen from the shaft; damping is external."""
    zero = np.zeros_like(system.mass)

    def both(first, second=None):
        return np.block([[first, zero], [zero, first if second is None else second]])

    def across(part):
        return np.block([[zero, part], [part, zero]])

    outside = damping * system.mass
    return rs.System(
        mass=both(system.mass),
        gyroscopic=across(system.gyroscopic - 2 * system.mass),
        external_damping=both(outside),
        internal_damping=both(zero),
        elastic=both(system.elastic + soft * DISK, system.elastic + stiff * DISK),
        geometric=both(system.geometric),
        spin_speed=system.spin_speed,
        spin_stiffness=across(-outside) if damping else None,
        spin_softening=both(system.mass - system.gyroscopic),
        planes=True,
    )


@pytest.mark.parametrize("damping", [0.0, 0.1])
def test_a_round_shaft_is_the_same_from_rotating_coordinates(damping):
    rotor = rs.lumped(rs.ShaftDisk(), 0.7)
    turning = in_rotating_coordinates(rotor, damping=damping)
    fixed = replace(rotor, external_damping=damping * rotor.mass)
    seen = rs.whirl_frequencies(fixed, 0.8) - 0.7
    expected = np.concatenate([seen, -seen.conj()])
    found = rs.whirl_frequencies(turning, 0.8)
    for power in (1, 2, 3, 4):
        assert (found**power).sum() == pytest.approx((expected**power).sum(), abs=1e-9)
    theta = np.array([0.9, 1.02, 2.6])
    np.testing.assert_allclose(
        rs.growth_rate(turning, 0.8, 0.4, theta), rs.growth_rate(fixed, 0.8, 0.4, theta), atol=1e-8
    )


def test_a_shaft_with_two_second_moments_is_unstable_between_its_critical_speeds():
    """The textbook case: with two stiffnesses there is a range of speeds without a stable rest."""
    resting = rs.lumped(rs.ShaftDisk(), 0.0)
    ends = [
        rs.critical_speeds(replace(resting, elastic=resting.elastic + k * DISK)).forward[0]
        for k in (0.0, 0.3)
    ]
    for speed, unstable in (
        (0.9 * ends[0], False),
        (0.99 * ends[0], False),
        (1.01 * ends[0], True),
        (0.99 * ends[1], True),
        (1.01 * ends[1], False),
    ):
        turning = in_rotating_coordinates(rs.lumped(rs.ShaftDisk(), speed), soft=0.0, stiff=0.3)
        assert bool(rs.mean_is_unstable(rs.whirl_frequencies(turning, 0.0))) is unstable, speed
        assert bool(rs.growth_rate(turning, 0.0, 0.0, 1.3) > 1e-6) is unstable
    with pytest.raises(ValueError, match="coordinates at rest"):
        rs.critical_speeds(turning)


def test_growth_in_rotating_coordinates_is_that_of_periodic_stiffness_at_rest():
    """From outside the shaft's stiffness turns with it, K(2Ωt): one period of both, integrated."""
    speed, theta, stiff = 0.5, 1.5, 0.3  # three half turns of the shaft to a period: T = 2π/0.5
    rotor = rs.lumped(rs.ShaftDisk(), speed)
    turning = in_rotating_coordinates(rotor, stiff=stiff)
    mass, damping, stiffness, geometric = real_matrices(rotor)
    inverse, n = np.linalg.inv(mass), len(mass)

    def rate(t, z):
        q, v = z.reshape(2, n, 2 * n)
        s, c = np.sin(speed * t), np.cos(speed * t)
        # stiff along the axis (−sin, cos) that turns with the shaft
        turned = stiff * np.kron(np.array([[s * s, -s * c], [-s * c, c * c]]), DISK)
        force = damping @ v + (stiffness + turned + (0.8 + 0.4 * np.cos(theta * t)) * geometric) @ q
        return np.concatenate([v, -inverse @ force]).ravel()

    period = 2 * np.pi / speed
    run = solve_ivp(rate, (0, period), np.eye(2 * n).ravel(), "DOP853", rtol=1e-10, atol=1e-10)
    expected = np.log(np.abs(np.linalg.eigvals(run.y[:, -1].reshape(2 * n, 2 * n))).max()) / period
    assert rs.growth_rate(turning, 0.8, 0.4, theta) == pytest.approx(expected, abs=1e-6)


def test_critical_speeds_of_two_planes_have_their_direction():
    round_one = rs.critical_speeds(rs.lumped(rs.ShaftDisk(), 0.0))
    planes = rs.critical_speeds(in_planes(rs.lumped(rs.ShaftDisk(), 0.0)))
    np.testing.assert_allclose(planes.forward, round_one.forward)
    np.testing.assert_allclose(planes.backward, round_one.backward)
    split = rs.critical_speeds(in_planes(rs.lumped(rs.ShaftDisk(), 0.0), kyy=0.3))
    assert len(split.forward) + len(split.backward) == 3
    for speed in (*split.forward, *split.backward):
        roots = rs.whirl_frequencies(in_planes(rs.lumped(rs.ShaftDisk(), speed), kyy=0.3), 0.0)
        assert np.abs(np.abs(roots.real) - speed).min() < 1e-9
