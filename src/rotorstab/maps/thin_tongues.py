"""Tongues that are narrower than the distance of a grid's columns, as lines along their centres."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .._types import Array, Mask
from ..floquet.criterion import is_unstable_on_chart
from ..floquet.interpolant.chart_interpolant import ChartInterpolant
from ..floquet.resonance import resonances
from ..floquet.resonance_table import Resonance
from ..floquet.tongues.collision_measure import collision_measure
from ..floquet.tongues.collisions import multiplier_collisions
from ..floquet.tongues.intervals import Interval
from ..floquet.tongues.linking import FARTHEST_MOVE, Piece, linked_pieces
from ..floquet.tongues.tracking import tongue_centres

__all__ = ["ThinTongue", "thin_tongues"]

_LEAST_ROWS = 12  # loads at which tongues are sought
_NARROW = 1.5  # columns: the columns see a narrower tongue in some rows only
_ROOT_MOVE = 0.02  # of the root: farthest foot of a line that is drawn on to it
_ROOT_ROWS = 3  # highest row from which it is


@dataclass(frozen=True, eq=False)
class ThinTongue:
    """The part of a tongue that is narrower than the distance of two columns.

    Parameters
    ----------
    name : str
        The mode pair of the nearest resonance, such as "1B+1F"; "" if there is none.
    order : int
        k of that resonance θ̄ = |ω_i − ω_j|/k; 0 where `name` is "".
    pulsating_loads : (m,) float
        p̄_t [EI/L²], rising.
    excitation_frequencies : (m,) float
        θ̄ of its centre [√(EI/(ρAL⁴))]; NaN where columns see the tongue.
    """

    name: str
    order: int
    pulsating_loads: Array
    excitation_frequencies: Array


def thin_tongues(
    interpolant: ChartInterpolant,
    function: Array,
    loads: Array,
    frequencies: Array,
    follow: bool,
) -> tuple[ThinTongue, ...]:
    """Return the tongues that a grid does not see.

    Parameters
    ----------
    interpolant : ChartInterpolant
        With panels that have nodes in T, if it has a closed form.
    function : (R, C) float
        The edge function of the grid: above 0 where a point is unstable.
    loads, frequencies : (R,), (C,) float
        p̄_t and θ̄ of the grid, rising.
    follow : bool
        Whether to follow the tongues of more than two coordinates point by point, which takes
        long; else their lines are those of first order, at one θ̄.

    Notes
    -----
    With two coordinates tongues of every order are found where two multipliers meet.
    """
    if len(frequencies) < 2 or loads[-1] <= 0:
        return ()
    largest = float(loads[-1])
    table = resonances(interpolant.system, interpolant.static_load, largest)
    if table.mean_is_unstable:
        return ()
    rows = tuple(row for row in table.tongues if frequencies[0] < row.centre < frequencies[-1])
    if not interpolant.closed_form:
        return _of_table(interpolant, rows, loads, frequencies, follow)
    stride = max(1, len(loads) // _LEAST_ROWS)
    some = np.flatnonzero(loads > 0)[::stride]
    pieces = linked_pieces(loads[some], _meetings(interpolant, loads[some]), float(loads[some[0]]))
    # tongues of whirls that the interpolant leaves out
    slowest = np.argsort(np.abs(table.frequencies.real), kind="stable")
    kept = {table.modes[index] for index in slowest[: len(interpolant.sampler.whirls)]}
    left_out = tuple(row for row in rows if not {row.first, row.second} <= kept)
    rows = tuple(row for row in rows if row not in left_out)
    found = list(_of_table(interpolant, left_out, loads, frequencies, follow))
    for piece in pieces:
        level, centre, hidden, lost = _seen(piece, interpolant, function, loads, frequencies)
        level, centre, hidden, lost = _rooted(level, centre, hidden, lost, rows, loads[some])
        if not hidden.any():
            continue
        nearest = table.nearest(float(centre[0]))
        # one more row on each side joins the line to what the columns see
        near = hidden.copy()
        near[1:] |= hidden[:-1]
        near[:-1] |= hidden[1:]
        near &= ~lost
        name, order = (nearest[0].name, nearest[1]) if nearest else ("", 0)
        found.append(ThinTongue(name, order, *_in_parts(level, np.where(near, centre, np.nan))))
    return tuple(found)


def _seen(
    piece: Piece, interpolant: ChartInterpolant, function: Array, loads: Array, frequencies: Array
) -> tuple[Array, Array, Mask, Mask]:
    """Return loads and centres of a piece, where columns do not see it, and where a wide one does.

    A narrow piece in the midst of a wide tongue, where other multipliers meet, is no tongue.
    """
    level = np.array(piece.loads)
    centre = np.array([interval.centre for interval in piece.intervals])
    width = np.array([interval.right - interval.left for interval in piece.intervals])
    narrow = width < _NARROW * float(np.diff(frequencies).max())
    beside = _unstable_columns(level, centre, function, loads, frequencies)
    # with damping what is unstable is wide, and the tongue of a pair is no part that stands out
    far = beside[[0, 3]]
    midst = far.any(axis=0) if interpolant.system.is_damped else far.all(axis=0)
    hidden = _of_rows(~beside[1:3].any(axis=0) | (narrow & ~midst), np.isin(level, loads))
    return level, centre, hidden, ~hidden & narrow & midst


def _meetings(interpolant: ChartInterpolant, loads: Array) -> list[list[Interval]]:
    """Return the narrow unstable intervals of θ̄ of each row, from left to right."""
    rows: list[list[Interval]] = [[] for _ in loads]
    for index, panel in enumerate(interpolant.panels):
        if not (panel.period_nodes and panel.high > panel.low):
            continue  # there are more tongues than columns
        row, period, half = multiplier_collisions(interpolant, index, loads)
        growth, error, _ = interpolant.at_points(index, loads[row], period, with_approach=True)
        # a line, which has no width, needs growth beyond the error also with damping
        sure = is_unstable_on_chart(growth, error, damped=False)
        for r, T, h in zip(row[sure], period[sure], half[sure], strict=True):
            rows[r].append(Interval(float(2 * np.pi / (T + h)), float(2 * np.pi / max(T - h, h))))
    return [list(_apart(sorted(row))) for row in rows]


def _apart(row: list[Interval]) -> Iterator[Interval]:
    """Yield the intervals of a row without those that overlap the one before."""
    end = 0.0
    for interval in row:
        if interval.left > end:
            yield interval
            end = interval.right


def _of_rows(hidden: Mask, is_row: Mask) -> Mask:
    """Return a mask whose values at the ends, between two rows of the grid, are those beside."""
    found = hidden.copy()
    if len(found) > 1:
        found[0] = hidden[0 if is_row[0] else 1]
        found[-1] = hidden[-1 if is_row[-1] else -2]
    return found


def _in_parts(level: Array, centre: Array) -> tuple[Array, Array]:
    """Return a line with a gap at each step to another tongue, and its loads."""
    jumps = np.flatnonzero(np.abs(np.diff(centre)) > FARTHEST_MOVE * centre[1:]) + 1
    return np.insert(level, jumps, level[jumps]), np.insert(centre, jumps, np.nan)


def _rooted(
    level: Array,
    centre: Array,
    hidden: Mask,
    lost: Mask,
    rows: tuple[Resonance, ...],
    loads: Array,
) -> tuple[Array, Array, Mask, Mask]:
    """Return a line drawn on to the root of a tongue of first order, if it begins near one."""
    if rows and level[0] <= loads[min(_ROOT_ROWS, len(loads) - 1)]:
        row = min(rows, key=lambda row: abs(row.centre - centre[0]))
        if abs(row.centre - centre[0]) <= _ROOT_MOVE * row.centre and row.threshold < level[0]:
            level, centre = np.append(row.threshold, level), np.append(row.centre, centre)
            hidden, lost = np.append(True, hidden), np.append(False, lost)
    return level, centre, hidden, lost


def _unstable_columns(
    level: Array, centre: Array, function: Array, loads: Array, frequencies: Array
) -> Mask:
    """Return whether four columns about each point of a line are unstable, (4, m).

    The second and the third are those beside it, the others two columns farther off.
    """
    row = np.abs(loads - level[:, None]).argmin(axis=1)
    after = np.searchsorted(frequencies, centre)
    column = (after + np.array([-3, -1, 0, 2])[:, None]).clip(0, len(frequencies) - 1)
    return np.asarray(function[row, column] > 0)


def _of_table(
    interpolant: ChartInterpolant,
    rows: tuple[Resonance, ...],
    loads: Array,
    frequencies: Array,
    follow: bool,
) -> tuple[ThinTongue, ...]:
    """Return lines along the tongues of the resonance table, up to where they are a column wide."""
    step = float(np.diff(frequencies).max())
    found = []
    for row in rows:
        wide = step / (4 * row.growth_per_load)
        level = np.unique([row.threshold, *loads[(loads > row.threshold) & (loads < wide)], wide])
        level = level[level <= loads[-1]]
        if level.size < 2:
            continue
        centre = np.full(level.shape, row.centre)
        if follow:
            centre[1:] = _followed(interpolant, row, level[1:])
        found.append(ThinTongue(row.name, 1, level, centre))
    return tuple(found)


def _followed(interpolant: ChartInterpolant, row: Resonance, level: Array) -> Array:
    """Return the centre of a tongue at some loads; that of first order where it is lost."""
    system, static = interpolant.system, interpolant.static_load
    centre = tongue_centres(
        lambda load, theta: collision_measure(system, static, load, theta)[0], level, (row,)
    )[0]
    return np.where(np.isfinite(centre), centre, row.centre)
