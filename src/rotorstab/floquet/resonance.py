"""Closed-form table of simple and combination resonances of the pulsating load."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._arguments import number
from ..model.modal import modal_basis
from ..model.system import System
from ..whirl.mode_names import names_of

__all__ = ["Resonance", "ResonanceTable", "resonances"]

_NO_COUPLING = 1e-12  # of the largest |g|: a product of rounding errors, not a tongue
_SLOPE_LOAD = 1e-4


@dataclass(frozen=True)
class Resonance:
    """One pair of modes that the pulsating load can couple.

    Parameters
    ----------
    first, second : str
        Names of the two modes, backward first, then the lower number.
    centre : float
        θ̄ = |ω_i − ω_j| [√(EI/(ρAL⁴))], the first-order centre of the tongue.
    coupling : complex
        g = B'_ij B'_ji of theory; real without damping. A tongue needs g > 0.
    growth_per_load : float
        Peak growth rate per unit pulsating load, undamped part, Re√g/2; 0 without a tongue.
    growth : float
        Peak growth rate at the given pulsating load, damping included; negative is decay,
        NaN if the mean system is unstable.
    half_width : float
        Half-width in θ̄ of the tongue at the given pulsating load, 0 where stable.
    threshold : float
        Pulsating load from which the tongue is unstable: 0 undamped, inf without a tongue.
    unstable : bool
        Whether the tongue exists at the given pulsating load (undamped: at any).
    kind : str
        "principal" (the two whirls of one number), "sum" (two numbers, opposite
        precession) or "difference" (same precession).
    precession : str
        "same" or "opposite".
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

    @property
    def name(self) -> str:
        """The pair as one label, such as 1B+1F."""
        return f"{self.first}+{self.second}"


@dataclass(frozen=True)
class ResonanceTable:
    """Every pair of modes of one system under one load, sorted by centre.

    Parameters
    ----------
    rows : tuple of Resonance
        n(2n − 1) of them.
    frequencies : (2n,) float or complex
        Whirl frequencies of the mean system, sorted by real part.
    modes : tuple of str
        Their names.
    mean_growth : float
        Growth rate of the mean system alone, max(−Im ω); above 0 it is unstable by itself.
    """

    rows: tuple[Resonance, ...]
    frequencies: NDArray[Any]
    modes: tuple[str, ...]
    mean_growth: float

    def __iter__(self) -> Iterator[Resonance]:
        """Iterate over the rows."""
        return iter(self.rows)

    def __len__(self) -> int:
        """Return the number of pairs."""
        return len(self.rows)

    def __getitem__(self, name: str) -> Resonance:
        """Return the pair of one name, such as "1B+1F"."""
        for row in self.rows:
            if row.name == name:
                return row
        raise KeyError(name)

    @property
    def tongues(self) -> tuple[Resonance, ...]:
        """The unstable pairs only."""
        return tuple(row for row in self.rows if row.unstable)


def _classify(first: str, second: str) -> tuple[str, str, str, str]:
    """Return both names in display order, the kind and the precession."""
    first, second = sorted((first, second), key=lambda name: (name[-1], int(name[:-1])))
    if first[-1] == second[-1]:
        return first, second, "difference", "same"
    return first, second, "principal" if first[:-1] == second[:-1] else "sum", "opposite"


def _tongue(coupling: complex, decay: tuple[float, float], load: float) -> tuple[float, ...]:
    """Return growth per load, growth, half-width and threshold of one resonant pair.

    The averaged pair a' = −σ_i a + (jp/2)B_ij b, b' = (±jδ − σ_j) b + (jp/2)B_ji a; with a
    complex g the detuning that grows most splits its phase evenly, so g_eff = (|g| + Re g)/2.
    """
    low, high = sorted(decay)
    strength = (abs(coupling) + coupling.real) / 2
    per_load = strength**0.5 / 2
    drive = load**2 * strength / 4
    growth = -(low + high) / 2 + (((high - low) / 2) ** 2 + drive) ** 0.5
    if strength == 0:
        return 0.0, growth, 0.0, np.inf
    if low < 0:
        return per_load, np.nan, np.nan, 0.0
    product = low * high
    if product == 0:  # or so small that it underflows
        return per_load, growth, 2 * drive**0.5, 0.0
    width = (low + high) * max(drive / product - 1, 0.0) ** 0.5
    return per_load, growth, width, 2 * (product / strength) ** 0.5


def resonances(system: System, static_load: float, pulsating_load: float) -> ResonanceTable:
    """Return the first-order resonance table, one row for each pair of modes.

    A pulsation p̄_t cos θ̄t couples modes i and j at θ̄ = |ω_i − ω_j| with g = B'_ij B'_ji, B' the
    load's part of the system in the modal basis. g > 0: growth (p̄_t/2)√g, half-width p̄_t√g.

    Parameters
    ----------
    system : System
        With one spin speed; lumped or finite-element, damped or not.
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
        If an argument is not one finite number in range, or the exact stiffness has a
        pole below the largest load.

    Notes
    -----
    First order in p̄_t: the centre shifts by O(p̄_t²) and tongues at |ω_i − ω_j|/k, k ≥ 2, are
    not listed. With light damping of ratio σ_i : σ_j the width is that of the damped pair,
    which does not tend to the undamped one unless σ_i = σ_j. Where two centres lie closer
    than their widths, only Floquet decides.

    References
    ----------
    V. V. Bolotin, The Dynamic Stability of Elastic Systems; A. H. Nayfeh and D. T. Mook,
    Nonlinear Oscillations, ch. 5 (method of averaging).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> table = resonances(lumped(ShaftDisk(), 2.0), 1.178, 0.1)
    >>> [row.name for row in table.tongues]
    ['1B+1F', '2B+1F', '1B+2F', '2B+2F']
    """
    if system.spin_speed.ndim:
        raise ValueError(
            f"`system` must have one spin speed, got an array of shape {system.spin_speed.shape}"
        )
    static = number("static_load", static_load)
    load = number("pulsating_load", pulsating_load, 0.0)
    slope = load if load > 0 else _SLOPE_LOAD
    mean, first = system.load_harmonics(static, load)[0], system.load_harmonics(static, slope)[1]
    shift = system.stiffness(static) - system.load_stiffness(static)
    basis = modal_basis(system, static, mean + shift)
    n = system.size
    kick = basis.inverse[:, n:] @ np.linalg.solve(system.mass, first / slope) @ basis.vectors[:n]
    # in coordinates (q, q̇) the product changes sign
    coupling = -np.asarray(kick * kick.T, dtype=np.complex128)
    coupling[np.abs(coupling) <= _NO_COUPLING * np.abs(coupling).max()] = 0
    if not system.is_damped and np.isrealobj(basis.frequencies):
        coupling = coupling.real.astype(np.complex128)
    frequencies = basis.frequencies
    # without damping a non-zero imaginary part is flutter or buckling of the mean system
    decay = np.imag(frequencies) if np.iscomplexobj(frequencies) else np.zeros(2 * n)
    names = names_of(system, static, frequencies)
    unstable_mean = bool(-decay.min() > 1e-9 * np.abs(frequencies).max())
    rows = []
    for i, j in combinations(range(2 * n), 2):
        label = _classify(names[i], names[j])
        pair = (float(decay[i]), float(decay[j]))
        growth_per_load, growth, width, threshold = _tongue(complex(coupling[i, j]), pair, load)
        exists = threshold == 0 or load > threshold
        rows.append(
            Resonance(
                first=label[0],
                second=label[1],
                centre=float(abs((frequencies[i] - frequencies[j]).real)),
                coupling=complex(coupling[i, j]),
                growth_per_load=float(growth_per_load),
                growth=float(growth),
                half_width=float(width),
                threshold=float(threshold),
                unstable=bool(exists and growth_per_load > 0 and not unstable_mean),
                kind=label[2],
                precession=label[3],
            )
        )
    rows.sort(key=lambda row: row.centre)
    frequencies.flags.writeable = False
    return ResonanceTable(tuple(rows), frequencies, names, float(-decay.min()))
