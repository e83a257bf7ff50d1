"""The exact shape of the loaded shaft against its differential equations and in limits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorstab import ShaftDisk, exact_stiffness, shaft_shape

ROTOR = ShaftDisk()


@given(
    shear=st.sampled_from([0.0, 1e-9, 0.0192, 0.1]),
    load=st.one_of(st.sampled_from([0.0, 1e-12, -1e-12, 1e-5]), st.floats(-40, 7)),
    tip=st.tuples(st.floats(-2, 2), st.floats(-2, 2)),
)
def test_shape_meets_both_ends_the_equations_and_the_stiffness(shear, load, tip):
    rotor = ShaftDisk(shear=shear)
    shape = shaft_shape(rotor, load, tip, 41)
    v, gamma = shape.displacement, shape.slope
    scale = 1e-9 * (1 + abs(np.array(tip)).max())
    assert abs(v[0]) + abs(gamma[0]) < scale
    np.testing.assert_allclose([v[-1], gamma[-1]], tip, rtol=0, atol=scale)
    fine = shaft_shape(rotor, load, tip, 2001)
    h = fine.position[1]
    first, second = (
        lambda y: (y[:-4] - 8 * y[1:-3] + 8 * y[3:-1] - y[4:]) / (12 * h),
        lambda y: (-y[:-4] + 16 * y[1:-3] - 30 * y[2:-2] + 16 * y[3:-1] - y[4:]) / (12 * h * h),
    )
    v, gamma = fine.displacement, fine.slope
    # Eq. (A4) times Φ, Eq. (A5) integrated, with the tip force of Eq. (A9)
    force, moment = exact_stiffness(load, shear) @ np.array(tip)
    strain = first(v) - gamma[2:-2]
    rough = 1e-4 * (1 + abs(np.array(tip)).max()) * (1 + abs(load))
    np.testing.assert_allclose(shear * second(gamma) + strain, 0, atol=rough)
    np.testing.assert_allclose(
        (1 - shear * load) * first(v) - gamma[2:-2], shear * force, rtol=0, atol=rough
    )
    # Eq. (A8)
    slope = (25 * gamma[-1] - 48 * gamma[-2] + 36 * gamma[-3] - 16 * gamma[-4] + 3 * gamma[-5]) / (
        12 * h
    )
    assert slope == pytest.approx(moment, abs=rough)


def test_shape_in_limits_and_in_bulk():
    # no load, no shear: the cubic
    x = np.linspace(0, 1, 5)
    cubic = shaft_shape(ShaftDisk(shear=0.0), 0.0, [1.0, 1.5], 5)
    np.testing.assert_allclose(cubic.displacement, (3 * x**2 - x**3) / 2, atol=1e-14)
    tips = np.array([[1 + 2j, 0.5], [0, 1j]])
    many = shaft_shape(ROTOR, 1.2, tips, 9)
    assert many.displacement.shape == (2, 9)
    for row, tip in zip(many.displacement, tips, strict=True):
        one = shaft_shape(ROTOR, 1.2, tip, 9).displacement
        np.testing.assert_allclose(row, one, atol=1e-15)
    with pytest.raises(ValueError, match="pole"):
        shaft_shape(ROTOR, 30.0, [1.0, 1.0])
    with pytest.raises(ValueError, match="`tip_state` must hold"):
        shaft_shape(ROTOR, 1.0, [1.0, np.nan])
    with pytest.raises(ValueError, match="`points` must be a whole number"):
        shaft_shape(ROTOR, 0.5, (1.0, 0.0), points=7.5)
