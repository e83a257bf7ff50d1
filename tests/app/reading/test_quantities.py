"""Units as people write them, against their definitions."""

import gc
import math
import subprocess
import sys
import tracemalloc
from contextlib import suppress
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.reading.quantities import DIMENSIONS, quantity

INCH, POUND, GRAVITY = 0.0254, 0.45359237, 9.80665  # exact, by definition
RPM = 2 * math.pi / 60

SPELLED = {
    "speed": {
        500 * RPM: "500 rpm;500rpm;500 RPM;500 Rpm;500 r.p.m.;500 rev/min;500 revs/min;500 r/min;"
        "500 min^-1;500 min-1;500 min⁻¹;500 min**-1;500 1/min;500/min;500 U/min;500 tr/min;"
        "0.5 krpm;500 revolutions per minute;500 rev per min;500 turns/min;500 rev·min⁻¹;"
        "500 cycles/min;180000 deg/min;180000 °/min;0,5 krpm;5e2 rpm",
        60 * RPM: "1 rev/s;1 rps;1 r/s;1 rev s^-1;1 turn/s;360 deg/s;360 °/s;1 rev/sec",
        104.7: "104.7 rad/s;104,7 rad/s;104.7 rad·s⁻¹;104.7 rad s^-1;104.7 rad s-1;104.7 rad/sec;"
        "104.7 radians per second;104.7 rad*s**-1;104.7 rad/(s);0.1047 rad/ms;104.7 RAD/S",
    },
    "inertia": {
        0.0136: "0.0136 kg m^2;0.0136 kgm²;0.0136 kgm2;0.0136 kg·m²;0.0136 kg*m^2;0.0136 kg.m^2;"
        "0.0136 kg.m2;0.0136 kg-m^2;0.0136 kg m2;0.0136 KG-M2;0.0136 kg⋅m²;0.0136 kg × m²;"
        "136 kgcm²;136 kg cm^2;13600 kgmm²;13600 kg mm2;136000 g·cm²;0.0136 N m s^2;"
        "13.6 g m²;0.0136 (kg m^2);0.0136 (kg)(m²);0.0136 N m/(s^-2);0.0136 kg/(s^2/m^2 s^-2)",
        POUND * INCH**2: "1 lb-in^2;1 lbm-in^2;1 lb in^2;1 lb·in²;1 lbm in2;1 lb in²;1 lbin²;"
        "1 LB-IN^2;1 pound inch^2;1 lb.in^2;1 in²·lb;1 lbs-in^2",
        POUND * (12 * INCH) ** 2: "1 lb-ft^2;1 lb ft²;1 lbm*ft^2;1 lbft2",
        POUND * GRAVITY * INCH: "1 lb-in-s^2;1 lbf-in-s^2;1 lbf·in·s²;1 in-lbf-s^2;1 lbf in sec^2",
        POUND * GRAVITY * 12 * INCH: "1 slug ft^2;1 slug-ft²;1 lbf ft s^2",
    },
    "mass": {
        1.401: "1.401 kg;1,4010 kg;1.401 Kg;1.401 KG;1401 g;1401 grams;1.401 kilograms;"
        "1401000 mg;0.001401 t;0.001401 Mg;1 401 g;1.401 kilogrammes;1.401 kgs;1.401kg",
        POUND: "1 lb;1 lbs;1 lbm;1 LB;1 pound;16 oz;1 lb.;16 ounces",
        POUND * GRAVITY / (12 * INCH): "1 slug;1 slugs",
    },
    "length": {
        0.02: "20 mm;20mm;20 MM;2 cm;0.02 m;0,02 m;20 millimetres;20 millimeters;20000 µm;20000 μm;"
        "2E-2 m;20000 microns;0.2 dm;0.00002 km;0.020 metres;0.02 Meter",
        INCH: "1 in;1 inch;1 in.;1 IN;1000 mil;1000 thou",
        12 * INCH: "1 ft;1 foot;12 inches;1 feet",
    },
    "modulus": {
        207e9: "207 GPa;207 gpa;207 GPA;207000 MPa;207000 Mpa;207000 mpa;207e9 Pa;207000 N/mm^2;"
        "207000 N/mm²;207000 N/mm2;207 kN/mm²;207000 N mm^-2;207e9 N/m^2;207e9 N/(m^2);207 GN/m²;"
        "207e9 kg/(m s^2);207e9 kg/(m·s²);207e9 (kg m)/(m² s²);207e9 N/m/(m);"
        "207000 MN/m^2;2.07e6 bar;2070 kbar;207 gigapascal;207e9 kg/m/s²;207e9 kg m^-1 s^-2",
        POUND * GRAVITY / INCH**2 * 1e6: "1 Msi;1 Mpsi;1000 ksi;1000 kpsi;1e6 psi;1e6 PSI;"
        "1e6 lb/in^2;1e6 lbf/in²;1e6 lbf/in2;1000 kip/in^2",
        GRAVITY * 1e6: "1 kgf/mm²;1 kp/mm^2;100 kgf/cm2",
    },
    "density": {
        7850.0: "7850 kg/m^3;7850 kg/m³;7850 kg/m3;7850 kg m^-3;7850 kg·m⁻³;7.85 g/cm^3;7.85 g/cm³;"
        "7.85 g/cc;7.85 t/m^3;7.85 kg/l;7.85 kg/dm³;7.85 g/ml;7.85e-9 t/mm^3;7 850 kg/m³;"
        "7.85e-6 kg/mm3;7850 kg per m^3",
        POUND / INCH**3: "1 lb/in^3;1 lbm/in³;1 lb/in3;1728 lb/ft^3",
    },
}
CASES = [
    (text, kind, value)
    for kind, values in SPELLED.items()
    for value, texts in values.items()
    for text in texts.split(";")
]


@pytest.mark.parametrize(("text", "kind", "value"), CASES)
def test_a_quantity_is_read_as_people_write_it(text, kind, value):
    assert quantity(text, kind) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(("text", "kind", "value"), CASES)
def test_a_quantity_is_of_one_kind_only(text, kind, value):
    for other in DIMENSIONS:
        if other != kind and not (text.startswith("1 lb") and {kind, other} <= {"mass", "modulus"}):
            with pytest.raises(ValueError, match=r"is not one|can count turns"):
                quantity(text, other)


REFUSED = [
    ("1,200 kg", "mass", "'1,200' can mean 1.2 or 1200: write one of them"),
    ("7,850 kg/m^3", "density", "can mean 7.85 or 7850"),
    ("1,500 rpm", "speed", "can mean 1.5 or 1500"),
    ("10 Hz", "speed", "'10 Hz' can count turns or radians: write rev/s or rad/s"),
    ("10 1/s", "speed", "can count turns or radians"),
    ("10 s^-1", "speed", "can count turns or radians"),
    ("10 kHz", "speed", "can count turns or radians"),
    ("10 m/s", "speed", "is not one"),
    ("10 rad", "speed", "is not one"),
    ("10 mPa m", "modulus", "is not one"),
    ("1 lbf", "mass", "is not one"),
    ("1 kgf", "mass", "is not one"),
    ("1 ton", "mass", "has no unit that is known"),  # short, long or metric
    ("1 furlong", "length", "has no unit that is known"),
    ("20 degC", "length", "has no unit that is known"),
    ("0.5", "length", "is not one number and one unit"),
    ("m", "length", "is not one number and one unit"),
    ("1 m m m m m", "length", "has no unit that is known"),
    ("1 m**999999999", "length", "has no unit that is known"),
    ("1 kg//m^3", "density", "has no unit that is known"),
    ("1 kg/(m^3", "density", "has no unit that is known"),
    ("1 kg/((m)^3)", "density", "has no unit that is known"),
    ("1 kg/m^3)", "density", "has no unit that is known"),
    ("1 (kg m)^2", "inertia", "has no unit that is known"),
    ("1 N/(m)^2", "modulus", "has no unit that is known"),
    ("1 N/(m) 2", "modulus", "has no unit that is known"),
    ("1 N/(m2", "modulus", "has no unit that is known"),
    ("1 /", "density", "has no unit that is known"),
    ("1 ()", "length", "has no unit that is known"),
    ("1 1", "length", "is not one number and one unit"),
    ("1 *m", "length", "has no unit that is known"),
    ("1 m*", "length", "has no unit that is known"),
    ("1 m 2", "length", "has no unit that is known"),
    ("1 " + "m" * 50, "length", "has no unit that is known"),
    ("1 m" + " " * 60, "length", "is not one number and one unit"),
    ("1 Gm", "length", "is not one"),
    ("1e99 km", "length", "is too large"),
    (5, "length", "as text in quotes"),
]


@pytest.mark.parametrize(("text", "kind", "match"), REFUSED, ids=range(len(REFUSED)))
def test_a_doubtful_quantity_is_refused_with_words(text, kind, match):
    with pytest.raises(ValueError, match=r"^must be a") as caught:
        quantity(text, kind)
    assert match in str(caught.value)
    assert len(str(caught.value)) < 200


def test_case_tells_milli_from_mega_only_where_it_is_written_so():
    assert quantity("5 mPa", "modulus") == pytest.approx(5e-3)
    assert quantity("5 MPa", "modulus") == pytest.approx(5e6)
    assert quantity("5 Mpa", "modulus") == pytest.approx(5e6)


@given(st.text(max_size=70) | st.text("0123456789.,e+-^*/() mkgµ²⁻·", max_size=30))
def test_any_text_is_a_quantity_or_refused(text):
    for kind in DIMENSIONS:
        words = "must be "
        try:
            assert math.isfinite(quantity(text, kind))
        except ValueError as error:
            words = str(error)
        assert words.startswith("must be ")
        assert words.isprintable()


def memory_kept(read, texts):
    """Return how many bytes are still held after some texts were read."""
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        read(texts)
        gc.collect()
        return tracemalloc.get_traced_memory()[0] - before
    finally:
        tracemalloc.stop()


def test_no_text_is_kept():
    def unit(number):
        letters = "".join(chr(ord("a") + int(digit)) for digit in str(number))
        return f"1 m{letters} kg{letters}^2 /s{letters}"

    def read(numbers):
        for number in numbers:
            with pytest.raises(ValueError, match="no unit"):
                quantity(unit(number), "inertia")

    read(range(100))
    kept = memory_kept(read, range(1000, 2500))
    assert kept < 60_000  # 40 bytes a text; a cache of units kept 1.1 kB of each


def test_no_product_of_units_is_kept():
    """Pint keeps what it parses and converts, so no product of a user may reach it."""
    words = ("kg", "lb", "slug", "mm", "in", "ft", "min", "s", "rad", "rev", "N", "lbf", "GPa")
    powers = (-3, -2, -1, 2, 3)
    units = [
        f"{first}{power} {second}/{third}^{other}"
        for first, second, third in product(words, repeat=3)
        for power, other in product(powers, repeat=2)
    ][::30]
    texts = [f"1 {unit}" for unit in units] + [f"1 {unit} q{unit[:2]}" for unit in units]
    assert len(set(texts)) > 3_000

    def read(some):
        for text in some:
            with suppress(ValueError):
                quantity(text, "inertia")

    read(texts[:100])
    assert memory_kept(read, texts) < 60_000


def test_pint_is_loaded_with_the_first_quantity_and_not_with_the_page():
    code = (
        "import sys, app.pages.explore; from app.reading.quantities import quantity; "
        "before = 'pint' in sys.modules; quantity('1 m', 'length'); "
        "sys.exit(before or 'pint' not in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
