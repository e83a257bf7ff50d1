"""The value of a quantity for one set of inputs, cached and shared by sessions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..reading.user_error import UserError
from ..results.caches import shared_cache
from .quantities import find
from .situation import Situation

__all__ = ["evaluate"]


@shared_cache(64)
def _situation(items: tuple[tuple[str, Any], ...], load: float | None) -> Situation:
    return Situation(dict(items), load)


@shared_cache(512)
def _evaluate(name: str, items: tuple[tuple[str, Any], ...], load: float | None) -> float:
    found = find(name)
    if found is None:
        raise UserError(f"no quantity named {name!r}")
    quantity, parts = found
    try:
        return float(quantity.compute(_situation(items, load), *parts))
    except KeyError:
        raise UserError(
            f"{name!r}: there is no such pair of modes; write B before F and 1 before 2"
        ) from None


def evaluate(name: str, inputs: Mapping[str, Any], load: float | None = None) -> float:
    """Return a quantity for one set of inputs.

    Parameters
    ----------
    name : str
        Such as "whirl.1F".
    inputs : mapping
        Every input of `State`, by name.
    load : float, optional
        Static load p̄₀ instead of α_s times the reference; tension below 0 [EI/L²].

    Returns
    -------
    float
        NaN or inf where the rotor has no such number.

    Raises
    ------
    UserError
        If there is no such quantity, or these inputs have no answer.
    """
    return _evaluate(name, tuple(inputs.items()), load)
