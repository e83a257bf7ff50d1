"""Whirl frequencies, mode tracking, load–frequency curves, Campbell diagram, critical speeds.

Signed frequency ω: a solution e^{jωt}; ω > 0 is forward, ω < 0 backward precession, and
an imaginary part below 0 is growth. Modes are named 1B, 1F, 2B, 2F … (theory.md's order:
by |ω| within each direction, at no load).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import linear_sum_assignment

from .checks import numbers
from .quartic import quartic_roots
from .system import System

__all__ = [
    "CriticalSpeeds",
    "WhirlCurves",
    "campbell_diagram",
    "critical_speeds",
    "load_frequency_curves",
    "mode_names",
    "track",
    "whirl_frequencies",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


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


def _mixed(a: Array, b: Array) -> Array:
    """Return the coefficient of t in det(a + tb) for 2 × 2 matrices."""
    return np.asarray(
        a[..., 0, 0] * b[..., 1, 1]
        + b[..., 0, 0] * a[..., 1, 1]
        - a[..., 0, 1] * b[..., 1, 0]
        - b[..., 0, 1] * a[..., 1, 0]
    )


def _two_degrees(system: System, load: Array) -> Complex:
    """Return the roots of det[K(p̄) + ωΩ̄H − ω²M], a real quartic in ω."""
    m, h, spin = system.mass, system.gyroscopic, system.spin_speed
    if system.is_linear:
        # scalars first: det(Ka + p̄Kb) and its like are short polynomials in p̄
        a, b = system.elastic, system.geometric
        with_m = _mixed(a, m) + load * _mixed(b, m)
        with_h = _mixed(a, h) + load * _mixed(b, h)
        determinant = (load * _mixed(b, b) / 2 + _mixed(a, b)) * load + _mixed(a, a) / 2
    else:
        k = system.load_stiffness(load)
        with_m, with_h, determinant = _mixed(k, m), _mixed(k, h), _mixed(k, k) / 2
    return quartic_roots(
        _mixed(m, m) / 2,
        -spin * _mixed(h, m),
        spin**2 * (_mixed(h, h) / 2) - with_m,
        spin * with_h,
        determinant,
    )


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
    load = numbers("load", load)
    size = system.size
    if size == 2 and not system.is_damped:
        return _two_degrees(system, load)
    # ω²q = M⁻¹Kq + ωM⁻¹(jD)q, companion form in (q, ωq); real where undamped
    spin = 1j * system.damping() if system.is_damped else system.spin_matrix()
    inverse = np.linalg.inv(system.mass)
    lower = inverse @ system.stiffness(load)
    spin = inverse @ spin
    shape = np.broadcast_shapes(lower.shape, spin.shape)
    companion = np.zeros((*shape[:-2], 2 * size, 2 * size), np.result_type(lower, spin))
    companion[..., :size, size:] = np.eye(size)
    companion[..., size:, :size] = lower
    companion[..., size:, size:] = spin
    return np.sort_complex(np.linalg.eigvals(companion))


def track(rows: Complex) -> Complex:
    """Reorder each row so that every column is continuous.

    Parameters
    ----------
    rows : (m, k) complex
        Each row sorted by real part; neighbours belong to neighbouring parameters.

    Returns
    -------
    (m, k) complex
        Columns in the order of the first row.

    Notes
    -----
    Real roots of one family do not cross, they veer or merge, so where both neighbours
    are real the sorted order is the continuous one. Only where a complex pair passes
    another root must entries change places; those steps are found at once.
    """
    before, after = rows[:-1], rows[1:]
    kept = np.abs(after - before) ** 2
    swapped = (
        np.abs(after[:, 1:] - before[:, :-1]) ** 2 + np.abs(after[:, :-1] - before[:, 1:]) ** 2
    )
    wrong = (swapped < kept[:, 1:] + kept[:, :-1]).any(axis=1)
    result = rows.copy()
    order = np.arange(rows.shape[1])
    for index in np.flatnonzero(wrong):
        cost = np.abs(rows[index][:, None] - rows[index + 1][None, :]) ** 2
        order = linear_sum_assignment(cost)[1][order]
        result[index + 1 :] = rows[index + 1 :, order]
    return result


def _track_from(rows: Complex, start: int) -> Complex:
    """Track both ways from row `start`, whose sorted order names the columns."""
    if not np.abs(rows.imag).any():
        return rows
    return np.concatenate([track(rows[start::-1])[:0:-1], track(rows[start:])])


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
    loads = numbers("loads", loads)
    start = int(np.abs(loads).argmin())
    rows = whirl_frequencies(system, loads)
    return WhirlCurves(loads, _track_from(rows, start), mode_names(system.size))


def campbell_diagram(system: System, spin_speeds: ArrayLike, load: float = 0.0) -> WhirlCurves:
    """Return the whirl frequencies over a range of spin speeds at one steady load.

    Parameters
    ----------
    system : System
        Its own spin speed is not used.
    spin_speeds : (m,) float
        Ascending Ω̄ [√(EI/(ρAL⁴))]; modes are followed from the first.
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
    rows = whirl_frequencies(system.at_speed(spin_speeds), load)
    return WhirlCurves(
        numbers("spin_speeds", spin_speeds), _track_from(rows, 0), mode_names(system.size)
    )


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
    stiffness = system.load_stiffness(load)

    def speeds(inertia: Array) -> Array:
        # eigenvalues 1/Ω̄², so that a singular M ∓ H gives 0 and not infinity
        inverse_squares = np.linalg.eigvals(np.linalg.solve(stiffness, inertia))
        real = np.abs(inverse_squares.imag) <= 1e-9 * np.abs(inverse_squares)
        squares = inverse_squares.real[real & (inverse_squares.real > 1e-12)]
        return np.sort(1 / np.sqrt(squares))

    return CriticalSpeeds(
        forward=speeds(system.mass - system.gyroscopic),
        backward=speeds(system.mass + system.gyroscopic),
    )
