"""Splitting integrators for z' = jR(t)z: exact mean flow between kicks of the pulsating load.

In the modal basis of the mean system the mean flow is a diagonal exp(jωh). The rest of
R maps displacement to momentum only, so its square is 0 and its flow is 1 + jh(…) exactly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .modal import ModalBasis
from .stiffness import largest_exact_load
from .system import System

__all__ = ["MAP_SCHEME", "POINT_SCHEME", "Scheme", "propagate"]

_ENTRIES_WANTED = 8192  # below, the overhead of a NumPy call outweighs its work

Complex = NDArray[np.complex128]
Kick = Callable[[Complex, float], None]
Loads = tuple[NDArray[np.float64], NDArray[np.float64]]


@dataclass(frozen=True)
class Scheme:
    """A symmetric composition: drifts a₀ … a_s with kicks b₁ … b_s between them."""

    drifts: tuple[float, ...]
    kicks: tuple[float, ...]


def _symmetric(drifts: tuple[float, ...], kicks: tuple[float, ...], middle: str) -> Scheme:
    """Complete half the coefficients; the missing middle one makes each sum 1."""
    if middle == "drift":
        a = (*drifts, 1 - 2 * sum(drifts), *drifts[::-1])
        b = (*kicks, 0.5 - sum(kicks), 0.5 - sum(kicks), *kicks[::-1])
    else:
        half = (*drifts, 0.5 - sum(drifts))
        a = (*half, *half[::-1])
        b = (*kicks, 1 - 2 * sum(kicks), *kicks[::-1])
    return Scheme(a, b)


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
    "drift",
)
# ABA(8,6,4), error εh⁸ + ε²h⁶ + ε³h⁴ for a kick of size ε: Blanes, Casas, Farrés, Laskar,
# Makazaga, Murua, Appl. Numer. Math. 68 (2013) 58, Table 3. Here ε is small, h is not.
MAP_SCHEME = _symmetric(
    (0.0711334264982231177779387300061549964174,
     0.241153427956640098736487795326289649618,
     0.521411761772814789212136078067994229991),
    (0.183083687472197221961703757166430291072,
     0.310782859898574869507522291054262796375,
     -0.0265646185119588006972121379164987592663),
    "kick",
)  # fmt: skip


def _linear_kick(
    system: System,
    basis: ModalBasis,
    loads: Loads,
    step: NDArray[np.float64],
) -> Callable[[NDArray[np.float64]], Kick]:
    """Return the maker of kicks j b h (p̄ − p̄_ref) B Y for K linear in the load."""
    static, pulsating = loads
    n = system.size
    load = np.linalg.solve(system.mass, system.geometric)
    operator = basis.inverse[..., :, n:] @ load @ basis.vectors[..., :n, :]
    offset = 1j * step * (static - basis.load)
    amplitude = 1j * step * pulsating
    shared = operator.ndim == 2
    if not shared:
        operator = np.ascontiguousarray(np.moveaxis(operator, 0, -1))

    def at_phase(phase: NDArray[np.float64]) -> Kick:
        scale = offset + amplitude * np.cos(phase)

        def kick(y: Complex, weight: float) -> None:
            if shared:
                change = _left_multiply(operator, y)
            else:
                change = np.einsum("ikp,kc...p->ic...p", operator, y)
            change *= weight * scale
            y += change

        return kick

    return at_phase


def _exact_kick(
    system: System,
    basis: ModalBasis,
    loads: Loads,
    step: NDArray[np.float64],
) -> Callable[[NDArray[np.float64]], Kick]:
    """Return the maker of kicks j b h L (K(p̄) − K(p̄_ref)) V_q Y for any K(p̄)."""
    n = system.size
    right = basis.vectors[..., :n, :]
    left = basis.inverse[..., :, n:] @ np.linalg.inv(system.mass)
    shared = right.ndim == 2
    if not shared:
        left, right = np.moveaxis(left, 0, -1), np.moveaxis(right, 0, -1)
    # K(p̄₀ + p̄_t cos φ) as a cosine series, taken once for all phases
    harmonics = np.stack(system.load_harmonics(*loads, count=_harmonic_count(system, loads)))
    harmonics[0] -= system.load_stiffness(basis.load)
    harmonics = np.moveaxis(harmonics, (-2, -1), (1, 2))
    table = harmonics.reshape(len(harmonics), -1)

    def at_phase(phase: NDArray[np.float64]) -> Kick:
        cosines = np.cos(phase.reshape(-1, 1) * np.arange(len(table)))
        remainder = (cosines @ table).reshape(-1, *harmonics.shape[1:])
        matrix = np.moveaxis(remainder, 0, 2)

        def kick(y: Complex, weight: float) -> None:
            if shared:
                low = _left_multiply(right, y)
            else:
                low = np.einsum("ikp,kc...p->ic...p", right, y)
            force = np.empty_like(low)
            for i in range(n):
                force[i] = matrix[i, 0] * low[0]
                for k in range(1, n):
                    force[i] += matrix[i, k] * low[k]
            force *= 1j * weight * step
            if shared:
                y += _left_multiply(left, force)
            else:
                y += np.einsum("ikp,kc...p->ic...p", left, force)

        return kick

    return at_phase


def _harmonic_count(system: System, loads: Loads) -> int:
    """Return how many harmonics of K(p̄(t)) matter: they fall like ρ^−m, ρ set by the pole."""
    assert system.exact_shear is not None
    reach = np.min((largest_exact_load(system.exact_shear) - loads[0]) / (np.abs(loads[1]) + 1e-9))
    ellipse = float(reach + np.sqrt(max(reach * reach - 1, 0.0)))
    return int(min(400, max(4, np.ceil(37 / np.log(max(ellipse, 1.01))))))


def _left_multiply(matrix: NDArray[Any], y: Complex) -> Complex:
    """Return matrix @ y over the first axis of a contiguous y; a real one in real arithmetic."""
    rows = len(matrix)
    flat = y.reshape(len(y), -1)
    if np.isrealobj(matrix):
        product = (matrix @ flat.view(np.float64)).view(np.complex128)
    else:
        product = matrix @ flat
    return np.asarray(product.reshape(rows, *y.shape[1:]))


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
    span: NDArray[np.float64],
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
        Number of equal steps; a few more may be taken.
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
    segments = max(1, min(steps, _ENTRIES_WANTED // max(entries, 1)))
    steps = -(-steps // segments)
    step = span / (steps * segments)
    maker = _linear_kick if system.is_linear else _exact_kick
    at_phase = maker(system, basis, loads, step)

    # axes: row, column, segment, grid; a list of bases runs along the grid's last axis
    frequencies = np.moveaxis(np.atleast_2d(basis.frequencies), 0, -1)
    frequencies = frequencies.reshape(size, 1, *([1] * len(grid)), -1)
    drifts = [*scheme.drifts[:-1], scheme.drifts[-1] + scheme.drifts[0]]
    flows = {a: np.exp(1j * a * frequencies * step) for a in {*drifts, scheme.drifts[-1]}}
    times = np.cumsum(scheme.drifts[:-1])
    segment = np.arange(segments).reshape(-1, *([1] * len(grid)))

    y = np.zeros((size, size, segments, *grid), dtype=np.complex128)
    y[np.arange(size), np.arange(size)] = 1
    y *= flows[drifts[0]]
    for index in range(steps):
        last = scheme.drifts[-1] if index == steps - 1 else drifts[-1]
        after = [flows[a] for a in (*drifts[1:-1], last)]
        for time, weight, flow in zip(times, scheme.kicks, after, strict=True):
            phase = turn * (segment + (index + time) / steps) / segments
            at_phase(phase)(y, weight)
            y *= flow
    return _chain(y)
