"""Verdicts of readings, the numbers that several readings need, and how these are written."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from .._tolerances import DECIMAL_ROUNDING, SAME_BOUNDARY
from .._types import Array
from ..charts.figure import Verdict
from ..charts.structure import Chart

__all__ = [
    "boundaries",
    "by_panel",
    "confirm",
    "fixed",
    "groups",
    "judge",
    "listed",
    "matches",
    "percent",
    "right_of",
    "say",
    "titles",
]

_MODES = ("1B", "1F", "2B", "2F")


def judge(*facts: bool | np.bool_) -> Verdict:
    """Return "agree" where all facts hold, "differ" where none does."""
    if all(facts):
        return "agree"
    return "agree in part" if any(facts) else "differ"


def confirm(*facts: bool | np.bool_) -> Verdict:
    """Return "confirmed" where Floquet confirms all facts, "not confirmed" where none."""
    if all(facts):
        return "confirmed"
    return "partly confirmed" if any(facts) else "not confirmed"


def matches(value: float, printed: str) -> bool:
    """Return whether a value is within one unit of the last digit of a printed number."""
    unit = 10.0 ** -len(printed.partition(".")[2])
    return abs(value - float(printed)) <= unit * (1 + DECIMAL_ROUNDING)


def fixed(value: float, decimals: int) -> str:
    """Write a number with so many decimals and a true minus sign."""
    return f"{value:.{decimals}f}".replace("-", "−")


def listed(values: Iterable[float], decimals: int = 3) -> str:
    """Write numbers one after the other."""
    return ", ".join(fixed(value, decimals) for value in values)


def by_panel(panels: Sequence[Chart], rows: Sequence[Sequence[float]]) -> str:
    """Write the numbers of every panel, joined by arrows."""
    return "; ".join(
        f"{panel.title}: {' → '.join(fixed(x, 3) for x in row)}"
        for panel, row in zip(panels, rows, strict=True)
    )


def titles(panels: Sequence[Chart]) -> str:
    """Write the titles of panels one after the other."""
    return ", ".join(panel.title for panel in panels)


def say(fact: bool | np.bool_, yes: str, no: str) -> str:
    """Return one text where the fact holds, the other where it does not."""
    return yes if fact else no


def boundaries(panel: Chart, group: str, modes: tuple[str, ...] = _MODES) -> Array:
    """Return θ/ω_n (modes, 21) of one group's boundaries at 21 even β_d of the panel.

    NaN where a boundary is not real.
    """
    factors = np.linspace(*panel.y_range, 21)
    lines = [panel.boundary(group, mode) for mode in modes]
    return np.array([np.interp(factors, line.y, line.x) for line in lines])


def right_of(first: Array, second: Array) -> bool:
    """Return whether the first lies at or right of the second wherever both are real."""
    both = np.isfinite(first) & np.isfinite(second)
    return bool((first[both] >= second[both] - SAME_BOUNDARY).all() and both.any())


def groups(panel: Chart) -> list[str]:
    """Return the names of a panel's groups, in the order of drawing."""
    return list(dict.fromkeys(line.group for line in panel.series))


def percent(value: float) -> str:
    """Write a fraction as a percentage."""
    return f"{fixed(100 * value, 1)} %"
