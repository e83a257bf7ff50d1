"""What several figures take and name in the same way: panels, styles, kinds of load, ω_n."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from string import ascii_lowercase
from typing import TypeVar

from ..charts.figure import Value
from ..charts.roles import STYLES, Style
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import ShaftDisk

__all__ = [
    "FACTORS",
    "LOAD_KINDS",
    "SPINS",
    "lettered",
    "parameters",
    "resting_frequency",
    "styled",
]

T = TypeVar("T")
K = TypeVar("K", bound=str)

SPINS = (0.0, 1.0, 2.0)
"""Ω̄ of the panels of Figs 5, 6, 7 and 9."""
FACTORS = (0.0, 0.2, 0.5)
"""α_s of the lines of Figs 6 and 7."""
LOAD_KINDS: tuple[tuple[str, Style, float], ...] = (
    ("axial force", "solid", 0.0),
    ("follower force", "dashed", 1.0),
)
"""Both kinds of load: name, line style and tangency μ."""


def parameters(rotor: ShaftDisk, **others: Value) -> dict[str, Value]:
    """Return a rotor's fields and other plain values as one mapping."""
    return {**asdict(rotor), **others}


def resting_frequency(rotor: ShaftDisk) -> float:
    """Return ω_n of the lumped rotor [√(EI/(ρAL⁴))], by which the figures divide frequencies."""
    return fundamental_frequency(lumped(rotor, 0.0))


def _paired(name: str, keys: Sequence[K], values: Sequence[T]) -> list[tuple[K, T]]:
    """Return each value with its key; raise ValueError where there are too many values or none."""
    if not 1 <= len(values) <= len(keys):
        raise ValueError(f"`{name}` must have 1 to {len(keys)} values, got {len(values)}")
    return list(zip(keys[: len(values)], values, strict=True))


def lettered(name: str, values: Sequence[T]) -> list[tuple[str, T]]:
    """Return the values of an argument, 1 to 26, with the letters of their panels."""
    return _paired(name, ascii_lowercase, values)


def styled(name: str, values: Sequence[T]) -> list[tuple[Style, T]]:
    """Return the values of an argument, 1 to 3, with their line styles."""
    return _paired(name, STYLES[:3], values)
