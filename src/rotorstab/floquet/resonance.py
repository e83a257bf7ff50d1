"""Closed-form table of simple and combination resonances of the pulsating load."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from .._arguments import number
from .._tolerances import NEGLIGIBLE
from .._types import AnyArray, Complex
from ..model.modal import ModalBasis, modal_basis
from ..model.system import System, single_speed
from ..whirl.mode_names import names_of
from .averaging import averaged_tongue
from .criterion import mean_is_unstable

__all__ = ["HIGHEST_NAMED_ORDER", "Resonance", "ResonanceTable", "resonances"]

HIGHEST_NAMED_ORDER = 9
"""Largest k of θ̄ = |ω_i − ω_j|/k up to which tongues are named after a pair of modes.

Tongues of higher orders stand so close together that the nearest one says little.
"""

_SLOPE_LOAD = 1e-4  # p̄_t of the slope K₁/p̄_t where the given one is 0


@dataclass(frozen=True)
class Resonance:
    """A pair of modes that the pulsating load can couple.

    Parameters
    ----------
    first, second : str
        Names of the two modes; backward before forward, then by number.
    centre : float
        θ̄ = |ω_i − ω_j|/k [√(EI/(ρAL⁴))], the first-order centre of the tongue; k is `harmonic`.
    coupling : complex
        g = B'_ij B'_ji, see `resonances`; real without damping. The modes make a tongue if g > 0.
    growth_per_load : float
        Peak growth rate per unit pulsating load without the decay of the modes, Re√g/2; 0 if the
        modes make no tongue.
    growth : float
        Peak growth rate [√(EI/(ρAL⁴))] at the given pulsating load, damping included; negative if
        the pair decays, NaN if one of the modes grows without pulsation.
    half_width : float
        Half-width in θ̄ of the tongue at the given pulsating load; 0 where the pair is stable.
    threshold : float
        Pulsating load p̄_t [EI/L²] above which the pair is unstable: 0 without damping, inf if the
        modes make no tongue.
    unstable : bool
        Whether the pair is unstable at the given pulsating load; without damping, at any load.
        Always False where the mean system is unstable by itself.
    kind : str
        "principal" (backward and forward whirl of one number), "sum" (two numbers, opposite
        precession) or "difference" (same precession). With two planes: "principal" is twice one
        frequency, "sum" and "difference" are those of two.
    precession : str
        "same" or "opposite".
    modes : (int, int)
        Which of the table's frequencies the two are.
    harmonic : int
        k, number of the load's harmonic that couples them.
    amplitude : float
        |a_k| of that harmonic.
    sign : str
        Stands between the names: "−" for a difference of two planes, else "+".
    """

    first: str
    second: str
    centre: float
    coupling: complex
    growth_per_load: float
    growth: float
    half_width: float
    threshold: float
    unstable: bool
    kind: str
    precession: str
    modes: tuple[int, int]
    harmonic: int = 1
    amplitude: float = 1.0
    sign: str = "+"

    @property
    def name(self) -> str:
        """The pair as one label, such as 1B+1F; (1B+1F)/2 by the second harmonic of the load."""
        pair = f"{self.first}{self.sign}{self.second}"
        return pair if self.harmonic == 1 else f"({pair})/{self.harmonic}"


@dataclass(frozen=True)
class ResonanceTable:
    """Every pair of modes of one system under one load, sorted by centre.

    Parameters
    ----------
    rows : tuple of Resonance
        All n(2n − 1) pairs of the 2n modes, once for each harmonic of the load. Of a system of two
        planes a pair and its mirror image, −ω for ω, are one row.
    frequencies : (2n,) float or complex
        Whirl frequencies of the mean system, sorted by real part.
    modes : tuple of str
        Their names.
    mean_growth : float
        Growth rate of the mean system, that is without pulsation: max(−Im ω).
    planes : bool
        Whether the system is one of two planes.
    """

    rows: tuple[Resonance, ...]
    frequencies: AnyArray
    modes: tuple[str, ...]
    mean_growth: float
    planes: bool = False

    def __iter__(self) -> Iterator[Resonance]:
        """Iterate over the rows."""
        return iter(self.rows)

    def __len__(self) -> int:
        """Return the number of pairs."""
        return len(self.rows)

    def __getitem__(self, name: str) -> Resonance:
        """Return the pair with a given name, such as "1B+1F"."""
        for row in self.rows:
            if row.name == name:
                return row
        raise KeyError(name)

    @property
    def tongues(self) -> tuple[Resonance, ...]:
        """The unstable pairs only."""
        return tuple(row for row in self.rows if row.unstable)

    @property
    def mean_is_unstable(self) -> bool:
        """Whether the mean system grows without pulsation, by more than rounding."""
        return bool(mean_is_unstable(self.frequencies))

    def nearest(
        self, frequency: float, highest_order: int = HIGHEST_NAMED_ORDER
    ) -> tuple[Resonance, int] | None:
        """Return the pair and order k whose θ̄ = |ω_i − ω_j|/k explains a frequency best.

        Parameters
        ----------
        frequency : float
            θ̄ [√(EI/(ρAL⁴))], above 0.
        highest_order : int
            Largest k considered.

        Returns
        -------
        (Resonance, int) or None
            Smallest k |ln(|ω_i − ω_j|/(kθ̄))|: a higher order must be nearer to be chosen. Only
            pairs that make a tongue without damping count; None if there are none.
        """
        choices = [
            (abs(math.log(row.centre / k / frequency)) * k, row.name, k)
            for row in self.rows
            if row.growth_per_load > 0 and row.centre > 0
            for k in range(1, highest_order + 1)
        ]
        if not choices:
            return None
        _, name, order = min(choices)
        return self[name], order


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
