"""Critical loads: static buckling, and flutter under a follower load."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import number, numbers
from .stiffness import largest_exact_load
from .system import System
from .whirl import whirl_frequencies

__all__ = ["critical_load", "flutter_load"]

_NOISE = 1e-6  # a double root is known to about 1e-8 only


def critical_load(shear: ArrayLike) -> NDArray[np.float64]:
    """Return the static buckling load of the axially loaded cantilever shaft.

    p̄_cr = (π²/4)/(1 + Φπ²/4), the first zero of det K of Appendix A.

    Parameters
    ----------
    shear : (...) float
        Φ [-], in [0, 1).

    Returns
    -------
    (...) float
        p̄_cr [EI/L²].

    Raises
    ------
    ValueError
        If Φ is out of range.

    Examples
    --------
    >>> float(critical_load(0.0192).round(7))
    2.3557973
    """
    shear = numbers("shear", shear, 0.0, 1.0, open_high=True)
    return np.asarray(np.pi**2 / 4 / (1 + shear * np.pi**2 / 4))


def flutter_load(system: System, largest_load: float | None = None) -> float:
    """Return the first load at which two whirl frequencies coalesce away from ω = 0.

    Parameters
    ----------
    system : System
        Undamped, at one spin speed.
    largest_load : float, optional
        End of the search [EI/L²]; by default the pole of the exact stiffness for a
        shaft with this shear, or 4π² where the shear is not known.

    Returns
    -------
    float
        p̄ [EI/L²]; inf where there is no coalescence up to `largest_load`.

    Raises
    ------
    ValueError
        If the system is damped: its frequencies are complex at every load.

    Notes
    -----
    The load is scanned in 400 steps, then the step is narrowed to 1e-10. Under an axial
    load at rest two frequencies meet at ω = 0: buckling, which is not counted.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> round(flutter_load(lumped(ShaftDisk(), 0.0, tangency=1.0)), 5)
    6.2901
    """
    if system.is_damped:
        raise ValueError("`system` must be undamped for a coalescence, got a damped one")
    if largest_load is None:
        pole = float(largest_exact_load(system.exact_shear or 0.0))
        largest_load = pole * (1 - 1e-9)
    high = number("largest_load", largest_load, 0.0, open_low=True)
    low = 0.0
    for steps in (400, 64, 64, 64, 64):
        loads = np.linspace(low, high, steps + 1)
        frequencies = whirl_frequencies(system, loads)
        scale = np.abs(frequencies).max(axis=-1, keepdims=True)
        coalesced = (np.abs(frequencies.imag) > _NOISE * scale) & (
            np.abs(frequencies.real) > _NOISE * scale
        )
        found = np.flatnonzero(coalesced.any(axis=-1))
        if not found.size:
            return float("inf")
        first = int(found[0])
        if first == 0:
            return float(loads[0])
        low, high = float(loads[first - 1]), float(loads[first])
    return (low + high) / 2
