"""Spin speeds at which a whirl is synchronous."""

import numpy as np
import pytest
from hypothesis import given, settings

import rotorstab as rs
from tests.testing.strategies import between, rotors, tangencies

BASE = rs.BASE_CASE
REFERENCE = 2.3557973  # p̄_cr of the base case


@settings(max_examples=60)
@given(rotor=rotors, load=between(-3.0, 1.9), tangency=tangencies)
def test_critical_speeds_are_synchronous_whirls(rotor, load, tangency):
    system = rs.lumped(rotor, 0.0, tangency)
    speeds = rs.critical_speeds(system, load)
    for sign, values in ((1, speeds.forward), (-1, speeds.backward)):
        assert (np.diff(values) >= 0).all()
        for speed in values:
            whirl = rs.whirl_frequencies(system.at_speed(speed), load)
            assert np.abs(whirl - sign * speed).min() < 1e-6 * np.abs(whirl).max()
            stiffness = system.stiffness(load)
            matrix = stiffness - speed**2 * (system.mass - sign * system.gyroscopic)
            scale = np.abs(stiffness).max() * max(np.abs(matrix).max(), np.abs(stiffness).max())
            assert abs(np.linalg.det(matrix)) < 1e-9 * scale


def test_number_of_critical_speeds():
    # a thin disk, Ī_P = 2 Ī_D > Ī_D, has no second forward critical speed
    speeds = rs.critical_speeds(rs.lumped(BASE, 0.0))
    assert (speeds.forward.size, speeds.backward.size) == (1, 2)
    long_disk = rs.lumped(rs.ShaftDisk(polar_inertia=0.4), 0.0)
    assert rs.critical_speeds(long_disk).forward.size == 2
    sphere = rs.lumped(rs.ShaftDisk(polar_inertia=0.8), 0.0)  # M − H is singular
    assert rs.critical_speeds(sphere).forward.size == 1
    without_gyroscopics = rs.critical_speeds(rs.lumped(rs.ShaftDisk(polar_inertia=0.0), 0.0))
    assert without_gyroscopics.forward == pytest.approx([0.64669, 2.41457], abs=5e-6)
    assert without_gyroscopics.backward == pytest.approx(without_gyroscopics.forward)


def test_critical_speeds_at_and_past_buckling():
    load = float(rs.critical_load(0.0))
    exact = rs.lumped(rs.EULER_BERNOULLI_TWIN, 0.0, stiffness="exact")
    for value in (load, 1.2 * load):
        speeds = rs.critical_speeds(exact, value)
        assert np.isfinite(speeds.forward).all()
        assert np.isfinite(speeds.backward).all()
    assert rs.critical_speeds(exact, 1.2 * load).backward.size == 1
