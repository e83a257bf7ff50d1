"""Intervals of successive rows linked into pieces: tips, moves, merging and splitting."""

import numpy as np

from rotorstab.floquet.tongues.intervals import Interval
from rotorstab.floquet.tongues.linking import linked_pieces


def linked(*rows):
    """Pieces of rows at the loads 1, 2, 3 …, as lists of (load, left, right)."""
    intervals = [[Interval(*pair) for pair in row] for row in rows]
    pieces = linked_pieces(np.arange(1.0, len(rows) + 1), intervals, 1.0)
    return [
        [(load, *interval) for load, interval in zip(piece.loads, piece.intervals, strict=True)]
        for piece in pieces
    ]


def test_a_piece_begins_and_ends_in_a_point_half_a_row_away():
    (piece,) = linked([], [(2.0, 3.0)], [(2.0, 4.0)], [])
    assert piece == [(1.5, 2.5, 2.5), (2.0, 2.0, 3.0), (3.0, 2.0, 4.0), (3.5, *piece[-1][1:])]
    assert piece[-1][1] == piece[-1][2]


def test_a_narrow_tongue_that_moves_by_more_than_its_width_stays_one_piece():
    assert len(linked([(1.0, 1.001)], [(1.008, 1.009)], [(1.018, 1.019)])) == 1
    assert len(linked([(1.0, 1.001)], [(1.5, 1.501)])) == 2


def test_pieces_that_merge_end_along_the_interval_that_they_become():
    left, right, both = linked([(1.0, 2.0), (3.0, 4.0)], [(0.8, 4.2)], [(0.8, 4.3)])
    assert left[-1] == (2.0, 0.8, 2.5)
    assert right[-1] == (2.0, 2.5, 4.2)
    assert both == [(2.0, 0.8, 4.2), (3.0, 0.8, 4.3)]


def test_a_piece_that_splits_ends_where_the_new_ones_begin():
    whole, left, right = linked([(1.0, 4.0)], [(1.0, 4.0)], [(1.0, 2.0), (3.0, 4.0)])
    assert whole[-1] == (2.0, 1.0, 4.0)
    assert left[0] == (2.0, 1.0, 2.5)
    assert right[0] == (2.0, 2.5, 4.0)


def test_several_become_several_through_one_interval_between_the_rows():
    pieces = linked([(1.0, 2.0), (2.5, 4.0)], [(1.0, 3.0), (3.5, 4.0)])
    assert len(pieces) == 4
    ends = [piece[-1] for piece in pieces[:2]]
    starts = [piece[0] for piece in pieces[2:]]
    assert ends[0][0] == starts[0][0] == 1.5
    for one, other in (ends, starts):
        assert one[1] == 1.0
        assert one[2] == other[1]
        assert other[2] == 4.0
