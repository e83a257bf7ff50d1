"""Which rotor the charts are of, and how it is operated: here a state becomes a `System`.

Nothing here imports `State` when it runs: a process that makes maps does without it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rotorstab import ShaftDisk, System, finite_element, lumped

from .caches import shared_cache

if TYPE_CHECKING:
    from ..state import State

__all__ = ["ELEMENTS", "MODES", "Model", "Operation", "model_of"]

ELEMENTS, MODES = 20, 4
"""Finite elements of the shaft, and the modes that a live chart keeps of them."""


@dataclass(frozen=True)
class Model:
    """Which system the charts are of, but for spin speed and tangency.

    Parameters
    ----------
    rotor : ShaftDisk
    kind : str
        "lumped" or "finite elements".
    law : str
        Stiffness law of the lumped model, "linear" or "exact".
    external_damping, internal_damping : float
        Damping ratios ζ_e and ζ_i.
    """

    rotor: ShaftDisk
    kind: str = "lumped"
    law: str = "linear"
    external_damping: float = 0.0
    internal_damping: float = 0.0

    def system(self, spin_speed: float, tangency: float, law: str | None = None) -> System:
        """Return the system; `law` overrides the stiffness law of the lumped model."""
        damping = self.external_damping, self.internal_damping
        if self.kind == "lumped":
            return lumped(self.rotor, spin_speed, tangency, *damping, stiffness=law or self.law)
        return finite_element(self.rotor, spin_speed, tangency, ELEMENTS, MODES, *damping)

    @property
    def is_damped(self) -> bool:
        """Whether the model has damping of either kind."""
        return bool(self.external_damping or self.internal_damping)

    planes = False
    """Whether the bearings differ in two directions, as those of another rotor may."""

    def undamped(self) -> Model:
        """Return the model without damping, which is what Bolotin's method is for."""
        return replace(self, external_damping=0.0, internal_damping=0.0)


@dataclass(frozen=True)
class Operation:
    """A rotor that spins under a static load, and what factors and ratios of it are shares of.

    The growth map, the marked point and the lessons are of an operation. It can be pickled, and
    two equal ones have the same results.

    Parameters
    ----------
    model : Model
    spin_speed, tangency : float
        Ω̄ and μ.
    static_load : float
        p̄₀ [EI/L²].
    reference_load : float
        The load [EI/L²] of which the factors α_s and β_d are shares.
    fundamental_frequency : float
        ω_n [√(EI/(ρAL⁴))], of which the excitation frequencies of the charts are multiples.
    """

    model: Model
    spin_speed: float
    tangency: float
    static_load: float
    reference_load: float
    fundamental_frequency: float

    @property
    def system(self) -> System:
        """The system of the charts."""
        return _system(self.model, self.spin_speed, self.tangency)

    @property
    def undamped(self) -> System:
        """The system without damping, which is what Bolotin's method is for."""
        return _system(self.model.undamped(), self.spin_speed, self.tangency)

    def pulsating_load(self, factor: float) -> float:
        """Return p̄_t [EI/L²] of a dynamic load factor β_d."""
        return factor * self.reference_load

    def excitation_frequency(self, ratio: float) -> float:
        """Return θ̄ [√(EI/(ρAL⁴))] of a ratio θ/ω_n."""
        return ratio * self.fundamental_frequency


@shared_cache(32)
def _system(model: Model, spin_speed: float, tangency: float) -> System:
    """Return the system of an operation, which several charts of one answer need."""
    return model.system(spin_speed, tangency)


def model_of(state: State) -> Model:
    """Return the model of the present inputs."""
    return Model(
        state.rotor(), state.model, state.law, state.external_damping, state.internal_damping
    )
