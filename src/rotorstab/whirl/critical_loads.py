"""Critical loads: static buckling, flutter of a rotor, and flutter of the shaft alone."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import brentq

from .._arguments import number, numbers, whole_number
from .._numerics.extrapolation import extrapolation_weights
from .._tolerances import COALESCED, FLUTTER_SEARCH_SHORT_OF_POLE
from .._types import Array, ArrayLike
from ..model.finite_element import finite_element
from ..model.stiffness import largest_exact_load
from ..model.system import System, single_speed
from ..rotors.shaft_disk import ShaftDisk
from .frequencies import whirl_frequencies

__all__ = ["beck_load", "critical_load", "flutter_load"]

_STEPS = (400, 128, 128, 128, 64)  # of the nested scans for flutter: 2e-11 of the range in all
_BECK_STEPS = 64  # loads up to the pole at which the two lowest ω² are compared


def critical_load(shear: ArrayLike) -> Array:
    """Return the static buckling load of the axially loaded cantilever shaft.

    p̄_cr = (π²/4)/(1 + Φπ²/4), the smallest load at which det K of Appendix A is zero.

    Parameters
    ----------
    shear : (...) float
        Shear parameter Φ [-], in [0, 1).

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
    # Euler's load of the cantilever; shear adds Φ to its reciprocal
    euler = np.pi**2 / 4
    return np.asarray(euler / (1 + shear * euler))


def flutter_load(system: System, largest_load: float | None = None) -> float:
    """Return the first load at which two whirl frequencies coalesce away from ω = 0.

    Parameters
    ----------
    system : System
        Undamped, with one spin speed.
    largest_load : float, optional
        End of the search [EI/L²]. By default it is the pole of the stiffness, at most 4π².

    Returns
    -------
    float
        p̄ [EI/L²], inf where there is no coalescence up to `largest_load`.

    Raises
    ------
    ValueError
        If the system is damped (its frequencies are complex at every load) or has several spin
        speeds, or `largest_load` is not positive or past the pole of the exact stiffness.

    Notes
    -----
    The load is scanned in 400 steps, then the step in which the first pair coalesces is narrowed
    to 1e-9. A flutter interval that is narrower than one of the 400 steps may be missed. Under
    an axial load at rest two frequencies meet at ω = 0: that is buckling and does not count.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> round(flutter_load(lumped(ShaftDisk(), 0.0, tangency=1.0)), 5)
    6.2901
    """
    if system.is_damped:
        raise ValueError("`system` must be undamped for a coalescence, got a damped one")
    single_speed(system)
    if largest_load is None:
        pole = min(system.pole, float(largest_exact_load(0.0)))
        largest_load = pole * (1 - FLUTTER_SEARCH_SHORT_OF_POLE)
    high = number("largest_load", largest_load, 0.0, open_low=True)
    low = 0.0
    for steps in _STEPS:
        loads = np.linspace(low, high, steps + 1)
        frequencies = whirl_frequencies(system, loads)
        growth, whirl = np.abs(frequencies.imag), np.abs(frequencies.real)
        away = whirl > COALESCED * whirl.max(axis=-1, keepdims=True)
        found = np.flatnonzero((away & (growth > COALESCED * whirl)).any(axis=-1))
        if not found.size:
            return float("inf")
        first = int(found[0])
        if first == 0:
            return float(loads[0])
        low, high = float(loads[first - 1]), float(loads[first])
    return (low + high) / 2


def _beck_load_on_mesh(shaft: ShaftDisk, elements: int) -> float:
    """Return the load at which the two lowest ω² of the follower-loaded shaft meet, inf if none."""
    system = finite_element(shaft, 0.0, tangency=1.0, elements=elements)

    def gap(load: Any) -> Any:
        """Return (ω₂² − ω₁²)², which is smooth, and negative once the pair is complex."""
        squares = np.linalg.eigvals(np.linalg.solve(system.mass, system.load_stiffness(load)))
        lowest = np.sort_complex(squares)[..., :2]
        return np.asarray(((lowest[..., 1] - lowest[..., 0]) ** 2).real)

    loads = np.linspace(0.0, float(largest_exact_load(shaft.shear)), _BECK_STEPS + 1)
    beyond = np.flatnonzero(gap(loads) < 0)
    if not beyond.size:
        return float("inf")
    first = int(beyond[0])
    return float(brentq(lambda load: float(gap(load)), loads[first - 1], loads[first], xtol=1e-11))


def beck_load(shear: float, slenderness: float, elements: int = 40) -> float:
    """Return the flutter load of the shaft alone under a follower load (Beck's column).

    Parameters
    ----------
    shear : float
        Shear parameter Φ [-], in [0, 1).
    slenderness : float
        r = √(I/A)/L [-], in [0, 1); it sets the rotary inertia.
    elements : int
        Number n of elements of the finest of three meshes, n/4, n/2 and n: a multiple of 4 in
        [8, 200].

    Returns
    -------
    float
        p̄ [EI/L²] in the mesh limit, inf where no pair of frequencies meets below the pole of the
        exact stiffness.

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    Richardson's extrapolation removes the errors of order h² and h⁴. At 40 elements the error
    against the exact transfer-matrix solution is below 1e-7 of the value. The follower "critical
    load" 12.3019 of the source paper is this load of its shaft.

    References
    ----------
    M. Beck, Die Knicklast des einseitig eingespannten, tangential gedrückten Stabes,
    ZAMP 3 (1952) 225–228.

    Examples
    --------
    >>> round(beck_load(0.0, 0.0), 4), round(beck_load(0.0192, 0.08), 4)
    (20.051, 12.302)
    """
    count = whole_number("elements", elements, 8, 200)
    if count % 4:
        raise ValueError(f"`elements` must be a multiple of 4 in [8, 200], got {elements!r}")
    shaft = ShaftDisk(shear, 0.0, 0.0, 0.0, slenderness)
    loads = np.array([_beck_load_on_mesh(shaft, count // part) for part in (4, 2, 1)])
    if not np.isfinite(loads).all():
        return float("inf")
    return float(extrapolation_weights((1, 2, 4), order=2) @ loads)
