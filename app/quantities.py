"""Numbers with units in text, such as "20 mm": one number, one unit, nothing evaluated."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pint

__all__ = ["DIMENSIONS", "quantity"]

# the unit a kind of quantity is returned in, and examples for the error
DIMENSIONS = {
    "length": ("m", "a length, such as 0.5 m or 20 mm"),
    "modulus": ("Pa", "a modulus, such as 207 GPa or 207000 N/mm^2"),
    "density": ("kg/m^3", "a density, such as 7850 kg/m^3 or 7.85 g/cm^3"),
    "mass": ("kg", "a mass, such as 1.401 kg or 850 g"),
    "inertia": ("kg*m^2", "a moment of inertia, such as 0.0136 kg m^2"),
    "speed": ("rad/s", "a speed of rotation, such as 1000 rpm or 104.7 rad/s"),
}
_LONGEST = 60
_NUMBER = r"[+−-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+−-]?\d{1,3})?"
_FACTOR = r"[A-Za-zµμ]{1,24}(?:(?:\^|\*\*)?-?[1-9]|[²³])?"
_UNIT = rf"{_FACTOR}(?:\s*[*·/ ]\s*{_FACTOR}){{0,3}}"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*({_UNIT})\s*")
_LARGEST = 1e100  # far beyond any rotor, far within a float


@cache
def _registry() -> pint.UnitRegistry:
    """Return the one registry; pint is loaded with the first rotor file, not with the page."""
    import pint

    return pint.UnitRegistry()


@cache
def _kind_units() -> dict[str, pint.Unit]:
    return {kind: _registry().Unit(unit) for kind, (unit, _) in DIMENSIONS.items()}


def _factor(unit: str, kind: str) -> float | None:
    """Return what one unit is in the unit of a kind, or None where it is no such unit."""
    unit = re.sub(r"\s*([*·/ ])\s*", r"\1", unit).replace("·", "*").replace(" ", "*")
    unit = unit.replace("²", "^2").replace("³", "^3").replace("**", "^")
    unit = re.sub(r"([A-Za-zµμ])(-?[1-9])", r"\1^\2", unit)
    try:
        one = _registry().Quantity(1.0, unit)
        # to pint 1 Hz is 1 rad/s; a speed must say whether it counts turns or radians
        if kind == "speed" and "radian" not in one.to_base_units().units._units:
            return None
        factor = float(one.to(_kind_units()[kind]).magnitude)
    except Exception:  # pint raises errors of many kinds, some of them not its own
        return None
    return factor if math.isfinite(factor) and factor > 0 else None


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
    shown = text if len(text) <= _LONGEST else text[:40] + " …"
    found = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST else None
    if found is None:
        raise ValueError(f"{allowed}; {shown!r} is not one number and one unit")
    factor = _factor(found[2], kind)
    if factor is None:
        raise ValueError(f"{allowed}; {shown!r} is not one")
    value = float(found[1].replace("−", "-")) * factor
    if not abs(value) < _LARGEST:
        raise ValueError(f"{allowed}; {shown!r} is too large")
    return value
