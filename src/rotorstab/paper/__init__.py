"""Every figure of the paper as data, with what the text says of it.

One file a figure: its arrays, and both readings of the text, against the paper's own method and
against Floquet. `region_figure` makes the panels that Figs 4 to 7 and 9 have in common. Then come
`table_1`, the conclusions, and `published` values with `validation`, the document of all of it.
"""

from collections.abc import Callable

from ..charts.figure import Figure, Statement
from .conclusions import CONCLUSIONS, FLOQUET_CONCLUSIONS
from .figure_2_axial_coefficients import figure_2
from .figure_3_follower_coefficients import figure_3
from .figure_4_finite_elements import figure_4
from .figure_5_shear import figure_5
from .figure_6_axial_load import figure_6
from .figure_7_follower_load import figure_7
from .figure_8_load_frequency import figure_8
from .figure_9_load_type import figure_9
from .own_rotor import own_regions
from .table_1 import Row, Table, table_1

__all__ = [
    "CONCLUSIONS",
    "FIGURES",
    "FLOQUET_CONCLUSIONS",
    "FLOQUET_FIGURES",
    "Figure",
    "Row",
    "Statement",
    "Table",
    "figure_2",
    "figure_3",
    "figure_4",
    "figure_5",
    "figure_6",
    "figure_7",
    "figure_8",
    "figure_9",
    "own_regions",
    "paper_figure",
    "table_1",
]

FIGURES: dict[int, Callable[..., Figure]] = {
    2: figure_2,
    3: figure_3,
    4: figure_4,
    5: figure_5,
    6: figure_6,
    7: figure_7,
    8: figure_8,
    9: figure_9,
}
"""The function of each figure by its number."""

FLOQUET_FIGURES = (4, 5, 6, 7, 8, 9)
"""Those whose function takes `floquet=True`."""


def paper_figure(number: int, floquet: bool = False) -> Figure:
    """Return a figure of the paper by its number.

    Parameters
    ----------
    number : int
        A key of `FIGURES`.
    floquet : bool
        Add Floquet's answer, for a figure that is one of `FLOQUET_FIGURES`.
    """
    make = FIGURES[number]
    return make(floquet=True) if floquet and number in FLOQUET_FIGURES else make()
