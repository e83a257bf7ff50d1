"""Checks of arguments: one message form, "`name` must be in [low, high], got value"."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["choice", "number", "numbers"]


def _interval(low: float, high: float, open_low: bool, open_high: bool) -> str:
    """Write the allowed interval as text."""
    left = "(" if open_low or math.isinf(low) else "["
    right = ")" if open_high or math.isinf(high) else "]"
    return f"{left}{low:g}, {high:g}{right}"


def numbers(
    name: str,
    value: ArrayLike,
    low: float = -math.inf,
    high: float = math.inf,
    *,
    open_low: bool = False,
    open_high: bool = False,
) -> NDArray[np.float64]:
    """Return `value` as a float array whose every entry is finite and inside the interval.

    Raises
    ------
    ValueError
        With the argument's name, the allowed interval and the first offending value.
    """
    interval = _interval(low, high, open_low, open_high)
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"`{name}` must be a real number in {interval}, got {value!r}")
    array = array.astype(np.float64, copy=False)
    below = array <= low if open_low else array < low
    above = array >= high if open_high else array > high
    wrong = below | above | ~np.isfinite(array)
    if wrong.any():
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
    """Return `value` as one checked float; see `numbers`."""
    array = numbers(name, value, low, high, open_low=open_low, open_high=open_high)
    if array.ndim:
        raise ValueError(f"`{name}` must be a single number, got an array of shape {array.shape}")
    return float(array)


def choice(name: str, value: object, allowed: tuple[str, ...]) -> str:
    """Return `value` if it is one of the allowed words."""
    if not isinstance(value, str) or value not in allowed:
        words = ", ".join(repr(word) for word in allowed)
        raise ValueError(f"`{name}` must be one of {words}, got {value!r}")
    return value
