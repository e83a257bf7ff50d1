"""Unstable regions to first order in the pulsating load, where tongues lie close together.

The resonance table treats each pair of modes alone. Where tongues share a mode and lie close, the
pairs act together: at rest 1B+2B and 1F+2F have one centre, and 1B+1F may be near.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._arguments import number
from .._tolerances import FIRST_ORDER_GROWTH
from .._types import Array, Complex, Index, Mask
from .resonance_table import Resonance, ResonanceTable

__all__ = ["FirstOrderRegion", "first_order_regions"]

_REACH = 3.0  # half-widths from its centre within which a tongue may affect another one
_POINTS = 800  # frequencies at which a group of tongues is scanned
_BISECTIONS = 40
# points; growth may touch 0 where one pair hands over to the next: a shorter gap is none
_SHORTEST_GAP = 4


@dataclass(frozen=True)
class FirstOrderRegion:
    """An interval of θ̄ that is unstable to first order in the pulsating load.

    Parameters
    ----------
    tongues : tuple of Resonance
        The pairs that make the region, sorted by centre.
    left, right : float
        Edges θ̄ of the region [√(EI/(ρAL⁴))].
    """

    tongues: tuple[Resonance, ...]
    left: float
    right: float

    @property
    def name(self) -> str:
        """The pairs that make the region, such as "1B+2B, 1F+2F"."""
        return ", ".join(sorted(tongue.name for tongue in self.tongues))

    @property
    def centre(self) -> float:
        """Middle of the region; the resonance itself where a single tongue makes it."""
        return (self.left + self.right) / 2

    @property
    def width(self) -> float:
        """Distance of the edges."""
        return self.right - self.left


def first_order_regions(
    table: ResonanceTable, pulsating_load: float
) -> tuple[FirstOrderRegion, ...]:
    """Return the unstable intervals of θ̄ to first order; tongues that act together make one.

    With a_i the slowly varying amplitudes of the modes, averaged over a period of the load,
    ȧ = j[diag(ω_i − m_i θ̄) + (p̄_t/2) C] a, where whole numbers m_i differ by 1 between the modes
    of a pair and C_ij C_ji = −g_ij; harmonic k of another load makes them differ by k, with
    C_ij C_ji = −|a_k|² g_ij. The rotor is unstable where an eigenvalue of the bracket has an
    imaginary part below 0.

    Parameters
    ----------
    table : ResonanceTable
        From `resonances` at the same pulsating load.
    pulsating_load : float
        p̄_t [EI/L²], above 0.

    Returns
    -------
    tuple of FirstOrderRegion
        From left to right.

    Raises
    ------
    ValueError
        If the load is not above 0.

    Notes
    -----
    Like the table, the regions leave out the shift of the centres, O(p̄_t²).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped, resonances
    >>> table = resonances(lumped(ShaftDisk(), 0.0), 1.178, 0.1)
    >>> [region.name for region in first_order_regions(table, 0.1)]
    ['1B+1F', '1B+2F, 2B+1F', '2B+2F']
    """
    load = number("pulsating_load", pulsating_load, 0.0, open_low=True)
    regions: list[FirstOrderRegion] = []
    for group in _groups(table.tongues):
        names = [name for tongue in group for name in (tongue.first, tongue.second)]
        share_modes = len(set(names)) < len(names)
        regions += _coupled_regions(table, group, load) if share_modes else _union(group)
    return tuple(sorted(regions, key=lambda region: region.left))


def _reach(tongue: Resonance) -> tuple[float, float]:
    """Return the interval of θ̄ in which a tongue may affect another one."""
    reach = _REACH * tongue.half_width
    return tongue.centre - reach, tongue.centre + reach


def _groups(tongues: tuple[Resonance, ...]) -> list[list[Resonance]]:
    """Return the tongues in groups whose reaches overlap."""
    groups: list[list[Resonance]] = []
    end = -np.inf
    for tongue in sorted(tongues, key=_reach):
        left, right = _reach(tongue)
        if left > end:
            groups.append([])
        groups[-1].append(tongue)
        end = max(end, right)
    return groups


def _union(group: list[Resonance]) -> list[FirstOrderRegion]:
    """Return the regions of tongues that share no mode, joined where they overlap."""
    regions: list[FirstOrderRegion] = []
    for tongue in sorted(group, key=lambda tongue: tongue.centre - tongue.half_width):
        left, right = tongue.centre - tongue.half_width, tongue.centre + tongue.half_width
        if regions and left <= regions[-1].right:
            last = regions.pop()
            tongues = (*last.tongues, tongue)
            regions.append(FirstOrderRegion(tongues, last.left, max(last.right, right)))
        else:
            regions.append(FirstOrderRegion((tongue,), left, right))
    return regions


@dataclass(frozen=True)
class _Averaged:
    """The averaged equations of a group of tongues: ȧ = j[diag(ω − mθ̄) + coupling] a."""

    frequencies: Complex
    harmonics: Index
    coupling: Complex

    @classmethod
    def of(
        cls, table: ResonanceTable, window: tuple[float, float], load: float
    ) -> _Averaged | None:
        """Return the equations of all pairs with centres in a window; None if they close a ring.

        Along a ring of pairs the products g do not determine the couplings C.
        """
        low, high = window
        rows = [row for row in table if row.coupling != 0 and low <= row.centre <= high]
        pairs = [pair for row in rows for pair in _coupled_modes(row, table)]
        harmonics = _harmonics(pairs)
        if harmonics is None:
            return None
        used = sorted(harmonics)
        coupling = np.zeros((len(used), len(used)), np.complex128)
        for first, second, row in pairs:
            i, j = used.index(first), used.index(second)
            size = load / 2 * row.amplitude * np.sqrt(-row.coupling)
            coupling[i, j] = coupling[j, i] = size
        frequencies = np.asarray(table.frequencies, np.complex128)[used]
        return cls(frequencies, np.array([harmonics[index] for index in used]), coupling)

    def grows(self, theta: Array) -> Mask:
        """Tell at which frequencies an amplitude grows."""
        slow = self.frequencies - np.multiply.outer(theta, self.harmonics)
        matrices = self.coupling + slow[..., None] * np.eye(len(self.frequencies))
        smallest = FIRST_ORDER_GROWTH * float(np.abs(self.coupling).max())
        return np.asarray(np.linalg.eigvals(matrices).imag.min(axis=-1) < -smallest)


_Pair = tuple[int, int, Resonance]


def _coupled_modes(row: Resonance, table: ResonanceTable) -> list[_Pair]:
    """Return which modes a row couples, the slower first; with two planes also their mirror."""
    low, high = sorted(row.modes, key=lambda mode: table.frequencies[mode].real)
    last = len(table.frequencies) - 1
    if not table.planes or (low, high) == (last - high, last - low):
        return [(low, high, row)]
    return [(low, high, row), (last - high, last - low, row)]


def _harmonics(pairs: list[_Pair]) -> dict[int, int] | None:
    """Return m of each mode that the pairs couple; None where they close a ring."""
    harmonics: dict[int, int] = {}
    left = list(pairs)
    while left:
        # a pair that has a mode in common with those before, if there is one
        pair = next((pair for pair in left if set(pair[:2]) & set(harmonics)), left[0])
        left.remove(pair)
        low, high, row = pair
        if low in harmonics and high in harmonics:
            return None
        if high in harmonics:
            harmonics[low] = harmonics[high] - row.harmonic
        else:
            harmonics[high] = harmonics.setdefault(low, 0) + row.harmonic
    return harmonics


def _coupled_regions(
    table: ResonanceTable, group: list[Resonance], load: float
) -> list[FirstOrderRegion]:
    """Return the regions of tongues that share modes."""
    reaches = [_reach(tongue) for tongue in group]
    window = min(left for left, _ in reaches), max(right for _, right in reaches)
    averaged = _Averaged.of(table, window, load)
    if averaged is None:
        return _union(group)
    edges = _unstable_intervals(averaged, window)
    if not len(edges):
        return []
    members: list[list[Resonance]] = [[] for _ in edges]
    for tongue in sorted(group, key=lambda tongue: tongue.centre):
        away = np.maximum(edges[:, 0] - tongue.centre, tongue.centre - edges[:, 1])
        members[int(np.maximum(away, 0.0).argmin())].append(tongue)
    return [
        FirstOrderRegion(tuple(tongues), float(left), float(right))
        for tongues, (left, right) in zip(members, edges, strict=True)
        if tongues
    ]


def _unstable_intervals(averaged: _Averaged, window: tuple[float, float]) -> Array:
    """Return the edges (k, 2) of the unstable intervals in a window of θ̄."""
    theta = np.linspace(*window, _POINTS)
    unstable = averaged.grows(theta)
    if not unstable.any():
        return np.empty((0, 2))
    change = np.diff(np.concatenate([[False], unstable, [False]]).astype(np.int8))
    first, last = np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1
    apart = first[1:] - last[:-1] > _SHORTEST_GAP
    first, last = first[np.append(True, apart)], last[np.append(apart, True)]
    inside = np.concatenate([theta[first], theta[last]])
    outside = theta[np.concatenate([np.maximum(first - 1, 0), np.minimum(last + 1, _POINTS - 1)])]
    for _ in range(_BISECTIONS):
        middle = (inside + outside) / 2
        unstable = averaged.grows(middle)
        inside, outside = np.where(unstable, middle, inside), np.where(unstable, outside, middle)
    return inside.reshape(2, -1).T
