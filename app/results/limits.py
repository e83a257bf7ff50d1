"""How much work one picture may take: a class shares the server, and each process has one core.

Each number was chosen so that the pictures of usual rotors are complete. What is left out of an
unusual one is blank on the page, and the page says so.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from .model import Model
    from .own_model import OwnModel

__all__ = ["Detail", "MapSize", "map_size"]


class Detail(Enum):
    """How fine a picture is, from coarse to fine."""

    COARSE = 0
    """A coarse growth map, made in the time of one step of a slider."""
    FULL = 1
    """The full growth map: doubtful pixels are computed one by one, and the edges are exact."""


class MapSize(NamedTuple):
    """Size of a growth map and of the finer grid on which the edges of tongues are found.

    Parameters
    ----------
    rows, columns : int
        Pixels of the map.
    density : float
        Of the nodes, see `stability_chart`.
    finer : int
        Columns of the grid in each pixel, an odd number. A tongue that is narrower than a column
        is found by itself, and where an edge crosses a column or a row is known exactly.
    """

    rows: int
    columns: int
    density: float
    finer: int


POLYNOMIALS, MATRICES = "polynomials", "matrices"
"""How a map is made: of the polynomial of four whirls, or of the matrices of all of them."""
# by whether the model is damped: a point takes 1 µs, with damping 4 µs
_COARSE_MAPS = {False: MapSize(40, 108, 1.0, 3), True: MapSize(32, 80, 1.0, 3)}
_FULL_MAP = MapSize(120, 240, 1.0, 3)
# the same with the matrices of all whirls of finite elements: a point takes 0.1 ms
_COARSE_MAPS_OF_MATRICES = {False: MapSize(16, 64, 0.6, 1), True: MapSize(14, 56, 0.6, 1)}
_FULL_MAP_OF_MATRICES = MapSize(48, 120, 1.0, 1)
_FULL_MAP_OF_PLANES = MapSize(26, 84, 1.0, 1)  # twice as many whirls: a point takes 1 ms


def map_size(
    model: Model | OwnModel, detail: Detail, matrices: bool = False, fineness: int = 1
) -> MapSize:
    """Return the size of the growth map of a model.

    Parameters
    ----------
    model : Model or OwnModel
    detail : Detail
    matrices : bool
        Whether it is made of the matrices of all whirls, which takes long.
    fineness : int
        Of the view. A coarse map and one of the matrices are the same for all screens.
    """
    if matrices:
        coarse = _COARSE_MAPS_OF_MATRICES
        full = _FULL_MAP_OF_PLANES if model.planes else _FULL_MAP_OF_MATRICES
    else:
        coarse, full = _COARSE_MAPS, _FULL_MAP
    if detail is Detail.COARSE:
        return coarse[model.is_damped]
    if matrices:
        return full
    return full._replace(rows=fineness * full.rows, columns=fineness * full.columns)


MOST_REFINED = {"lumped": 1800, "finite elements": 60}
"""Largest number of pixels computed one by one, by kind of model; those in doubt come first."""
MOST_CYCLES_REFINED = 40
"""Largest number of cycles of the fastest whirl on the map in one period of the load, at which a
pixel is computed one by one. The slowest 2 % of the paper's window took most of a picture's time,
and lie where no tongue can be drawn."""

MOST_CYCLES = 1000
"""Largest number of cycles of the fastest whirl in one period of the load, on a growth map and in
the marked point: the time of a column rises with it, and without bound for a slow load."""
MOST_WORK = {
    (POLYNOMIALS, False): 20,
    (POLYNOMIALS, True): 10,
    (MATRICES, False): 33,
    (MATRICES, True): 20,
}
"""Largest sum of these cycles over the columns of a map, divided by the number of columns, by how
it is made and whether the model is damped: a full map then takes some seconds at most."""
COARSE_CYCLES = 20
"""Number of these cycles above which a column of a coarse map waits for the full map: the slowest
columns take as long as all others."""
COARSE_SHARE = 0.9
"""Least share of the columns that a coarse map has, whatever their number of cycles."""
COARSE_WORK = 0.75
"""Share of `MOST_WORK` that a coarse map may take."""
MOST_NODES = {Detail.COARSE: 60_000, Detail.FULL: 2_000_000}
"""Largest sum of nodes times steps of a map, 0.1 s or some 4 s of work (`columns_within_work`)."""
COARSE_NODES_OF_ELEMENTS = 35_000
"""The same on a coarse map of finite elements, whose steps take twice as long."""

MOST_STEPS = {"lumped": 5000, "finite elements": 2400}
"""Largest number of steps in one period of the load in the marked point, by kind of model: 0.1 s of
work for the multipliers, and as much for the motion."""
LAW_STEPS = 2400
"""As `MOST_STEPS`, for a law that is not linear and has few harmonics of the stiffness."""
LAW_HARMONICS = 40
"""Number of harmonics of the stiffness with which a step costs twice as much as with none."""
MOST_SAMPLES = 6000
"""Largest number of samples of the response in the marked point; more would slow the page."""
