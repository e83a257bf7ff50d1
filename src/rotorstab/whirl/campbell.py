"""Whirl frequencies as curves: over the static load, and over the spin speed (Campbell)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._arguments import number, series
from .._types import Array, ArrayLike, Complex
from ..model.system import System, single_speed
from .frequencies import whirl_frequencies
from .mode_names import mode_names, named_frequencies, names_of
from .tracking import nearest_columns, track

__all__ = ["WhirlCurves", "campbell_diagram", "load_frequency_curves"]


@dataclass(frozen=True, eq=False)
class WhirlCurves:
    """Whirl frequencies followed by continuity.

    Parameters
    ----------
    parameter : (m,) float
        Load p̄ [EI/L²] or spin speed Ω̄ [√(EI/(ρAL⁴))].
    frequencies : (m, 2n) complex
        ω [√(EI/(ρAL⁴))], one mode a column.
    names : tuple of str
        2n names, such as ("2B", "1B", "1F", "2F"): the number counts by |ω| within backward (B)
        and forward (F) whirls of the undamped rotor without load. With a system of two planes they
        are those of the orbits where the curves start; −ω has the name of ω with a minus.
    """

    parameter: Array
    frequencies: Complex
    names: tuple[str, ...]


def load_frequency_curves(system: System, loads: ArrayLike) -> WhirlCurves:
    """Return the whirl frequencies over a range of static loads (Fig. 8 of the source paper).

    Parameters
    ----------
    system : System
        It has one spin speed.
    loads : (m,) float
        Ascending loads p̄ [EI/L²]. Modes are followed from the load nearest to 0.

    Returns
    -------
    WhirlCurves
        The columns of a pair that has become complex are conjugates.

    Raises
    ------
    ValueError
        If the loads are not a list of finite numbers or are past the pole of the stiffness,
        or if the system has several spin speeds.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> curves = load_frequency_curves(lumped(ShaftDisk(), 2.0), [0.0, 0.5, 1.0])
    >>> curves.names, curves.frequencies.shape
    (('2B', '1B', '1F', '2F'), (3, 4))
    """
    loads = series("loads", loads)
    single_speed(system)
    start = int(np.abs(loads).argmin()) if loads.size else 0
    rows = track(whirl_frequencies(system, loads), start)
    if system.planes and loads.size:
        return WhirlCurves(loads, rows, names_of(system, float(loads[start]), rows[start]))
    if system.is_damped and loads.size:
        named = named_frequencies(system, float(loads[start]))
        rows = rows[:, nearest_columns(named, rows[start])]
    return WhirlCurves(loads, rows, mode_names(system.size))


def campbell_diagram(system: System, spin_speeds: ArrayLike, load: float = 0.0) -> WhirlCurves:
    """Return the whirl frequencies over a range of spin speeds at one static load.

    Parameters
    ----------
    system : System
        Its own spin speed is not used.
    spin_speeds : (m,) float
        Ascending Ω̄ [√(EI/(ρAL⁴))]. Modes are followed from the first speed; with damping, or
        with two planes, they are named at the fastest.
    load : float
        p̄ [EI/L²].

    Returns
    -------
    WhirlCurves

    Raises
    ------
    ValueError
        If the speeds are not a list of finite numbers, or the load is not finite or past the pole
        of the stiffness.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> curves = campbell_diagram(lumped(ShaftDisk(), 0.0), [0.0, 1.0, 2.0])
    >>> curves.frequencies[-1].real.round(4).tolist()
    [-1.7334, -0.2661, 1.073, 4.9265]
    """
    speeds = series("spin_speeds", spin_speeds)
    load = number("load", load)
    rows = track(whirl_frequencies(system.at_speed(speeds), load))
    fastest = int(np.abs(speeds).argmax()) if speeds.size else 0
    if system.planes and speeds.size:
        names = names_of(system.at_speed(speeds[fastest]), load, rows[fastest])
        return WhirlCurves(speeds, rows, names)
    if system.is_damped and speeds.size:
        # there the two directions differ most; at rest an overdamped pair has no direction
        named = named_frequencies(system.at_speed(speeds[fastest]), load)
        rows = rows[:, nearest_columns(named, rows[fastest])]
    return WhirlCurves(speeds, rows, mode_names(system.size))
