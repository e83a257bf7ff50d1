"""Splitting integrators for z' = jR(t)z: exact mean flow between kicks of the pulsating load.

In the modal basis of the mean system the mean flow is a diagonal exp(jωh). The rest of R maps
displacement to momentum only: its square is 0, so the flow of a kick is 1 + jh(…) exactly.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg import blas

from .._numerics.extrapolation import extrapolation_weights
from .._types import AnyArray, Array, Complex
from ..model.modal import ModalBasis
from ..model.system import System
from .kicks import Kicks, Loads, law_kicks, linear_kicks
from .schemes import Scheme

__all__ = [
    "POINT_LEVELS",
    "fastest_rate",
    "fine_and_coarse",
    "propagate",
    "segment_propagators",
]

_ENTRIES_WANTED = 8192  # below, the overhead of a NumPy call takes longer than its work

POINT_LEVELS = (3, 4, 5)
"""Step counts of the extrapolation of order 6 at single points, times a common factor."""

_FINE = extrapolation_weights(POINT_LEVELS, 6)  # leaves an error h¹⁰
_COARSE = np.concatenate([[0.0], extrapolation_weights(POINT_LEVELS[1:], 6)])  # leaves h⁸


def fastest_rate(system: System, basis: ModalBasis, loads: Loads) -> Array:
    """Return a rate (...) [√(EI/(ρAL⁴))] that bounds how fast the state turns, for step sizes.

    The stiffness under the largest load exceeds that at the reference load of the basis by at most
    ‖M⁻¹Kb‖ (|p̄₀ − p̄_ref| + |p̄_t| max |f|) and the shift, which add to ω².
    """
    drive = np.linalg.norm(np.linalg.solve(system.mass, system.geometric), 2)
    swing = np.abs(loads[0] - basis.load) + np.abs(loads[1]) * system.pulsation.largest
    squares = np.abs(basis.frequencies).max(axis=-1) ** 2
    return np.asarray(np.sqrt(squares + drive * swing + basis.shift))


def fine_and_coarse(propagator: Callable[[int], Complex], factor: int) -> tuple[AnyArray, AnyArray]:
    """Return the extrapolants of order 10 and of order 8 of a propagator by `POINT_SCHEME`.

    Parameters
    ----------
    propagator : callable
        Takes a number of steps; returns Y.
    factor : int
        Multiplies the step counts `POINT_LEVELS`.
    """
    fine = coarse = np.complex128(0)
    for level, better, worse in zip(POINT_LEVELS, _FINE, _COARSE, strict=True):
        y = propagator(level * factor)
        fine, coarse = fine + better * y, coarse + worse * y
    return np.asarray(fine), np.asarray(coarse)


def _multiplier(
    matrix: AnyArray, y: Complex, out: Complex, add: bool = False
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
    # BLAS adds in the same pass; it needs Fortran's order, so all matrices are transposed
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
        p̄₀ and p̄_t [EI/L²]; they and `span` broadcast to the grid's shape.
    span : float array
        Time [√(ρAL⁴/(EI))] from start to end.
    turn : float
        Phase [rad] that the load advances meanwhile: π for half a period, 2π for the whole.
    steps : int
        Number of equal steps.
    scheme : Scheme

    Returns
    -------
    (2n, 2n, *grid) complex
        In modal coordinates: z(span) = V Y V⁻¹ z(0).

    Notes
    -----
    A small grid is cut into segments of time that are computed side by side and then multiplied;
    otherwise the overhead of NumPy's calls would take most of the time.
    """
    size = 2 * system.size
    grid = np.broadcast_shapes(loads[0].shape, loads[1].shape, span.shape)
    entries = size * size * int(np.prod(grid))
    wanted = max(1, min(steps, _ENTRIES_WANTED // max(entries, 1)))
    # extrapolation needs exactly this number of steps
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

    The other parameters are those of `propagate`, except that `steps` is the number of steps in
    one segment.

    Returns
    -------
    (2n, 2n, segments, *grid) complex
        In modal coordinates; their product, the last one leftmost, is Y(span).
    """
    size = 2 * system.size
    grid = np.broadcast_shapes(loads[0].shape, loads[1].shape, span.shape)
    step = span / (steps * segments)
    arguments = system, basis, loads, step, scheme.gradient
    kicks = linear_kicks(*arguments) if system.law is None else law_kicks(system.law, *arguments)

    # axes: row, column, segment, grid; a list of bases runs along the grid's last axis
    frequencies = np.moveaxis(np.atleast_2d(basis.frequencies), 0, -1)
    frequencies = frequencies.reshape(size, 1, *([1] * len(grid)), -1)
    lengths = {*scheme.drifts, scheme.joined}
    # NumPy multiplies arrays of one shape faster; with many stages they would fill the cache
    shape = (size, size if len(lengths) <= 3 else 1, segments, *grid)
    flows = {
        a: np.ascontiguousarray(np.broadcast_to(np.exp(1j * a * frequencies * step), shape))
        for a in lengths
    }
    y = np.zeros((size, size, segments, *grid), dtype=np.complex128)
    diagonal = np.arange(size)
    y[diagonal, diagonal] = flows[scheme.drifts[0]][:, 0]
    _advance(y, kicks, flows, scheme, steps, turn, system.is_linear)
    return y


def _advance(
    y: Complex,
    kicks: Kicks,
    flows: dict[float, Complex],
    scheme: Scheme,
    steps: int,
    turn: float,
    linear: bool,
) -> None:
    """Apply all kicks and drifts of a number of steps to Y after its first drift, in place."""
    segments, grid = y.shape[2], y.shape[3:]
    force = np.empty((kicks.right.shape[-2], *y.shape[1:]), dtype=np.complex128)
    push = force if linear else np.empty_like(force)
    to_force = _multiplier(kicks.right, y, force)
    add_change = _multiplier(kicks.left, push, y, add=True)
    times = np.cumsum(scheme.drifts[:-1])
    weights = np.array(scheme.kicks)
    after = [flows[a] for a in (*scheme.drifts[1:-1], scheme.joined)]
    last = flows[scheme.drifts[-1]]
    segment = np.arange(segments)
    block = max(1, _ENTRIES_WANTED * 8 // (int(np.prod(grid)) * segments * len(times)))
    for start in range(0, steps, block):
        index = np.arange(start, min(start + block, steps))
        time = (index[:, None] + times).reshape(-1, 1)
        phase = turn * (segment + time / steps) / segments
        table = kicks.factors(phase.reshape(*phase.shape, *([1] * len(grid))))
        table *= np.tile(weights, len(index)).reshape(-1, *([1] * (table.ndim - 1)))
        for stage, factor in enumerate(table):
            to_force()
            if linear:
                force *= factor[:, None]
            else:
                np.einsum("ik...,kc...->ic...", factor, force, out=push)
            add_change()
            final = start + len(index) == steps and stage == len(table) - 1
            y *= last if final else after[stage % len(times)]
