"""What a chart is, as data: axes and layers of named columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .quantities import Quantity

__all__ = ["Chart", "Layer"]


@dataclass(frozen=True, eq=False)
class Layer:
    """One kind of mark with its columns.

    Parameters
    ----------
    kind : {"map", "regions", "lines", "points", "labels"}
        A map has one row: a 2-d `image` (rows upwards, NaN is clear) and further 2-d columns
        for hovering, over the rectangle `x`, `y`, `dw`, `dh`. Regions and lines hold a list
        of arrays in `xs`, `ys`; the others one value a row in `x`, `y`. All but maps have a
        `name`; lines also a `role`, a key of `ROLES`, a `group`, their entry in a printed
        legend, and a `mode`, a `Mode` or None; labels also a `side` of their point. A column
        `wording` holds a `Wording` where the name gives a value, and None elsewhere.
    label : str
        Unique within its chart.
    columns : mapping of str to sequence
        Equal lengths; arrays become read-only, because charts are shared.
    quantity : Quantity, optional
        What the image of a map shows.
    """

    kind: str
    label: str
    columns: Mapping[str, Sequence[Any]]
    quantity: Quantity | None = None

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for column in self.columns.values():
            for array in (column, *column):
                if isinstance(array, np.ndarray):
                    array.flags.writeable = False


@dataclass(frozen=True, eq=False)
class Chart:
    """Axes and layers of one chart.

    Parameters
    ----------
    key, title : str
    x, y : Quantity
        What the axes measure.
    x_range, y_range : (float, float)
        Of the axes.
    layers : tuple of Layer
        From below to above.
    square : bool
        Whether both axes have one scale, in a square place.
    units : {"non-dimensional", "SI"}
    """

    key: str
    title: str
    x: Quantity
    y: Quantity
    x_range: tuple[float, float]
    y_range: tuple[float, float]
    layers: tuple[Layer, ...]
    square: bool = False
    units: str = "non-dimensional"

    @property
    def in_si(self) -> bool:
        """Whether its numbers have SI units, which its labels then give."""
        return self.units == "SI"

    @property
    def x_label(self) -> str:
        """Label of the abscissa, with its unit if the chart is in SI."""
        return self.x.label(self.in_si)

    @property
    def y_label(self) -> str:
        """Label of the ordinate, with its unit if the chart is in SI."""
        return self.y.label(self.in_si)

    def layer(self, label: str) -> Layer:
        """Return the layer of that label."""
        return next(layer for layer in self.layers if layer.label == label)
