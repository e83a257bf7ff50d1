"""Rotor files: what is read, what is refused and in what words, and what comes back."""

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.state.rotor_file import LARGEST_FILE, read_rotor_file, write_rotor_file
from app.state.state import State
from rotorstab import TABLE_1_SI, ShaftDisk
from rotorstab.rotors.materials import MATERIALS, shear_coefficient

TABLE_1 = Path(__file__).parents[3].joinpath("docs", "table_1.toml").read_text("utf-8")
SHAFT = """[shaft]
length = "0.5 m"
diameter = "20 mm"
material = "steel"
"""
DISK = """[disk]
mass = "1.401 kg"
diametral_inertia = "0.0136 kg m^2"
polar_inertia = "0.0272 kg m^2"
"""
NUMBERS = """[nondimensional]
shear = 0.01
disk_mass = 4
diametral_inertia = 0.5
polar_inertia = 0.9
"""


def test_the_example_gives_the_numbers_of_table_1():
    values, left_out = read_rotor_file(TABLE_1)
    assert left_out == []
    assert values["shear"] == pytest.approx(2.92191e-4, rel=1e-5)
    assert values["disk_mass"] == pytest.approx(1.161334, rel=1e-6)
    assert values["diametral_inertia"] == pytest.approx(0.0450939, rel=1e-6)
    rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
    for name in ("shear", "disk_mass", "diametral_inertia", "polar_inertia"):
        assert values[name] == pytest.approx(getattr(rotor, name), rel=1e-14)
    assert values["spin_speed"] * scales.frequency == pytest.approx(1000 * 2 * math.pi / 60)
    assert (values["units"], values["load_type"]) == ("SI", "axial")
    state = State()
    assert state.change(values) == {}
    assert state.shaft_in_use()


def test_a_solid_disk_of_a_material():
    text = SHAFT + '[disk]\ndiameter = "240 mm"\nthickness = "20 mm"\nmaterial = "aluminium"\n'
    values, _ = read_rotor_file(text)
    mass = 2700 * math.pi * 0.24**2 / 4 * 0.02
    assert values["si_disk_mass"] == pytest.approx(mass)
    assert values["si_polar_inertia"] == pytest.approx(mass * 0.12**2 / 2)
    assert values["si_diametral_inertia"] == pytest.approx(mass * (0.12**2 / 4 + 0.02**2 / 12))
    assert values["material"] == "steel"


def test_units_of_many_kinds_give_one_rotor():
    inches = SHAFT.replace("0.5 m", "50 cm").replace("20 mm", "2.0e-2 m") + DISK.replace(
        "1.401 kg", "1401 g"
    ).replace("0.0136 kg m^2", "136 kg*cm²")
    (one, _), (other, _) = read_rotor_file(SHAFT + DISK), read_rotor_file(inches)
    assert one.keys() == other.keys()
    for name, value in one.items():
        assert other[name] == (value if isinstance(value, str) else pytest.approx(value, rel=1e-12))


PLAIN = {
    "units": "non-dimensional",
    "shear": 0.01,
    "disk_mass": 4.0,
    "diametral_inertia": 0.5,
    "polar_inertia": 0.9,
    "spin_speed": 1.5,
}


def test_plain_numbers():
    text = "[nondimensional]\nshear = 0.01\ndisk_mass = 4\n"
    text += "diametral_inertia = 0.5\npolar_inertia = 0.9\n[operation]\nspin_speed = 1.5\n"
    assert read_rotor_file(text) == (PLAIN, [])
    # a number in quotes, and one with a decimal comma, is still a number
    typed = text.replace("0.01", '"0,01"').replace("4\n", '"4.0"\n').replace("1.5", '"1,5"')
    assert read_rotor_file(typed) == (PLAIN, [])


@pytest.mark.parametrize(
    ("key", "written", "words"),
    [
        ("spin_speed", '"60000 rpm"', "line 10: operation.spin_speed gives Ω̄ = 60.7"),
        ("spin_speed", '"-100 rpm"', "line 10: operation.spin_speed gives Ω̄ = -0.1012"),
        ("static_load_factor", "7", "line 10: operation.static_load_factor gives α_s = 7, which"),
        ("tangency", "1.5", "line 10: operation.tangency gives μ = 1.5, which must be a number"),
    ],
)
def test_what_the_sliders_cannot_show_of_the_operation_is_left_out(key, written, words):
    rotor, _ = read_rotor_file(SHAFT + DISK)
    operation = f'[operation]\n{key} = {written}\nload_type = "Follower"\n'
    values, (left_out,) = read_rotor_file(SHAFT + DISK + operation)
    assert values == rotor | {"load_type": "follower"}
    assert left_out.startswith(words)
    assert "must be a number from 0 to" in left_out
    # of the plain numbers too
    values, left_out = read_rotor_file(f"{NUMBERS}[operation]\nspin_speed = 4.01\n")
    assert "spin_speed" not in values
    assert left_out == [
        "line 7: operation.spin_speed gives Ω̄ = 4.01, which must be a number from 0 to 4"
    ]


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("Steel", "steel"),
        ("STEEL", "steel"),
        (" mild steel ", "steel"),
        ("Structural-Steel", "steel"),
        ("aluminum", "aluminium"),
        ("Aluminium", "aluminium"),
        ("ALUMINUM", "aluminium"),
        ("Ti-6Al-4V", "titanium"),
        ("Ti6Al4V", "titanium"),
        ("Titanium", "titanium"),
    ],
)
def test_materials_are_known_as_people_write_them(written, name):
    values, _ = read_rotor_file(SHAFT.replace("steel", written) + DISK)
    assert values["material"] == name
    solid = f'[disk]\ndiameter = "240 mm"\nthickness = "20 mm"\nmaterial = "{written}"\n'
    values, _ = read_rotor_file(SHAFT + solid)
    volume = math.pi * 0.24**2 / 4 * 0.02
    assert values["si_disk_mass"] == pytest.approx(MATERIALS[name].density * volume)


REFUSED = [
    ("", "lacks [shaft]"),
    (SHAFT, "lacks [disk]"),
    (SHAFT.replace("0.5 m", "0.5 kg") + DISK, "line 2: shaft.length must be a length"),
    (SHAFT.replace('"0.5 m"', "0.5") + DISK, "line 2: shaft.length must be a length"),
    (SHAFT.replace("0.5 m", "0.5") + DISK, "line 2: .* '0.5' is not one number and one unit"),
    (SHAFT.replace("0.5 m", "-1 m") + DISK, "line 2: shaft.length must be more than 0"),
    (SHAFT.replace("0.5 m", "1e999 m") + DISK, "line 2: .* too large"),
    (SHAFT.replace("0.5 m", "1e30 m") + DISK, "line 2: shaft.length must be a number"),
    (SHAFT.replace("0.5 m", "1 m**999999999") + DISK, "line 2: .* has no unit that is known"),
    (SHAFT + DISK.replace("1.401 kg", "1,200 kg"), "line 6: .* can mean 1.2 or 1200: write one"),
    (SHAFT.replace('"0.5 m"', "0.5 m") + DISK, 'line 2: a quantity is a text in quotes: "0.5 m"'),
    ("[nondimensional]\nshear = 0,01\n", "line 2: write a number with a point, 0.01, not"),
    ("[nondimensional]\nshear = 0x" + "f" * 5000, "line 1: nondimensional lacks"),
    (NUMBERS.replace("0.01", "0x" + "f" * 5000), "line 2: .* a number of thousands of digits is"),
    (NUMBERS.replace("0.01", "[" + "0x" + "f" * 5000 + "]"), "line 2: .* a number of thousands"),
    (NUMBERS + '[operation]\nspin_speed = "500 rpm"\n', "line 7: .* plain number Ω̄ where there"),
    (NUMBERS + '[operation]\nspin_speed = "1,500"\n', "line 7: .* can mean 1.5 or 1500"),
    (SHAFT + DISK + '[operation]\nspin_speed = "50 kg"\n', "line 10: .* is not one"),
    (SHAFT + DISK + '[operation]\nspin_speed = "50"\n', "line 10: .* one number and one unit"),
    (SHAFT.replace("steel", "cheese") + DISK, "line 4: shaft.material must be one of steel"),
    (SHAFT + 'density = "1 g/cm^3"\n' + DISK, "line 5: shaft.density cannot stand beside material"),
    (SHAFT + 'colour = "red"\n' + DISK, "line 5: shaft.colour is unknown"),
    (SHAFT + 'length = "1 m"\n' + DISK, "line 5: not TOML: Cannot overwrite"),
    (SHAFT + DISK + "[shaft]\n", "line 9: not TOML: Cannot declare"),
    (SHAFT + DISK + "[wheel]\n", "line 9: wheel is unknown"),
    ("shaft = 3\n" + DISK, "line 1: shaft must be a table"),
    (SHAFT + DISK.replace("1.401 kg", "1 g"), "line 6: disk.mass gives M̄_D = .* from 0.5 to 20"),
    (SHAFT + DISK.replace("mass", "mess"), "line 6: disk.mess is unknown"),
    (SHAFT + "[disk]\n", "line 5: disk lacks mass"),
    (SHAFT + DISK + '[operation]\nspin_speed = "10 Hz"\n', "line 10: .* speed of rotation"),
    (SHAFT + DISK + "[operation]\nspin_speed = 10\n", "line 10: .* as text in quotes"),
    (SHAFT + DISK + '[operation]\nload_type = "sideways"\n', "line 10: .* one of axial"),
    (SHAFT + DISK + "[operation]\nstatic_load_factor = nan\n", "line 10: .* plain number"),
    (SHAFT + DISK + "[nondimensional]\n", "line 5: disk cannot stand beside"),
    ("[nondimensional]\nshear = 0.01\n", "line 1: nondimensional lacks disk_mass"),
    (SHAFT.replace("20 mm", "5 m") + DISK, "line 3: shaft.diameter .* '5 m' is 5 m"),
    (SHAFT.replace("20 mm", "4400 yd") + DISK, "line 3: .* '4400 yd' is 4023 m"),
    ("a = " + "[" * 5000, "line 1: it is nested deeper than 8 levels"),
    ("a = " + "9" * 5000, "line 1: a number has too many digits"),
    ("a = 2001-99-99", "not TOML"),
    ("#" * (LARGEST_FILE + 1), "larger than 8 kB"),
    ("#" + "é" * (LARGEST_FILE // 2), "larger than 8 kB"),
    ("\ud800", "not TOML"),
]


@pytest.mark.parametrize(("text", "match"), REFUSED, ids=range(len(REFUSED)))
def test_a_bad_file_is_refused_in_one_line(text, match):
    with pytest.raises(ValueError, match=match.replace("[", r"\[").replace("]", r"\]")) as caught:
        read_rotor_file(text)
    words = str(caught.value)
    assert words.isprintable()
    assert len(words) < 400


def only_a_line(text):
    values, problem = {}, None
    try:
        values, left_out = read_rotor_file(text)
        assert all(one.isprintable() and len(one) < 400 for one in left_out)
    except ValueError as error:
        problem = error
    assert str(problem).isprintable()
    assert len(str(problem)) < 400
    assert State().change(values) == {}


@given(st.text() | st.text("[]=.\"'\n#0123456789e mkg{}", max_size=80))
def test_any_text_gives_inputs_or_one_line(text):
    only_a_line(text)


toml_values = st.one_of(
    st.text(max_size=20).map(lambda text: "'" + text.replace("'", "") + "'"),
    st.builds(
        lambda number, unit: f'"{number} {unit}"',
        st.floats() | st.integers(),
        st.sampled_from(["m", "kg", "GPa", "kg/m^3", "kg m^2", "rpm", "degC", "dB", "in", "m**9"]),
    ),
    st.floats().map(repr),
    st.integers().map(str),
    st.sampled_from(["true", "[1]", "{a = 1}", "1979-05-27", '"steel"', '"axial"', "nan", "inf"]),
)
KEYS = [line.partition(" =")[0].strip("# ") for line in TABLE_1.splitlines() if " = " in line]


@given(st.data())
def test_any_values_of_the_keys_give_inputs_or_one_line(data):
    lines = []
    for line in TABLE_1.splitlines():
        key, equals, value = line.partition(" = ")
        move = data.draw(st.sampled_from("kkkkkkkvdr")) if equals else "k"
        if move == "v":
            value = data.draw(toml_values)
        if move == "r":
            key = data.draw(st.sampled_from(KEYS))
        if move != "d":
            lines.append(key + equals + value)
    only_a_line("\n".join(lines))


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"units": "SI"},
        {"units": "SI", "material": "titanium", "shaft_length": 0.7},
        {"load_type": "partly", "tangency": 0.3, "spin_speed": 1.7},
        read_rotor_file(TABLE_1)[0],
    ],
)
def test_what_is_written_reads_back(values):
    state = State()
    assert state.change(values) == {}
    back = State()
    assert back.change(read_rotor_file(write_rotor_file(state))[0]) == {}
    for name, value in state.inputs().items():
        given = value if isinstance(value, str | bool) else pytest.approx(value, rel=1e-11)
        assert getattr(back, name) == given, name


def test_materials_are_isotropic_and_coefficients_cowper_s():
    assert set(MATERIALS) == {"steel", "aluminium", "titanium"}
    for one in MATERIALS.values():
        poisson = one.youngs_modulus / (2 * one.shear_modulus) - 1
        assert 0.25 < poisson < 0.35
        assert one.shear_coefficient == pytest.approx(6 * (1 + poisson) / (7 + 6 * poisson))
    assert shear_coefficient(2.6, 1.0) == pytest.approx(0.8864, abs=1e-4)
    with pytest.raises(ValueError, match="at most 3 `shear_modulus`"):
        shear_coefficient(4.0, 1.0)
