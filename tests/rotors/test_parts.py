"""The parts of a rotor: their checks, section properties and shear coefficients."""

import math

import pytest

from rotorstab import AxialLoad, Bearing, Disk, Material, Rotor, ShaftSection, Sleeve
from rotorstab.rotors.materials import shear_coefficient
from tests.testing.rotors import SHAFT, STEEL

SECTION = {"length": 1.0, "outer_diameter": 0.05, "material": STEEL}
BEARING = {"position": 0.0, "kxx": 1e6}
DISK = {"position": 0.5, "mass": 1.0, "diametral_inertia": 0.1, "polar_inertia": 0.2}
KINDS = {ShaftSection: SECTION, Bearing: BEARING, Disk: DISK}


def test_shear_coefficient_of_the_book_is_cowper_s():
    # Friswell et al. 2010 print κ = 0.8863064 for this steel
    assert SHAFT.shear_coefficient == pytest.approx(0.8863064, abs=5e-8)


@pytest.mark.parametrize("poisson", [0.0, 0.25, 0.3, 0.5])
@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.8, 0.999])
def test_shear_coefficient_of_a_hollow_section(poisson, ratio):
    """As Cowper 1966 prints it, with m the ratio of the radii."""
    square = ratio**2
    printed = (
        6
        * (1 + poisson)
        * (1 + square) ** 2
        / ((7 + 6 * poisson) * (1 + square) ** 2 + (20 + 12 * poisson) * square)
    )
    assert shear_coefficient(2 * (1 + poisson), 1.0, ratio) == pytest.approx(printed, rel=1e-13)


def test_properties_of_a_tube_with_a_sleeve():
    aluminium = Material(70e9, 27e9, 2700.0)
    section = ShaftSection(
        **SECTION, inner_diameter=0.03, sleeves=(Sleeve(0.08, 0.06, aluminium, 0.5),)
    )
    found = section.properties
    inner_moment = math.pi * (0.05**4 - 0.03**4) / 64
    outer_moment = math.pi * (0.08**4 - 0.06**4) / 64
    outer_area = math.pi * (0.08**2 - 0.06**2) / 4
    inner_area = math.pi * (0.05**2 - 0.03**2) / 4
    assert found.bending == pytest.approx(211e9 * inner_moment + 70e9 * outer_moment)
    assert found.mass == pytest.approx(7810 * inner_area + 2700 * outer_area)
    assert found.inertia == pytest.approx(7810 * inner_moment + 2700 * outer_moment)
    shear = section.shear_coefficient * 81.2e9 * inner_area + 0.5 * 27e9 * outer_area
    assert found.shear == pytest.approx(shear)


def test_a_bearing_is_the_same_in_both_directions_by_default():
    bearing = Bearing(0.0, kxx=1e6, cxx=50.0)
    assert (bearing.kyy, bearing.cyy) == (1e6, 50.0)
    assert bearing.is_isotropic
    assert Bearing(0.0, 1e6, kxy=2e5, kyx=-2e5, cxy=3.0, cyx=-3.0).is_isotropic
    for change in ({"kyy": 2e6}, {"kxy": 1.0}, {"cyy": 1.0}, {"cxy": 1.0, "cyx": 1.0}):
        assert not Bearing(0.0, 1e6, **change).is_isotropic


@pytest.mark.parametrize(
    ("kind", "change", "message"),
    [
        (ShaftSection, {"length": 0.0}, r"`length` must be in \[1e-06, 1e\+06\], got 0"),
        (ShaftSection, {"outer_diameter": -1.0}, r"`outer_diameter` must be in .*, got -1"),
        (
            ShaftSection,
            {"inner_diameter": 0.05},
            r"`inner_diameter` must be smaller than `outer_diameter` = 0.05, got 0.05",
        ),
        (ShaftSection, {"material": "steel"}, "`material` must be a Material, got str"),
        (ShaftSection, {"shear_coefficient": 0.0}, r"`shear_coefficient` must be in \(0, 1\]"),
        (ShaftSection, {"sleeves": (SHAFT,)}, "`sleeves` must hold Sleeves, got ShaftSection"),
        (Bearing, {"kxx": math.nan}, r"`kxx` must be in .*, got nan"),
        (Bearing, {"cyx": math.inf}, r"`cyx` must be in .*, got inf"),
        (Bearing, {"position": -0.1}, r"`position` must be in \[0, inf\), got -0.1"),
        (Disk, {"mass": -1.0}, r"`mass` must be in .*, got -1"),
        (Disk, {"polar_inertia": "0.2"}, r"`polar_inertia` must be a real number"),
    ],
)
def test_bad_parts_are_refused(kind, change, message):
    with pytest.raises(ValueError, match=message):
        kind(**{**KINDS[kind], **change})


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((0.0, 1e11, 7800.0), r"`youngs_modulus` must be in"),
        ((2e11, math.nan, 7800.0), r"`shear_modulus` must be in"),
        ((2e11, 8e10, -1.0), r"`density` must be in"),
    ],
)
def test_bad_materials_are_refused(values, message):
    with pytest.raises(ValueError, match=message):
        Material(*values)


def test_a_material_that_is_not_isotropic_needs_its_own_coefficient():
    fibre = Material(140e9, 5e9, 1600.0)
    with pytest.raises(ValueError, match="`youngs_modulus` must be at most 3 `shear_modulus`"):
        ShaftSection(1.0, 0.05, fibre)
    assert ShaftSection(1.0, 0.05, fibre, shear_coefficient=0.5).shear_coefficient == 0.5


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"sections": ()}, "`sections` must hold one ShaftSection or more, got none"),
        ({"sections": (1.0,)}, "`sections` must hold objects of ShaftSection, got float"),
        ({"disks": (Disk(1.6, 1, 0, 0),)}, r"`disks\[0\].position` must be in \[0, 1.5\], got 1.6"),
        (
            {"bearings": (Bearing(0, 1), Bearing(2, 1))},
            r"`bearings\[1\].position` must be in \[0, 1.5\], got 2",
        ),
        ({"clamps": (-0.5,)}, r"`clamps\[0\]` must be in \[0, 1.5\], got -0.5"),
        ({"load": AxialLoad(end=9.0)}, r"`load.end` must be in \[0, 1.5\], got 9"),
        ({"load": AxialLoad(start=1.5)}, "`load.start` and `load.end` must be two points"),
        ({"load": 100.0}, "`load` must be an AxialLoad, got float"),
    ],
)
def test_bad_rotors_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        Rotor(**{"sections": (SHAFT,), **change})


def test_bad_loads_are_refused():
    with pytest.raises(ValueError, match=r"`tangency` must be in \[0, 1\], got 1.5"):
        AxialLoad(tangency=1.5)
    with pytest.raises(ValueError, match=r"`end` must be in \[0, inf\), got -1"):
        AxialLoad(end=-1.0)


def test_a_rotor_is_a_value():
    one, two = (
        Rotor([SHAFT], disks=[Disk(0.5, 1.0, 0.1, 0.2)], bearings=[Bearing(0.0, 1e6)], clamps=[1.5])
        for _ in range(2)
    )
    assert one == two
    assert hash(one) == hash(two)
    assert one.length == one.load_end == 1.5


def test_a_position_beyond_the_end_by_rounding_is_the_end():
    sections = tuple(ShaftSection(0.1, 0.05, STEEL) for _ in range(3))
    rotor = Rotor(sections, bearings=(Bearing(0.1 + 0.2, 1e6),), clamps=(0.1 + 0.1 + 0.1,))
    assert rotor.bearings[0].position == rotor.clamps[0] == rotor.length
