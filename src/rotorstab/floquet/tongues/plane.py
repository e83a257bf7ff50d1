"""The plane of pulsating load and excitation frequency, and what is unstable at its points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..._tolerances import VISIBLE_GROWTH
from ..._types import Array
from ...model.system import System
from ..point import floquet_solution
from ..resonance_table import ResonanceTable
from .collision_measure import pair_closeness

__all__ = ["Plane"]

_RANKS = 3  # closest pairs of multipliers that are examined at a point


@dataclass(frozen=True)
class Plane:
    """The plane of pulsating load and excitation frequency of one system under one static load.

    Parameters
    ----------
    system : System
        At one spin speed.
    static : float
        p̄₀ [EI/L²].
    table : ResonanceTable
        Of the same system and static load.
    """

    system: System
    static: float
    table: ResonanceTable

    @property
    def decay(self) -> float:
        """Slowest decay rate of the rotor without pulsation, 0 without damping."""
        return max(-self.table.mean_growth, 0.0)

    @property
    def decays(self) -> bool:
        """Whether the rotor decays without pulsation, so that each tongue has a lowest point."""
        return self.decay >= VISIBLE_GROWTH

    @property
    def strength(self) -> float:
        """Largest √|g| of the table: the rate per unit load at which the load couples modes."""
        return float(max(abs(row.coupling) for row in self.table) ** 0.5)

    @property
    def limit(self) -> float:
        """Pulsating load at which the stiffness has its pole, inf where it has none."""
        return self.system.pole - self.static

    @property
    def closeness_needed(self) -> float:
        """Closeness, as in `sample`, that a pair must exceed in order to grow [EI/(ρAL⁴)]."""
        return self.growth_counted**2 + self.decay**2 / 2

    @property
    def growth_counted(self) -> float:
        """Growth above which a point counts as unstable [√(EI/(ρAL⁴))].

        It is 0 where the rotor decays without pulsation: its margin is the limit of stability, a
        root of the growth rate, and not a verdict, which rounding would decide there.
        """
        return 0.0 if self.decays else VISIBLE_GROWTH

    def sample(self, load: Array, frequency: Array) -> tuple[Array, Array]:
        """Return how far points exceed the limit of stability, and how close pairs are.

        Parameters
        ----------
        load, frequency : (...) float
            p̄_t and θ̄.

        Returns
        -------
        excess : (...) float
            Above 0 at unstable points: the growth rate less `growth_counted` or, without damping,
            its square less the square of `growth_counted`, for there growth starts like a square
            root.
        closeness : (..., R) float
            Re ((ln μ_i − ln μ_j)/2T)² of the closest pairs, closest first: −(half the detuning)²
            outside a tongue, (growth)² of an undamped one inside.
        """
        solution = floquet_solution(self.system, self.static, load, frequency)
        rate = np.asarray(frequency / (2 * np.pi))
        pairs = pair_closeness(solution.multipliers) * rate[..., None] ** 2
        closeness = -np.sort(-pairs, axis=-1)[..., :_RANKS]
        if self.system.is_damped:
            return solution.growth_rate - self.growth_counted, closeness
        return closeness[..., 0] - self.growth_counted**2, closeness

    def excess(self, load: Array, frequency: Array) -> Array:
        """Return the first result of `sample`."""
        return self.sample(load, frequency)[0]
