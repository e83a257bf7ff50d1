"""The resonance that is nearest to an excitation frequency."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from rotorstab import Resonance, ResonanceTable

__all__ = ["Pair", "nearest_pair", "nearest_resonance"]

_LOW_MODES = {"1B", "1F", "2B", "2F"}


@dataclass(frozen=True)
class Pair:
    """Two whirl modes whose resonance is the nearest one.

    Parameters
    ----------
    name : str
        Such as "1B+1F".
    modes : (str, str)
        The two modes, the one of the lower signed frequency first.
    frequencies : (float, float)
        Their signed whirl frequencies, real parts.
    precession : str
        "same" or "opposite".
    threshold : float
        Pulsating load from which the resonance is an unstable tongue; inf if it is none.
    """

    name: str
    modes: tuple[str, str]
    frequencies: tuple[float, float]
    precession: str
    threshold: float

    @property
    def centre(self) -> float:
        """θ̄ of the resonance."""
        return abs(self.frequencies[0] - self.frequencies[1])


def nearest_resonance(rows: Iterable[Resonance], excitation: float) -> Resonance | None:
    """Return the resonance whose centre is nearest to θ̄, or None where there is none."""
    return min(rows, key=lambda row: abs(row.centre - excitation), default=None)


def nearest_pair(table: ResonanceTable, excitation: float) -> Pair | None:
    """Return the nearest resonance of first and second modes."""
    rows = [row for row in table if {row.first, row.second} <= _LOW_MODES]
    row = nearest_resonance(rows, excitation)
    if row is None:
        return None
    places = sorted(map(table.modes.index, (row.first, row.second)))
    first, second = (table.modes[place] for place in places)
    lower, higher = (float(np.real(table.frequencies[place])) for place in places)
    return Pair(row.name, (first, second), (lower, higher), row.precession, row.threshold)
