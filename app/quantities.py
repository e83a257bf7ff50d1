"""Numbers with units in text, such as "20 mm": one number, one unit, nothing evaluated.

A unit is read by a table of names, so that no text is kept and no unit is guessed. Names that
differ in case only are one name, unless case tells them apart (mPa, MPa).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from itertools import product

from .typed_number import NUMBER, printable, read_number

__all__ = ["DIMENSIONS", "quantity"]

_Powers = tuple[int, int, int, int]  # of mass, length, time, angle
_Meaning = tuple[float, _Powers]  # a factor to kg, m, s, rad, and the powers

_MASS, _LENGTH, _TIME, _ANGLE = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)
_FORCE, _PRESSURE, _FREQUENCY = (1, 1, -2, 0), (1, -1, -2, 0), (0, 0, -1, 0)
_SPEED = (0, 0, -1, 1)
# what a kind of quantity is returned in is the product of kg, m, s and rad; examples for the error
DIMENSIONS: Mapping[str, tuple[_Powers, str]] = {
    "length": (_LENGTH, "a length, such as 0.5 m or 20 mm"),
    "modulus": (_PRESSURE, "a modulus, such as 207 GPa or 207000 N/mm^2"),
    "density": ((1, -3, 0, 0), "a density, such as 7850 kg/m^3 or 7.85 g/cm^3"),
    "mass": (_MASS, "a mass, such as 1.401 kg or 850 g"),
    "inertia": ((1, 2, 0, 0), "a moment of inertia, such as 0.0136 kg m^2"),
    "speed": (_SPEED, "a speed of rotation, such as 1000 rpm or 104.7 rad/s"),
}
_POUND, _GRAVITY, _INCH = 0.45359237, 9.80665, 0.0254  # exact, by definition
_LBF = _POUND * _GRAVITY
_TURN = 2 * math.pi
_PREFIXES = {"": 1.0, "µ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "k": 1e3, "M": 1e6, "G": 1e9}
_PREFIXES |= {"micro": 1e-6, "milli": 1e-3, "centi": 1e-2, "deci": 1e-1, "kilo": 1e3}
_PREFIXES |= {"mega": 1e6, "giga": 1e9}
# names, the prefixes that they take, factor of the bare unit, powers
_METRIC = (
    ("m", " µ m c d k", 1.0, _LENGTH),
    ("metre metres meter meters", " micro milli centi deci kilo", 1.0, _LENGTH),
    ("g", " m k M", 1e-3, _MASS),
    ("gram grams gramme grammes", " milli kilo", 1e-3, _MASS),
    ("N", " m k M G", 1.0, _FORCE),
    ("newton newtons", " kilo mega", 1.0, _FORCE),
    ("Pa", " m k M G", 1.0, _PRESSURE),
    ("pascal pascals", " kilo mega giga", 1.0, _PRESSURE),
    ("bar", " k", 1e5, _PRESSURE),
    ("l L", " m", 1e-3, (0, 3, 0, 0)),
    ("Hz", " k", 1.0, _FREQUENCY),
    ("rpm", " k", _TURN / 60, _SPEED),
    ("s", " m", 1.0, _TIME),
)
_OTHERS = (
    ("micron microns", 1e-6, _LENGTH),
    ("in inch inches", _INCH, _LENGTH),
    ("ft foot feet", 12 * _INCH, _LENGTH),
    ("yd yard yards", 36 * _INCH, _LENGTH),
    ("thou mil mils", _INCH / 1000, _LENGTH),
    ("kgs kilo kilos", 1.0, _MASS),
    ("t tonne tonnes", 1000.0, _MASS),
    ("lb lbs lbm pound pounds", _POUND, _MASS),
    ("oz ozm ounce ounces", _POUND / 16, _MASS),
    ("slug slugs", _LBF / (12 * _INCH), _MASS),
    ("slinch slinches", _LBF / _INCH, _MASS),
    ("kgf kp", _GRAVITY, _FORCE),
    ("dyn dyne dynes", 1e-5, _FORCE),
    ("lb lbs lbf pound pounds", _LBF, _FORCE),
    ("kip kips klbf", 1000 * _LBF, _FORCE),
    ("psi", _LBF / _INCH**2, _PRESSURE),
    ("ksi kpsi", 1e3 * _LBF / _INCH**2, _PRESSURE),
    ("Msi Mpsi", 1e6 * _LBF / _INCH**2, _PRESSURE),
    ("cc ccm", 1e-6, (0, 3, 0, 0)),
    ("sec second seconds", 1.0, _TIME),
    ("min minute minutes", 60.0, _TIME),
    ("h hr hour hours", 3600.0, _TIME),
    ("rad rads radian radians", 1.0, _ANGLE),
    ("deg degs degree degrees °", _TURN / 360, _ANGLE),
    # U and tr: the German Umdrehung and the French tour
    ("rev revs revolution revolutions r rot turn turns U tr cycle cycles", _TURN, _ANGLE),
    ("rps", _TURN, _SPEED),
)
_BY_CASE = frozenset({"mPa", "mN", "Mg"})  # found in this case only: MPA is not mPa


def _all_names() -> dict[str, list[_Meaning]]:
    """Return every name with its meanings; only a pound has two, of mass and of force."""
    found: dict[str, list[_Meaning]] = {}
    for names, prefixes, factor, powers in _METRIC:
        for name, prefix in product(names.split(), prefixes.split(" ")):
            found[prefix + name] = [(_PREFIXES[prefix] * factor, powers)]
    for names, factor, powers in _OTHERS:
        for name in names.split():
            found.setdefault(name, []).append((factor, powers))
    return found


_NAMES = _all_names()
_FOLDED = {name.casefold(): name for name in _NAMES if name not in _BY_CASE}
_LONGEST = 60
_LARGEST = 1e100  # far beyond any rotor, far within a float
_LONGEST_NAME = 24
_QUANTITY = re.compile(rf"\s*({NUMBER})\s*((?![0-9.,])\S.*?|1\s*/.*?)\s*", re.DOTALL)
_TOKEN = re.compile(
    r"(?P<name>[A-Za-zµ°]+)(?:(?:\s*\^\s*)?(?P<power>-?[1-9]|\(-?[1-9]\)))?"
    r"|(?P<sign>[*/()-]|1(?=\s*/))|(?P<space>\s+)"
)
_MOST_FACTORS = 4
_RAISED = str.maketrans("⁻¹²³⁴⁵⁶⁷⁸⁹", "-123456789")
# how units are spelled, and how they are read
_SPELLINGS = (
    (r"[μ]", "µ"),  # the Greek letter, and the sign
    (r"−", "-"),
    (r"\*\*", "^"),
    (r"[⁻¹²³⁴⁵⁶⁷⁸⁹]+", lambda found: "^" + found[0].translate(_RAISED)),
    (r"(?i:\br\.p\.m\b\.?)", "rpm"),
    (r"(?i:\bper\b)", "/"),
    (r"[·⋅×∙•]", "*"),
    (r"(?<=[^\W_])\.(?=[A-Za-zµ])|(?<=[1-9)])\.(?=[A-Za-zµ])", "*"),  # kg.m2
    (r"\.(?=\W|$)", ""),  # in.
)


def _name(word: str) -> list[_Meaning]:
    """Return the meanings of a name, none where it is unknown."""
    exact = word if word in _NAMES else _FOLDED.get(word.casefold(), "")
    return _NAMES.get(exact, [])


def _split(word: str) -> tuple[str, ...]:
    """Return a name as it is, or two that are written as one, such as kgm and lbin."""
    if not _name(word) and len(word) <= _LONGEST_NAME:
        for at in range(1, len(word)):
            if _name(word[:at]) and any(powers == _LENGTH for _, powers in _name(word[at:])):
                return word[:at], word[at:]
    return (word,)


def _times(powers: _Powers, others: _Powers, by: int) -> _Powers:
    a, b, c, d = (one + by * other for one, other in zip(powers, others, strict=True))
    return a, b, c, d


def _factors(unit: str) -> Iterator[tuple[str, int]]:
    """Yield the names of a unit and their powers.

    Raises
    ------
    ValueError
        If the text is not names that are multiplied or divided.
    """
    at, sign, group, joined = 0, 1, 0, True  # joined: a name may follow
    while at < len(unit):
        found = _TOKEN.match(unit, at)
        if found is None:
            raise ValueError
        at = found.end()
        if found["name"]:
            *first, last = _split(found["name"])
            yield from ((one, (group or 1) * sign) for one in first)
            yield last, (group or 1) * sign * int((found["power"] or "1").strip("()"))
            sign, joined = 1, False
        elif found["space"]:
            continue
        elif found["sign"] == "(" and not group:
            sign, group = 1, sign
        elif found["sign"] == ")" and group and not joined:
            group = 0
        elif found["sign"] == "/" and sign == 1:
            sign, joined = -1, True
        elif found["sign"] in "*-" and not joined:
            joined = True
        elif found["sign"] != "1" or at != 1:
            raise ValueError
    if joined or group:
        raise ValueError


def _readings(unit: str) -> list[_Meaning]:
    """Return what a unit can mean; none where a name in it is unknown."""
    for spelling, meaning in _SPELLINGS:
        unit = re.sub(spelling, meaning, unit)
    try:
        factors = list(_factors(unit))
    except ValueError:
        return []
    if len(factors) > _MOST_FACTORS:
        return []
    readings = []
    for chosen in product(*(_name(word) for word, _ in factors)):
        size, powers = 1.0, (0, 0, 0, 0)
        for (factor, one), (_, power) in zip(chosen, factors, strict=True):
            size *= factor**power
            powers = _times(powers, one, power)
        readings.append((size, powers))
    return readings


def _factor(unit: str, kind: str, words: str) -> float:
    """Return what one unit is in the unit of a kind; `words` begin the error."""
    readings = _readings(unit)
    if not readings:
        raise ValueError(f"{words} has no unit that is known")
    sizes = {f"{size:.12g}": size for size, powers in readings if powers == DIMENSIONS[kind][0]}
    if len(sizes) == 1:
        return sizes.popitem()[1]
    size, powers = readings[0]
    if kind == "speed" and powers == _FREQUENCY:
        if math.isclose(size, 1 / 60):  # min⁻¹ counts turns by every standard
            return _TURN / 60
        raise ValueError(f"{words} can count turns or radians: write rev/s or rad/s")
    raise ValueError(f"{words} is not one")


def quantity(text: object, kind: str) -> float:
    """Return a quantity in the SI unit of its kind.

    Parameters
    ----------
    text : str
        A number and a unit: up to four units, multiplied or divided, with powers to 9.
    kind : str
        A key of `DIMENSIONS`.

    Raises
    ------
    ValueError
        With what is allowed and what was given.
    """
    allowed = f"must be {DIMENSIONS[kind][1]}"
    if not isinstance(text, str):
        raise ValueError(f"{allowed}, as text in quotes")
    shown = repr(printable(text))
    found = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST else None
    if found is None:
        raise ValueError(f"{allowed}; {shown} is not one number and one unit")
    factor = _factor(found[2], kind, f"{allowed}; {shown}")
    try:
        value = read_number(found[1]) * factor
    except ValueError as error:
        raise ValueError(f"{allowed}; {error}") from None
    if not abs(value) < _LARGEST:
        raise ValueError(f"{allowed}; {shown} is too large")
    return value
