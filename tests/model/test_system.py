"""The system's matrices, the lumped rotor and the harmonics of the pulsating stiffness."""

import numpy as np
import pytest
from hypothesis import given
from scipy.integrate import quad

import rotorstab as rs
from rotorstab.model.stiffness import largest_exact_load
from tests.testing.strategies import between, rotors, tangencies

BASE = rs.BASE_CASE


def test_base_case_fundamental_frequency():
    # docs/theory.md, from a separate solution
    assert rs.fundamental_frequency(rs.lumped(BASE, 0.0)) == pytest.approx(0.6466913, abs=5e-8)


@given(rotor=rotors, speed=between(-4.0, 4.0), tangency=tangencies)
def test_matrices_are_those_of_the_paper(rotor, speed, tangency):
    system = rs.lumped(rotor, speed, tangency)
    # (14), (15)
    assert system.mass.tolist() == [[rotor.disk_mass, 0], [0, rotor.diametral_inertia]]
    assert system.damping()[1, 1] == pytest.approx(-1j * speed * rotor.polar_inertia)
    assert np.count_nonzero(system.damping()) <= 1
    elastic, geometric = rs.linear_stiffness(rotor.shear, tangency)
    assert system.stiffness(1.7) == pytest.approx(elastic + 1.7 * geometric)
    assert not system.is_damped


def test_exact_law():
    system = rs.lumped(BASE, 1.0, tangency=1.0, stiffness="exact")
    assert not system.is_linear
    assert system.stiffness([1.0, -2.0]) == pytest.approx(
        rs.exact_stiffness([1.0, -2.0], BASE.shear, 1.0), rel=1e-15
    )


def test_damping_matrices():
    system = rs.lumped(BASE, 2.0, external_damping=0.01, internal_damping=0.02)
    natural = rs.fundamental_frequency(system)
    assert system.is_damped
    assert system.external_damping == pytest.approx(0.02 * natural * system.mass)
    assert system.internal_damping == pytest.approx(0.04 / natural * system.elastic)
    # rotating damping acts on q̇ − jΩ̄q
    assert system.stiffness(0.0) == pytest.approx(
        system.elastic - 2j * system.internal_damping, rel=1e-15
    )


def test_speeds_broadcast_against_loads():
    system = rs.lumped(BASE, np.array([[0.5], [1.0], [2.0]]), internal_damping=0.01)
    assert system.stiffness(np.linspace(0, 1, 4)).shape == (3, 4, 2, 2)
    assert system.damping().shape == (3, 1, 2, 2)
    assert rs.lumped(BASE, []).damping().shape == (0, 2, 2)


def test_arrays_are_read_only_and_not_shared_with_the_caller():
    speeds = np.array([1.0, 2.0])
    system = rs.lumped(BASE, speeds)
    speeds[0] = 9.0
    assert system.spin_speed.tolist() == [1.0, 2.0]
    frozen = speeds[:]
    frozen.flags.writeable = False
    again = system.at_speed(frozen)
    speeds[1] = 9.0
    assert again.spin_speed.tolist() == [9.0, 2.0]
    with pytest.raises(ValueError, match="read-only"):
        system.mass[0, 0] = 1.0


@pytest.mark.parametrize("stiffness", ["linear", "exact"])
@pytest.mark.parametrize("count", [0, 1, 3])
def test_harmonics_rebuild_the_stiffness(stiffness, count):
    system = rs.lumped(BASE, 0.0, 1.0, stiffness=stiffness)
    static, pulsating = np.array([0.2, 1.0]), np.array([[0.0], [1e-9], [0.7], [-2.0], [8.0]])
    harmonics = system.load_harmonics(static, pulsating, count=count)
    assert [k.shape for k in harmonics] == [(5, 2, 2, 2)] * (count + 1)
    many = np.array(system.load_harmonics(static, pulsating, count=40))
    assert np.array(harmonics) == pytest.approx(many[: count + 1], abs=1e-12)
    for phase in (0.0, 0.8, 2.5):
        series = np.tensordot(np.cos(phase * np.arange(41)), many, 1)
        now = system.load_stiffness(static + pulsating * np.cos(phase))
        assert series == pytest.approx(now, abs=1e-9)


@pytest.mark.parametrize("share", [0.5, 0.9, 0.999, 0.999999])
def test_harmonics_stay_true_up_to_the_pole(share):
    system = rs.lumped(BASE, 0.0, stiffness="exact")
    pole = float(largest_exact_load(BASE.shear))
    pulsating = share * pole - 1.0
    mean, first = system.load_harmonics(1.0, pulsating)
    for matrix, m in ((mean, 0), (first, 1)):

        def integrand(phase, m=m):
            load = 1.0 + pulsating * np.cos(phase)
            return rs.exact_stiffness(load, BASE.shear)[1, 1] * np.cos(m * phase)

        integral = quad(integrand, 0, np.pi, epsabs=1e-10, epsrel=1e-11, limit=400, points=[0.01])[
            0
        ]
        assert matrix[1, 1] == pytest.approx((1 + m) * integral / np.pi, rel=1e-9)


def test_a_peak_load_past_the_pole_is_an_error():
    system = rs.lumped(BASE, 0.0, stiffness="exact")
    pole = float(largest_exact_load(BASE.shear))
    for pulsating in (pole, -pole, pole * (1 + 1e-12)):
        with pytest.raises(ValueError, match="must be below the pole"):
            system.load_harmonics(0.0, pulsating)


def test_harmonics_of_nothing():
    for stiffness in ("linear", "exact"):
        system = rs.lumped(BASE, 0.0, stiffness=stiffness)
        assert [k.shape for k in system.load_harmonics([], [])] == [(0, 2, 2)] * 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"spin_speed": np.nan}, r"`spin_speed` must be in \[-1e\+09, 1e\+09\], got nan"),
        ({"spin_speed": [1.0, np.inf]}, r"`spin_speed` must be in \[-1e\+09, 1e\+09\], got inf"),
        ({"spin_speed": True}, r"`spin_speed` must be a real number .*, got True"),
        ({"spin_speed": "1"}, r"`spin_speed` must be a real number .*, got '1'"),
        ({"spin_speed": 1j}, r"`spin_speed` must be a real number .*, got 1j"),
        ({"tangency": 1.1}, r"`tangency` must be in \[0, 1\], got 1.1"),
        ({"external_damping": -0.1}, r"`external_damping` must be in \[0, 1e\+09\], got -0.1"),
        ({"internal_damping": np.nan}, r"`internal_damping` must be in \[0, 1e\+09\], got nan"),
        ({"stiffness": "cubic"}, r"`stiffness` must be one of 'linear', 'exact', got 'cubic'"),
        ({"stiffness": ["linear"]}, r"`stiffness` must be one of .*, got \['linear'\]"),
        ({"rotor": rs.ShaftDisk(disk_mass=0.0)}, r"`disk_mass` must be in \(0, inf\), got 0"),
        (
            {"rotor": rs.ShaftDisk(diametral_inertia=0.0)},
            r"`diametral_inertia` must be in \(0, inf\), got 0",
        ),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        rs.lumped(**{"rotor": BASE, "spin_speed": 1.0, **arguments})


def test_a_system_may_be_made_from_lists_and_from_views():
    entries = {
        "mass": [[1, 0], [0, 2]],
        "gyroscopic": [[0, 0], [0, 1]],
        "external_damping": [[0, 0], [0, 0]],
        "internal_damping": [[0, 0], [0, 0]],
        "elastic": [[2, 0], [0, 3]],
        "geometric": [[-1, 0], [0, -1]],
        "spin_speed": 0.5,
    }
    system = rs.System(**entries)
    assert system.mass.dtype == np.float64
    assert rs.whirl_frequencies(system, 0.0).shape == (4,)
    base = np.eye(2)
    view = base[:]
    view.flags.writeable = False
    viewed = rs.System(**{**entries, "mass": view})
    base[0, 0] = 7.0
    assert viewed.mass[0, 0] == 1.0


def test_other_coordinates_change_no_frequency_and_fewer_raise_them():
    system = rs.finite_element(BASE, 2.0, 0.0, elements=3, external_damping=0.02)
    basis = np.random.default_rng(4).normal(size=(6, 6))
    there, here = (rs.whirl_frequencies(one, 0.7) for one in (system.projected(basis), system))
    assert there == pytest.approx(here, rel=1e-8)
    fewer = system.at_speed(0.0).projected(basis[:, :3])
    assert fewer.size == 3
    # Rayleigh's principle
    assert rs.fundamental_frequency(fewer) > rs.fundamental_frequency(system)


def test_the_exact_stiffness_has_no_other_coordinates():
    with pytest.raises(ValueError, match="`system` must have the linear stiffness law"):
        rs.lumped(BASE, 0.0, stiffness="exact").projected(np.eye(2))
