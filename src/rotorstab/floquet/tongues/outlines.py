"""Outlines of everything that Floquet's theory finds unstable in a window, at the pace of a drag.

`edges.tongue_edges` follows named tongues point by point. Here `intervals` finds every unstable
interval of every row of loads and `linking` links them from row to row: combination resonances of
all orders, tongues that merge, and unstable ground that belongs to no tongue.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..._arguments import number, whole_number
from ..._tolerances import CURVES_SHORT_OF_POLE, SAME_FREQUENCY
from ..._types import Array, Mask
from ...model.system import System
from ...whirl.frequencies import whirl_frequencies
from ..criterion import mean_is_unstable
from ..resonance import resonances
from ..resonance_table import ResonanceTable
from .intervals import Interval, unstable_intervals
from .linking import Piece, linked_pieces

__all__ = ["Outline", "unstable_outlines"]

_TIP_MOVE = 0.02  # of the root: farthest tip that is drawn on to its root at p̄_t = 0
_TIP_ROWS = 12  # highest row from which it is


@dataclass(frozen=True, eq=False)
class Outline:
    """A connected piece of the unstable set that has one interval of θ̄ at every load.

    Parameters
    ----------
    name : str
        The mode pair whose resonance is nearest to the lowest row, such as "1B+1F"; "" where there
        is none, and where the rotor grows without pulsation.
    order : int
        k of that resonance θ̄ = |ω_i − ω_j|/k; 0 where `name` is "".
    pulsating_loads : (m,) float
        p̄_t [EI/L²] in rising order.
    left, right : (m,) float
        Edges θ̄ at these loads [√(EI/(ρAL⁴))].
    window : (float, float)
        Lowest and highest θ̄ that were searched; a piece that extends farther is cut there.
    """

    name: str
    order: int
    pulsating_loads: Array
    left: Array
    right: Array
    window: tuple[float, float]

    @property
    def borders(self) -> Mask:
        """Where left and right, (2, m) bool, are borders of the window and no edges."""
        ends = np.array([self.left, self.right])
        borders = np.array([self.window]).T
        return np.asarray(np.isclose(ends, borders, rtol=SAME_FREQUENCY, atol=0.0))

    @property
    def area(self) -> float:
        """Area in the plane of θ̄ and p̄_t."""
        return float(np.trapezoid(self.right - self.left, self.pulsating_loads))


def unstable_outlines(
    system: System,
    static_load: float,
    largest_load: float,
    lowest_frequency: float,
    highest_frequency: float,
    rows: int = 61,
) -> tuple[Outline, ...]:
    """Return the outlines of the unstable set in a window of θ̄, for p̄_t up to a largest value.

    Parameters
    ----------
    system : System
        Of two coordinates at one spin speed; damped or not, any stiffness law.
    static_load, largest_load : float
        p̄₀ and the largest p̄_t [EI/L²]; the second above 0.
    lowest_frequency, highest_frequency : float
        Window of θ̄ [√(EI/(ρAL⁴))], above 0.
    rows : int
        Number of evenly spaced loads from 0 to the largest, 8 or more.

    Returns
    -------
    tuple of Outline
        Sorted by their lowest row, then from left to right. Where tongues merge, their outlines
        end and another begins, along a common line.

    Raises
    ------
    ValueError
        If an argument is out of range, or the system has more coordinates or several spin speeds.

    Notes
    -----
    At the loads of the rows the edges are roots, to 1e-6 of θ̄, of the distance of two multipliers,
    with damping of the growth rate; between rows they are straight lines. The rows end
    before a pole of the stiffness. Tongues that are narrower than the columns of a chart are found
    where two multipliers collide: none that grows faster than 1e-4 is missed at θ̄ above 0.4 ω_n
    (`python -m benchmarks tongues` counts this over random rotors); slower ones may be left out. A
    gap between two tongues is closed where it is narrower than 0.35 % of θ̄ (0.7 % in the lowest
    octaves).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> pieces = unstable_outlines(lumped(ShaftDisk(), 2.0), 1.178, 0.5, 0.6, 1.5, rows=11)
    >>> pieces[0].name, pieces[0].order
    ('1B+1F', 1)
    """
    if system.size != 2 or system.spin_speed.ndim:
        raise ValueError("`system` must have two coordinates and one spin speed")
    static = number("static_load", static_load)
    largest = number("largest_load", largest_load, 0.0, open_low=True)
    low = number("lowest_frequency", lowest_frequency, 0.0, open_low=True)
    high = number("highest_frequency", highest_frequency, low, open_low=True)
    count = whole_number("rows", rows, 8, 100_000)
    largest = min(largest, (1 - CURVES_SHORT_OF_POLE) * (system.pole - static))
    if largest <= 0:
        return ()
    loads = np.linspace(0.0, largest, count)
    found = unstable_intervals(system, static, loads[1:], low, high)
    step = float(loads[1])
    if found[0] and mean_is_unstable(whirl_frequencies(system, static)):
        found.insert(0, [Interval(low, high)])  # the rotor grows without any pulsation
    else:
        loads = loads[1:]
    table = resonances(system, static, largest)
    return tuple(
        _outline(piece, table, step, system.is_damped, (low, high))
        for piece in linked_pieces(loads, found, step)
    )


def _outline(
    piece: Piece,
    table: ResonanceTable,
    step: float,
    damped: bool,
    window: tuple[float, float],
) -> Outline:
    """Return a piece as an outline, named by the resonance nearest to its lowest row.

    Without damping the outline of a tongue of first order is drawn on to its root at p̄_t = 0.
    """
    loads = np.array(piece.loads)
    left, right = np.array(piece.intervals).T.copy()
    middle = (left[0] + right[0]) / 2
    nearest = table.nearest(middle)
    if nearest is None or loads[0] == 0.0:
        return Outline("", 0, loads, left, right, window)
    row, order = nearest
    if left[0] == right[0] and not damped and order == 1:
        root = row.centre
        if abs(root - middle) < _TIP_MOVE * root and loads[0] < _TIP_ROWS * step:
            loads[0], left[0], right[0] = 0.0, root, root
    for array in (loads, left, right):
        array.flags.writeable = False
    return Outline(row.name, order, loads, left, right, window)
