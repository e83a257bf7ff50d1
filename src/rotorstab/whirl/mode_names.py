"""Names of whirl modes: 1B, 1F, 2B, 2F and so on.

The number counts by |ω| within each direction of precession, B backward and F forward, of the
undamped rotor without load. Along a curve a mode keeps its name.

With the coordinates of two planes each root ω > 0 is one motion, and its orbit tells the direction:
B, F, or S for straight lines. The root −ω of the same motion has a minus before its name.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .._arguments import LARGEST_LOAD, number
from .._tolerances import NEGLIGIBLE, STRAIGHT_ORBIT
from .._types import AnyArray, Array, ArrayLike, Complex
from ..model.modal import modal_basis
from ..model.system import System, single_speed
from .frequencies import whirl_frequencies
from .tracking import nearest_columns, track

__all__ = [
    "kinetic_energy",
    "mode_names",
    "named_frequencies",
    "names_by_orbit",
    "names_by_rank",
    "names_of",
]

_LOADS, _DAMPINGS = 48, 160  # steps in which a spectrum is followed


def mode_names(size: int) -> tuple[str, ...]:
    """Return the names of the 2n modes in ascending order of their frequency ω at no load.

    Parameters
    ----------
    size : int
        Number n of complex coordinates.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> mode_names(2)
    ('2B', '1B', '1F', '2F')
    """
    backward = [f"{number}B" for number in range(size, 0, -1)]
    return (*backward, *(f"{number}F" for number in range(1, size + 1)))


def names_by_rank(frequencies: ArrayLike) -> tuple[str, ...]:
    """Name frequencies by their rank in |ω| within each direction of precession.

    Parameters
    ----------
    frequencies : (2n,) float or complex
        Signed ω in any order. The real part decides; ω ≥ 0 is forward.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> names_by_rank([-0.4, -1.9, 0.9, 3.4])
    ('1B', '2B', '1F', '2F')
    """
    real = np.real(np.asarray(frequencies))
    names = [""] * len(real)
    for letter, members in (("B", np.flatnonzero(real < 0)), ("F", np.flatnonzero(real >= 0))):
        for rank, index in enumerate(members[np.argsort(np.abs(real[members]), kind="stable")]):
            names[index] = f"{rank + 1}{letter}"
    return tuple(names)


def kinetic_energy(system: System, part: AnyArray) -> Array:
    """Return qᴴMq (k,) of circular parts (n/2, k) of motions of two planes, M that of one plane."""
    half = system.size // 2
    mass = system.mass[:half, :half]
    return np.asarray(np.einsum("ik,ij,jk->k", part.conj(), mass, part).real)


def names_by_orbit(system: System, frequencies: AnyArray, vectors: AnyArray) -> tuple[str, ...]:
    """Name the modes of a system of two planes by their orbits.

    Parameters
    ----------
    system : System
        Of two planes.
    frequencies : (2n,) float or complex
        ω, sorted by real part.
    vectors : (2n, 2n) float or complex
        One column for each ω; its first n rows are q.

    Returns
    -------
    tuple of str
        F, B or S for forward, backward or straight, numbered by |ω|; with a minus for ω < 0. Where
        stations of one mode whirl in different directions, that with the larger kinetic energy
        names it.
    """
    half = system.size // 2
    first, second = vectors[:half], vectors[half : 2 * half]
    forward = kinetic_energy(system, first + second)
    backward = kinetic_energy(system, first - second)
    # the root −ω turns its orbit the other way
    lead = (forward - backward) * np.where(np.real(frequencies) < 0, -1, 1)
    straight = np.abs(lead) <= STRAIGHT_ORBIT * (forward + backward)
    letters = np.where(straight, "S", np.where(lead > 0, "F", "B"))
    count = {"F": 0, "B": 0, "S": 0}
    names = [""] * len(letters)
    for up in range(half * 2, 4 * half):
        letter = str(letters[up])
        count[letter] += 1
        names[up] = f"{count[letter]}{letter}"
        names[len(names) - 1 - up] = "−" + names[up]
    return tuple(names)


def named_frequencies(system: System, load: float = 0.0) -> Complex:
    """Return the whirl frequencies in the order of `mode_names`.

    The frequencies are followed from the undamped rotor without load: first the damping is raised
    to its value, then the load. For a strongly damped whirl has no order by frequency: its Re ω
    may be anything.

    Parameters
    ----------
    system : System
        It has one spin speed.
    load : float
        p̄ [EI/L²].

    Returns
    -------
    (2n,) complex
        ω [√(EI/(ρAL⁴))].

    Raises
    ------
    ValueError
        If the system has several spin speeds or is one of two planes, or the load is not finite
        or past the pole of the stiffness.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> system = lumped(ShaftDisk(), 2.0, external_damping=0.01)
    >>> dict(zip(mode_names(system.size), named_frequencies(system).real.round(4).tolist()))
    {'2B': -1.7334, '1B': -0.2661, '1F': 1.073, '2F': 4.9265}
    """
    single_speed(system)
    if system.planes:
        raise ValueError("`system` must have complex coordinates, got one of two planes")
    load = number("load", load, -LARGEST_LOAD, LARGEST_LOAD)
    loads = np.linspace(0.0, load, _LOADS) if load else np.zeros(1)
    rows = [whirl_frequencies(system, loads)]
    if system.is_damped:
        # quadratic steps, for the fastest modes are overdamped first
        share = np.linspace(0.0, 1.0, _DAMPINGS)[:-1, None, None] ** 2
        parts = ("external_damping", "internal_damping", "cross_stiffness", "cross_damping")
        given = {name: getattr(system, name) for name in parts}
        rising = replace(
            system, **{name: share * part for name, part in given.items() if part is not None}
        )
        rows.insert(0, whirl_frequencies(rising, 0.0))
    found = track(np.concatenate(rows))[-1]
    small = NEGLIGIBLE * np.abs(found).max()
    found.real[np.abs(found.real) <= small] = 0.0
    found.imag[np.abs(found.imag) <= small] = 0.0
    return np.asarray(found)


def names_of(system: System, load: float, frequencies: ArrayLike) -> tuple[str, ...]:
    """Return the names of the whirl frequencies of a system, as the whirl curves give them.

    Parameters
    ----------
    system : System
        It has one spin speed.
    load : float
        p̄ [EI/L²].
    frequencies : (2n,) float or complex
        ω of this system at this load, in any order [√(EI/(ρAL⁴))].

    Returns
    -------
    tuple of str
        In the order of `frequencies`. Undamped modes are named by rank, see `names_by_rank`, those
        of a system of two planes by their orbits.
    """
    if system.planes:
        basis = modal_basis(system, load)
        names = names_by_orbit(system, basis.frequencies, basis.vectors)
        given = np.asarray(frequencies, dtype=np.complex128)
        found = np.asarray(basis.frequencies, dtype=np.complex128)
        return tuple(names[i] for i in nearest_columns(given, found))
    if not system.is_damped:
        return names_by_rank(frequencies)
    names = mode_names(system.size)
    given = np.asarray(frequencies, dtype=np.complex128)
    return tuple(names[i] for i in nearest_columns(given, named_frequencies(system, load)))
