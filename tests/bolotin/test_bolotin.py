"""Bolotin's boundary frequencies, regions and chart."""

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


def winding(points, polygon):
    """Whether each point lies in a polygon, by counting edges to its right."""
    x, y = points[:, :1], points[:, 1:]
    x0, y0 = polygon.T
    x1, y1 = np.roll(polygon, -1, axis=0).T
    crossing = (y0 <= y) != (y1 <= y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = x0 + (y - y0) * (x1 - x0) / (y1 - y0)
    return (crossing & (at > x)).sum(axis=1) % 2 == 1


@pytest.mark.parametrize(
    ("speed", "static_factor", "factor", "expected"),
    [
        # theory notes §5: axial, Φ = 0.0192, disk (5, 0.8), θ/ω_n
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


# chart

CHARTS = {
    "axial": (rs.lumped(BASE, 1.0), 0.5, 1.0),
    "follower": (rs.lumped(BASE, 1.0, 1.0), 0.5, 1.0),
    "at rest": (rs.lumped(BASE, 0.0), 0.5, 0.9),
    "at rest past buckling": (rs.lumped(BASE, 0.0), 0.8, 2.0),
    "past buckling": (rs.lumped(BASE, 1.0), 0.8, 3.0),
    "follower towards flutter": (rs.lumped(BASE, 0.0, 1.0), 1.5, 4.0),
    "follower past flutter": (rs.lumped(BASE, 0.5, 1.0), 2.9, 3.0),
    "no gyroscopics": (rs.lumped(rs.ShaftDisk(polar_inertia=0.0), 2.0), 0.5, 1.5),
    "slow": (rs.lumped(BASE, 0.01), 0.3, 2.0),
    "fast": (rs.lumped(BASE, 4.0, 1.0), 0.9, 3.0),
    "exact": (rs.lumped(BASE, 1.0, stiffness="exact"), 0.5, 1.2),
    "exact follower": (rs.lumped(BASE, 0.3, 1.0, stiffness="exact"), 1.0, 4.0),
    "buckled": (rs.lumped(BASE, 0.0), 1.3, 1.0),
    "buckled, spinning": (rs.lumped(BASE, 0.5), 1.3, 1.0),
}


@pytest.fixture(params=CHARTS, name="case")
def _case(request):
    system, static, largest = CHARTS[request.param]
    chart = rs.bolotin_chart(system, static * REFERENCE, largest * REFERENCE)
    return system, static * REFERENCE, chart


def test_chart_holds_the_boundary_frequencies(case):
    system, static, chart = case
    expected = rs.boundary_frequencies(system, static, chart.pulsating_load)
    assert np.sort(chart.frequency) == pytest.approx(expected, abs=2e-6, nan_ok=True)
    assert (np.diff(chart.pulsating_load) > 0).all()
    assert sorted(chart.names) == ["1B", "1F", "2B", "2F"]


def assert_no_spurious_line(chart):
    """Neighbours differ by no more than the boundary's own slope and turning explain."""
    frequency, load = chart.frequency, chart.pulsating_load
    scale = np.nanmax(frequency, initial=0.0)
    for column in frequency.T:
        real = np.isfinite(column)
        inside = np.flatnonzero(real[1:] & real[:-1])
        step = np.abs(column[inside + 1] - column[inside])
        fraction = (load[inside + 1] - load[inside]) / load[-1]
        assert (step <= 3 * scale * np.sqrt(fraction)).all()


def ends(chart):
    """Yield row, column where a boundary starts or ends inside the chart."""
    real = np.isfinite(chart.frequency)
    for row, column in zip(*np.nonzero(real[1:] != real[:-1]), strict=True):
        yield (row if real[row, column] else row + 1), column


def test_no_spurious_lines_and_every_end_is_closed(case):
    chart = case[2]
    assert_no_spurious_line(chart)
    scale = np.nanmax(chart.frequency)
    for row, column in ends(chart):
        here = chart.frequency[row]
        others = np.delete(here, column)
        # either two boundaries meet, or one reaches θ̄ = 0
        meets = np.nanmin(np.abs(others - here[column]), initial=np.inf)
        assert min(meets, here[column]) < 2e-4 * scale


def test_polygons_are_the_region(case):
    system, static, chart = case
    random = np.random.default_rng(5)
    right = 1.2 * np.nanmax(chart.frequency)
    points = random.uniform([0, 0], [right, chart.pulsating_load[-1]], (4000, 2))
    inside = np.zeros(4000, bool)
    for polygon in chart.regions:
        assert np.isfinite(polygon).all()
        inside ^= winding(points, polygon)
    expected = rs.in_bolotin_region(system, static, points[:, 1], points[:, 0])
    wrong = np.flatnonzero(inside != expected)
    # chords cut off a sliver between rows
    assert wrong.size <= 8
    for x, y in points[wrong]:
        around = x + 2e-3 * right * np.array([-1, 1])
        assert np.ptp(rs.in_bolotin_region(system, static, y, around).astype(int)) == 1


@settings(max_examples=100)
@given(
    rotor=rotors,
    speed=spin_speeds,
    tangency=tangencies,
    static=between(0.0, 1.5),
    largest=between(0.1, 4.0),
    seed=st.integers(0, 1000),
)
def test_polygons_of_random_rotors(rotor, speed, tangency, static, largest, seed):
    reference = float(rs.critical_load(rotor.shear))
    system = rs.lumped(rotor, speed, tangency)
    chart = rs.bolotin_chart(system, static * reference, largest * reference)
    assert_no_spurious_line(chart)
    right = 1.1 * np.nanmax(chart.frequency, initial=1e-3)
    points = np.random.default_rng(seed).uniform(
        [0, 0], [right, chart.pulsating_load[-1]], (300, 2)
    )
    inside = np.zeros(300, bool)
    for polygon in chart.regions:
        inside ^= winding(points, polygon)
    expected = rs.in_bolotin_region(system, static * reference, points[:, 1], points[:, 0])
    for x, y in points[inside != expected]:
        # only within a sliver of a boundary
        boundaries = rs.boundary_frequencies(system, static * reference, y)
        load_step = chart.pulsating_load[-1] / 119
        near = rs.boundary_frequencies(
            system, static * reference, y + load_step * np.array([-1, 1])
        )
        close = np.nanmin(np.abs(np.append(boundaries, near) - x), initial=np.inf)
        assert close < 5e-3 * right


@pytest.mark.parametrize("speed", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_names_order_by_whirl_frequency(speed, tangency):
    system = rs.lumped(BASE, speed, tangency)
    static = 0.4 * REFERENCE
    chart = rs.bolotin_chart(system, static, REFERENCE)
    whirl = dict(
        zip(("2B", "1B", "1F", "2F"), rs.whirl_frequencies(system, static).real, strict=True)
    )
    for name, theta in zip(chart.names, chart.frequency[0], strict=True):
        assert theta == pytest.approx(2 * abs(whirl[name]), rel=1e-9)


@pytest.mark.parametrize("tangency", [0.0, 0.5, 1.0])
def test_at_rest_backward_is_the_left_boundary(tangency):
    chart = rs.bolotin_chart(rs.lumped(BASE, 0.0, tangency), 0.3 * REFERENCE, 0.5 * REFERENCE)
    columns = dict(zip(chart.names, chart.frequency.T, strict=True))
    for number in "12":
        left, right = columns[number + "B"], columns[number + "F"]
        assert left[0] == pytest.approx(right[0], rel=1e-9)
        assert (left[1:] < right[1:]).all()
    assert columns["1F"].max() < columns["2B"].min()


def test_at_rest_boundaries_cross_without_changing_names():
    # K∓ come apart so far that the right boundary of 1 crosses the left one of 2
    rotor = rs.ShaftDisk(disk_mass=2.0, diametral_inertia=2.0)
    chart = rs.bolotin_chart(rs.lumped(rotor, 0.0), 0.0, 6.0, rows=400)
    for column in chart.frequency.T:
        column = column[np.isfinite(column)]
        # smooth: the second difference stays small where no end is near
        bend = np.abs(np.diff(column, 2))[:-40]
        assert np.quantile(bend, 0.9) < 1e-3


@pytest.mark.parametrize("speed", [0.0, 0.2, 1.0])
@pytest.mark.parametrize("tangency", [0.0, 1.0])
@pytest.mark.parametrize("factor", [1.2, 2.8, 4.0])
def test_names_past_buckling_and_flutter_come_from_no_load(speed, tangency, factor):
    system = rs.lumped(BASE, speed, tangency)
    static = factor * REFERENCE
    chart = rs.bolotin_chart(system, static, REFERENCE)
    curves = rs.load_frequency_curves(system, np.linspace(0, static, 400))
    whirl = dict(zip(curves.names, curves.frequencies[-1], strict=True))
    for name, theta in zip(chart.names, chart.frequency[0], strict=True):
        square = whirl[name] ** 2
        if np.isfinite(theta):
            assert theta == pytest.approx(2 * np.sqrt(square.real), rel=1e-6)
        else:
            assert square.real <= 0 or abs(square.imag) > 0


def test_a_finite_element_rotor_goes_the_same_way():
    lumped = rs.bolotin_chart(rs.lumped(BASE, 1.0), 0.0, REFERENCE)
    heavy = rs.ShaftDisk(disk_mass=5e4, diametral_inertia=8e3, polar_inertia=1.6e4)
    system = rs.finite_element(heavy, 1e-2, elements=4)
    # a disk 1e4 times heavier makes the shaft massless and time 100 times slower
    chart = rs.bolotin_chart(system, 0.0, REFERENCE, rows=8)
    expected = rs.boundary_frequencies(rs.lumped(heavy, 1e-2), 0.0, REFERENCE)
    assert chart.frequency.shape[1] == 2 * system.size
    assert np.sort(chart.frequency[-1])[:2] == pytest.approx(expected[:2], rel=1e-2)
    assert set(lumped.names) <= set(chart.names)


def test_rows():
    chart = rs.bolotin_chart(rs.lumped(BASE, 1.0), 0.0, 0.5, rows=8)
    assert chart.pulsating_load == pytest.approx(np.linspace(0, 0.5, 8))


def test_empty_input_gives_empty_output():
    for stiffness in ("linear", "exact"):
        system = rs.lumped(BASE, 1.0, stiffness=stiffness)
        assert rs.boundary_frequencies(system, 0.5, []).shape == (0, 4)
        assert rs.boundary_frequencies(system, [], 0.5).shape == (0, 4)
        assert rs.in_bolotin_region(system, 0.5, 0.1, []).shape == (0,)
    assert rs.boundary_frequencies(rs.lumped(BASE, []), 0.5, 0.5).shape == (0, 4)
    assert rs.boundary_frequencies(rs.lumped(BASE, 0.0), 0.5, []).shape == (0, 4)


@pytest.mark.parametrize("bad", [np.nan, np.inf, True, "1", 1j, None])
def test_bad_numbers_are_refused(bad):
    system = rs.lumped(BASE, 1.0)
    wrong = r" must be (a real number )?in [(\[].*, inf\), got"
    with pytest.raises(ValueError, match="`static_load`" + wrong):
        rs.boundary_frequencies(system, bad, 0.1)
    with pytest.raises(ValueError, match="`pulsating_load`" + wrong):
        rs.boundary_frequencies(system, 0.1, bad)
    with pytest.raises(ValueError, match="`excitation_frequency`" + wrong):
        rs.in_bolotin_region(system, 0.1, 0.1, bad)
    with pytest.raises(ValueError, match="`static_load`" + wrong):
        rs.bolotin_chart(system, bad, 1.0)
    with pytest.raises(ValueError, match="`largest_pulsating_load`" + wrong):
        rs.bolotin_chart(system, 0.0, bad)
    with pytest.raises(ValueError, match=r"`rows` must be (a real number )?in \[8, 100000\], got"):
        rs.bolotin_chart(system, 0.0, 1.0, bad)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: rs.bolotin_chart(s, 0.0, 0.0), r"`largest_pulsating_load` must be in \(0, inf"),
        (lambda s: rs.bolotin_chart(s, 0.0, 1.0, 7), r"`rows` must be in \[8, 100000\], got 7"),
        (lambda s: rs.bolotin_chart(s, 0.0, 1.0, 9.5), "`rows` must be a whole number .* got 9.5"),
        (lambda s: rs.bolotin_chart(s, [0.0], 1.0), "`static_load` must be a single number"),
        (
            lambda s: rs.bolotin_chart(s.at_speed([1.0, 2.0]), 0.0, 1.0),
            r"`system` must have one spin speed, .*\(2,\)",
        ),
        (
            lambda s: rs.in_bolotin_region(s, 0.0, 0.0, -1.0),
            r"`excitation_frequency` must be in \[0, inf\), got -1",
        ),
        (
            lambda s: rs.in_bolotin_region(rs.lumped(BASE, 0.0, 0.0, 0.1), 0.0, 0.0, 1.0),
            "`system` must be undamped",
        ),
        (
            lambda s: rs.boundary_frequencies(rs.lumped(BASE, 1.0, stiffness="exact"), 1.0, 30.0),
            r"`static_load` \+ \|`pulsating_load`\| must be below the pole",
        ),
    ],
)
def test_bad_arguments_are_named(call, message):
    with pytest.raises(ValueError, match=message):
        call(rs.lumped(BASE, 1.0))


def test_the_mask_wants_rows_and_columns():
    system = rs.lumped(rs.BASE_CASE, 2.0)
    with pytest.raises(ValueError, match="`pulsating_loads` must be one-dimensional"):
        rs.bolotin_mask(system, 0.5, 1.0, [1.0, 2.0])
    with pytest.raises(ValueError, match="`excitation_frequencies` must be one-dimensional"):
        rs.bolotin_mask(system, 0.5, [1.0], 2.0)
    with pytest.raises(ValueError, match="`largest_pulsating_load` must be a single number"):
        rs.bolotin_chart(system, 0.5, [1.0, 2.0])
    assert rs.bolotin_chart(system, 0, np.int64(1)).names == ("1B", "1F", "2B", "2F")
