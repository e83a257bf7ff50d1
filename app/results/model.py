"""Which rotor system the charts are of: the one place where a state becomes a `System`.

Nothing here imports `State` when it runs: a process that makes maps does without it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rotorstab import ShaftDisk, System, finite_element, lumped

if TYPE_CHECKING:
    from ..state import State

__all__ = ["ELEMENTS", "MODES", "Model", "model_of"]

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

    def undamped(self) -> Model:
        """Return the model without damping, which is what Bolotin's method is for."""
        return replace(self, external_damping=0.0, internal_damping=0.0)


def model_of(state: State) -> Model:
    """Return the model of the present inputs."""
    return Model(
        state.rotor(), state.model, state.law, state.external_damping, state.internal_damping
    )
