"""The buckling load of any rotor against Euler's and other exact loads."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorstab import AxialLoad, Bearing, Rotor, ShaftSection
from tests.testing.rotors import FRISWELL_597, OIL_FILM, STEEL, UNEQUAL

THIN = ShaftSection(1.0, 0.01, STEEL, shear_coefficient=math.inf)
EI = THIN.properties.bending


@pytest.mark.parametrize("mu", [0.0, 0.25, 0.4])
def test_a_partly_tangential_load_buckles_where_theory_says(mu):
    """Of a cantilever: cos √p = −μ/(1 − μ), p in EI/L²."""
    rotor = Rotor((THIN,), clamps=(0.0,), load=AxialLoad(tangency=mu))
    exact = math.acos(-mu / (1 - mu)) ** 2
    assert rotor.critical_load(20) / EI == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("mu", [0.55, 0.7, 1.0])
@pytest.mark.parametrize("elements", [6, 20, 40])
def test_a_follower_load_does_not_buckle(mu, elements):
    rotor = Rotor((THIN,), clamps=(0.0,), load=AxialLoad(tangency=mu))
    assert rotor.critical_load(elements) == math.inf


@pytest.mark.parametrize(
    ("clamps", "places", "exact"),
    [
        ((), (0.0, 1.0), math.pi**2),
        ((0.0,), (1.0,), 20.1907286),  # tan k = k
        ((0.0, 1.0), (), 4 * math.pi**2),
        ((), (0.0, 0.5, 1.0), 4 * math.pi**2),
    ],
)
def test_euler_s_columns(clamps, places, exact):
    rigid = 1e6 * EI
    rotor = Rotor((THIN,), bearings=tuple(Bearing(x, rigid) for x in places), clamps=clamps)
    assert rotor.critical_load(24) / EI == pytest.approx(exact, rel=2e-5)


def test_soft_bearings_let_a_stiff_shaft_turn():
    """A rigid bar on two springs k under compression turns at p = kL/2."""
    stiff = ShaftSection(1.0, 0.5, STEEL)
    rotor = Rotor((stiff,), bearings=(Bearing(0.0, 1e3), Bearing(1.0, 1e3)))
    assert rotor.critical_load() == pytest.approx(500.0, rel=1e-5)


def test_the_softer_direction_decides():
    soft = replace(FRISWELL_597, bearings=(Bearing(0.0, 0.6e6), Bearing(1.5, 0.6e6)))
    assert UNEQUAL.critical_load() == pytest.approx(soft.critical_load(), rel=1e-9)


def test_cross_coupling_counts_with_its_symmetric_part():
    """Turned by 45°, bearings of unequal stiffness are equal ones with kxy = kyx."""
    turned = tuple(Bearing(x, 0.8e6, kxy=0.2e6, kyx=0.2e6) for x in (0.0, 1.5))
    rotor = replace(FRISWELL_597, bearings=turned)
    assert rotor.critical_load() == pytest.approx(UNEQUAL.critical_load(), rel=1e-9)
    skew = tuple(Bearing(x, 0.6e6, kxy=3e5, kyx=-3e5) for x in (0.0, 1.5))
    rotor = replace(FRISWELL_597, bearings=skew)
    assert rotor.critical_load() == pytest.approx(UNEQUAL.critical_load(), rel=1e-9)
    assert np.isfinite(OIL_FILM.critical_load())


@pytest.mark.parametrize(
    "bearings",
    [(), (Bearing(0.5, 1e6),), (Bearing(0.5, 1e6), Bearing(0.5, 1e6)), (Bearing(0.0, 0.0),)],
    ids=["none", "one", "two at one place", "without stiffness"],
)
def test_a_rotor_that_nothing_holds_has_no_buckling_load(bearings):
    with pytest.raises(ValueError, match="`rotor` must be held by clamps or bearings"):
        Rotor((THIN,), bearings=bearings).critical_load()


def test_a_rotor_held_in_one_direction_only_has_none():
    bearings = tuple(Bearing(x, 1e6, kyy=0.0) for x in (0.0, 1.0))
    with pytest.raises(ValueError, match="`rotor` must be held"):
        Rotor((THIN,), bearings=bearings).critical_load()


def test_a_negative_stiffness_is_told():
    bearings = (Bearing(0.0, 1e6), Bearing(0.5, -1e9), Bearing(1.0, 1e6))
    with pytest.raises(ValueError, match="`rotor` must have a positive stiffness at rest"):
        Rotor((THIN,), bearings=bearings).critical_load()
