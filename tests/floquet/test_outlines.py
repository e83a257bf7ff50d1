"""Edges of everything unstable: where growth changes sign, with damping and exact stiffness too."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.bench_tongues import GAP, KINDS, LEAST, random_case, top_row
from benchmarks.tongue_scan import compare, scan
from rotorstab import (
    BASE_CASE,
    TABLE_1_SI,
    ShaftDisk,
    System,
    critical_load,
    finite_element,
    fundamental_frequency,
    growth_rate,
    lumped,
    tongue_edges,
)
from rotorstab.floquet.tongues.outlines import unstable_outlines
from rotorstab.model.finite_element import first_modes
from rotorstab.model.stiffness import largest_exact_load
from tests.testing.example_rotors import P, W

WINDOW = P, 0.8 * W, 6 * W
SYSTEMS = {
    "axial": lumped(BASE_CASE, 2.0),
    "follower": lumped(BASE_CASE, 1.0, 1.0),
    "exact": lumped(BASE_CASE, 1.0, 0.5, stiffness="exact"),
    "damped": lumped(BASE_CASE, 2.0, external_damping=0.01, internal_damping=0.002),
    "lightly damped": lumped(BASE_CASE, 2.0, external_damping=0.0005),
    "damped, exact": lumped(BASE_CASE, 1.0, external_damping=0.01, stiffness="exact"),
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_growth_changes_sign_at_the_edges(name):
    system = SYSTEMS[name]
    edges = [
        (load, left, right)
        for one in unstable_outlines(system, 0.5 * P, *WINDOW, rows=25)
        if one.order == 1
        for load, left, right in list(zip(one.pulsating_loads, one.left, one.right, strict=True))[
            2:-1:4
        ]
        if right - left > 1e-4 * right
    ]
    assert len(edges) > 10
    load, left, right = (column[:, None] for column in np.array(edges).T)
    step = np.array([1e-6, -1e-6])
    for theta in (left * (1 - step), right * (1 + step)):
        real = ((theta > 0.801 * W) & (theta < 5.99 * W)).all(axis=1)
        outside, inside = growth_rate(system, 0.5 * P, load, theta)[real].T
        assert (inside > 1e-10).all()
        assert (outside < 1e-9).all()
        assert real.sum() > 8


@pytest.mark.parametrize("damping", [0.005, 0.02])
def test_proportional_damping_at_rest_lowers_growth_by_itself(damping):
    """q = e^{−ct/2}u: an edge is where the undamped u, K less c²/4 M, grows at c/2."""
    system = lumped(BASE_CASE, 0.0, external_damping=damping)
    rate = system.external_damping[0, 0] / system.mass[0, 0]
    plain = lumped(BASE_CASE, 0.0)
    plain = replace(plain, elastic=plain.elastic - rate**2 / 4 * plain.mass)
    pieces = unstable_outlines(system, 0.2 * P, 0.5 * P, W, 4 * W, rows=9)
    piece = next(one for one in pieces if one.name == "1B+1F" and one.order == 1)
    for edge, side in ((piece.left[-1], -1), (piece.right[-1], 1)):
        theta = edge * (1 + side * np.array([-1e-6, 1e-6]))
        inside, outside = growth_rate(plain, 0.2 * P, piece.pulsating_loads[-1], theta)
        assert outside < rate / 2 < inside
    assert piece.pulsating_loads[0] > 0


def test_gyroscopic_band_in_closed_form():
    """z = u e^{jgt/2} turns z̈ − jgż + (1 + ε cos θt)z = 0 into Mathieu's equation."""
    system = System(
        mass=np.eye(2),
        gyroscopic=np.diag([1.0, 0.0]),
        external_damping=np.zeros((2, 2)),
        internal_damping=np.zeros((2, 2)),
        elastic=np.diag([1.0, 30.0]),
        geometric=np.diag([1.0, 0.0]),
        spin_speed=0.4,
    )
    pieces = unstable_outlines(system, 0.0, 0.4, 1.5, 2.6, rows=9)
    assert len(pieces) == 1
    assert pieces[0].left[-1] == pytest.approx(1.8396583, abs=3e-7)
    assert pieces[0].right[-1] == pytest.approx(2.2306405, abs=3e-7)


def test_rows_end_before_the_pole_of_the_exact_stiffness():
    system = SYSTEMS["exact"]
    pole = float(largest_exact_load(BASE_CASE.shear))
    pieces = unstable_outlines(system, 0.5 * P, 3 * pole, 2 * W, 6 * W, rows=9)
    assert max(one.pulsating_loads[-1] for one in pieces) < pole - 0.5 * P
    assert unstable_outlines(system, 1.1 * pole, P, 2 * W, 6 * W) == ()


def test_a_larger_system_is_refused():
    with pytest.raises(ValueError, match="`system` must have two coordinates"):
        unstable_outlines(finite_element(BASE_CASE, 0.0, modes=3), 0.0, 1.0, 0.5, 1.0)


def test_outlines_of_the_first_two_modes_are_tongues_of_finite_elements():
    system = finite_element(BASE_CASE, 2.0, modes=4)
    pieces = unstable_outlines(first_modes(system, 0.5 * P), 0.5 * P, 0.5 * P, 0.8 * W, 16 * W)
    piece = next(one for one in pieces if one.name == "1B+1F" and one.order == 1)
    load = piece.pulsating_loads[-1:]
    exact = tongue_edges(system, 0.5 * P, load, ("1B+1F",))
    assert piece.left[-1] == pytest.approx(exact.left[0, 0], rel=3e-3)
    assert piece.right[-1] == pytest.approx(exact.right[0, 0], rel=3e-3)


def test_one_edge_around_a_window_that_grows_everywhere():
    """A rotor that whirls by itself at every θ̄, and whose modes decay by 1e50 in a period."""
    rotor, _ = ShaftDisk.from_si(**TABLE_1_SI)
    load = float(critical_load(rotor.shear))
    frequency = fundamental_frequency(lumped(rotor, 0.0))
    system = lumped(rotor, 4.0, internal_damping=0.2)
    theta = np.geomspace(0.4, 16, 5) * frequency
    assert growth_rate(system, 0.0, 0.5 * load, theta).min() > 0.3
    (whole,) = unstable_outlines(system, 0.0, load, theta[0], theta[-1], rows=9)
    np.testing.assert_allclose(whole.left, theta[0])
    np.testing.assert_allclose(whole.right, theta[-1])


def test_a_rotor_that_grows_without_pulsation_has_no_edge_where_nothing_ends():
    system = lumped(BASE_CASE, 1.2, internal_damping=0.02)
    (whole,) = unstable_outlines(system, 0.0, 0.3 * P, 0.4 * W, 6 * W, rows=13)
    assert whole.pulsating_loads[0] == 0.0
    assert whole.order == 0
    assert np.allclose(whole.left, 0.4 * W)
    assert np.allclose(whole.right, 6 * W)
    assert whole.borders.all()


def test_a_tongue_cut_by_the_window_keeps_its_other_edge():
    theta = 1.68 * W  # near the middle of 1B+1F
    pieces = unstable_outlines(SYSTEMS["axial"], 0.5 * P, 0.5 * P, theta, 3 * W, rows=13)
    one = next(one for one in pieces if one.name == "1B+1F" and one.order == 1)
    left, right = one.borders
    assert left.sum() > 8
    assert not right.any()
    assert (one.right[2:] > theta).all()


AT_REST = lumped(BASE_CASE, 0.0, internal_damping=0.1)
SHORT_DISK = ShaftDisk(
    shear=0.09185309540553982, disk_mass=6.12522643630386, diametral_inertia=1.1173710800575072
)
# system, static and pulsating load, and a tongue that has been missed
MISSED = {
    "beside a harmless pass": (
        (lumped(BASE_CASE, 0.0, 0.5), 0.5 * P, 0.5 * P),
        (0.904 * W, 0.914 * W, 2.4e-3),
    ),
    "exact follower load at rest": (
        (lumped(SHORT_DISK, 0.0, 1.0, stiffness="exact"), 0.13064799732073154, 1.0057572967747268),
        (0.550, 0.559, 4.2e-3),
    ),
    "damped, first order": ((AT_REST, 0.5 * P, P), (0.91 * W, 1.984 * W, 0.05)),
    "damped, second order": ((AT_REST, 0.5 * P, P), (0.501 * W, 0.775 * W, 0.01)),
    "damped, third order": ((AT_REST, 0.5 * P, P), (0.4 * W, 0.475 * W, 0.005)),
}


def at_top(pieces, load):
    return [
        (float(one.left[-1]), float(one.right[-1]))
        for one in pieces
        if one.pulsating_loads[-1] == load
    ]


@pytest.mark.parametrize("name", MISSED)
def test_tongues_that_were_missed(name):
    (system, static, load), (low, high, growth) = MISSED[name]
    assert growth_rate(system, static, load, np.linspace(low, high, 81)).max() > growth
    pieces = unstable_outlines(system, static, load, 0.4 * W, 16 * W)
    piece = min(at_top(pieces, load), key=lambda one: abs(one[0] - low) + abs(one[1] - high))
    assert piece == pytest.approx((low, high), rel=3e-3)
    for edge, step in zip(piece, (1e-6, -1e-6), strict=True):
        inside, outside = growth_rate(system, static, load, edge * (1 + np.array([step, -step])))
        assert edge == 0.4 * W or outside < 1e-9 < inside


def test_strong_internal_damping_leaves_nothing_stable():
    system = lumped(BASE_CASE, 2.0, internal_damping=0.2)
    assert growth_rate(system, 0.5 * P, P, np.geomspace(0.4, 16, 40) * W).min() > 0
    (whole,) = unstable_outlines(system, 0.5 * P, P, 0.4 * W, 16 * W)
    assert whole.borders.all()
    assert whole.pulsating_loads[0] == 0


@pytest.mark.parametrize(
    ("kind", "seed"),
    [(kind, seed) for kind in KINDS[:2] for seed in (100, 101)] + [(KINDS[3], 100)],
)
def test_random_rotors_against_points(kind, seed):
    """The short form of `python -m benchmarks tongues`: one row, points alone as the truth."""
    system, static, load, frequency = random_case(seed, kind)
    low, high = 0.6 * frequency, 8 * frequency
    found = scan(system, static, load, low, high, 700)
    verdict = compare(found, top_row(system, static, load, low, high, 20), LEAST)
    assert verdict.missed == []
    assert [gap for _, gap in verdict.false if gap > GAP] == []


def test_the_scan_sees_what_outlines_miss():
    """A check that cannot fail shows nothing: with one piece taken away it must."""
    system, static, load = MISSED["beside a harmless pass"][0]
    pieces = unstable_outlines(system, static, load, 0.8 * W, 1.1 * W, 12)
    found = scan(system, static, load, 0.8 * W, 1.1 * W, 150)
    row = at_top(pieces, load)
    assert compare(found, row, LEAST).missed == []
    assert compare(found, row[1:], LEAST).missed
    wide = compare(found, [(row[0][0], 1.05 * row[0][1])], LEAST).false
    assert max(gap for _, gap in wide) > GAP
