"""What a published value is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal

__all__ = ["Published", "item"]


@dataclass(frozen=True)
class Published:
    """One value to meet.

    Parameters
    ----------
    section : str
        Kind of source, a heading of the table.
    quantity, unit, source : str
        "-" for no unit.
    value : float
        As published.
    decimals : int
        Its printed decimals.
    allowed : float
        Largest allowed |ours − value|, in the value's unit.
    ours : callable
        Returns our number.
    note : str
        Why it differs by more than its rounding, where it does.
    """

    section: str
    quantity: str
    unit: str
    value: float
    decimals: int
    allowed: float
    source: str
    ours: Callable[[], float]
    note: str = ""


def item(
    section: str,
    quantity: str,
    unit: str,
    printed: str,
    source: str,
    ours: Callable[[], float],
    allowed: float | None = None,
    note: str = "",
) -> Published:
    """Return an entry; allowed is one unit of the last printed digit unless told."""
    decimals = -int(Decimal(printed).as_tuple().exponent)
    if allowed is None:
        allowed = 10.0**-decimals
    return Published(section, quantity, unit, float(printed), decimals, allowed, source, ours, note)
