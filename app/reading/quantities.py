"""Reads quantities such as "20 mm": one number and one unit; no text is executed.

The size of a unit comes from pint. Pint gives some words another meaning than engineers do (ton,
mil), and it keeps every unit text that it has read. So it gets each word of a closed list once, and
never a text of a user. Upper and lower case mean the same except for the words of `_BY_CASE`.
"""

from __future__ import annotations

import math
import re
from functools import cache
from itertools import product
from typing import TYPE_CHECKING

from .numbers import NUMBER, printable, read_number
from .user_error import UserError

if TYPE_CHECKING:
    import pint
    from pint.facets.plain import PlainQuantity

__all__ = ["DIMENSIONS", "quantity"]

# by dimension of quantity: the unit in which it is returned, and examples for the error
DIMENSIONS = {
    "length": ("m", "a length, such as 0.5 m or 20 mm"),
    "modulus": ("Pa", "a modulus, such as 207 GPa or 207000 N/mm^2"),
    "density": ("kg/m^3", "a density, such as 7850 kg/m^3 or 7.85 g/cm^3"),
    "mass": ("kg", "a mass, such as 1.401 kg or 850 g"),
    "inertia": ("kg*m^2", "a moment of inertia, such as 0.0136 kg m^2"),
    "speed": ("rad/s", "a speed of rotation, such as 1000 rpm or 104.7 rad/s"),
}
# the words that are read, with pint's word for the unit after "=" where that differs
_WORDS = (
    "µm mm cm dm m km in inch inches ft foot feet yd thou mil=thou mils=thou l ml cc ccm=cc"
    " mg g kg Mg t kgs=kg kilo=kg kilos=kg lb lbs lbm=lb oz ozm=oz slinch slinches=slinch"
    " mN N kN MN GN kgf kp=kgf dyn lbf lb=lbf lbs=lbf pound=lbf pounds=lbf klbf"
    " mPa Pa kPa MPa GPa bar kbar psi kpsi ksi Mpsi Msi=Mpsi"
    " ms s sec min h hr Hz kHz rpm krpm rps rad rads=rad deg degs °=deg"
    " rev=turn revs=turn r=turn rot=turn U=turn tr=turn"  # U: Umdrehung, tr: tour
)
_SPELLED_OUT = (  # and their plurals, with an s
    "micrometer millimeter centimeter decimeter meter kilometer micron yard"
    " milligram gram kilogram tonne pound ounce slug newton kilonewton meganewton dyne kip"
    " pascal kilopascal megapascal gigapascal second minute hour radian degree"
    " turn revolution cycle"
)
_BY_CASE = frozenset({"mPa", "mN", "Mg"})  # found in this case only: MPA is not mPa

_LONGEST = 60
_LARGEST = 1e100  # far beyond any rotor, far within a float
_LONGEST_NAME = 24
_MOST_FACTORS = 4
_QUANTITY = re.compile(rf"\s*({NUMBER})\s*((?![0-9.,])\S.*?|1\s*/.*?)\s*", re.DOTALL)
_LETTERS = "[A-Za-zµ°]"
_FACTOR = re.compile(
    rf"\s*(?P<sign>[*/-]?)\s*(?P<name>{_LETTERS}+)(?:(?:\s*\^\s*)?(?P<power>-?[1-9]))?"
)
_RAISED = str.maketrans("⁻¹²³⁴⁵⁶⁷⁸⁹", "-123456789")
# how units are spelled, and how they are read
_SPELLINGS = (
    (r"[μ]", "µ"),  # the Greek letter, and the sign
    (r"(?i:metre)", "meter"),
    (r"(?i:gramme)", "gram"),
    (r"−", "-"),
    (r"\*\*", "^"),
    (r"[⁻¹²³⁴⁵⁶⁷⁸⁹]+", lambda found: "^" + found[0].translate(_RAISED)),
    (r"(?i:\br\.p\.m\b\.?)", "rpm"),
    (r"(?i:\bper\b)", "/"),
    (r"[·⋅×∙•]", "*"),
    (r"(?<=[^\W_])\.(?=[A-Za-zµ])|(?<=[1-9)])\.(?=[A-Za-zµ])", "*"),  # kg.m2
    (r"\.(?=\W|$)", ""),  # in.
    (r"\^\s*\((-?[1-9])\)", r"^\1"),
    (r"^1\s*/", "/"),
    # N/(m s), then (N s)/m; a power of brackets is not read
    (rf"/\s*\(\s*({_LETTERS}[^()]*)\)(?!\s*\^|-?\d)", lambda found: _inverted(found[1])),
    (rf"\(\s*({_LETTERS}[^()]*)\)(?!\s*\^|-?\d)", r" \1 "),
)


def _inverted(product_of_words: str) -> str:
    """Return m s as /m/s, and m/s as /m*s."""
    return re.sub(
        rf"\s*([*/-]?)\s*({_LETTERS}+)",
        lambda found: ("*" if found[1] == "/" else "/") + found[2],
        product_of_words,
    )


@cache
def _registry() -> pint.UnitRegistry[float]:
    """Return pint's registry; pint is imported with the first rotor file, not with the page."""
    import pint

    return pint.UnitRegistry()


@cache
def _in_base_units(unit: str) -> PlainQuantity[float]:
    """Return one of the units named in this module in kg, m, s and rad."""
    return _registry().Quantity(1.0, unit).to_base_units()


@cache
def _words() -> dict[str, list[PlainQuantity[float]]]:
    """Return the meanings of every word; only a pound has two, a mass and a force."""
    found: dict[str, list[PlainQuantity[float]]] = {}
    for entry in f"{_WORDS} {_SPELLED_OUT} {_SPELLED_OUT.replace(' ', 's ')}s".split():
        word, _, unit = entry.partition("=")
        found.setdefault(word, []).append(_in_base_units(unit or word))
    return {word.casefold(): found[word] for word in found if word not in _BY_CASE} | found


def _meanings(word: str) -> list[PlainQuantity[float]]:
    """Return the meanings of a word; an unknown word has none."""
    return _words().get(word) or _words().get(word.casefold(), [])


def _split(word: str) -> tuple[str, ...]:
    """Return a word as it is, or as two if it is two units in one, such as kgm and lbin."""
    if not _meanings(word) and len(word) <= _LONGEST_NAME:
        metre = _in_base_units("m").units
        for at in range(1, len(word)):
            if _meanings(word[:at]) and any(
                meaning.units == metre for meaning in _meanings(word[at:])
            ):
                return word[:at], word[at:]
    return (word,)


def _factors(unit: str) -> list[tuple[str, int]]:
    """Return the words of a unit and their powers; none if it is no product of words."""
    for spelling, meaning in _SPELLINGS:
        unit = re.sub(spelling, meaning, unit)
    unit = unit.strip() if unit.startswith("/") else f"*{unit.strip()}"
    factors, at = [], 0
    while found := _FACTOR.match(unit, at):
        at = found.end()
        sign = -1 if found["sign"] == "/" else 1
        *first, last = _split(found["name"])
        factors += [(word, sign) for word in first]
        factors.append((last, sign * int(found["power"] or 1)))
    return factors if at == len(unit) else []


def _factor(unit: str, dimension: str, words: str) -> float:
    """Return what one unit is in the unit of a dimension; `words` begin the error."""
    factors = _factors(unit)
    readings = []
    if 0 < len(factors) <= _MOST_FACTORS:
        powers = [power for _, power in factors]
        for meanings in product(*(_meanings(word) for word, _ in factors)):
            readings.append(math.prod(map(pow, meanings, powers)))
    if not readings:
        raise UserError(f"{words} has no unit that is known")
    wanted = _in_base_units(DIMENSIONS[dimension][0]).units
    sizes = {
        f"{reading.magnitude:.12g}": reading.magnitude
        for reading in readings
        if reading.units == wanted
    }
    if len(sizes) == 1:
        return float(sizes.popitem()[1])
    if dimension == "speed" and readings[0].units == _in_base_units("Hz").units:
        if math.isclose(readings[0].magnitude, 1 / 60):  # min⁻¹ counts turns by every standard
            return _in_base_units("rpm").magnitude
        raise UserError(f"{words} can count turns or radians: write rev/s or rad/s")
    raise UserError(f"{words} is not one")


def quantity(text: object, dimension: str) -> float:
    """Return a quantity in the SI unit of its dimension.

    Parameters
    ----------
    text : str
        A number and a unit: up to four units, multiplied or divided, with powers to 9.
    dimension : str
        A key of `DIMENSIONS`.

    Raises
    ------
    UserError
        With what is allowed and what was given.
    """
    allowed = f"must be {DIMENSIONS[dimension][1]}"
    if not isinstance(text, str):
        raise UserError(f"{allowed}, as text in quotes")
    shown = repr(printable(text))
    found = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST else None
    if found is None:
        raise UserError(f"{allowed}; {shown} is not one number and one unit")
    factor = _factor(found[2], dimension, f"{allowed}; {shown}")
    try:
        value = read_number(found[1]) * factor
    except UserError as error:
        raise UserError(f"{allowed}; {error}") from None
    if not abs(value) < _LARGEST:
        raise UserError(f"{allowed}; {shown} is too large")
    return value
