"""Numbers of rotor files, and quantities: a number and a unit in one text, such as "50 mm".

The list of units is closed and short, so that the solver needs no package for them.
"""

from __future__ import annotations

import math
import re

__all__ = ["EXAMPLES", "plain_number", "read_quantity"]

_UNITS = {
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3},
    "modulus": {"Pa": 1.0, "MPa": 1e6, "GPa": 1e9, "N/m^2": 1.0, "N/mm^2": 1e6},
    "density": {"kg/m^3": 1.0, "g/cm^3": 1e3},
    "mass": {"kg": 1.0, "g": 1e-3, "t": 1e3},
    "inertia": {"kg m^2": 1.0, "kg cm^2": 1e-4, "kg mm^2": 1e-6},
    "stiffness": {"N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3, "kN/mm": 1e6, "MN/m": 1e6},
    "damping": {"N s/m": 1.0, "N s/mm": 1e3, "kN s/m": 1e3},
}
EXAMPLES = {
    "length": "0.5 m or 20 mm",
    "modulus": "207 GPa",
    "density": "7850 kg/m^3",
    "mass": "1.4 kg",
    "inertia": "0.0136 kg m^2",
    "stiffness": "1e6 N/m",
    "damping": "200 N s/m",
}
"""An example of every dimension."""

_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*(\S.*?)\s*")
_LONGEST = 80
_SPELLINGS = (("²", "^2"), ("³", "^3"), ("**", "^"), ("·", " "), ("*", " "), ("⋅", " "))


def plain_number(value: object) -> float | None:
    """Return a value of a parsed file as a float.

    Parameters
    ----------
    value : object

    Returns
    -------
    float or None
        None if the value is no number, or an integer that is too large for a float.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        return float(value)
    except OverflowError:
        return None


def read_quantity(text: object, dimension: str) -> float:
    """Return a quantity in the SI unit of its dimension.

    Parameters
    ----------
    text : str
        A decimal number and a unit.
    dimension : str
        A key of `EXAMPLES`.

    Returns
    -------
    float
        In m, Pa, kg/m³, kg, kg m², N/m or N s/m.

    Raises
    ------
    ValueError
        If the text is no quantity of this dimension; the message starts with "must be".

    Examples
    --------
    >>> read_quantity("20 mm", "length"), read_quantity("1.5 MN/m", "stiffness")
    (0.02, 1500000.0)
    """
    units = _UNITS[dimension]
    allowed = f'must be a {dimension} in quotes, such as "{EXAMPLES[dimension]}"'
    found = _QUANTITY.fullmatch(text) if isinstance(text, str) and len(text) <= _LONGEST else None
    if found is None:
        shown = repr(text)[:40] if not isinstance(text, int) else "a number without a unit"
        raise ValueError(f"{allowed}, got {shown}")
    unit = found[2]
    for spelling, meaning in _SPELLINGS:
        unit = unit.replace(spelling, meaning)
    unit = " ".join(unit.split())
    if unit not in units:
        raise ValueError(f"{allowed}, with one of the units {', '.join(units)}; got {found[2]!r}")
    value = float(found[1]) * units[unit]
    if not math.isfinite(value):
        raise ValueError(f"{allowed}, got {found[1]}, which is too large")
    return value
