"""Beck's column, with shear and rotary inertia, against its exact solution."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq, minimize_scalar

from rotorstab import ShaftDisk, beck_load, finite_element, flutter_load


def whirl_determinant(squared, load, shear, slenderness):
    """Return the tip condition's determinant of the exact shaft; state v, γ, γ′, N.

    N = T − p̄v′ is the transverse force, T = (v′ − γ)/Φ the shear force.
    """
    give = 1 - shear * load
    flow = expm(
        np.array(
            [
                [0, 1 / give, 0, shear / give],
                [0, 0, 1, 0],
                [0, -load / give - squared * slenderness**2, 0, -1 - load * shear / give],
                [-squared, 0, 0, 0],
            ]
        )
    )
    return np.linalg.det(np.array([flow[2], flow[3] + load * flow[1]])[:, 2:])


def exact_beck_load(shear, slenderness, guess):
    """Return the load at which the first two roots ω² of the exact determinant merge."""

    def largest_between(load):
        sign = np.sign(whirl_determinant(1e-6, load, shear, slenderness))
        return minimize_scalar(
            lambda squared: sign * whirl_determinant(squared, load, shear, slenderness),
            bounds=(10, 250),
            method="bounded",
            options={"xatol": 1e-10},
        ).fun

    return brentq(largest_between, 0.95 * guess, 1.05 * guess, xtol=1e-10)


@pytest.mark.parametrize(
    ("shear", "slenderness"), [(0.0, 0.0), (0.0192, 0.08), (0.0192, 0.0), (0.0, 0.08)]
)
def test_beck_load_is_the_exact_one(shear, slenderness):
    ours = beck_load(shear, slenderness)
    assert ours == pytest.approx(exact_beck_load(shear, slenderness, ours), rel=1e-7)


def test_coarse_meshes_are_already_close():
    assert beck_load(0.0192, 0.08, elements=16) == pytest.approx(12.3019566, rel=1e-5)


def test_flutter_load_finds_the_same_column():
    shaft = ShaftDisk(0.0192, 0.0, 0.0, 0.0, 0.08)
    system = finite_element(shaft, 0.0, tangency=1.0, modes=8)
    # a mesh of 20: 12.3106
    assert flutter_load(system, 20.0) == pytest.approx(12.3106, abs=5e-4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1.0, 0.0), r"`shear` must be in \[0, 1\), got 1"),
        ((0.0, -0.1), r"`slenderness` must be in \[0, 1\), got -0.1"),
        ((0.0, 0.0, 4), r"`elements` must be in \[8, 200\], got 4"),
        ((0.0, 0.0, 10), r"`elements` must be a multiple of 4 in \[8, 200\], got 10"),
    ],
)
def test_bad_arguments_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        beck_load(*arguments)
