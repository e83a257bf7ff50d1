"""Outlines of everything that Floquet finds unstable in a window, fast enough to draw live.

`tongues.tongue_edges` follows named tongues to 1e-9, one point at a time. Here every
unstable interval of every row of loads is found on the interpolated characteristic polynomial
of the chart, refined there and linked from row to row: combination resonances, all orders,
tongues that merge, and ground that no tongue explains.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .checks import number
from .resonance import ResonanceTable, resonances
from .sampler import ChartSampler
from .system import System

__all__ = ["Outline", "unstable_outlines"]

Array = NDArray[np.float64]
Runs = tuple[NDArray[np.intp], Array, Array]

_PER_OCTAVE = (220, 110)  # columns, even in T: in the upper four octaves, below
_GROWTH = 1e-8  # smallest growth rate that counts
_NEAREST = -1.0  # approach below which a pair is too far apart to meet within a column
_SHRINK = (0.3, 0.03)  # half-widths of the parabolas, in columns
_TOUCH = 1e-12
_FAR = 0.05  # of a parabola's bend over a column: error allowed its estimated top
_ROUNDS = 6  # of false position, from brackets a column wide
_ORDERS = 9  # highest θ̄ = |ω_i − ω_j|/k that is named
_DRIFT = 0.012  # of θ̄: farthest unexplained move of a narrow tongue in a row


@dataclass(frozen=True, eq=False)
class Outline:
    """A connected piece of the unstable set that has one interval in every row.

    Parameters
    ----------
    name : str
        The mode pair whose resonance its lowest row lies nearest to, such as "1B+1F".
    order : int
        k of that resonance θ̄ = |ω_i − ω_j|/k; 0 where there is none.
    pulsating_loads : (m,) float
        p̄_t [EI/L²], rising.
    left, right : (m,) float
        Edges θ̄ [√(EI/(ρAL⁴))].
    """

    name: str
    order: int
    pulsating_loads: Array
    left: Array
    right: Array

    @property
    def area(self) -> float:
        """Its area in the plane of θ̄ and p̄_t."""
        return float(np.trapezoid(self.right - self.left, self.pulsating_loads))


class _Interval(NamedTuple):
    left: float
    right: float

    @property
    def centre(self) -> float:
        return (self.left + self.right) / 2


@dataclass
class _Chain:
    """An outline that grows row by row."""

    loads: list[float] = field(default_factory=list)
    ends: list[_Interval] = field(default_factory=list)

    def add(self, load: float, end: _Interval) -> None:
        self.loads.append(load)
        self.ends.append(end)

    def predicted(self, load: float) -> _Interval:
        """Return where the next row's interval should be: centres are even in the load."""
        last = self.ends[-1]
        if len(self.ends) < 2 or self.loads[-1] == self.loads[-2]:
            return last
        before = self.ends[-2]
        run = (load**2 - self.loads[-1] ** 2) / (self.loads[-1] ** 2 - self.loads[-2] ** 2)
        shift = run * (last.centre - before.centre)
        return _Interval(last.left + shift, last.right + shift)


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
        Undamped, two coordinates, one spin speed.
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
        If an argument is out of range or the system is damped or larger.

    Notes
    -----
    Edges are roots of the collision measure of two multipliers, within 1e-4 of θ̄. Not seen:
    a tongue whose growth rate is below the chart's error, some 1e-5, such as thin cusps of high
    order at small loads, and a gap between two tongues narrower than 0.3 % of θ̄ (0.6 % in the
    lowest octaves). `tongues.tongue_edges` is exact where that matters.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> pieces = unstable_outlines(lumped(ShaftDisk(), 2.0), 1.178, 0.5, 0.6, 1.5, rows=11)
    >>> pieces[0].name, pieces[0].order
    ('1B+1F', 1)
    """
    if system.is_damped or system.size != 2 or system.spin_speed.ndim:
        raise ValueError("`system` must be undamped, of two coordinates and one spin speed")
    static = number("static_load", static_load)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    low = number("lowest_frequency", lowest_frequency, 0.0, open_low=True)
    high = number("highest_frequency", highest_frequency, low, open_low=True)
    loads = np.linspace(0.0, largest, int(number("rows", rows, 8)))
    found = _intervals(system, static, loads[1:], low, high)
    table = resonances(system, static, largest)
    roots = _roots(table)
    step = float(loads[1])
    chains = _link(loads[1:], found, step)
    return tuple(_outline(chain, roots, step) for chain in chains)


def _roots(table: ResonanceTable) -> list[tuple[float, str, int]]:
    """Return θ̄, name and order of every resonance that a tongue may hang from."""
    return [
        (row.centre / k, row.name, k)
        for row in table
        if row.growth_per_load > 0 and row.centre > 0
        for k in range(1, _ORDERS + 1)
    ]


def _columns(low: float, high: float) -> Array:
    """Return periods, rising, even within each octave."""
    shortest, longest = 2 * np.pi / high, 2 * np.pi / low
    octaves = max(1, int(np.ceil(np.log2(longest / shortest))))
    cuts = shortest * (longest / shortest) ** (np.arange(octaves + 1) / octaves)
    parts = [
        np.linspace(a, b, _PER_OCTAVE[k >= 4], endpoint=False)
        for k, (a, b) in enumerate(pairwise(cuts.tolist()))
    ]
    return np.append(np.concatenate(parts), longest)


def _intervals(
    system: System, static: float, loads: Array, low: float, high: float
) -> list[list[_Interval]]:
    """Return the unstable intervals of θ̄ of each row, from left to right."""
    periods = _columns(low, high)
    sampler = ChartSampler(system, static, float(loads[-1]), periods)
    edges: list[Runs] = []
    for index, panel in enumerate(sampler.panels):
        # up to the next panel's first column, so that they meet
        span = periods[panel.columns.start : panel.columns.stop + 1]
        error = sampler.coefficient_error(index, loads[:, None], span)
        growth, error, approach = sampler.growth(
            sampler.evaluate(index, loads, span), error, span, nearness=True
        )
        unstable = growth > np.maximum(error, _GROWTH)
        edges.append(_crossings(sampler, index, loads, span, unstable, approach))
        if panel.period_nodes and len(span) > 2:
            edges.append(_peaks(sampler, index, loads, span, unstable, approach))
    row, start, stop = (np.concatenate(parts) for parts in zip(*edges, strict=True))
    return [
        _joined(np.column_stack([2 * np.pi / stop[row == r], 2 * np.pi / start[row == r]]))
        for r in range(len(loads))
    ]


def _joined(pairs: Array) -> list[_Interval]:
    """Return sorted intervals, those that touch across the border of a panel as one."""
    out: list[_Interval] = []
    for left, right in pairs[np.argsort(pairs[:, 0])]:
        if out and left <= out[-1].right * (1 + _TOUCH):
            out[-1] = _Interval(out[-1].left, max(float(right), out[-1].right))
        else:
            out.append(_Interval(float(left), float(right)))
    return out


def _crossings(
    sampler: ChartSampler,
    panel: int,
    loads: Array,
    span: Array,
    unstable: NDArray[np.bool_],
    approach: Array,
) -> Runs:
    """Return row, first and last T of every run of unstable columns, refined."""
    border = np.zeros((len(loads), 1), dtype=bool)
    change = np.diff(np.hstack([border, unstable | (approach > 0), border]).astype(np.int8), axis=1)
    row, first = np.nonzero(change == 1)
    last = np.nonzero(change == -1)[1] - 1
    # rounding alone may lift the approach above 0
    total = np.hstack([np.zeros((len(loads), 1), dtype=int), unstable.cumsum(axis=1)])
    sure = total[row, last + 1] > total[row, first]
    row, first, last = row[sure], first[sure], last[sure]
    ends = []
    for inside, step in ((first, -1), (last, 1)):
        outside = inside + step
        within = (outside >= 0) & (outside < len(span))
        clipped = np.clip(outside, 0, len(span) - 1)
        end = np.where(within, (span[inside] + span[clipped]) / 2, span[inside])
        if sampler.panels[panel].period_nodes:
            part = np.flatnonzero(within)
            root = _root(sampler, panel, loads[row[part]], span[inside[part]], span[clipped[part]])
            end[part] = np.where(np.isfinite(root), root, end[part])
        ends.append(end)
    return row, ends[0], ends[1]


def _root(sampler: ChartSampler, panel: int, load: Array, inside: Array, outside: Array) -> Array:
    """Return T between points inside and outside at which the approach is 0: Illinois' rule."""

    def value(period: Array) -> Array:
        growth, error, approach = sampler.at_points(panel, load, period, nearness=True)
        # where two pairs grow at once the approach may tell nothing
        grows = (approach <= 0) & (growth > np.maximum(error, _GROWTH))
        return np.where(grows, growth, approach)

    if not load.size:
        return np.empty(0)
    a, b = inside.copy(), outside.copy()
    fa, fb = value(a), value(b)
    good = (fa > 0) & (fb <= 0)
    for _ in range(_ROUNDS):
        with np.errstate(divide="ignore", invalid="ignore"):
            x = (a * fb - b * fa) / (fb - fa)
        x = np.where((x - a) * (x - b) <= 0, x, (a + b) / 2)
        f = value(x)
        positive = f > 0
        a, fa, b, fb = (
            np.where(positive, x, a),
            np.where(positive, f, fa / 2),
            np.where(positive, b, x),
            np.where(positive, fb / 2, f),
        )
    return np.where(good, x, np.nan)


def _peaks(
    sampler: ChartSampler,
    panel: int,
    loads: Array,
    span: Array,
    unstable: NDArray[np.bool_],
    approach: Array,
) -> Runs:
    """Return row, first and last T of tongues that pass between two columns."""
    middle = approach[:, 1:-1]
    candidate = (middle < 0) & (middle >= approach[:, :-2]) & (middle > approach[:, 2:])
    candidate &= (middle > _NEAREST) & ~(unstable[:, :-2] | unstable[:, 1:-1] | unstable[:, 2:])
    # the parabola through three columns tells where there is nothing near 0
    bend = approach[:, :-2] - 2 * middle + approach[:, 2:]
    slope = (approach[:, 2:] - approach[:, :-2]) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        candidate &= middle - slope**2 / (2 * bend) > _FAR * bend
    row, column = np.nonzero(candidate)
    column += 1
    load, before, after = loads[row], span[column - 1], span[column + 1]
    centre, spacing = span[column].copy(), (after - before) / 2
    for shrink in _SHRINK:
        reach = shrink * spacing
        points = np.clip(centre + reach * np.array([[-1.0], [0.0], [1.0]]), span[0], span[-1])
        height = sampler.at_points(panel, np.tile(load, 3), points.ravel(), nearness=True)[2]
        low, mid, high = height.reshape(3, -1)
        bend = low - 2 * mid + high
        with np.errstate(divide="ignore", invalid="ignore"):
            shift = np.where(bend < 0, (low - high) / (2 * bend), np.sign(high - low))
        centre = np.clip(centre + reach * np.clip(shift, -2, 2), before, after)
    growth, error, _ = sampler.at_points(panel, load, centre)
    keep = growth > np.maximum(error, _GROWTH)
    row = row[keep]
    load, centre, before, after = (one[keep] for one in (load, centre, before, after))
    start = _root(sampler, panel, load, centre, before)
    stop = _root(sampler, panel, load, centre, after)
    good = np.isfinite(start) & np.isfinite(stop)
    return row[good], start[good], stop[good]


def _components(
    chains: list[_Chain], found: list[_Interval], load: float
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


def _cut(whole: _Interval, parts: list[_Interval]) -> list[_Interval]:
    """Return an interval cut where the gaps between some parts close."""
    inner = [(a.right + b.left) / 2 for a, b in pairwise(parts)]
    cuts = [whole.left, *(min(max(x, whole.left), whole.right) for x in inner), whole.right]
    return [_Interval(a, b) for a, b in pairwise(cuts)]


def _link(loads: Array, found: list[list[_Interval]], step: float) -> list[_Chain]:
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
                    chain.add(load - step / 2, _Interval(middle, middle))
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
                hull = _Interval(
                    (min(one.left for one in parts) + ends[0].left) / 2,
                    (max(one.right for one in parts) + ends[-1].right) / 2,
                )
                for chain, piece in zip(chains, _cut(hull, parts), strict=True):
                    chain.add(load - step / 2, piece)
                for chain, piece in zip(new, _cut(hull, ends), strict=True):
                    chain.add(load - step / 2, piece)
            for chain, end in zip(new, ends, strict=True):
                if not chains:
                    chain.add(load - step / 2, _Interval(end.centre, end.centre))
                chain.add(load, end)
            after += new
        live = sorted(after, key=lambda chain: chain.ends[-1].left)
    return [chain for chain in sorted(done + live, key=_place) if len(chain.loads) > 1]


def _place(chain: _Chain) -> tuple[float, float]:
    return chain.loads[0], chain.ends[0].left


def _outline(chain: _Chain, roots: list[tuple[float, str, int]], step: float) -> Outline:
    """Return a chain as an outline, with its name; a tongue of first order reaches p̄_t = 0."""
    loads = np.array(chain.loads)
    left, right = np.array(chain.ends).T.copy()
    middle = (left[0] + right[0]) / 2
    near = [(abs(np.log(root / middle)) * k, root, name, k) for root, name, k in roots]
    if not near:
        return Outline("", 0, loads, left, right)
    _, root, name, order = min(near)
    tip = left[0] == right[0]
    if tip and order == 1 and abs(root - middle) < 0.02 * root and loads[0] < 12 * step:
        loads[0], left[0], right[0] = 0.0, root, root
    for array in (loads, left, right):
        array.flags.writeable = False
    return Outline(name, order, loads, left, right)
