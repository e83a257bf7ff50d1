"""Numbers as text: plain digits in groups of three, and loads in the unit that suits the shaft."""

from __future__ import annotations

import math
from decimal import Decimal

from ..rotors.shaft_disk import Scales
from ..whirl.critical_loads import critical_load

__all__ = ["LOAD_UNITS", "load_unit", "written"]

LOAD_UNITS = {"µN": 1e-6, "mN": 1e-3, "N": 1.0, "kN": 1e3, "MN": 1e6, "GN": 1e9}
"""Units of load, in N."""

_GAP = "\u202f"  # narrow, and no line ends there
_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def load_unit(scales: Scales) -> str:
    """Return the one unit in which all loads of a shaft are given, a key of `LOAD_UNITS`.

    Charts reach a few times Euler's load; below 100 000 of a unit no axis needs an exponent.
    """
    euler = float(critical_load(0.0)) * scales.load
    fitting = [name for name, size in LOAD_UNITS.items() if euler >= 20 * size]
    # the largest unit of which there are 20 or more
    return fitting[-1] if fitting else "µN"


def written(value: float, digits: int = 4) -> str:
    r"""Return a number with at most `digits` significant digits, without exponent where possible.

    >>> written(15320.4), written(-0.00125), written(3.83e-7)
    ('15\u202f320', '−0.00125', '3.83 × 10⁻⁷')
    """
    if not math.isfinite(value):
        return f"{value}"
    value = float(f"{value:.{digits}g}")
    size = abs(value)
    if size and not 1e-4 <= size < 1e9:
        exact = Decimal(repr(value))
        power = exact.adjusted()
        mantissa = f"{exact.scaleb(-power).normalize():f}"
        return f"{mantissa} × 10{str(power).translate(_POWERS)}".replace("-", "−")
    places = max(0, digits - 1 - math.floor(math.log10(size))) if size else 0
    text = f"{value:,.{places}f}".replace(",", _GAP if size >= 1e4 else "")
    if places:
        text = text.rstrip("0").rstrip(".")
    return text.replace("-", "−")
