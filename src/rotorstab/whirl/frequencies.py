"""Whirl frequencies, mode tracking, load–frequency curves, Campbell diagram, critical speeds.

Signed frequency ω: a solution e^{jωt}; ω > 0 is forward, ω < 0 backward precession, and
an imaginary part below 0 is growth. Modes are named 1B, 1F, 2B, 2F … (theory.md's order:
by |ω| within each direction, at no load).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.linalg import eigvals
from scipy.optimize import linear_sum_assignment

from .._arguments import LARGEST, number, numbers, series
from .._numerics.quartic import quartic_roots
from .._numerics.roots import is_real
from .._tolerances import NEGLIGIBLE
from .._types import Array, ArrayLike, Complex
from ..model.modal import mode_names as ranked_names
from ..model.modal import state_matrix
from ..model.system import System, single_speed

__all__ = [
    "CriticalSpeeds",
    "WhirlCurves",
    "campbell_diagram",
    "critical_speeds",
    "load_frequency_curves",
    "mode_names",
    "named_frequencies",
    "names_of",
    "track",
    "whirl_frequencies",
]

_LOADS, _DAMPINGS = 48, 160  # steps in which a spectrum is followed to be named


@dataclass(frozen=True, eq=False)
class WhirlCurves:
    """Whirl frequencies followed by continuity.

    Parameters
    ----------
    parameter : (m,) float
        Load p̄ or spin speed Ω̄.
    frequencies : (m, 2n) complex
        One mode a column [√(EI/(ρAL⁴))].
    names : tuple of str
        2n names, such as ("2B", "1B", "1F", "2F").
    """

    parameter: Array
    frequencies: Complex
    names: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class CriticalSpeeds:
    """Spin speeds at which a whirl is synchronous, ω = Ω̄ or ω = −Ω̄.

    Parameters
    ----------
    forward, backward : (k,) float
        Ascending [√(EI/(ρAL⁴))].
    """

    forward: Array
    backward: Array


def mode_names(size: int) -> tuple[str, ...]:
    """Return the 2n mode names in ascending order of signed frequency at no load.

    Examples
    --------
    >>> mode_names(2)
    ('2B', '1B', '1F', '2F')
    """
    backward = [f"{number}B" for number in range(size, 0, -1)]
    return (*backward, *(f"{number}F" for number in range(1, size + 1)))


def entries(matrix: Array) -> tuple[Any, ...]:
    """Return the four entries of 2 × 2 matrices, as plain numbers for a single one."""
    if matrix.ndim == 2:
        return tuple(matrix.ravel().tolist())
    return tuple(matrix[..., i, j] for i in range(2) for j in range(2))


def mixed(a: tuple[Any, ...], b: tuple[Any, ...]) -> Any:
    """Return the coefficient of t in det(a + tb) for the `entries` of 2 × 2 matrices.

    Examples
    --------
    >>> mixed((1.0, 0.0, 0.0, 1.0), (2.0, 0.0, 0.0, 3.0))
    5.0
    """
    return a[0] * b[3] + b[0] * a[3] - a[1] * b[2] - b[1] * a[2]


def _two_degrees(system: System, load: Array) -> Complex:
    """Return the roots of det[K(p̄) + ωΩ̄H − ω²M], a real quartic in ω."""
    m, h, spin = entries(system.mass), entries(system.gyroscopic), system.spin_speed
    if system.is_linear:
        # det(Ka + p̄Kb) and its like are short polynomials in p̄
        a, b = entries(system.elastic), entries(system.geometric)
        with_m = mixed(a, m) + load * mixed(b, m)
        with_h = mixed(a, h) + load * mixed(b, h)
        determinant = (load * (mixed(b, b) / 2) + mixed(a, b)) * load + mixed(a, a) / 2
    else:
        k = entries(system.load_stiffness(load))
        with_m, with_h, determinant = mixed(k, m), mixed(k, h), mixed(k, k) / 2
    return quartic_roots(
        mixed(m, m) / 2,
        -spin * mixed(h, m),
        spin**2 * (mixed(h, h) / 2) - with_m,
        spin * with_h,
        determinant,
    )


def eigenvalues(system: System, load: Array) -> Complex:
    """Return the roots ω (..., 2n) of any system as eigenvalues; see `whirl_frequencies`."""
    matrix = state_matrix(system, system.stiffness(load))
    return np.asarray(np.sort_complex(np.linalg.eigvals(matrix)))


def whirl_frequencies(system: System, load: ArrayLike) -> Complex:
    """Return the roots ω of det[K(p̄) + jωD − ω²M] = 0.

    Parameters
    ----------
    system : System
        Its spin speed broadcasts against the load.
    load : (...) float
        Steady load p̄ [EI/L²].

    Returns
    -------
    (..., 2n) complex
        ω [√(EI/(ρAL⁴))], sorted by real, then imaginary part: solution e^{jωt}.

    Raises
    ------
    ValueError
        If the load is not finite, or past the pole of the exact stiffness.

    References
    ----------
    Eq. (20) with β_d = 0.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> whirl_frequencies(lumped(ShaftDisk(), 1.0), 0.0).real.round(4).tolist()
    [-1.9348, -0.4041, 0.9092, 3.4297]
    """
    load = numbers("load", load, -LARGEST, LARGEST)
    if system.size == 2 and not system.is_damped:
        return _two_degrees(system, load)
    return eigenvalues(system, load)


def track(rows: Complex, start: int = 0) -> Complex:
    """Reorder each row so that every column is continuous.

    Parameters
    ----------
    rows : (m, k) complex
        Each row sorted by real part; neighbours belong to neighbouring parameters.
    start : int
        Row whose order is kept.

    Returns
    -------
    (m, k) complex

    Notes
    -----
    Real roots of one family do not cross, they veer or merge, so where both neighbours
    are real the sorted order is the continuous one. Only where a complex pair passes
    another root must entries change places.
    """
    if not rows.imag.any():
        return rows
    pair = np.ascontiguousarray(rows.imag.T) != 0  # a row for each column
    some = pair.any(axis=0)
    moved = (pair[:, 1:] != pair[:, :-1]).any(axis=0) | pair[:, 1:].all(axis=0)
    steps = np.flatnonzero(some[1:] & some[:-1] & moved)
    if not steps.size:
        return rows
    costs = np.abs(rows[steps, :, None] - rows[steps + 1, None, :]) ** 2
    # where every root stays nearest to itself no other order is better
    kept = (costs.argmin(axis=2) == np.arange(rows.shape[1])).all(axis=1)
    if kept.all():
        return rows
    orders = np.tile(np.arange(rows.shape[1]), (len(rows), 1))
    for step, cost in zip(steps[~kept], costs[~kept], strict=True):
        orders[step + 1 :] = linear_sum_assignment(cost)[1][orders[step]]
    return np.take_along_axis(rows, orders, axis=1)[:, np.argsort(orders[start])]


def named_frequencies(system: System, load: float = 0.0) -> Complex:
    """Return ω (2n,) in the order of `mode_names`, followed from the undamped, unloaded rotor.

    A strongly damped whirl has no order by frequency: its Re ω may be anything. So damping is
    raised from nothing, then the load.

    Parameters
    ----------
    system : System
        At one spin speed.
    load : float
        p̄ [EI/L²].

    Returns
    -------
    (2n,) complex
    """
    single_speed(system)
    load = number("load", load, -LARGEST, LARGEST)
    loads = np.linspace(0.0, load, _LOADS) if load else np.zeros(1)
    rows = [whirl_frequencies(system, loads)]
    if system.is_damped:
        # quadratic, for the fastest modes are the first to be damped out
        share = np.linspace(0.0, 1.0, _DAMPINGS)[:-1, None, None] ** 2
        rising = replace(
            system,
            external_damping=share * system.external_damping,
            internal_damping=share * system.internal_damping,
        )
        rows.insert(0, whirl_frequencies(rising, 0.0))
    found = track(np.concatenate(rows))[-1]
    # what is far below the fastest whirl is rounding
    small = NEGLIGIBLE * np.abs(found).max()
    found.real[np.abs(found.real) <= small] = 0.0
    found.imag[np.abs(found.imag) <= small] = 0.0
    return np.asarray(found)


def names_of(system: System, load: float, frequencies: ArrayLike) -> tuple[str, ...]:
    """Name the frequencies ω (2n,) of a system in any order, as the whirl curves do.

    Undamped ones go by rank, as `modal.mode_names` has it.
    """
    if not system.is_damped:
        return ranked_names(frequencies)
    cost = np.abs(np.subtract.outer(np.asarray(frequencies), named_frequencies(system, load))) ** 2
    names = mode_names(system.size)
    return tuple(names[index] for index in linear_sum_assignment(cost)[1])


def _in_order(rows: Complex, named: Complex, start: int) -> Complex:
    """Return tracked rows with their columns in the order of the named frequencies."""
    cost = np.abs(named[:, None] - rows[start]) ** 2
    return rows[:, linear_sum_assignment(cost)[1]]


def load_frequency_curves(system: System, loads: ArrayLike) -> WhirlCurves:
    """Return the whirl frequencies over a range of steady loads (Fig. 8).

    Parameters
    ----------
    system : System
        At one spin speed.
    loads : (m,) float
        Ascending loads p̄ [EI/L²]; modes are followed from the one nearest to 0.

    Returns
    -------
    WhirlCurves
        Where a pair has become complex its columns are conjugates.

    Raises
    ------
    ValueError
        If the loads are not finite, or past the pole of the exact stiffness.
    """
    loads = series("loads", loads)
    single_speed(system)
    start = int(np.abs(loads).argmin()) if loads.size else 0
    rows = track(whirl_frequencies(system, loads), start)
    if system.is_damped and loads.size:
        rows = _in_order(rows, named_frequencies(system, float(loads[start])), start)
    return WhirlCurves(loads, rows, mode_names(system.size))


def campbell_diagram(system: System, spin_speeds: ArrayLike, load: float = 0.0) -> WhirlCurves:
    """Return the whirl frequencies over a range of spin speeds at one steady load.

    Parameters
    ----------
    system : System
        Its own spin speed is not used.
    spin_speeds : (m,) float
        Ascending Ω̄ [√(EI/(ρAL⁴))]; modes are followed from the first, with damping from the
        fastest.
    load : float
        p̄ [EI/L²].

    Returns
    -------
    WhirlCurves

    Raises
    ------
    ValueError
        If an argument is not finite.
    """
    speeds = series("spin_speeds", spin_speeds)
    load = number("load", load)
    rows = track(whirl_frequencies(system.at_speed(speeds), load))
    if system.is_damped and speeds.size:
        # where the two precessions differ most; at rest an overdamped pair has neither
        start = int(np.abs(speeds).argmax())
        named = named_frequencies(system.at_speed(speeds[start]), load)
        rows = _in_order(rows, named, start)
    return WhirlCurves(speeds, rows, mode_names(system.size))


def critical_speeds(system: System, load: float = 0.0) -> CriticalSpeeds:
    """Return the spin speeds at which an undamped whirl is synchronous, ω = ±Ω̄.

    Parameters
    ----------
    system : System
        Its own spin speed and damping are not used.
    load : float
        p̄ [EI/L²].

    Returns
    -------
    CriticalSpeeds

    Notes
    -----
    With ω = ±Ω̄ the determinant is det[K − Ω̄²(M ∓ H)]: a generalised eigenvalue problem
    whose positive real eigenvalues are Ω̄². A disk with Ī_P > Ī_D has no forward
    critical speed of its second mode.
    """
    stiffness = system.load_stiffness(number("load", load))

    def speeds(inertia: Array) -> Array:
        # eigenvalues 1/Ω̄², so that a singular M ∓ H gives 0 and not infinity
        inverse_squares = eigvals(inertia, stiffness, check_finite=False)
        with np.errstate(invalid="ignore"):
            size = np.abs(inverse_squares)
            real = is_real(inverse_squares)
        squares = inverse_squares.real[
            real & (inverse_squares.real > NEGLIGIBLE * size[np.isfinite(size)].max(initial=0.0))
        ]
        return np.sort(1 / np.sqrt(squares))

    return CriticalSpeeds(
        forward=speeds(system.mass - system.gyroscopic),
        backward=speeds(system.mass + system.gyroscopic),
    )
