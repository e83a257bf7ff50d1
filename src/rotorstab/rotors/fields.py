"""How the frozen parts of a rotor check their fields."""

from __future__ import annotations

from .._arguments import number

__all__ = ["normalise"]


def normalise(part: object, ranges: dict[str, tuple[float, float]]) -> None:
    """Check fields of a frozen part against their ranges, and turn them into floats.

    Parameters
    ----------
    part : object
    ranges : dict of str to (float, float)
        Smallest and largest value of each field.

    Raises
    ------
    ValueError
        If a value is no real number or out of its range.
    """
    for name, (low, high) in ranges.items():
        object.__setattr__(part, name, number(name, getattr(part, name), low, high))
