"""How a state operates its rotor: the static load, and whether a load is past the stiffness law."""

from __future__ import annotations

from ..reading.user_error import UserError
from ..state import State
from .curves import reference_load, rotor_numbers
from .model import Operation, model_of

__all__ = ["check_peak", "operation_of"]


def operation_of(state: State, own_load: float | None = None) -> Operation:
    """Return the operation of the present inputs.

    Parameters
    ----------
    state : State
    own_load : float, optional
        Static load p̄₀ instead of α_s times the reference [EI/L²].

    Raises
    ------
    UserError
        Where the rotor has no load of the kind that load factors refer to.
    """
    model = model_of(state)
    reference = reference_load(model.rotor, state.reference)
    return Operation(
        model,
        state.spin_speed,
        state.effective_tangency(),
        state.static_load_factor * reference if own_load is None else own_load,
        reference,
        rotor_numbers(model.rotor).fundamental_frequency,
    )


def check_peak(operation: Operation, factor: float, advice: str) -> None:
    """Raise UserError where the load at a factor β_d is past the end of the stiffness law.

    Parameters
    ----------
    operation : Operation
    factor : float
        β_d.
    advice : str
        What the user can do, with which the message ends.
    """
    peak = operation.static_load + operation.pulsating_load(factor)
    system = operation.system
    if system.law is None or system.in_charts(peak):
        return
    raise UserError(
        f"With the {system.law.name} stiffness law the load must stay below "
        f"p̄ = {system.largest_load:.4g}, {system.law.pole_meaning}. Here "
        f"p̄₀ = {operation.static_load:.4g}, and with β_d = {factor:g} the load reaches {peak:.4g}: "
        f"{advice}."
    )
