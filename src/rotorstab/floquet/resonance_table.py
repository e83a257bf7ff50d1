"""Pairs of modes that the pulsating load couples, as rows of a table."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .._types import AnyArray
from .criterion import mean_is_unstable

__all__ = ["HIGHEST_NAMED_ORDER", "Resonance", "ResonanceTable"]

HIGHEST_NAMED_ORDER = 9
"""Largest k of θ̄ = |ω_i − ω_j|/k up to which tongues are named after a pair of modes.

Tongues of higher orders stand so close together that the nearest one says little.
"""


@dataclass(frozen=True)
class Resonance:
    """A pair of modes that the pulsating load can couple.

    Parameters
    ----------
    first, second : str
        Names of the two modes; backward before forward, then by number.
    centre : float
        θ̄ = |ω_i − ω_j|/k [√(EI/(ρAL⁴))], the first-order centre of the tongue; k is `harmonic`.
    coupling : complex
        g = B'_ij B'_ji, see `resonances`; real without damping. The modes make a tongue if g > 0.
    growth_per_load : float
        Peak growth rate per unit pulsating load without the decay of the modes, Re√g/2; 0 if the
        modes make no tongue.
    growth : float
        Peak growth rate [√(EI/(ρAL⁴))] at the given pulsating load, damping included; negative if
        the pair decays, NaN if one of the modes grows without pulsation.
    half_width : float
        Half-width in θ̄ of the tongue at the given pulsating load; 0 where the pair is stable.
    threshold : float
        Pulsating load p̄_t [EI/L²] above which the pair is unstable: 0 without damping, inf if the
        modes make no tongue.
    unstable : bool
        Whether the pair is unstable at the given pulsating load; without damping, at any load.
        Always False where the mean system is unstable by itself.
    kind : str
        "principal" (backward and forward whirl of one number), "sum" (two numbers, opposite
        precession) or "difference" (same precession). With two planes: "principal" is twice one
        frequency, "sum" and "difference" are those of two.
    precession : str
        "same" or "opposite".
    modes : (int, int)
        Which of the table's frequencies the two are.
    harmonic : int
        k, number of the load's harmonic that couples them.
    amplitude : float
        |a_k| of that harmonic.
    sign : str
        Stands between the names: "−" for a difference of two planes, else "+".
    """

    first: str
    second: str
    centre: float
    coupling: complex
    growth_per_load: float
    growth: float
    half_width: float
    threshold: float
    unstable: bool
    kind: str
    precession: str
    modes: tuple[int, int]
    harmonic: int = 1
    amplitude: float = 1.0
    sign: str = "+"

    @property
    def name(self) -> str:
        """The pair as one label, such as 1B+1F; (1B+1F)/2 by the second harmonic of the load."""
        pair = f"{self.first}{self.sign}{self.second}"
        return pair if self.harmonic == 1 else f"({pair})/{self.harmonic}"


@dataclass(frozen=True)
class ResonanceTable:
    """Every pair of modes of one system under one load, sorted by centre.

    Parameters
    ----------
    rows : tuple of Resonance
        All n(2n − 1) pairs of the 2n modes, once for each harmonic of the load. Of a system of two
        planes a pair and its mirror image, −ω for ω, are one row.
    frequencies : (2n,) float or complex
        Whirl frequencies of the mean system, sorted by real part.
    modes : tuple of str
        Their names.
    mean_growth : float
        Growth rate of the mean system, that is without pulsation: max(−Im ω).
    planes : bool
        Whether the system is one of two planes.
    """

    rows: tuple[Resonance, ...]
    frequencies: AnyArray
    modes: tuple[str, ...]
    mean_growth: float
    planes: bool = False

    def __iter__(self) -> Iterator[Resonance]:
        """Iterate over the rows."""
        return iter(self.rows)

    def __len__(self) -> int:
        """Return the number of pairs."""
        return len(self.rows)

    def __getitem__(self, name: str) -> Resonance:
        """Return the pair with a given name, such as "1B+1F"."""
        for row in self.rows:
            if row.name == name:
                return row
        raise KeyError(name)

    @property
    def tongues(self) -> tuple[Resonance, ...]:
        """The unstable pairs only."""
        return tuple(row for row in self.rows if row.unstable)

    @property
    def mean_is_unstable(self) -> bool:
        """Whether the mean system grows without pulsation, by more than rounding."""
        return bool(mean_is_unstable(self.frequencies))

    def nearest(
        self, frequency: float, highest_order: int = HIGHEST_NAMED_ORDER
    ) -> tuple[Resonance, int] | None:
        """Return the pair and order k whose θ̄ = |ω_i − ω_j|/k explains a frequency best.

        Parameters
        ----------
        frequency : float
            θ̄ [√(EI/(ρAL⁴))], above 0.
        highest_order : int
            Largest k considered.

        Returns
        -------
        (Resonance, int) or None
            Smallest k |ln(|ω_i − ω_j|/(kθ̄))|: a higher order must be nearer to be chosen. Only
            pairs that make a tongue without damping count; None if there are none.
        """
        choices = [
            (abs(math.log(row.centre / k / frequency)) * k, row.name, k)
            for row in self.rows
            if row.growth_per_load > 0 and row.centre > 0
            for k in range(1, highest_order + 1)
        ]
        if not choices:
            return None
        _, name, order = min(choices)
        return self[name], order
