"""Bolotin's boundary frequencies and regions, the paper's method.

Solutions of period 2T are sought as one harmonic, q = a sin(θt/2) + b cos(θt/2). With
λ = θ²/4, K∓ = K₀ ∓ K₁/2 (K₀, K₁ the first harmonics of K(p̄(t))), and b → jb, the
undamped condition is a real symmetric-form determinant

    P(λ) = det [[K₋ − λM, −√λ Ω̄H], [−√λ Ω̄H, K₊ − λM]] = 0.            (24)

A *Bolotin region* is where P < 0. Once the rotor spins that is not where it is unstable:
a Floquet multiplier may pass through −1 and stay on the unit circle.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from .._arguments import number, numbers, series, whole_number
from .._numerics.quartic import quadratic_roots, quartic_roots
from .._numerics.roots import is_real
from .._tolerances import CLOSE_SQUARES, SAME_START
from .._types import AnyArray, Array, ArrayLike, Complex, Index, Mask
from ..model.system import System, single_speed
from ..whirl.frequencies import (
    eigenvalues,
    entries,
    load_frequency_curves,
    mixed,
    mode_names,
    track,
)

__all__ = [
    "BolotinChart",
    "bolotin_chart",
    "bolotin_mask",
    "boundary_frequencies",
    "in_bolotin_region",
]

_GRADING = np.linspace(0.0, 1.0, 17)[1:-1] ** 2
_PARTS = np.linspace(0.0, 1.0, 257)


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
    h, m = entries(system.gyroscopic), entries(system.mass)
    return not any((*h[:3], *m[1:3]))


def _mean_and_half(
    system: System, static_load: Array, pulsating_load: Array
) -> tuple[Array, Array, Array]:
    """Return K₀, B and y with K∓ = K₀ ∓ yB."""
    if system.is_linear:
        return system.load_stiffness(static_load), system.geometric, pulsating_load / 2
    mean, first = system.load_harmonics(static_load, pulsating_load)
    return mean, first, np.array(0.5)


def _lumped_squares(system: System, mean: Array, slope: Array, y: Array) -> Complex:
    """Return λ (..., 4) of the lumped model, Eq. (24) as a quartic."""
    m, k, b = entries(system.mass), entries(mean), entries(slope)
    # det(K∓ − λM) = e₂λ² + e₁λ + e₀ ∓ (f₁λ + f₀)
    e2, e1, e0 = mixed(m, m) / 2, -mixed(k, m), mixed(k, k) / 2 + y * y * (mixed(b, b) / 2)
    f1, f0 = -y * mixed(b, m), y * mixed(k, b)
    gyroscopic = (system.spin_speed * system.gyroscopic[1, 1]) ** 2
    if not gyroscopic.any():
        # two quadratics whose roots cross freely, a column each
        blocks = quadratic_roots(e2, e1 - f1, e0 - f0), quadratic_roots(e2, e1 + f1, e0 + f0)
        shape = (*np.broadcast_shapes(gyroscopic.shape, blocks[0].shape[:-1]), 2)
        return np.concatenate([np.broadcast_to(block, shape) for block in blocks], axis=-1)
    # D₋D₊ − λ(Ω̄Ī_P)² a₋a₊ with a∓ = k₁₁ ∓ y b₁₁ − λM̄_D
    squares = quartic_roots(
        e2 * e2,
        2 * e2 * e1 - gyroscopic * m[0] ** 2,
        e1 * e1 + 2 * e2 * e0 - f1 * f1 + gyroscopic * (2 * k[0] * m[0]),
        2 * (e1 * e0 - f1 * f0) - gyroscopic * (k[0] ** 2 - (y * b[0]) ** 2),
        (e0 - f0) * (e0 + f0),
    )
    # coefficients hold only half the digits of roots that nearly meet; matrices hold them all
    lower, upper = squares.real[..., :-1], squares.real[..., 1:]
    close = upper - lower < CLOSE_SQUARES * np.abs(upper)
    if close.any():
        near = close.any(axis=-1)
        parts = mean - y[..., None, None] * slope, mean + y[..., None, None] * slope
        shape = (*near.shape, 2, 2)
        rows = [np.broadcast_to(part, shape)[near] for part in (*parts, system.spin_matrix())]
        squares[near] = _matrix_squares(system, *rows)
    return squares


def _matrix_squares(system: System, minus: AnyArray, plus: AnyArray, spin: AnyArray) -> Complex:
    """Return λ (..., 2n) of any system by eigenvalues, λ = s² with b = s b′.

    ([K₋, 0; −S, K₊] − λ [M, S; 0, M]) [a; b′] = 0, where S = jD.
    """
    n = system.size
    inverse = np.linalg.inv(system.mass)
    minus, plus, spin = inverse @ minus, inverse @ plus, inverse @ spin
    if not np.any(spin):
        blocks = [np.sort_complex(np.linalg.eigvals(block)) for block in (minus, plus)]
        return np.concatenate(np.broadcast_arrays(*blocks), axis=-1)
    shape = np.broadcast_shapes(minus.shape, spin.shape)[:-2]
    matrix = np.empty((*shape, 2 * n, 2 * n), np.result_type(minus, spin))
    matrix[..., :n, :n] = minus + spin @ spin
    matrix[..., :n, n:] = -spin @ plus
    matrix[..., n:, :n] = -spin
    matrix[..., n:, n:] = plus
    return np.asarray(np.sort_complex(np.linalg.eigvals(matrix)))


def _squares(system: System, static_load: Array, pulsating_load: Array) -> Complex:
    """Return λ = θ̄²/4 (..., 2n) complex: every boundary, real or not."""
    mean, slope, y = _mean_and_half(system, static_load, pulsating_load)
    if _plain_lumped(system):
        return _lumped_squares(system, mean, slope, y)
    half = y[..., None, None] * slope
    if not system.is_damped:
        # b → jb keeps an undamped system real
        return _matrix_squares(system, mean - half, mean + half, system.spin_matrix())
    rotating = 1j * system.spin_speed[..., None, None] * system.internal_damping
    return _matrix_squares(
        system, mean - half - rotating, mean + half - rotating, 1j * system.damping()
    )


def _real(squares: Complex) -> Array:
    """Return the real λ, NaN for those that are not."""
    if not squares.imag.any():
        return squares.real
    return np.where(is_real(squares), squares.real, np.nan)


def _frequency(values: Array) -> Array:
    """Return θ̄ = 2√λ, NaN where λ is not real and positive."""
    with np.errstate(invalid="ignore"):
        return np.asarray(2 * np.sqrt(values))


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
    return np.sort(_frequency(_real(_squares(system, static, pulsating))), axis=-1)


def in_bolotin_region(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    excitation_frequency: ArrayLike,
) -> Mask:
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
    mean, slope, y = _mean_and_half(system, static, pulsating)
    shift = y[..., None, None] * slope
    inertia = half**2 * system.mass
    minus, plus = mean - shift - inertia, mean + shift - inertia
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
) -> Mask:
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
    loads = series("pulsating_loads", pulsating_loads)
    level = (series("excitation_frequencies", excitation_frequencies, 0.0) / 2) ** 2
    squares = _squares(system, static, loads)
    # P changes sign at every real root, and is positive below the first
    passed = (np.where(is_real(squares), squares.real, np.inf)[:, None, :] < level[:, None]).sum(
        axis=-1
    )
    return np.asarray(passed % 2 == 1)


def _status(squares: Complex) -> Index:
    """Return per row how many λ are real, and how many of those are positive, in one code."""
    values = _real(squares)
    if values.min() > 0:  # not so with a NaN
        return np.full(len(values), 101 * values.shape[1])
    return np.asarray((~np.isnan(values)).sum(axis=1) * 100 + (values > 0).sum(axis=1))


def _rows(system: System, static: Array, largest: float, rows: int) -> tuple[Array, Complex]:
    """Return loads and their λ, with graded rows at every change of status."""
    loads = np.linspace(0.0, largest, rows)
    squares = _squares(system, static, loads)
    status = _status(squares)
    changes = np.flatnonzero(status[1:] != status[:-1])
    if not changes.size:
        return loads, squares
    low, high = loads[changes], loads[changes + 1]
    below = status[changes, None]
    index = np.arange(changes.size)
    for _ in range(3):  # the step narrows 256³ times
        trial = low[:, None] + (high - low)[:, None] * _PARTS
        codes = _status(_squares(system, static, trial.ravel())).reshape(trial.shape)
        # the ends are known
        first = (codes[:, 1:-1] != below).argmax(axis=1) + 1
        first[(codes[:, 1:-1] == below).all(axis=1)] = _PARTS.size - 1
        low, high = trial[index, first - 1], trial[index, first]
    # θ̄ turns as a square root there: quadratic grading on both sides
    left, right = loads[changes], loads[changes + 1]
    extra = np.concatenate(
        [
            low,
            high,
            *(low - np.outer(_GRADING, low - left)),
            *(high + np.outer(_GRADING, right - high)),
        ]
    )
    loads, kept = np.unique(np.concatenate([loads, extra]), return_index=True)
    return loads, np.concatenate([squares, _squares(system, static, extra)])[kept]


def _polygons(loads: Array, values: Array) -> tuple[Array, ...]:
    """Return the polygons of {P < 0}: between the 1st and 2nd, 3rd and 4th … real root."""
    values = np.sort(values, axis=1)  # NaN last
    frequency = 2 * np.sqrt(np.maximum(values, 0.0))
    count = (~np.isnan(values)).sum(axis=1)
    polygons = []
    edges = [0, *(np.flatnonzero(count[1:] != count[:-1]) + 1).tolist(), len(loads)]
    for start, stop in itertools.pairwise(edges):
        rows = stop - start
        for k in range(0, int(count[start]) - 1, 2):
            left, right = frequency[start:stop, k], frequency[start:stop, k + 1]
            if rows > 1 and right.max() > 0:
                polygon = np.empty((2 * rows, 2))
                polygon[:rows, 0], polygon[rows:, 0] = left, right[::-1]
                polygon[:rows, 1], polygon[rows:, 1] = loads[start:stop], loads[start:stop][::-1]
                polygons.append(polygon)
    return tuple(polygons)


def _forward(system: System, static: Array, squares: Array) -> Mask:
    """Return whether each λ (4,) of a spinning lumped rotor at p̄_t = 0 is a forward whirl's.

    There (24) splits in two; with ω² = λ it is D + ωΩ̄Ī_P a = 0, which gives ω its sign.
    """
    k, m = entries(system.load_stiffness(static)), entries(system.mass)
    a = k[0] - squares * m[0]
    determinant = a * (k[3] - squares * m[3]) - k[1] * k[2]
    return np.asarray(a * determinant * system.spin_speed < 0)


def _boundary_names(system: System, static: Array, squares: Complex) -> tuple[str, ...]:
    """Name each column of λ (m, 2n) by the whirl mode whose ω² it starts from."""
    first, spinning = squares[0], system.spin_matrix().any()
    if spinning and _plain_lumped(system) and not first.imag.any() and first.real[0] > 0:
        count = {"B": 0, "F": 0}
        names = []
        for direction in np.where(_forward(system, static, first.real), "F", "B").tolist():
            count[direction] += 1
            names.append(f"{count[direction]}{direction}")
        return tuple(names)
    frequencies = eigenvalues(system, static)
    if frequencies.imag.any() and not system.is_damped:
        # past buckling or flutter a mode keeps the name it has at no load
        curves = load_frequency_curves(system, static * np.linspace(0.0, 1.0, 200))
        frequencies = curves.frequencies[-1]
    starts = (frequencies**2).real.tolist()
    scale = max(map(abs, starts))
    # 1B before 1F where both start from one point: the left boundary is the backward one
    labels = zip(
        (round(x / scale, SAME_START) for x in starts), mode_names(system.size), strict=True
    )
    # just above p̄_t = 0, where columns that start together have parted
    columns = np.argsort(squares[1].real, kind="stable").tolist()
    named = {column: name for column, (_, name) in zip(columns, sorted(labels), strict=True)}
    return tuple(named[column] for column in range(len(named)))


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
    static = np.array(number("static_load", static_load))
    single_speed(system)
    largest = number("largest_pulsating_load", largest_pulsating_load, 0.0, open_low=True)
    loads, squares = _rows(system, static, largest, whole_number("rows", rows, 8, 100_000))
    names = _boundary_names(system, static, squares)
    regions = _polygons(loads, _real(squares))
    if system.spin_matrix().any():
        squares = track(squares)
    return BolotinChart(loads, _frequency(_real(squares)), names, regions)
