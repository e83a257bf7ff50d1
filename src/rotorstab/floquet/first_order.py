"""Unstable regions of first order: what tongues that lie close together make as one.

The resonance table takes each pair of modes alone. Where tongues share modes and lie close, as at
rest where 1B+2B and 1F+2F have one centre and 1B+1F may be near, the pairs act together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._arguments import number
from .resonance import Resonance, ResonanceTable

__all__ = ["FirstOrderRegion", "first_order_regions"]

Array = NDArray[np.float64]

_REACH = 3.0  # half-widths from its centre within which a tongue may feel another
_POINTS = 800
_GROWS = 1e-4  # of the strongest coupling: below this a double root's rounding
_BISECTIONS = 40
_GAP = 4  # points; where one pair hands over to the next growth may touch 0


@dataclass(frozen=True)
class FirstOrderRegion:
    """An interval of θ̄ that is unstable to first order in the pulsating load.

    Parameters
    ----------
    tongues : tuple of Resonance
        What it is made of, by centre.
    left, right : float
        Its edges θ̄ [√(EI/(ρAL⁴))].
    """

    tongues: tuple[Resonance, ...]
    left: float
    right: float

    @property
    def name(self) -> str:
        """The pairs that make it, such as "1B+2B, 1F+2F"."""
        return ", ".join(sorted(one.name for one in self.tongues))

    @property
    def centre(self) -> float:
        """Its middle; the resonance itself where one tongue makes it."""
        return (self.left + self.right) / 2

    @property
    def width(self) -> float:
        """From edge to edge."""
        return self.right - self.left


def first_order_regions(
    table: ResonanceTable, pulsating_load: float
) -> tuple[FirstOrderRegion, ...]:
    """Return the unstable intervals of θ̄ to first order, tongues that act together as one.

    With a_i the slowly varying amplitudes of the modes, averaged over a period of the load,
    ȧ = j[diag(ω_i − m_i θ̄) + (p̄_t/2) C] a, where whole numbers m_i differ by 1 between the modes
    of a pair and C_ij C_ji = −g_ij. Unstable where an eigenvalue has an imaginary part below 0.

    Parameters
    ----------
    table : ResonanceTable
        Made at the same pulsating load.
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
    As the table, of first order: centres shift by O(p̄_t²).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped, resonances
    >>> table = resonances(lumped(ShaftDisk(), 0.0), 1.178, 0.1)
    >>> [one.name for one in first_order_regions(table, 0.1)]
    ['1B+1F', '1B+2F, 2B+1F', '2B+2F']
    """
    load = number("pulsating_load", pulsating_load, 0.0, open_low=True)
    regions: list[FirstOrderRegion] = []
    for group in _groups(table.tongues):
        names = [name for one in group for name in (one.first, one.second)]
        if len(group) == 1 or len(set(names)) == len(names):
            regions += _union(group)
        else:
            regions += _together(table, group, load)
    return tuple(sorted(regions, key=lambda one: one.left))


def _groups(tongues: tuple[Resonance, ...]) -> list[list[Resonance]]:
    """Return the tongues in groups whose reaches overlap."""
    groups: list[list[Resonance]] = []
    end = -np.inf
    for one in sorted(tongues, key=lambda one: one.centre - _REACH * one.half_width):
        if one.centre - _REACH * one.half_width > end:
            groups.append([])
        groups[-1].append(one)
        end = max(end, one.centre + _REACH * one.half_width)
    return groups


def _union(group: list[Resonance]) -> list[FirstOrderRegion]:
    """Return tongues that share no mode, joined where they overlap."""
    out: list[FirstOrderRegion] = []
    for one in sorted(group, key=lambda one: one.centre - one.half_width):
        left, right = one.centre - one.half_width, one.centre + one.half_width
        if out and left <= out[-1].right:
            last = out.pop()
            out.append(FirstOrderRegion((*last.tongues, one), last.left, max(last.right, right)))
        else:
            out.append(FirstOrderRegion((one,), left, right))
    return out


def _together(table: ResonanceTable, group: list[Resonance], load: float) -> list[FirstOrderRegion]:
    """Return the unstable intervals of tongues that share modes."""
    low = min(one.centre - _REACH * one.half_width for one in group)
    high = max(one.centre + _REACH * one.half_width for one in group)
    place = {name: index for index, name in enumerate(table.modes)}
    pairs = [row for row in table if row.coupling != 0 and low <= row.centre <= high]
    levels = _levels(pairs, table, place)
    if levels is None:
        return _union(group)
    used = sorted(levels)
    frequencies = np.asarray(table.frequencies, np.complex128)[used]
    turns = np.array([levels[index] for index in used])
    coupling = np.zeros((len(used), len(used)), np.complex128)
    for row in pairs:
        i, j = used.index(place[row.first]), used.index(place[row.second])
        coupling[i, j] = coupling[j, i] = load / 2 * np.sqrt(-row.coupling)
    smallest = _GROWS * float(np.abs(coupling).max())

    def grows(theta: Array) -> NDArray[np.bool_]:
        slow = frequencies - np.multiply.outer(theta, turns)
        matrices = coupling + slow[..., None] * np.eye(len(used))
        return np.asarray(np.linalg.eigvals(matrices).imag.min(axis=-1) < -smallest)

    theta = np.linspace(low, high, _POINTS)
    unstable = grows(theta)
    if not unstable.any():
        return []
    change = np.diff(np.concatenate([[False], unstable, [False]]).astype(np.int8))
    first, last = np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1
    apart = first[1:] - last[:-1] > _GAP
    first, last = first[np.append(True, apart)], last[np.append(apart, True)]
    inside = np.concatenate([theta[first], theta[last]])
    outside = theta[np.concatenate([np.maximum(first - 1, 0), np.minimum(last + 1, _POINTS - 1)])]
    for _ in range(_BISECTIONS):
        middle = (inside + outside) / 2
        unstable = grows(middle)
        inside, outside = np.where(unstable, middle, inside), np.where(unstable, outside, middle)
    edges = inside.reshape(2, -1).T
    members: list[list[Resonance]] = [[] for _ in edges]
    for one in sorted(group, key=lambda one: one.centre):
        away = np.maximum(np.maximum(edges[:, 0] - one.centre, one.centre - edges[:, 1]), 0.0)
        members[int(away.argmin())].append(one)
    return [
        FirstOrderRegion(tuple(ones), float(left), float(right))
        for ones, (left, right) in zip(members, edges, strict=True)
        if ones
    ]


def _levels(
    pairs: list[Resonance], table: ResonanceTable, place: dict[str, int]
) -> dict[int, int] | None:
    """Return m of each mode that the pairs couple; None where they close a ring.

    Along a ring the products g do not tell the couplings.
    """
    levels: dict[int, int] = {}
    left = list(pairs)
    while left:
        row = next(
            (one for one in left if {place[one.first], place[one.second]} & set(levels)), left[0]
        )
        left.remove(row)
        low, high = sorted(
            (place[row.first], place[row.second]), key=lambda i: table.frequencies[i].real
        )
        if low in levels and high in levels:
            return None
        if high in levels:
            levels[low] = levels[high] - 1
        else:
            levels[high] = levels.setdefault(low, 0) + 1
    return levels
