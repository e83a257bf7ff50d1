"""Bolotin's boundary frequencies and regions, the paper's method.

Solutions of period 2T are sought as one harmonic, q = a sin(θt/2) + b cos(θt/2). With
λ = θ²/4, K∓ = K₀ ∓ K₁/2 (K₀, K₁ the first harmonics of K(p̄(t))), and b → jb, the
undamped condition is a real symmetric-form determinant

    P(λ) = det [[K₋ − λM, −√λ Ω̄H], [−√λ Ω̄H, K₊ − λM]] = 0.            (24)

A *Bolotin region* is where P < 0. Once the rotor spins that is not where it is unstable:
a Floquet multiplier may pass through −1 and stay on the unit circle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import number, numbers
from .quartic import quadratic_roots, quartic_roots
from .system import System
from .whirl import mode_names, track, whirl_frequencies

__all__ = [
    "BolotinChart",
    "bolotin_chart",
    "bolotin_mask",
    "boundary_frequencies",
    "in_bolotin_region",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_REAL = 1e-7  # |Im λ|/|λ| below which a boundary counts as real: a double root's own error
_GRADING = np.linspace(0.0, 1.0, 17)[1:-1] ** 2


@dataclass(frozen=True, eq=False)
class BolotinChart:
    """Bolotin's boundaries and regions over a range of pulsating loads.

    Parameters
    ----------
    pulsating_load : (m,) float
        Ascending p̄_t [EI/L²]; closer where a boundary turns or ends.
    frequency : (m, 2n) float
        θ̄ of each boundary [√(EI/(ρAL⁴))], a column each, NaN where it is not real.
    names : tuple of str
        The whirl mode each boundary starts from, θ̄ = 2|ω| at p̄_t = 0.
    regions : tuple of (k, 2) float arrays
        Closed polygons (θ̄, p̄_t) whose union is {P < 0}.
    """

    pulsating_load: Array
    frequency: Array
    names: tuple[str, ...]
    regions: tuple[Array, ...]


def _plain_lumped(system: System) -> bool:
    """Whether (24) is the quartic of the paper: two degrees of freedom, only H₂₂."""
    if system.size != 2 or system.is_damped:
        return False
    (h11, h12), (h21, _) = system.gyroscopic
    (_, m12), (m21, _) = system.mass
    return not any((h11, h12, h21, m12, m21))


def _determinant(k: Array, m: Array) -> tuple[float, Array, Array]:
    """Return the coefficients of det(K − λM), highest first, for diagonal M."""
    k11, k22 = k[..., 0, 0], k[..., 1, 1]
    linear = -m[1, 1] * k11 - m[0, 0] * k22
    return m[0, 0] * m[1, 1], linear, k11 * k22 - k[..., 0, 1] * k[..., 1, 0]


def _companion_squares(system: System, minus: Array, plus: Array, spin: Array) -> Complex:
    """Return λ (..., 2n) by the quadratic eigenproblem in s = θ̄/2, for any system."""
    n = system.size
    inverse = np.linalg.inv(system.mass)
    shape = np.broadcast_shapes(minus.shape, spin.shape)[:-2]
    companion = np.zeros((*shape, 4 * n, 4 * n), np.result_type(minus, spin))
    companion[..., : 2 * n, 2 * n :] = np.eye(2 * n)
    companion[..., 2 * n : 3 * n, :n] = inverse @ minus
    companion[..., 3 * n :, n : 2 * n] = inverse @ plus
    companion[..., 2 * n : 3 * n, 3 * n :] = -inverse @ spin
    companion[..., 3 * n :, 2 * n : 3 * n] = -inverse @ spin
    # roots come as ±s, so every λ twice
    return np.asarray(np.sort_complex(np.linalg.eigvals(companion) ** 2)[..., ::2])


def _lumped_squares(system: System, minus: Array, plus: Array) -> Complex:
    """Return λ (..., 4) of the lumped model, Eq. (24) as a quartic."""
    m = system.mass
    a, b1, c1 = _determinant(minus, m)
    a, b2, c2 = _determinant(plus, m)
    gyroscopic = (system.spin_speed * system.gyroscopic[1, 1]) ** 2
    if not np.any(gyroscopic):
        # D₋ D₊ = 0: two quadratics whose roots cross freely, a column each
        shape = (*np.broadcast_shapes(gyroscopic.shape, b1.shape), 2)
        blocks = [np.sort_complex(quadratic_roots(a, b, c)) for b, c in ((b1, c1), (b2, c2))]
        return np.concatenate([np.broadcast_to(block, shape) for block in blocks], axis=-1)
    # D₋ D₊ − λ Ω̄²Ī_P² a₋ a₊
    k1, k2 = minus[..., 0, 0], plus[..., 0, 0]
    squares = quartic_roots(
        a * a,
        a * (b1 + b2) - gyroscopic * m[0, 0] ** 2,
        a * (c1 + c2) + b1 * b2 + gyroscopic * m[0, 0] * (k1 + k2),
        b1 * c2 + c1 * b2 - gyroscopic * k1 * k2,
        c1 * c2,
    )
    # coefficients hold only half the digits of roots that nearly meet; matrices hold them all
    near = (np.abs(np.diff(squares)) < 1e-4 * np.abs(squares[..., 1:])).any(axis=-1)
    if near.any():
        shape = (*near.shape, 2, 2)
        squares[near] = _companion_squares(
            system,
            *(np.broadcast_to(x, shape)[near] for x in (minus, plus, system.spin_matrix())),
        )
    return squares


def _squares(system: System, static_load: Array, pulsating_load: Array) -> Complex:
    """Return λ = θ̄²/4 (..., 2n) complex: every boundary, real or not."""
    mean, first = system.load_harmonics(static_load, pulsating_load)
    minus, plus = mean - first / 2, mean + first / 2
    if _plain_lumped(system):
        return _lumped_squares(system, minus, plus)
    # b → jb keeps an undamped system real
    spin = 1j * system.damping() if system.is_damped else system.spin_matrix()
    if system.internal_damping.any():
        rotating = 1j * system.spin_speed[..., None, None] * system.internal_damping
        minus, plus = minus - rotating, plus - rotating
    return _companion_squares(system, minus, plus, spin)


def _real_frequency(squares: Complex) -> Array:
    """Return θ̄ = 2√λ, NaN where λ is not real and positive."""
    real = np.abs(squares.imag) <= _REAL * np.abs(squares)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(real, 2 * np.sqrt(squares.real), np.nan))


def boundary_frequencies(
    system: System, static_load: ArrayLike, pulsating_load: ArrayLike
) -> Array:
    """Return Bolotin's boundary frequencies θ̄, the roots of Eq. (24).

    Parameters
    ----------
    system : System
        Its spin speed broadcasts against the loads.
    static_load, pulsating_load : (...) float
        p̄₀ = α_s p̄_cr and p̄_t = β_d p̄_cr [EI/L²]; the sign of p̄_t does not matter.

    Returns
    -------
    (..., 2n) float
        θ̄ [√(EI/(ρAL⁴))] ascending, NaN (last) where a root is not real and positive.

    Raises
    ------
    ValueError
        If a load is not finite, or past the pole of the exact stiffness.

    Notes
    -----
    First approximation (one harmonic). At p̄_t = 0 the values are 2|ω|. A damped rotor
    that spins has in general no solution of period 2T at all: every entry is NaN.

    References
    ----------
    Eqs. (21)–(24) of the source paper.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> boundary_frequencies(lumped(ShaftDisk(), 2.0), 0.0, 0.0).round(4).tolist()
    [0.5322, 2.146, 3.4668, 9.8529]
    """
    static, pulsating = (
        numbers("static_load", static_load),
        numbers("pulsating_load", pulsating_load),
    )
    return np.sort(_real_frequency(_squares(system, static, pulsating)), axis=-1)


def in_bolotin_region(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    excitation_frequency: ArrayLike,
) -> NDArray[np.bool_]:
    """Return whether a point lies in a Bolotin region, P(λ) < 0.

    Parameters
    ----------
    system : System
        Undamped.
    static_load, pulsating_load : (...) float
        p̄₀ and p̄_t [EI/L²].
    excitation_frequency : (...) float
        θ̄ [√(EI/(ρAL⁴))], 0 or more.

    Returns
    -------
    (...) bool
        Not a statement about stability: see the module's text.

    Raises
    ------
    ValueError
        If an argument is not finite or the system is damped.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> bool(in_bolotin_region(lumped(ShaftDisk(), 0.0), 0.0, 1.0, 1.3))
    True
    """
    if system.is_damped:
        raise ValueError("`system` must be undamped for the sign of Eq. (24), got a damped one")
    half = numbers("excitation_frequency", excitation_frequency, 0.0)[..., None, None] / 2
    static, pulsating = (
        numbers("static_load", static_load),
        numbers("pulsating_load", pulsating_load),
    )
    mean, first = system.load_harmonics(static, pulsating)
    inertia = half**2 * system.mass
    minus, plus = mean - first / 2 - inertia, mean + first / 2 - inertia
    coupling = -half * system.spin_matrix()
    # Eq. (24) after b → jb
    minus, plus, coupling = np.broadcast_arrays(minus, plus, coupling)
    rows = [np.concatenate(pair, axis=-1) for pair in ((minus, coupling), (coupling, plus))]
    return np.asarray(np.linalg.det(np.concatenate(rows, axis=-2)) < 0)


def bolotin_mask(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
) -> NDArray[np.bool_]:
    """Return which points of a grid lie in a Bolotin region, from the boundaries of each row.

    Parameters
    ----------
    system : System
        Undamped, at one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²].
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], 0 or more.

    Returns
    -------
    (R, C) bool
        As `in_bolotin_region` on the grid, at the cost of R sets of boundaries.

    Raises
    ------
    ValueError
        If an argument is not finite or the system is damped.
    """
    if system.is_damped:
        raise ValueError("`system` must be undamped for the sign of Eq. (24), got a damped one")
    static = np.asarray(number("static_load", static_load))
    loads = numbers("pulsating_loads", pulsating_loads)
    level = (numbers("excitation_frequencies", excitation_frequencies, 0.0) / 2) ** 2
    squares = _squares(system, static, loads)
    real = np.abs(squares.imag) <= _REAL * np.abs(squares)
    # P changes sign at every real root, and is positive below the first
    passed = (np.where(real, squares.real, np.inf)[:, None, :] < level[:, None]).sum(axis=-1)
    return np.asarray(passed % 2 == 1)


def _status(squares: Complex) -> NDArray[np.int64]:
    """Return per row how many λ are real, and how many of those are positive, in one code."""
    real = np.abs(squares.imag) <= _REAL * np.abs(squares)
    return np.asarray(real.sum(axis=1) * 100 + (real & (squares.real > 0)).sum(axis=1))


def _rows(
    system: System, static_load: float, largest: float, rows: int
) -> tuple[Array, Complex, NDArray[np.int64]]:
    """Return loads, their λ and status, with graded rows at every change of status."""
    static = np.float64(static_load)
    loads = np.linspace(0.0, largest, rows)
    squares = _squares(system, static, loads)
    status = _status(squares)
    changes = np.flatnonzero(status[1:] != status[:-1])
    if not changes.size:
        return loads, squares, status
    low, high = loads[changes], loads[changes + 1]
    below = status[changes]
    parts = np.linspace(0.0, 1.0, 18)
    for _ in range(7):  # 17⁷: the step narrows to rounding
        trial = low[:, None] + (high - low)[:, None] * parts
        codes = _status(_squares(system, static, trial.ravel()).reshape(trial.size, -1))
        codes = codes.reshape(trial.shape)
        codes[:, 0], codes[:, -1] = below, -1
        first = (codes != below[:, None]).argmax(axis=1)
        index = np.arange(changes.size)
        low, high = trial[index, first - 1], trial[index, first]
    # θ̄ turns as a square root there: quadratic grading on both sides
    left, right = loads[changes][:, None], loads[changes + 1][:, None]
    extra = np.concatenate(
        [
            low,
            high,
            (low[:, None] - (low[:, None] - left) * _GRADING).ravel(),
            (high[:, None] + (right - high[:, None]) * _GRADING).ravel(),
        ]
    )
    extra = np.setdiff1d(extra, loads)
    loads = np.concatenate([loads, extra])
    squares = np.concatenate([squares, _squares(system, static, extra)])
    order = np.argsort(loads)
    squares = squares[order]
    return loads[order], squares, _status(squares)


def _polygons(loads: Array, squares: Complex, status: NDArray[np.int64]) -> tuple[Array, ...]:
    """Return the polygons of {P < 0}: between the 1st and 2nd, 3rd and 4th … real root."""
    real = np.abs(squares.imag) <= _REAL * np.abs(squares)
    values = np.where(real, squares.real, np.inf)
    frequency = 2 * np.sqrt(np.maximum(np.sort(values, axis=1), 0.0))
    count = status // 100
    polygons = []
    edges = np.flatnonzero(np.diff(count)) + 1
    for rows in np.split(np.arange(loads.size), edges):
        if rows.size < 2:
            continue
        y = loads[rows]
        for k in range(0, int(count[rows[0]]) - 1, 2):
            left, right = frequency[rows, k], frequency[rows, k + 1]
            if right.max() > 0:
                x = np.concatenate([left, right[::-1]])
                polygons.append(np.column_stack([x, np.concatenate([y, y[::-1]])]))
    return tuple(polygons)


def _boundary_names(system: System, static_load: float, squares: Complex) -> tuple[str, ...]:
    """Name each column by the whirl mode whose 2|ω| it starts from."""
    sorted_names = mode_names(system.size)
    frequencies = whirl_frequencies(system, static_load)
    # 1B before 1F where both start from one point: the left boundary is the backward one
    keys = [(round(abs(w), 9), name) for w, name in zip(frequencies, sorted_names, strict=True)]
    by_size = [name for _, name in sorted(keys)]
    # just above p̄_t = 0, where columns that start together have parted
    order = np.argsort(squares[1].real, kind="stable")
    names = [""] * len(by_size)
    for column, name in zip(order, by_size, strict=True):
        names[int(column)] = name
    return tuple(names)


def bolotin_chart(
    system: System, static_load: float, largest_pulsating_load: float, rows: int = 120
) -> BolotinChart:
    """Return the boundaries by mode and the regions for p̄_t from 0 to a largest value.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    largest_pulsating_load : float
        Above 0 [EI/L²].
    rows : int
        Even loads to begin with, 8 or more; rows are added where boundaries turn or end.

    Returns
    -------
    BolotinChart
        No boundaries (NaN) and no regions for a damped rotor that spins.

    Raises
    ------
    ValueError
        If an argument is out of range, or the load passes the pole of the exact stiffness.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> bolotin_chart(lumped(ShaftDisk(), 2.0), 0.0, 1.0).names
    ('1B', '1F', '2B', '2F')
    """
    static = number("static_load", static_load)
    largest = number("largest_pulsating_load", largest_pulsating_load, 0.0, open_low=True)
    number("rows", rows, 8)
    loads, squares, status = _rows(system, static, largest, rows)
    names = _boundary_names(system, static, squares)
    regions = _polygons(loads, squares, status)
    if not (_plain_lumped(system) and not system.spin_matrix().any()):
        squares = track(squares)
    return BolotinChart(loads, _real_frequency(squares), names, regions)
