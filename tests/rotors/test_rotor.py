"""The rotor and the checks of its arguments."""

import math

import numpy as np
import pytest

import rotorstab as rs

FIELDS = ("shear", "disk_mass", "diametral_inertia", "polar_inertia", "slenderness")


def test_base_case_is_the_papers():
    # r = 0.08 and E/κG = 3: Φ = r²E/(κG)
    assert rs.BASE_CASE.shear == pytest.approx(3 * rs.BASE_CASE.slenderness**2, rel=1e-15)
    assert rs.ShaftDisk() == rs.BASE_CASE
    assert rs.EULER_BERNOULLI_TWIN.shear == 0.0


def test_table_1():
    rotor, scales = rs.ShaftDisk.from_si(**rs.TABLE_1_SI)
    # Table 1 made non-dimensional by hand (docs/theory.md)
    assert scales.mass == pytest.approx(1.20637, abs=5e-6)
    assert rotor.shear == pytest.approx(2.92191e-4, abs=5e-10)
    assert rotor.disk_mass == pytest.approx(1.161334, abs=5e-7)
    assert rotor.diametral_inertia == pytest.approx(0.0450939, abs=5e-8)
    assert rs.critical_load(rotor.shear) * scales.load == pytest.approx(16034, abs=0.5)
    at_rest = rs.lumped(rotor, 0.0)
    frequencies = rs.whirl_frequencies(at_rest, 0.0).real[2:] * scales.frequency
    # 159.805 rad/s is the paper's own number
    assert frequencies == pytest.approx([159.805, 1019.46], abs=5e-3)
    assert rs.fundamental_frequency(at_rest) * scales.frequency == pytest.approx(159.805, abs=5e-4)
    half = rs.whirl_frequencies(at_rest, 0.5 * rs.critical_load(rotor.shear))
    assert half.real[2:] * scales.frequency == pytest.approx([113.452, 999.53], abs=5e-3)


def test_scales_give_the_si_rotor_back():
    rotor, scales = rs.ShaftDisk.from_si(**rs.TABLE_1_SI)
    table = rs.TABLE_1_SI
    assert scales.length == table["length"]
    assert rotor.disk_mass * scales.mass == pytest.approx(table["disk_mass"], rel=1e-14)
    assert rotor.polar_inertia * scales.mass * scales.length**2 == pytest.approx(
        table["polar_inertia"], rel=1e-14
    )
    assert rotor.slenderness * scales.length == pytest.approx(table["diameter"] / 4, rel=1e-14)
    # frequency² = load/(mass · length)
    assert scales.frequency**2 == pytest.approx(scales.load / (scales.mass * scales.length))


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("bad", [math.nan, math.inf, -1.0])
def test_a_bad_number_is_refused_with_its_name_and_range(field, bad):
    with pytest.raises(ValueError, match=rf"`{field}` must be .*\[0, (1|inf)\), got"):
        rs.ShaftDisk(**{field: bad})


@pytest.mark.parametrize(
    "bad", [True, "0.1", 1j, None, [0.1, [0.2]], {}, 10**5000], ids=lambda bad: type(bad).__name__
)
def test_what_is_no_real_number_is_refused(bad):
    with pytest.raises(
        ValueError, match=r"`shear` must be a real number in \[0, 1\), got .{1,60}$"
    ):
        rs.ShaftDisk(shear=bad)


def test_an_array_is_no_rotor():
    with pytest.raises(ValueError, match=r"`disk_mass` must be a single number, .*\(2,\)"):
        rs.ShaftDisk(disk_mass=[1.0, 2.0])


@pytest.mark.parametrize("name", sorted(rs.TABLE_1_SI))
def test_from_si_refuses_a_negative_value(name):
    with pytest.raises(ValueError, match=rf"`{name}` must be in .*, got -1"):
        rs.ShaftDisk.from_si(**{**rs.TABLE_1_SI, name: -1.0})


def test_shear_of_one_is_out_of_range():
    with pytest.raises(ValueError, match=r"`shear` must be in \[0, 1\), got 1$"):
        rs.ShaftDisk(shear=1.0)


def test_integers_and_numpy_scalars_become_floats():
    rotor = rs.ShaftDisk(shear=np.float32(0.5), disk_mass=3, polar_inertia=np.int64(2))
    assert all(type(getattr(rotor, name)) is float for name in FIELDS)
    assert rotor.disk_mass == 3.0


def test_a_rotor_is_frozen_and_hashable():
    with pytest.raises(AttributeError, match="cannot assign"):
        rs.ShaftDisk().shear = 0.1
    assert hash(rs.ShaftDisk()) == hash(rs.BASE_CASE)
