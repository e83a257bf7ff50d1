"""Checks of arguments. All messages have the form "`name` must be in [low, high], got value"."""

from __future__ import annotations

import math
import reprlib

import numpy as np

from ._types import Array, ArrayLike

__all__ = ["LARGEST", "LARGEST_LOAD", "choice", "number", "numbers", "series", "whole_number"]

LARGEST = 1e9
"""Largest spin speed and damping ratio; beyond, results would be rounding errors only."""

LARGEST_LOAD = 1e12
"""Largest load, either sign: in newtons, a stocky shaft of a metre in diameter buckles at 1e11."""


def _interval(low: float, high: float, open_low: bool, open_high: bool) -> str:
    """Write the allowed interval as text."""
    left = "(" if open_low or math.isinf(low) else "["
    right = ")" if open_high or math.isinf(high) else "]"
    return f"{left}{low:g}, {high:g}{right}"


def _shown(value: object) -> str:
    """Return a short text for any value."""
    try:
        return reprlib.repr(value)
    except ValueError:  # an integer of thousands of digits
        return "an integer too long to show"


def numbers(
    name: str,
    value: ArrayLike,
    low: float = -math.inf,
    high: float = math.inf,
    *,
    open_low: bool = False,
    open_high: bool = False,
) -> Array:
    """Return `value` as a float array, every entry of which is finite and inside an interval.

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    value : array of numbers
    low, high : float
        Ends of the interval.
    open_low, open_high : bool
        Whether an end is excluded from the interval.

    Raises
    ------
    ValueError
        If `value` is not real or an entry is outside. The message holds the name, the interval
        and the first wrong value.
    """
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different length
        array = np.asarray(None)
    if array.dtype.kind not in "fiu":
        interval = _interval(low, high, open_low, open_high)
        raise ValueError(f"`{name}` must be a real number in {interval}, got {_shown(value)}")
    array = array.astype(np.float64, copy=False)
    wrong = ~np.isfinite(array)
    if low > -math.inf:
        wrong |= array <= low if open_low else array < low
    if high < math.inf:
        wrong |= array >= high if open_high else array > high
    if wrong.any():
        interval = _interval(low, high, open_low, open_high)
        raise ValueError(f"`{name}` must be in {interval}, got {array[wrong].flat[0]:g}")
    return array


def number(
    name: str,
    value: float,
    low: float = -math.inf,
    high: float = math.inf,
    *,
    open_low: bool = False,
    open_high: bool = False,
) -> float:
    """Return `value` as a single checked float, see `numbers`."""
    if type(value) is float and low < value < high:
        return value
    array = numbers(name, value, low, high, open_low=open_low, open_high=open_high)
    if array.ndim:
        raise ValueError(f"`{name}` must be a single number, got an array of shape {array.shape}")
    return float(array)


def series(name: str, value: ArrayLike, low: float = -math.inf) -> Array:
    """Return `value` as a checked one-dimensional array, which may be empty."""
    array = numbers(name, value, low)
    if array.ndim != 1:
        raise ValueError(f"`{name}` must be one-dimensional, got an array of shape {array.shape}")
    return array


def whole_number(name: str, value: int, low: int, high: float = math.inf) -> int:
    """Return `value` as a checked integer. Floats such as 3.0 and NumPy's integers are accepted."""
    checked = number(name, value, low, high)
    if not checked.is_integer():
        interval = _interval(low, high, False, False)
        raise ValueError(f"`{name}` must be a whole number in {interval}, got {checked:g}")
    return int(value)


def choice(name: str, value: object, allowed: tuple[str, ...]) -> str:
    """Return `value` if it is one of the allowed texts, else raise ValueError."""
    if not isinstance(value, str) or value not in allowed:
        words = ", ".join(repr(word) for word in allowed)
        raise ValueError(f"`{name}` must be one of {words}, got {_shown(value)}")
    return value
