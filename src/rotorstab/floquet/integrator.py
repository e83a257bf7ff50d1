"""Splitting integrators for z' = jR(t)z: exact mean flow between kicks of the pulsating load.

In the modal basis of the mean system the mean flow is a diagonal exp(jωh). The rest of
R maps displacement to momentum only, so its square is 0 and its flow is 1 + jh(…) exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import blas

from ..model.harmonics import DIGITS, exact_harmonics, harmonic_rate, pole_term
from ..model.modal import ModalBasis
from ..model.stiffness import refuse_peaks
from ..model.system import System

__all__ = [
    "MAP_SCHEME",
    "POINT_SCHEME",
    "Scheme",
    "divisible",
    "harmonic_count",
    "propagate",
    "segment_propagators",
]

_ENTRIES_WANTED = 8192  # below, the overhead of a NumPy call outweighs its work
_MOST_HARMONICS = 400  # from there on K itself is no dearer
_WORST_MODES = 1e3  # condition of a load operator's eigenvectors that may be used

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Loads = tuple[Array, Array]
Factors = Callable[[Array], Complex]


@dataclass(frozen=True)
class Scheme:
    """A symmetric composition: drifts a₀ … a_s with kicks b₁ … b_s between them.

    A kick is h b ΔK + h³ g ΔK M⁻¹ ΔK with ΔK = K(p̄(t)) − K(p̄_ref); g = `gradient`.
    """

    drifts: tuple[float, ...]
    kicks: tuple[float, ...]
    gradient: float = 0.0


def _symmetric(drifts: tuple[float, ...], kicks: tuple[float, ...]) -> Scheme:
    """Complete half the coefficients; the missing middle ones make each sum 1."""
    last = 0.5 - sum(kicks)
    return Scheme((*drifts, 1 - 2 * sum(drifts), *drifts[::-1]), (*kicks, last, last, *kicks[::-1]))


# SRKNa14, order 6: Blanes, Moan, J. Comput. Appl. Math. 142 (2002) 313, Table 3
POINT_SCHEME = _symmetric(
    (
        0.0378593198406116,
        0.102635633102435,
        -0.0258678882665587,
        0.314241403071447,
        -0.130144459517415,
        0.106417700369543,
        -0.00879424312851058,
    ),
    (
        0.09171915262446165,
        0.183983170005006,
        -0.05653436583288827,
        0.004914688774712854,
        0.143761127168358,
        0.328567693746804,
    ),
)
# One kick a step with the gradient term: M. Takahashi, M. Imada, J. Phys. Soc. Jpn 53 (1984)
# 3765. Up to a change of variables, which no eigenvalue sees, its error is ε²h⁴: a monodromy's
# characteristic polynomial comes out with errors h⁴, h⁶ …, though Y itself only with h².
MAP_SCHEME = Scheme((0.5, 0.5), (1.0,), -1 / 12)


@lru_cache(maxsize=64)
def _load_modes(system: System) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]] | None:
    """Return eigenvalues, eigenvectors and their inverse of A = M⁻¹Kb, None if nearly defective."""
    values, modes = np.linalg.eig(np.linalg.solve(system.mass, system.geometric))
    if np.linalg.cond(modes) > _WORST_MODES:
        return None
    return values, modes, np.linalg.inv(modes)


def _linear_factors(
    system: System, basis: ModalBasis, loads: Loads, step: Array, gradient: float
) -> tuple[NDArray[Any], NDArray[Any], Factors]:
    """Return V_q, L and the maker of factors for K linear in the load, ΔK = (p̄ − p̄_ref) Kb.

    ΔK and ΔK M⁻¹ ΔK are polynomials of one constant operator, A = M⁻¹Kb: in its eigenvectors
    a kick is a number for each of them.
    """
    n = system.size
    right, left = basis.vectors[..., :n, :], basis.inverse[..., :, n:]
    apart = _load_modes(system)
    if apart is None:
        operator = np.linalg.solve(system.mass, system.geometric)
        right = np.concatenate([operator @ right, operator @ operator @ right], axis=-2)
        left = np.concatenate([left, left], axis=-1)
    else:
        right, left = apart[2] @ right, left @ apart[1]

    def factors(phase: Array) -> Complex:
        impulse = step * (loads[0] - basis.load + loads[1] * np.cos(phase))
        square = gradient * step * impulse * impulse
        if apart is None:
            return np.repeat(1j * np.stack([impulse, square], axis=1), n, axis=1)
        values = apart[0].reshape(n, *[1] * (impulse.ndim - 1))
        return np.asarray(1j * (values * impulse[:, None] + values**2 * square[:, None]))

    return left, right, factors


def _exact_factors(
    system: System, basis: ModalBasis, loads: Loads, step: Array, gradient: float
) -> tuple[NDArray[Any], NDArray[Any], Factors]:
    """Return V_q, L and the maker of factors, whole matrices, for the exact K(p̄)."""
    n, shear = system.size, system.exact_shear
    assert shear is not None
    refuse_peaks(*loads, shear)
    inverse = np.linalg.inv(system.mass)
    reference = system.load_stiffness(basis.load)
    count = harmonic_count(system, loads)
    series = count <= _MOST_HARMONICS
    if series:
        static, pulsating = np.broadcast_arrays(*loads)
        harmonics = exact_harmonics(static, pulsating, shear, system.tangency, count)
        harmonics[0] -= reference
        harmonics = np.moveaxis(inverse @ harmonics, (-2, -1), (1, 2)).reshape(count + 1, -1)

    def change_at(phase: Array) -> Array:
        """Return M⁻¹ΔK (stage, n, n, segment, *grid)."""
        load = loads[0] + loads[1] * np.cos(phase)
        if not series:
            change = inverse @ (system.load_stiffness(load) - reference)
            return np.moveaxis(change, (-2, -1), (1, 2))
        # K itself is dear: a cosine series, but for what the pole makes infinite
        lead = phase.shape[: phase.ndim - loads[1].ndim]
        change = np.cos(phase.reshape(-1, 1) * np.arange(count + 1)) @ harmonics
        change = change.reshape(*lead, n, n, *load.shape[len(lead) :])
        change = np.moveaxis(change, 1, 3)
        change[:, :, 1] += (
            inverse[:, 1].reshape(-1, *[1] * (load.ndim - 1)) * pole_term(load, shear)[:, None]
        )
        return change

    def factors(phase: Array) -> Complex:
        change = change_at(phase)
        table: Complex = np.asarray((1j * step) * change)
        if gradient:
            square = np.einsum("sik...,skj...->sij...", change, change)
            table += (1j * gradient) * step**3 * square
        return table

    return basis.inverse[..., :, n:], basis.vectors[..., :n, :], factors


def harmonic_count(system: System, loads: Loads) -> int:
    """Return how many harmonics of K(p̄(t)) matter, `pole_term` apart."""
    assert system.exact_shear is not None
    return max(4, math.ceil(DIGITS / harmonic_rate(*loads, system.exact_shear)))


def _multiplier(
    matrix: NDArray[Any], y: Complex, out: Complex, add: bool = False
) -> Callable[[], None]:
    """Return a call that writes matrix @ y over the first axis into `out`, or adds it there.

    Both arrays are contiguous.
    """
    if matrix.ndim > 2:
        each = np.ascontiguousarray(np.moveaxis(matrix, 0, -1))

        def multiply_each() -> None:
            product = np.einsum("ikp,kc...p->ic...p", each, y)
            np.add(product, out, out=out) if add else np.copyto(out, product)

        return multiply_each
    source, target = y.reshape(len(y), -1), out.reshape(len(out), -1)
    real = np.isrealobj(matrix)
    if real:
        # one real product serves real and imaginary parts
        source, target = source.view(np.float64), target.view(np.float64)
    if not add:

        def multiply() -> None:
            np.matmul(matrix, source, out=target)

        return multiply
    # BLAS adds in the same pass; it wants Fortran's order, so all is transposed
    gemm = blas.dgemm if real else blas.zgemm
    turned = np.ascontiguousarray(matrix).T

    def multiply_add() -> None:
        gemm(1.0, source.T, turned, 1.0, target.T, overwrite_c=1)

    return multiply_add


def _chain(y: Complex) -> Complex:
    """Return the product over axis 2 of propagators (m, m, S, ...), the last one leftmost."""
    while y.shape[2] > 1:
        pairs = np.einsum("ik...,kj...->ij...", y[:, :, 1::2], y[:, :, : y.shape[2] // 2 * 2 : 2])
        odd = y[:, :, -1:] if y.shape[2] % 2 else None
        y = pairs if odd is None else np.concatenate([pairs, odd], axis=2)
    return np.asarray(y[:, :, 0])


def divisible(count: int) -> int:
    """Return a count at most a sixteenth larger that many numbers divide, for `propagate`.

    A prime number of steps leaves no equal segments, and takes ten times as long.
    """
    unit = 1 << max(0, count.bit_length() - 5)
    return -(-count // unit) * unit


def propagate(
    system: System,
    basis: ModalBasis,
    loads: Loads,
    span: Array,
    turn: float,
    steps: int,
    scheme: Scheme,
) -> Complex:
    """Return Y(span) of z = VY under the load p̄₀ + p̄_t cos φ, φ from 0 to `turn`.

    Parameters
    ----------
    system : System
    basis : ModalBasis
        Shared, shapes (2n, 2n), or one for each point of a 1-d grid, (P, 2n, 2n).
    loads : tuple of float arrays
        p̄₀ and p̄_t; they and `span` broadcast to the grid's shape.
    span : float array
        Time taken.
    turn : float
        π for half a period, 2π for the whole.
    steps : int
        Number of equal steps.
    scheme : Scheme

    Returns
    -------
    (2n, 2n, *grid) complex
        In modal coordinates: z(span) = V Y V⁻¹ z(0).

    Notes
    -----
    A small grid is cut into segments of time that run side by side, then multiplied: NumPy's
    cost of a call would rule otherwise.
    """
    size = 2 * system.size
    grid = np.broadcast_shapes(loads[0].shape, loads[1].shape, span.shape)
    entries = size * size * int(np.prod(grid))
    wanted = max(1, min(steps, _ENTRIES_WANTED // max(entries, 1)))
    # extrapolation needs the very number of steps
    segments = next(count for count in range(wanted, 0, -1) if steps % count == 0)
    steps //= segments
    return _chain(segment_propagators(system, basis, loads, span, turn, steps, scheme, segments))


def segment_propagators(
    system: System,
    basis: ModalBasis,
    loads: Loads,
    span: Array,
    turn: float,
    steps: int,
    scheme: Scheme,
    segments: int,
) -> Complex:
    """Return Y over each of `segments` equal parts of the span, first part first.

    The other parameters are those of `propagate`, but for `steps`, counted in one segment.

    Returns
    -------
    (2n, 2n, segments, *grid) complex
        In modal coordinates; their product, the last one leftmost, is Y(span).
    """
    size = 2 * system.size
    grid = np.broadcast_shapes(loads[0].shape, loads[1].shape, span.shape)
    step = span / (steps * segments)
    maker = _linear_factors if system.is_linear else _exact_factors
    left, right, factors = maker(system, basis, loads, step, scheme.gradient)

    # axes: row, column, segment, grid; a list of bases runs along the grid's last axis
    frequencies = np.moveaxis(np.atleast_2d(basis.frequencies), 0, -1)
    frequencies = frequencies.reshape(size, 1, *([1] * len(grid)), -1)
    drifts = [*scheme.drifts[:-1], scheme.drifts[-1] + scheme.drifts[0]]
    needed = {*drifts, scheme.drifts[-1]}
    # NumPy multiplies arrays of one shape faster; with many stages they would fill the cache
    shape = (size, size if len(needed) <= 3 else 1, segments, *grid)
    flows = {
        a: np.ascontiguousarray(np.broadcast_to(np.exp(1j * a * frequencies * step), shape))
        for a in needed
    }
    times = np.cumsum(scheme.drifts[:-1])
    weights = np.array(scheme.kicks)
    segment = np.arange(segments)

    y = np.zeros((size, size, segments, *grid), dtype=np.complex128)
    diagonal = np.arange(size)
    y[diagonal, diagonal] = flows[drifts[0]][:, 0]
    force = np.empty((right.shape[-2], *y.shape[1:]), dtype=np.complex128)
    push = force if system.is_linear else np.empty_like(force)
    to_force = _multiplier(right, y, force)
    add_change = _multiplier(left, push, y, add=True)
    block = max(1, _ENTRIES_WANTED * 8 // (int(np.prod(grid)) * segments * len(times)))
    for start in range(0, steps, block):
        index = np.arange(start, min(start + block, steps))
        time = (index[:, None] + times).reshape(-1, 1)
        phase = turn * (segment + time / steps) / segments
        table = factors(phase.reshape(*phase.shape, *([1] * len(grid))))
        table *= np.tile(weights, len(index)).reshape(-1, *([1] * (table.ndim - 1)))
        for stage, factor in enumerate(table):
            to_force()
            if system.is_linear:
                force *= factor[:, None]
            else:
                np.einsum("ik...,kc...->ic...", factor, force, out=push)
            add_change()
            which = stage % len(times)
            final = which == len(times) - 1 and index[stage // len(times)] == steps - 1
            y *= flows[scheme.drifts[-1] if final else drifts[which + 1]]
    return y
