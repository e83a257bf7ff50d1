"""Simple and combination resonances of the pulsating load, in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np

from .._arguments import number
from .._tolerances import NEGLIGIBLE
from .._types import Complex
from ..model.modal import ModalBasis, modal_basis
from ..model.system import System, single_speed
from ..whirl.mode_names import names_of
from .averaging import averaged_tongue
from .resonance_table import Resonance, ResonanceTable

__all__ = ["resonances"]


_SLOPE_LOAD = 1e-4  # p̄_t of the slope K₁/p̄_t where the given one is 0


def _classify(first: str, second: str, planes: bool) -> tuple[str, str, str, str, str]:
    """Return two names in display order, their sign, the kind of pair and the precession."""
    is_sum = first.startswith("−") != second.startswith("−")
    first, second = sorted(
        (name.removeprefix("−") for name in (first, second)),
        key=lambda name: (name[-1], int(name[:-1])),
    )
    precession = "same" if first[-1] == second[-1] else "opposite"
    if planes and not is_sum:
        return first, second, "−", "difference", precession
    if planes:
        return first, second, "+", "principal" if first == second else "sum", precession
    if precession == "same":
        return first, second, "+", "difference", "same"
    return first, second, "+", "principal" if first[:-1] == second[:-1] else "sum", "opposite"


def _pairs(count: int, planes: bool) -> Iterator[tuple[int, int]]:
    """Yield the pairs of modes; of a pair of two planes and its mirror image the first one."""
    for i, j in combinations(range(count), 2):
        if not planes or (i, j) <= (count - 1 - j, count - 1 - i):
            yield i, j


def resonances(system: System, static_load: float, pulsating_load: float) -> ResonanceTable:
    """Return the first-order resonance table, one row for each pair of modes.

    A pulsation p̄_t cos θ̄t couples modes i and j at θ̄ = |ω_i − ω_j| with g = B'_ij B'_ji, B' the
    load's part of the system in the modal basis. g > 0: growth (p̄_t/2)√g, half-width p̄_t√g.
    Another periodic load does so with each of its harmonics, at |ω_i − ω_j|/k, with p̄_t|a_k| for
    p̄_t and a k-th of the width.

    Parameters
    ----------
    system : System
        At one spin speed; lumped or finite-element, damped or not.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_load : float
        p̄_t [EI/L²], 0 or more.

    Returns
    -------
    ResonanceTable

    Raises
    ------
    ValueError
        If the system has no single spin speed, an argument is not one finite number in range, or
        the peak load reaches the pole of the stiffness.

    Notes
    -----
    The table is of first order in p̄_t: it leaves out the shift of the centres, O(p̄_t²), and the
    tongues at |ω_i − ω_j|/k, k ≥ 2. The width is that of the damped pair; as the damping tends to
    0 in a ratio σ_i : σ_j, it tends to the undamped width only if σ_i = σ_j. Where two centres
    lie closer than their widths, see `first_order_regions` or compute the growth rate.

    References
    ----------
    V. V. Bolotin, The Dynamic Stability of Elastic Systems, Holden-Day, 1964; A. H. Nayfeh and
    D. T. Mook, Nonlinear Oscillations, Wiley, 1979, chapter 5.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> table = resonances(lumped(ShaftDisk(), 2.0), 1.178, 0.1)
    >>> [row.name for row in table.tongues]
    ['1B+1F', '2B+1F', '1B+2F', '2B+2F']
    """
    single_speed(system)
    static = number("static_load", static_load)
    load = number("pulsating_load", pulsating_load, 0.0)
    basis, coupling = _couplings(system, static, load)
    frequencies = basis.frequencies
    # without damping a non-zero imaginary part is flutter or buckling of the mean system
    decay = np.imag(frequencies) if np.iscomplexobj(frequencies) else np.zeros(2 * system.size)
    names = names_of(system, static, frequencies)
    frequencies.flags.writeable = False
    growth = float(-decay.min())
    table = ResonanceTable((), frequencies, names, growth, system.planes)
    shape = system.pulsation
    rows = [
        _row(table, pair, (complex(coupling[pair]), k, abs(shape.amplitudes[k - 1])), load)
        for pair in _pairs(2 * system.size, system.planes)
        for k in shape.harmonics
    ]
    return replace(table, rows=tuple(sorted(rows, key=lambda row: row.centre)))


def _row(
    table: ResonanceTable, pair: tuple[int, int], drive: tuple[complex, int, float], load: float
) -> Resonance:
    """Return the row of one pair of modes; `drive` is its g, and k and |a_k| of the harmonic."""
    g, harmonic, amplitude = drive
    one, other = (complex(table.frequencies[mode]) for mode in pair)
    names = table.modes[pair[0]], table.modes[pair[1]]
    first, second, sign, kind, precession = _classify(*names, table.planes)
    decay = (one.imag, other.imag)
    growth_per_load, growth, width, threshold = averaged_tongue(g, decay, load * amplitude)
    threshold /= amplitude
    above = threshold == 0 or load > threshold
    return Resonance(
        first=first,
        second=second,
        centre=abs(one.real - other.real) / harmonic,
        coupling=g,
        growth_per_load=growth_per_load * amplitude,
        growth=growth,
        half_width=width / harmonic,
        threshold=threshold,
        unstable=above and growth_per_load > 0 and not table.mean_is_unstable,
        kind=kind,
        precession=precession,
        modes=pair,
        harmonic=harmonic,
        amplitude=amplitude,
        sign=sign,
    )


def _couplings(system: System, static: float, load: float) -> tuple[ModalBasis, Complex]:
    """Return the modal basis of the mean system and g of every pair of its modes, (2n, 2n)."""
    slope = load if load > 0 else _SLOPE_LOAD
    if system.is_linear:
        mean, first = system.load_stiffness(static), slope * system.geometric
    else:
        mean = system.load_harmonics(static, load)[0]
        first = system.load_harmonics(static, slope)[1]
    basis = modal_basis(system, static, mean + system.cross_part())
    n = system.size
    kick = basis.inverse[:, n:] @ np.linalg.solve(system.mass, first / slope) @ basis.vectors[:n]
    # in coordinates (q, q̇) the product changes sign
    with np.errstate(over="ignore", invalid="ignore"):
        # at a double root ω, as of a free rotor, the basis is singular: that pair makes no tongue
        coupling = -np.nan_to_num(np.asarray(kick * kick.T, dtype=np.complex128), posinf=0.0)
    coupling[np.abs(coupling) <= NEGLIGIBLE * np.abs(coupling).max()] = 0
    if not system.is_damped and np.isrealobj(basis.frequencies):
        coupling = coupling.real.astype(np.complex128)
    return basis, coupling
