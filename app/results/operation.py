"""The rotor as it is operated: its spin speed, its static load, and what factors and ratios mean.

The charts, the marked point and the lessons take their loads and frequencies from here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rotorstab import System

from ..reading.user_error import UserError
from ..state import State
from .curves import reference_load, rotor_numbers
from .model import Model, model_of

__all__ = ["Operation", "operation_of"]


@dataclass(frozen=True)
class Operation:
    """A rotor that spins under a static load; every result is computed once, when needed.

    Parameters
    ----------
    model : Model
    spin_speed, tangency : float
        Ω̄ and μ.
    static_load_factor : float
        α_s.
    reference : str
        The load that load factors refer to, "buckling" or "flutter".
    own_load : float or None
        Static load p̄₀ instead of α_s times the reference [EI/L²].
    """

    model: Model
    spin_speed: float
    tangency: float
    static_load_factor: float
    reference: str
    own_load: float | None = None

    @cached_property
    def system(self) -> System:
        """The system of the charts."""
        return self.model.system(self.spin_speed, self.tangency)

    @cached_property
    def undamped(self) -> System:
        """The system without damping, which is what Bolotin's method is for."""
        return self.model.undamped().system(self.spin_speed, self.tangency)

    @property
    def buckling_load(self) -> float:
        """Static buckling load p̄_cr."""
        return rotor_numbers(self.model.rotor)[0]

    @property
    def fundamental_frequency(self) -> float:
        """ω_n, of which the excitation frequencies of the charts are multiples."""
        return rotor_numbers(self.model.rotor)[1]

    @property
    def reference_load(self) -> float:
        """The load [EI/L²] of which the factors α_s and β_d are shares.

        Raises
        ------
        UserError
            Where the rotor has no such load.
        """
        return reference_load(self.model.rotor, self.reference)

    @property
    def static_load(self) -> float:
        """p̄₀ [EI/L²]."""
        if self.own_load is not None:
            return self.own_load
        return self.static_load_factor * self.reference_load

    def pulsating_load(self, factor: float) -> float:
        """Return p̄_t [EI/L²] of a dynamic load factor β_d."""
        return factor * self.reference_load

    def check_peak(self, factor: float, advice: str) -> None:
        """Raise UserError where the load at a factor β_d is past the end of the stiffness law.

        Parameters
        ----------
        factor : float
            β_d.
        advice : str
            What the user can do, with which the message ends.
        """
        peak = self.static_load + self.pulsating_load(factor)
        law = self.system.law
        if law is None or self.system.in_charts(peak):
            return
        raise UserError(
            f"With the {law.name} stiffness law the load must stay below "
            f"p̄ = {self.system.largest_load:.4g}, {law.pole_meaning}. Here "
            f"p̄₀ = {self.static_load:.4g}, and with β_d = {factor:g} the load reaches {peak:.4g}: "
            f"{advice}."
        )

    def excitation_frequency(self, ratio: float) -> float:
        """Return θ̄ [√(EI/(ρAL⁴))] of a ratio θ/ω_n."""
        return ratio * self.fundamental_frequency


def operation_of(state: State, own_load: float | None = None) -> Operation:
    """Return the operation of the present inputs, with a static load of its own if there is one."""
    return Operation(
        model_of(state),
        state.spin_speed,
        state.effective_tangency(),
        state.static_load_factor,
        state.reference,
        own_load,
    )
