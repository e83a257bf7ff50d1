"""Outlines of the unstable set of any system, large ones through their first two modes."""

from __future__ import annotations

import math

import numpy as np

from ..floquet.tongues.outlines import Outline, unstable_outlines
from ..model.finite_element import first_modes
from ..model.system import System
from ..whirl.frequencies import whirl_frequencies

__all__ = ["tongue_outlines"]

# The outlines of two modes end at this share of the lowest resonance that a third mode takes part
# in: nearer to it the two modes say nothing about the system.
_CLEAR_OF_THIRD_MODE = 0.95
# Largest relative error of the four slowest whirl frequencies with which two modes represent the
# system.
_TWO_MODES_ERROR = 1e-2


def tongue_outlines(
    system: System,
    static_load: float,
    largest_load: float,
    lowest_frequency: float,
    highest_frequency: float,
    *,
    most_cycles: float = math.inf,
) -> tuple[Outline, ...]:
    """Return the outlines of the unstable set, from the first two modes of a larger system.

    Parameters
    ----------
    system : System
        One spin speed, any number of coordinates; damped or not, any stiffness law.
    static_load, largest_load : float
        p̄₀ and the top of p̄_t [EI/L²]; the second above 0.
    lowest_frequency, highest_frequency : float
        Window of θ̄ [√(EI/(ρAL⁴))], above 0.
    most_cycles : float
        Largest number of cycles of the fastest whirl in one period of the load. The outlines begin
        at the θ̄ that this allows: the time that they take rises with the number of cycles.

    Returns
    -------
    tuple of Outline
        Empty where the window has no outline, and where two modes do not represent the system.

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    The outlines are exact for a system of two coordinates. Those of a larger system are right to
    1e-2 at small loads and some percent off at β_d = 1. They end below the resonances of the third
    mode. There are none where two modes do not give the four slowest whirl frequencies to 1e-2, as
    with a fast disk of large polar inertia.
    """
    if system.size > 2:
        whirl = whirl_frequencies(system, static_load).real
        slow, fast = np.split(whirl[np.argsort(np.abs(whirl))], [4])
        third = float(np.abs(np.subtract.outer(fast, slow)).min())
        highest_frequency = min(highest_frequency, _CLEAR_OF_THIRD_MODE * third)
        system = first_modes(system, static_load)
        two = np.sort(whirl_frequencies(system, static_load).real)
        slow.sort()
        # a frequency near 0 is compared with the window, in which θ̄ is a sum of two of them
        scale = np.maximum(np.abs(slow), lowest_frequency / 2)
        if (np.abs(two - slow) > _TWO_MODES_ERROR * scale).any():
            return ()
    fastest = float(np.abs(whirl_frequencies(system, static_load)).max())
    lowest_frequency = max(lowest_frequency, fastest / most_cycles)
    if highest_frequency <= lowest_frequency:
        return ()
    return unstable_outlines(system, static_load, largest_load, lowest_frequency, highest_frequency)
