"""The finite elements of any rotor against published values, exact limits and real matrices."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotorstab import (
    TABLE_1_SI,
    AxialLoad,
    Bearing,
    Disk,
    Material,
    Rotor,
    ShaftDisk,
    ShaftSection,
    Sleeve,
    finite_element,
    flutter_load,
    fundamental_frequency,
    growth_rate,
    resonances,
    whirl_frequencies,
)
from rotorstab.model.finite_element import first_modes
from tests.testing.rotors import (
    FRISWELL_597,
    FRISWELL_599,
    FRISWELL_681,
    OIL_FILM,
    SHAFT,
    STEEL,
    UNEQUAL,
    real_frequencies,
    real_matrices,
    rpm,
    steel_disk,
)


def slowest(system, load, count):
    return np.sort(np.abs(whirl_frequencies(system, load).real))[:count]


# Friswell et al. 2010; tension is a negative load
@pytest.mark.parametrize(
    ("rotor", "speed", "load", "unit", "printed", "allowed"),
    [
        (FRISWELL_597, 0.0, -1e5, math.tau, (15.020440, 46.132265, 120.620287), 6e-7),
        (
            FRISWELL_597,
            rpm(4000),
            -1e5,
            math.tau,
            (14.867629, 15.156882, 42.570013, 49.325073, 100.969101, 139.063735),
            6e-7,
        ),
        (FRISWELL_599, rpm(4000), 0.0, 1.0, (76.19, 103.91, 565.99, 634.23, 647.75), 5e-3),
        (FRISWELL_681, 0.0, 0.0, 1.0, (44.322, 397.537), 5e-4),
        (FRISWELL_681, rpm(1000), 0.0, 1.0, (42.250, 46.404, 389.801, 402.327), 5e-4),
    ],
)
def test_frequencies_of_the_book(rotor, speed, load, unit, printed, allowed):
    count = len(printed) * (2 if speed == 0 else 1)
    ours = slowest(rotor.system(speed), load, count) / unit
    # at rest a forward and a backward whirl have one frequency
    assert ours[:: count // len(printed)] == pytest.approx(printed, abs=allowed)


def test_frequencies_of_the_example_of_ross():
    """Rotor.run_modal of ROSS 2 documents 91.79655318 and 96.28899977 rad/s for this rotor."""
    rotor = Rotor(
        (SHAFT,),
        (steel_disk(0.5, 0.28), steel_disk(1.0, 0.28)),
        (Bearing(0.0, kxx=1e6, kyy=0.8e6), Bearing(1.5, kxx=1e6, kyy=0.8e6)),
    )
    ours = np.unique(slowest(rotor.system(0.0), 0.0, 4).round(8))
    assert ours == pytest.approx([91.79655318, 96.28899977], abs=5e-9)


def test_the_last_frequency_of_example_599():
    assert slowest(FRISWELL_599.system(rpm(4000)), 0.0, 6)[5] == pytest.approx(1174.2, abs=0.05)


def test_a_tongue_of_the_overhung_rotor():
    """A separate code of the same model, reduced to six free modes at rest."""
    buckling = FRISWELL_599.critical_load()
    assert buckling == pytest.approx(206435.6, abs=0.05)
    system = first_modes(FRISWELL_599.system(rpm(4000)), 0.0, 6)
    tongue = resonances(system, 0.3 * buckling, 0.1 * buckling)["1B+1F"]
    assert tongue.centre / math.tau == pytest.approx(24.3524, abs=5e-5)
    growth = growth_rate(system, 0.3 * buckling, 0.1 * buckling, tongue.centre)
    assert growth == pytest.approx(2.49777, abs=5e-6)


def table_1(tangency):
    si = dict(TABLE_1_SI)
    material = Material(si["youngs_modulus"], si["shear_modulus"], si["density"])
    section = ShaftSection(
        si["length"], si["diameter"], material, shear_coefficient=si["shear_coefficient"]
    )
    disk = Disk(si["length"], si["disk_mass"], si["diametral_inertia"], si["polar_inertia"])
    return Rotor((section,), (disk,), clamps=(0.0,), load=AxialLoad(tangency=tangency))


@pytest.mark.parametrize("tangency", [0.0, 0.7])
def test_the_papers_cantilever_is_a_special_case(tangency):
    shaft, scales = ShaftDisk.from_si(**TABLE_1_SI)
    ours = table_1(tangency).system(100.0, elements=20)
    other = finite_element(shaft, 100.0 / scales.frequency, tangency, elements=20)
    # one coordinate of v and one of γ in turn: lengths and angles
    scale = np.tile([scales.length, 1.0], ours.size // 2)
    for name, unit in (
        ("mass", scales.mass),
        ("gyroscopic", scales.mass),
        ("elastic", scales.load / scales.length),
        ("geometric", 1 / scales.length),
    ):
        made = getattr(ours, name) * scale[:, None] * scale / scales.length**2 / unit
        wanted = getattr(other, name)
        assert made == pytest.approx(wanted, rel=1e-11, abs=1e-13 * np.abs(wanted).max())


@pytest.mark.parametrize("load", [-2e4, 0.0, 5e4])
@pytest.mark.parametrize("rotor", [UNEQUAL, OIL_FILM], ids=["stiffness", "oil film"])
def test_two_planes_have_the_frequencies_of_real_matrices(rotor, load):
    system = rotor.system(rpm(3000))
    assert system.planes
    ours = whirl_frequencies(system, load)
    other = real_frequencies(*real_matrices(rotor, rpm(3000), load))
    assert len(ours) == len(other)
    distance = np.abs(ours[:, None] - other)
    size = np.abs(other).max()
    assert distance.min(axis=0).max() < 1e-7 * size
    slow = np.abs(other) < 500
    assert slow.sum() >= 8
    assert distance.min(axis=0)[slow].max() < 1e-6


@pytest.mark.parametrize("cross", [0.0, 2e5, -2e5])
def test_an_isotropic_rotor_is_the_same_in_complex_coordinates_and_in_two_planes(cross):
    def rotor(kyy):
        bearings = tuple(
            Bearing(x, 1e6, kyy, kxy=cross, kyx=-cross, cxx=50.0, cxy=3.0, cyx=-3.0)
            for x in (0.0, 1.5)
        )
        return replace(FRISWELL_597, bearings=bearings)

    complex_form = rotor(1e6).system(rpm(3000))
    planes = rotor(1e6 * (1 + 1e-13)).system(rpm(3000))
    assert not complex_form.planes
    assert planes.planes
    assert planes.size == 2 * complex_form.size
    whirl = whirl_frequencies(complex_form, 1e4)
    both = np.concatenate([whirl, -whirl.conj()])
    ours = whirl_frequencies(planes, 1e4)
    slow = np.abs(both) < 1000
    assert np.abs(both[slow, None] - ours).min(axis=1).max() < 1e-5
    # a force against the displacement ahead of it, F_x = −kxy y, drives the forward whirl
    first = whirl[(whirl.real > 0) & (whirl.real < 200)]
    damped = abs(cross) / np.abs(first.real) < 50.0
    assert ((first.imag > 0) == (damped | (cross < 0))).all()


@pytest.fixture(scope="module")
def unequal_case():
    """The second whirls of each direction, far apart by the gyroscopic moments."""
    buckling = UNEQUAL.critical_load()
    return rpm(4000), 0.2 * buckling, 0.05 * buckling


def second_pair(system, static):
    whirl = whirl_frequencies(system, static).real
    return np.sort(np.unique(np.abs(whirl).round(6)))[2:4]


def test_tongues_at_twice_a_frequency_appear_with_unequal_bearings(unequal_case):
    speed, static, pulsating = unequal_case
    unequal, sister = (one.system(speed, modes=4) for one in (UNEQUAL, FRISWELL_597))
    low, high = second_pair(sister, static)
    assert growth_rate(sister, static, pulsating, low + high) > 0.5
    assert growth_rate(sister, static, pulsating, [2 * low, 2 * high]).max() < 1e-6
    low, high = second_pair(unequal, static)
    assert growth_rate(unequal, static, pulsating, [2 * low, 2 * high]).min() > 0.1


def test_growth_with_unequal_bearings_is_that_of_real_matrices(unequal_case):
    """Method against method: monodromy by DOP853 in the real coordinates of the reduced rotor."""
    speed, static, pulsating = unequal_case
    system = UNEQUAL.system(speed, modes=4)
    n = system.size // 2
    excitation = 2 * second_pair(system, static)[0]
    ours = growth_rate(system, static, pulsating, excitation)
    # the second half of the coordinates is jy
    spin = speed * system.gyroscopic[:n, n:]
    zero = np.zeros((n, n))
    inverse = np.linalg.inv(system.mass)
    damping = inverse @ np.block([[zero, spin], [-spin.T, zero]])
    period = math.tau / excitation

    def rate(time, state):
        load = static + pulsating * math.cos(excitation * time)
        stiffness = inverse @ (system.elastic + load * system.geometric)
        motion = state.reshape(4 * n, -1)
        return np.concatenate(
            [motion[2 * n :], -damping @ motion[2 * n :] - stiffness @ motion[: 2 * n]]
        ).ravel()

    end = solve_ivp(rate, (0, period), np.eye(4 * n).ravel(), "DOP853", rtol=1e-10, atol=1e-10)
    multipliers = np.linalg.eigvals(end.y[:, -1].reshape(4 * n, 4 * n))
    assert ours == pytest.approx(np.log(np.abs(multipliers).max()) / period, rel=1e-5)


@pytest.mark.parametrize(
    ("tangency", "exact"),
    [(0.5, 16.0525), (1.0, 20.0510)],  # Beck 1952; the partly tangential column: exact determinant
)
def test_a_follower_load_flutters_where_theory_says(tangency, exact):
    thin = ShaftSection(1.0, 0.002, STEEL, shear_coefficient=math.inf)
    rotor = Rotor((thin,), clamps=(0.0,), load=AxialLoad(tangency=tangency))
    bending = thin.properties.bending
    load = flutter_load(rotor.system(0.0, elements=10), 25 * bending)
    assert load / bending == pytest.approx(exact, rel=1e-4)


def test_a_hollow_section_and_a_sleeve_are_one_tube():
    """A tube in two layers has the stiffness and the mass of the tube, without shear."""
    thick = ShaftSection(1.0, 0.1, STEEL, inner_diameter=0.04, shear_coefficient=math.inf)
    layered = ShaftSection(
        1.0,
        0.06,
        STEEL,
        inner_diameter=0.04,
        shear_coefficient=math.inf,
        sleeves=(Sleeve(0.1, 0.06, STEEL, math.inf),),
    )
    one, two = (
        Rotor((section,), clamps=(0.0,)).system(50.0, elements=8) for section in (thick, layered)
    )
    for name in ("mass", "gyroscopic", "elastic"):
        assert getattr(two, name) == pytest.approx(getattr(one, name), rel=1e-12)


def test_cutting_a_section_in_two_changes_nothing():
    whole = FRISWELL_597.system(rpm(2000), elements=6)
    halves = replace(FRISWELL_597, sections=(replace(SHAFT, length=0.75),) * 2)
    cut = halves.system(rpm(2000), elements=3)
    assert cut.size == whole.size
    for name in ("mass", "gyroscopic", "elastic", "geometric"):
        assert getattr(cut, name) == pytest.approx(getattr(whole, name), rel=1e-9)


def test_stations_that_differ_by_rounding_are_one():
    rotor = replace(FRISWELL_597, disks=(Disk(0.1 + 0.2, 1.0, 0.0, 0.0), Disk(0.3, 1.0, 0.0, 0.0)))
    single = replace(FRISWELL_597, disks=(Disk(0.3, 2.0, 0.0, 0.0),))
    ours, other = (one.system(0.0).mass for one in (rotor, single))
    assert ours == pytest.approx(other, rel=1e-12)


def test_the_load_stiffens_only_the_shaft_between_its_ends():
    rotor = replace(FRISWELL_597, load=AxialLoad(start=0.5, end=1.0))
    geometric = rotor.system(0.0).geometric
    # nodes every 0.25 m: 0.5 m is node 2, 1.0 m is node 4
    assert not geometric[:4].any()
    assert not geometric[10:].any()
    assert np.count_nonzero(np.diag(geometric)) == 6


def test_a_load_from_right_to_left_is_the_mirror_image():
    left = table_1(0.6)
    right = replace(
        left,
        disks=(replace(left.disks[0], position=0.0),),
        clamps=(0.5,),
        load=AxialLoad(start=0.5, end=0.0, tangency=0.6),
    )
    load = 0.4 * left.critical_load() if math.isfinite(left.critical_load()) else 6000.0
    ours, other = (whirl_frequencies(one.system(80.0, 5), load) for one in (right, left))
    assert ours.real == pytest.approx(other.real, rel=1e-8)


def test_a_rotor_that_nothing_holds_moves_as_a_rigid_body():
    free = replace(FRISWELL_597, bearings=())
    system = free.system(0.0)
    frequencies = np.sort(np.abs(whirl_frequencies(system, 0.0)))
    assert frequencies[3] < 1e-2 * frequencies[5]
    reduced = np.sort(np.abs(whirl_frequencies(free.system(0.0, modes=6), 0.0)))
    assert reduced[5] == pytest.approx(frequencies[5], rel=1e-2)
    assert np.isfinite(growth_rate(free.system(rpm(500), modes=4), -1e4, 1e3, 40.0))


def test_spin_speeds_broadcast():
    speeds = np.array([0.0, 100.0, 300.0])
    together = whirl_frequencies(UNEQUAL.system(speeds, modes=3), 1e4)
    assert together.shape == (3, 12)
    for speed, row in zip(speeds, together, strict=True):
        alone = whirl_frequencies(UNEQUAL.system(speed, modes=3), 1e4)
        assert np.sort(row.real) == pytest.approx(np.sort(alone.real), abs=1e-6)


def test_too_many_elements_are_refused():
    sections = (replace(SHAFT, length=0.01),) * 100
    rotor = Rotor(sections, clamps=(0.0,))
    with pytest.raises(
        ValueError, match=r"`elements` = 6 gives 600 elements, more than 400: take 4 or fewer"
    ):
        rotor.system(0.0)
    assert fundamental_frequency(rotor.system(0.0, elements=1)) > 0
    with pytest.raises(ValueError, match="gives 500 elements"):
        FRISWELL_597.system(0.0, elements=500)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"elements": 0}, r"`elements` must be in \[1, inf\), got 0"),
        ({"elements": 1.5}, r"`elements` must be a whole number in \[1, inf\), got 1.5"),
        ({"modes": 0}, r"`modes` must be in \[1, 14\], got 0"),
        ({"modes": 15}, r"`modes` must be in \[1, 14\], got 15"),
        ({"spin_speed": math.nan}, r"`spin_speed` must be in \[-1e\+09, 1e\+09\], got nan"),
    ],
)
def test_bad_arguments_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        FRISWELL_597.system(**{"spin_speed": 0.0, **change})


def test_parts_of_sizes_too_far_apart_are_told():
    foil = ShaftSection(1e-6, 1e4, STEEL, shear_coefficient=math.inf)
    with pytest.raises(ValueError, match="`rotor` must have lengths, diameters, masses"):
        Rotor((foil,)).system(0.0, elements=1)


def test_a_stocky_shaft_takes_the_load_that_buckles_it():
    rotor = Rotor((ShaftSection(2.0, 1.0, STEEL),), clamps=(0.0, 2.0))
    buckling = rotor.critical_load()
    assert buckling > 1e9
    whirl = whirl_frequencies(rotor.system(0.0, modes=4), 0.99 * buckling)
    assert np.isfinite(whirl).all()


def test_a_shaft_without_a_free_coordinate_is_refused():
    with pytest.raises(ValueError, match="`elements` must leave a free coordinate, got 1"):
        Rotor((SHAFT,), clamps=(0.0, 1.5)).system(0.0, elements=1)
