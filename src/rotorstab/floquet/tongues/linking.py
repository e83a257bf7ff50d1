"""Linking the unstable intervals of successive rows of loads into connected pieces.

A piece has one interval in every row. Where pieces merge or split, the old ones end and new ones
begin along a common line.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise

from ..._types import Array
from .intervals import Interval

__all__ = ["FARTHEST_MOVE", "Piece", "linked_pieces"]

FARTHEST_MOVE = 0.012
"""Part of θ̄ by which a narrow tongue may move from one row to the next without overlap."""


@dataclass
class Piece:
    """A connected piece of the unstable set, which grows row by row.

    Parameters
    ----------
    loads : list of float
        p̄_t of its rows, rising.
    intervals : list of Interval
        Its interval in each row.
    """

    loads: list[float] = field(default_factory=list)
    intervals: list[Interval] = field(default_factory=list)

    def add(self, load: float, interval: Interval) -> None:
        """Add a row."""
        self.loads.append(load)
        self.intervals.append(interval)

    def predicted(self, load: float) -> Interval:
        """Return where the interval at the next load should be: centres depend on p̄_t²."""
        last = self.intervals[-1]
        if len(self.intervals) < 2 or self.loads[-1] == self.loads[-2]:
            return last
        before = self.intervals[-2]
        run = (load**2 - self.loads[-1] ** 2) / (self.loads[-1] ** 2 - self.loads[-2] ** 2)
        shift = run * (last.centre - before.centre)
        return Interval(last.left + shift, last.right + shift)


def linked_pieces(loads: Array, rows: list[list[Interval]], step: float) -> list[Piece]:
    """Return the pieces of two rows or more, sorted by their lowest row, then from left to right.

    Parameters
    ----------
    loads : (R,) float
        p̄_t of the rows, rising.
    rows : list of list of Interval
        Unstable intervals of each row, from left to right.
    step : float
        Distance of the loads. Pieces begin and end half a step before the row that shows it.
    """
    ended: list[Piece] = []
    live: list[Piece] = []
    for load, row in zip(loads.tolist(), rows, strict=True):
        after: list[Piece] = []
        for pieces, intervals in _groups(live, row, load):
            if len(pieces) == 1 and len(intervals) == 1:
                pieces[0].add(load, intervals[0])
                after += pieces
            else:
                ended += pieces
                after += _branched(pieces, intervals, load, load - step / 2)
        live = sorted(after, key=lambda piece: piece.intervals[-1].left)
    found = sorted(ended + live, key=lambda piece: (piece.loads[0], piece.intervals[0].left))
    return [piece for piece in found if len(piece.loads) > 1]


def _groups(
    pieces: list[Piece], row: list[Interval], load: float
) -> Iterator[tuple[list[Piece], list[Interval]]]:
    """Yield groups of pieces and of intervals of the next row that belong together."""
    predicted = [piece.predicted(load) for piece in pieces]
    links = [
        (a, b)
        for a, expected in enumerate(predicted)
        for b, interval in enumerate(row)
        if expected.left <= interval.right and interval.left <= expected.right
    ]
    links += _nearest_links(predicted, row, links)
    # each piece and each interval has the number of its group
    of_piece = list(range(len(pieces)))
    of_interval = [len(pieces) + b for b in range(len(row))]
    for a, b in links:
        old, new = of_interval[b], of_piece[a]
        of_piece = [new if group == old else group for group in of_piece]
        of_interval = [new if group == old else group for group in of_interval]
    for group in dict.fromkeys([*of_piece, *of_interval]):
        yield (
            [piece for piece, its in zip(pieces, of_piece, strict=True) if its == group],
            [interval for interval, its in zip(row, of_interval, strict=True) if its == group],
        )


def _nearest_links(
    predicted: list[Interval], row: list[Interval], links: list[tuple[int, int]]
) -> list[tuple[int, int]]:
    """Return links of narrow tongues that moved by more than their width, nearest first."""
    free_a = set(range(len(predicted))) - {a for a, _ in links}
    free_b = set(range(len(row))) - {b for _, b in links}
    found = []
    for distance, a, b in sorted(
        (abs(predicted[a].centre - row[b].centre), a, b) for a in free_a for b in free_b
    ):
        if a in free_a and b in free_b and distance <= FARTHEST_MOVE * row[b].centre:
            found.append((a, b))
            free_a.remove(a)
            free_b.remove(b)
    return found


def _branched(
    pieces: list[Piece], intervals: list[Interval], load: float, below: float
) -> list[Piece]:
    """End some pieces and return the new ones that begin in a row.

    `below` is the load half a row before `load`.
    """
    if not intervals:
        _add_rows(pieces, below, [_point(piece.predicted(load).centre) for piece in pieces])
        return []
    new = [Piece() for _ in intervals]
    last = [piece.intervals[-1] for piece in pieces]
    if not pieces:
        if load > 0:
            _add_rows(new, below, [_point(interval.centre) for interval in intervals])
    elif len(intervals) == 1:
        # pieces merge: their last row is the new interval
        _add_rows(pieces, load, _cut(intervals[0], last))
    elif len(pieces) == 1:
        # a piece splits: the first row of the new ones is its last interval
        _add_rows(new, pieces[0].loads[-1], _cut(last[0], intervals))
    else:
        # several become several: through one interval half a row below
        hull = Interval(
            (min(interval.left for interval in last) + intervals[0].left) / 2,
            (max(interval.right for interval in last) + intervals[-1].right) / 2,
        )
        _add_rows(pieces, below, _cut(hull, last))
        _add_rows(new, below, _cut(hull, intervals))
    _add_rows(new, load, intervals)
    return new


def _add_rows(pieces: list[Piece], load: float, intervals: Iterable[Interval]) -> None:
    """Add one row to each of some pieces."""
    for piece, interval in zip(pieces, intervals, strict=True):
        piece.add(load, interval)


def _point(place: float) -> Interval:
    """Return an interval of no width, the tip of a tongue."""
    return Interval(place, place)


def _cut(whole: Interval, parts: list[Interval]) -> list[Interval]:
    """Return an interval cut in the middle of the gaps between some parts."""
    inner = [(a.right + b.left) / 2 for a, b in pairwise(parts)]
    cuts = [whole.left, *(min(max(x, whole.left), whole.right) for x in inner), whole.right]
    return [Interval(a, b) for a, b in pairwise(cuts)]
