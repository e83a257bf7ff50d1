"""Names of whirl modes: 1B, 1F, 2B, 2F and so on.

The number counts by |ω| within each direction of precession, B backward and F forward, of the
undamped rotor without load. Along a curve a mode keeps its name.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .._arguments import LARGEST, number
from .._tolerances import NEGLIGIBLE
from .._types import ArrayLike, Complex
from ..model.system import System, single_speed
from .frequencies import whirl_frequencies
from .tracking import nearest_columns, track

__all__ = ["mode_names", "named_frequencies", "names_by_rank", "names_of"]

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
        If the system has several spin speeds, or the load is not finite or past the pole of the
        stiffness.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> system = lumped(ShaftDisk(), 2.0, external_damping=0.01)
    >>> dict(zip(mode_names(system.size), named_frequencies(system).real.round(4).tolist()))
    {'2B': -1.7334, '1B': -0.2661, '1F': 1.073, '2F': 4.9265}
    """
    single_speed(system)
    load = number("load", load, -LARGEST, LARGEST)
    loads = np.linspace(0.0, load, _LOADS) if load else np.zeros(1)
    rows = [whirl_frequencies(system, loads)]
    if system.is_damped:
        # quadratic steps, for the fastest modes are overdamped first
        share = np.linspace(0.0, 1.0, _DAMPINGS)[:-1, None, None] ** 2
        rising = replace(
            system,
            external_damping=share * system.external_damping,
            internal_damping=share * system.internal_damping,
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
        In the order of `frequencies`. Undamped modes are named by rank, see `names_by_rank`.
    """
    if not system.is_damped:
        return names_by_rank(frequencies)
    names = mode_names(system.size)
    given = np.asarray(frequencies, dtype=np.complex128)
    return tuple(names[i] for i in nearest_columns(given, named_frequencies(system, load)))
