"""Outlines of everything that Floquet finds unstable in a window, fast enough to draw live.

`tongues.tongue_edges` follows named tongues, one point at a time. Here every unstable interval
of every row of loads is found by `intervals` and linked from row to row: combination
resonances, all orders, tongues that merge, and ground that no tongue explains.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..._arguments import number, whole_number
from ...model.stiffness import largest_exact_load
from ...model.system import System
from ..point import growth_rate
from ..resonance import ResonanceTable, resonances
from .collisions import SMALLEST_GROWTH
from .intervals import Interval, unstable_intervals

__all__ = ["Outline", "unstable_outlines"]

Array = NDArray[np.float64]

_ORDERS = 9  # highest θ̄ = |ω_i − ω_j|/k that is named
_NEAR_POLE = 0.9  # of the way to the pole of the exact stiffness: rows end there
_DRIFT = 0.012  # of θ̄: farthest unexplained move of a narrow tongue in a row


@dataclass(frozen=True, eq=False)
class Outline:
    """A connected piece of the unstable set that has one interval in every row.

    Parameters
    ----------
    name : str
        The mode pair whose resonance its lowest row lies nearest to, such as "1B+1F".
    order : int
        k of that resonance θ̄ = |ω_i − ω_j|/k; 0 where there is none, and where the rotor grows
        without pulsation.
    pulsating_loads : (m,) float
        p̄_t [EI/L²], rising.
    left, right : (m,) float
        Edges θ̄ [√(EI/(ρAL⁴))].
    window : (float, float)
        Lowest and highest θ̄ that were searched; a piece that goes on beyond is cut there.
    """

    name: str
    order: int
    pulsating_loads: Array
    left: Array
    right: Array
    window: tuple[float, float]

    @property
    def borders(self) -> NDArray[np.bool_]:
        """Where left and right, (2, m), are the window's and not an edge."""
        ends = np.array([self.left, self.right])
        at: NDArray[np.bool_] = np.isclose(ends, np.array([self.window]).T, rtol=1e-9, atol=0.0)
        return at

    @property
    def area(self) -> float:
        """Its area in the plane of θ̄ and p̄_t."""
        return float(np.trapezoid(self.right - self.left, self.pulsating_loads))


@dataclass
class _Chain:
    """An outline that grows row by row."""

    loads: list[float] = field(default_factory=list)
    ends: list[Interval] = field(default_factory=list)

    def add(self, load: float, end: Interval) -> None:
        self.loads.append(load)
        self.ends.append(end)

    def predicted(self, load: float) -> Interval:
        """Return where the next row's interval should be: centres are even in the load."""
        last = self.ends[-1]
        if len(self.ends) < 2 or self.loads[-1] == self.loads[-2]:
            return last
        before = self.ends[-2]
        run = (load**2 - self.loads[-1] ** 2) / (self.loads[-1] ** 2 - self.loads[-2] ** 2)
        shift = run * (last.centre - before.centre)
        return Interval(last.left + shift, last.right + shift)


def unstable_outlines(
    system: System,
    static_load: float,
    largest_load: float,
    lowest_frequency: float,
    highest_frequency: float,
    rows: int = 61,
) -> tuple[Outline, ...]:
    """Return the outlines of the unstable set for p̄_t up to a largest value.

    Parameters
    ----------
    system : System
        Two coordinates, one spin speed; damped or not, any stiffness law.
    static_load, largest_load : float
        p̄₀ and the top of p̄_t [EI/L²]; the second above 0.
    lowest_frequency, highest_frequency : float
        Window of θ̄ [√(EI/(ρAL⁴))], above 0.
    rows : int
        Even loads from 0, 8 or more.

    Returns
    -------
    tuple of Outline
        By their lowest row, then from left to right. Where tongues merge an outline ends and
        another begins, along a common line.

    Raises
    ------
    ValueError
        If an argument is out of range or the system is larger.

    Notes
    -----
    At the loads of the rows, edges are roots of the collision measure of two multipliers, with
    damping of the growth rate, to 1e-6 of θ̄; between rows they are straight lines. Past the
    pole of the exact stiffness there are no rows. Tongues come from the columns of a chart and,
    where they are narrower, from `passing.passes`, which follows every pair of multipliers, so
    none that grows faster than 1e-4 is missed from θ̄ = 0.4 ω_n on (`python -m benchmarks
    tongues` counts this over random rotors). Slower ones may be left out. A gap between two
    tongues is closed where it is narrower than 0.35 % of θ̄ (0.7 % in the lowest octaves).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> pieces = unstable_outlines(lumped(ShaftDisk(), 2.0), 1.178, 0.5, 0.6, 1.5, rows=11)
    >>> pieces[0].name, pieces[0].order
    ('1B+1F', 1)
    """
    if system.size != 2 or system.spin_speed.ndim:
        raise ValueError("`system` must be of two coordinates and one spin speed")
    static = number("static_load", static_load)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    low = number("lowest_frequency", lowest_frequency, 0.0, open_low=True)
    high = number("highest_frequency", highest_frequency, low, open_low=True)
    if system.exact_shear is not None:
        room = _NEAR_POLE * (float(largest_exact_load(system.exact_shear)) - static)
        largest = min(largest, room)
        if largest <= 0:
            return ()
    loads = np.linspace(0.0, largest, whole_number("rows", rows, 8, 100_000))
    found = unstable_intervals(system, static, loads[1:], low, high)
    step = float(loads[1])
    if found[0] and growth_rate(system, static, 0.0, high) > SMALLEST_GROWTH:
        found.insert(0, [Interval(low, high)])  # it grows without any pulsation
    else:
        loads = loads[1:]
    roots = _roots(resonances(system, static, largest))
    return tuple(
        _outline(chain, roots, step, system.is_damped, (low, high))
        for chain in _link(loads, found, step)
    )


def _roots(table: ResonanceTable) -> list[tuple[float, str, int]]:
    """Return θ̄, name and order of every resonance that a tongue may hang from."""
    return [
        (row.centre / k, row.name, k)
        for row in table
        if row.growth_per_load > 0 and row.centre > 0
        for k in range(1, _ORDERS + 1)
    ]


def _components(
    chains: list[_Chain], found: list[Interval], load: float
) -> Iterator[tuple[list[int], list[int]]]:
    """Yield groups of chains and of intervals of the next row that belong together."""
    predicted = [chain.predicted(load) for chain in chains]
    links = {
        (a, b)
        for a, one in enumerate(predicted)
        for b, other in enumerate(found)
        if one.left <= other.right and other.left <= one.right
    }
    # narrow tongues that moved by more than their width: nearest first
    lonely_a = set(range(len(chains))) - {a for a, _ in links}
    lonely_b = set(range(len(found))) - {b for _, b in links}
    distances = sorted(
        (abs(predicted[a].centre - found[b].centre), a, b) for a in lonely_a for b in lonely_b
    )
    for distance, a, b in distances:
        if a in lonely_a and b in lonely_b and distance <= _DRIFT * found[b].centre:
            links.add((a, b))
            lonely_a.remove(a)
            lonely_b.remove(b)
    left_a, left_b = set(range(len(chains))), set(range(len(found)))
    while left_a or left_b:
        ones, others = ({left_a.pop()}, set()) if left_a else (set(), {left_b.pop()})
        while True:
            more = {b for a, b in links if a in ones} - others
            back = {a for a, b in links if b in others | more} - ones
            others |= more
            if not more and not back:
                break
            ones |= back
        left_a -= ones
        left_b -= others
        yield sorted(ones), sorted(others)


def _cut(whole: Interval, parts: list[Interval]) -> list[Interval]:
    """Return an interval cut where the gaps between some parts close."""
    inner = [(a.right + b.left) / 2 for a, b in pairwise(parts)]
    cuts = [whole.left, *(min(max(x, whole.left), whole.right) for x in inner), whole.right]
    return [Interval(a, b) for a, b in pairwise(cuts)]


def _link(loads: Array, found: list[list[Interval]], step: float) -> list[_Chain]:
    """Return chains of intervals through the rows."""
    done: list[_Chain] = []
    live: list[_Chain] = []
    for load, row in zip(loads.tolist(), found, strict=True):
        after: list[_Chain] = []
        for ones, others in _components(live, row, load):
            chains, ends = [live[a] for a in ones], [row[b] for b in others]
            if len(chains) == 1 and len(ends) == 1:
                chains[0].add(load, ends[0])
                after += chains
                continue
            done += chains
            if not ends:
                for chain in chains:
                    middle = chain.predicted(load).centre
                    chain.add(load - step / 2, Interval(middle, middle))
                continue
            new = [_Chain() for _ in ends]
            if chains and len(ends) == 1:
                parts = [chain.ends[-1] for chain in chains]
                for chain, piece in zip(chains, _cut(ends[0], parts), strict=True):
                    chain.add(load, piece)
            elif len(chains) == 1:
                last = chains[0].ends[-1]
                for chain, piece in zip(new, _cut(last, ends), strict=True):
                    chain.add(chains[0].loads[-1], piece)
            elif chains:
                # several to several: through one hull half a row below
                parts = [chain.ends[-1] for chain in chains]
                hull = Interval(
                    (min(one.left for one in parts) + ends[0].left) / 2,
                    (max(one.right for one in parts) + ends[-1].right) / 2,
                )
                for chain, piece in zip(chains, _cut(hull, parts), strict=True):
                    chain.add(load - step / 2, piece)
                for chain, piece in zip(new, _cut(hull, ends), strict=True):
                    chain.add(load - step / 2, piece)
            for chain, end in zip(new, ends, strict=True):
                if not chains and load > 0:
                    chain.add(load - step / 2, Interval(end.centre, end.centre))
                chain.add(load, end)
            after += new
        live = sorted(after, key=lambda chain: chain.ends[-1].left)
    return [chain for chain in sorted(done + live, key=_place) if len(chain.loads) > 1]


def _place(chain: _Chain) -> tuple[float, float]:
    return chain.loads[0], chain.ends[0].left


def _outline(
    chain: _Chain,
    roots: list[tuple[float, str, int]],
    step: float,
    damped: bool,
    window: tuple[float, float],
) -> Outline:
    """Return a chain as an outline, with its name.

    Without damping a tongue of first order reaches p̄_t = 0.
    """
    loads = np.array(chain.loads)
    left, right = np.array(chain.ends).T.copy()
    middle = (left[0] + right[0]) / 2
    near = [(abs(np.log(root / middle)) * k, root, name, k) for root, name, k in roots]
    if not near or loads[0] == 0.0:
        return Outline("", 0, loads, left, right, window)
    _, root, name, order = min(near)
    tip = left[0] == right[0] and not damped
    if tip and order == 1 and abs(root - middle) < 0.02 * root and loads[0] < 12 * step:
        loads[0], left[0], right[0] = 0.0, root, root
    for array in (loads, left, right):
        array.flags.writeable = False
    return Outline(name, order, loads, left, right, window)
