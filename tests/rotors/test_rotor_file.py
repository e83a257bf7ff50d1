"""Rotor files of any rotor: what is written is read again, and errors say where."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorstab import MATERIALS, AxialLoad, Bearing, Disk, Rotor, ShaftSection, Sleeve
from rotorstab.rotors.quantities import EXAMPLES, read_quantity
from rotorstab.rotors.rotor_file import RotorFileError, rotor_from_toml, rotor_to_toml
from tests.testing.rotors import FRISWELL_597, OIL_FILM, STEEL

STEPPED = Rotor(
    sections=(
        ShaftSection(0.3, 0.05, MATERIALS["steel"], shear_coefficient=math.inf),
        ShaftSection(0.7, 0.08, STEEL, 0.02, sleeves=(Sleeve(0.1, 0.08, MATERIALS["titanium"]),)),
    ),
    disks=(Disk(1.0, 3.0, 0.01, 0.02),),
    clamps=(0.0, 0.3),
    load=AxialLoad(start=0.1, end=0.9, tangency=0.25),
)
TEXT = """\
clamps = ["0 m"]

[[sections]]
length = "500 mm"
outer_diameter = "50 mm"
material = "steel"

[[disks]]
position = "0.5 m"
mass = "3 kg"
diametral_inertia = "0.01 kg m²"
polar_inertia = "200 kg cm^2"
"""


@pytest.mark.parametrize("rotor", [FRISWELL_597, OIL_FILM, STEPPED], ids=["equal", "film", "steps"])
def test_a_written_rotor_is_read_again(rotor, tmp_path):
    path = tmp_path / "rotor.toml"
    rotor.write(path)
    assert Rotor.read(path) == rotor
    assert Rotor.read(str(path)).critical_load() == rotor.critical_load()


positive = st.floats(1e-3, 1e3)


@settings(max_examples=50, deadline=None)
@given(positive, st.floats(0.0, 0.99), positive, st.floats(-1e9, 1e9), st.floats(0.0, 1.0))
def test_every_number_comes_back_to_the_last_digit(length, part, diameter, stiffness, share):
    rotor = Rotor(
        (ShaftSection(length, diameter, STEEL, part * diameter),),
        bearings=(Bearing(share * length, stiffness, cxy=stiffness),),
        load=AxialLoad(tangency=share),
    )
    assert rotor_from_toml(rotor_to_toml(rotor)) == rotor


def test_a_file_as_people_write_it():
    rotor = rotor_from_toml(TEXT)
    assert rotor.sections == (ShaftSection(0.5, 0.05, MATERIALS["steel"]),)
    assert rotor.disks == (Disk(0.5, 3.0, 0.01, 0.02),)
    assert rotor.clamps == (0.0,)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"500 mm"', "0.5", r'line 4: sections\[0\].length: must be a length in quotes, such as "'),
        ('"500 mm"', '"0 mm"', r"line 3: sections\[0\]: `length` must be in .*, got 0"),
        ('"50 mm"', '"50 Nm"', r"line 5: .*with one of the units m, cm, mm; got 'Nm'"),
        ('"50 mm"', '"50 mm 3"', "line 5: .*must be a length"),
        ('"steel"', '"cheese"', r"line 6: .* must be one of steel, aluminium, titanium, got 'che"),
        ("material", "materiel", r"line 6: sections\[0\].materiel: is unknown; allowed are length"),
        ('mass = "3 kg"\n', "", r"line 8: disks\[0\]: lacks 'mass'"),
        ('"0.5 m"', '"0.6 m"', r"line 9: disks\[0\].position: .* must be in \[0, 0.5\], got 0.6"),
        ('["0 m"]', '"0 m"', "line 1: clamps: must be a list"),
        ('["0 m"]', '["0 m", 1]', r"line 1: clamps\[1\]: must be a length .* without a unit"),
        ("[[disks]]", "[disks]", "line 8: disks: must be a list"),
        ("[[disks]]", "[[discs]]", r"line 8: discs: is unknown; a rotor file has sections"),
        ("[[sections]]", "[sections", r"the file is not TOML: .*line 3"),
        ("clamps =", "clamps = ", None),
    ],
)
def test_errors_say_where_and_what(old, new, message):
    text = TEXT.replace(old, new, 1)
    if message is None:
        assert rotor_from_toml(text)
        return
    with pytest.raises(RotorFileError, match=message) as caught:
        rotor_from_toml(text)
    assert "\n" not in str(caught.value)


def test_a_file_without_a_shaft_is_refused():
    with pytest.raises(RotorFileError, match=r"lacks \[\[sections\]\]"):
        rotor_from_toml("")
    with pytest.raises(RotorFileError, match="larger than"):
        rotor_from_toml("#" * 2_000_000)
    with pytest.raises(RotorFileError, match="must be a table of keys and values"):
        rotor_from_toml("sections = [1]")


VALUES = [
    "1",
    '"1 m"',
    '"x"',
    "nan",
    "-inf",
    "1" + "0" * 400,
    "[]",
    "{}",
    "true",
    '"1e308 m"',
    '"9e999 N/m"',
    "[{}]",
    "1979-05-27",
    '"steel"',
]
HEADS = ["", "[x]", "[[disks]]", "[load]", "[materials]", "[[materials]]", "[sections]"]


@settings(max_examples=200, deadline=None)
@given(st.sampled_from([OIL_FILM, STEPPED]), st.data())
def test_any_value_in_any_line_gives_a_rotor_or_one_line(rotor, data):
    lines = rotor_to_toml(rotor).splitlines()
    at = data.draw(st.integers(0, len(lines) - 1))
    key, equals, _ = lines[at].partition(" = ")
    lines[at] = data.draw(
        st.sampled_from([f"{key} = {value}" for value in VALUES] if equals else HEADS)
    )
    words = ""
    try:
        assert isinstance(rotor_from_toml("\n".join(lines)), Rotor)
    except RotorFileError as error:
        words = str(error)
    assert "\n" not in words


@pytest.mark.parametrize("dimension", EXAMPLES)
def test_the_example_of_every_dimension_is_read(dimension):
    for example in EXAMPLES[dimension].split(" or "):
        assert read_quantity(example, dimension) > 0


@pytest.mark.parametrize(
    "bad", ["", "mm", "5", "1 2 mm", "nan m", "1e999 m", None, 3.0, "5 m" * 99]
)
def test_what_is_no_length_is_refused(bad):
    with pytest.raises(ValueError, match="must be a length in quotes"):
        read_quantity(bad, "length")


def test_a_material_of_the_file_has_a_name_of_its_own():
    other = replace(MATERIALS["steel"], density=8000.0)
    rotor = Rotor((ShaftSection(1.0, 0.1, MATERIALS["steel"]), ShaftSection(1.0, 0.1, other)))
    text = rotor_to_toml(rotor)
    assert 'material = "steel"' in text
    assert text.count("[materials.") == 1
    assert rotor_from_toml(text) == rotor
