"""What a picture is, as data: charts of layers, and layers of named columns.

One `Chart` serves the live page, which patches its columns, the panels of printed figures and
the tables: all of them see the same arrays.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Array
from .modes import Mode
from .quantities import Quantity
from .roles import ROLES, Role, Style

__all__ = ["Chart", "Curve", "Layer", "pixel_centres"]


@dataclass(frozen=True, eq=False)
class Curve:
    """One row of a layer: a line, a shaded region, an outline or a point.

    Parameters
    ----------
    name : str
        Unique in its chart.
    x, y : (m,) float
        NaN where a line has a gap; a single value for a point.
    role : str
        A key of `ROLES`: how it looks.
    group : str
        Its entry in a printed legend.
    mode : Mode, optional
        The whirl mode that a line follows.
    pair : str
        The pair of modes whose tongue an outline is, such as "1B+1F"; else empty.
    order : int
        Order of that tongue; else 0.
    """

    name: str
    x: Array
    y: Array
    role: str
    group: str
    mode: Mode | None = None
    pair: str = ""
    order: int = 0

    @property
    def look(self) -> Role:
        """How it looks."""
        return ROLES[self.role]

    @property
    def style(self) -> Style:
        """Its line style in print and in tables."""
        return self.look.style

    @property
    def polygon(self) -> tuple[Array, Array]:
        """The points (x, y) of a region or an outline, without gaps.

        The first half goes up the left edge, the second down the right one.
        """
        inside = np.isfinite(self.x)
        return self.x[inside], self.y[inside]

    @property
    def edges(self) -> tuple[Array, Array, Array]:
        """Heights y (k,) of a polygon whose edges have the same heights, left x and right x."""
        x, y = self.polygon
        half = x.size // 2
        return y[:half], x[:half], x[half:][::-1]


@dataclass(frozen=True, eq=False)
class Layer:
    """One kind of mark with its columns.

    Parameters
    ----------
    kind : str
        "map", "bands", "edges", "blanks", "regions", "areas", "outlines", "lines", "points" or
        "labels".
        A map has one row: a 2-d `image` (rows upwards, NaN is clear) and further 2-d columns
        for hovering, over the rectangle `x`, `y`, `dw`, `dh`. Blanks, regions, areas, outlines and
        lines hold a list of arrays in `xs`, `ys`; the others have one value a row in `x`, `y`. All
        but maps and bands have a `name`. Labels have a `side` of their point, where the text
        stands. The others have the columns `role` and `group`, and may have `mode`, `pair` and
        `order`: see `Curve`. A column `wording` holds a `Wording` where a name gives a value, else
        None.

        Bands and edges have one row: the grid on which Floquet's verdict is known, from which
        they are drawn as contours. `x` (C,) and `y` (R,) are its coordinates, `edge` (R, C) is
        above 0 where the rotor is unstable, and `across` and `along` say where the edge crosses
        the lines of the grid: see `GridEdges`. Bands also have `growth` (R, C) and `top`, the
        growth at the upper end of the colours; edges have `name`, `role` and `group`.

        Blanks are parts of a chart that are not computed, `xs` and `ys` of their polygons.

        A region is Bolotin's. An area is a polygon that is filled with the colour of its role. An
        outline bounds what Floquet finds unstable: its left edge upwards, a gap, its right edge
        downwards, with further gaps where it runs along the border of the chart.
    label : str
        Unique within its chart.
    columns : mapping of str to sequence
        Equal lengths; arrays become read-only, because charts are shared.
    quantity : Quantity, optional
        What the image of a map or the colours of bands show.
    role : str
        Of points: the key of `ROLES` of every row, also where there are none; else empty.
    """

    kind: str
    label: str
    columns: Mapping[str, Sequence[Any]]
    quantity: Quantity | None = None
    role: str = ""

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for column in self.columns.values():
            for array in (column, *column):
                if isinstance(array, np.ndarray):
                    array.flags.writeable = False

    def curves(self) -> tuple[Curve, ...]:
        """Return the rows of a layer of regions, outlines, lines or points."""
        columns = self.columns
        keys = [key for key in ("name", "role", "group", "mode", "pair", "order") if key in columns]
        xs, ys = (
            np.reshape(columns[axis], (-1, 1)) if self.kind == "points" else columns[f"{axis}s"]
            for axis in ("x", "y")
        )
        rows = zip(*(columns[key] for key in keys), strict=True)
        return tuple(
            Curve(x=x, y=y, **dict(zip(keys, row, strict=True)))
            for x, y, row in zip(xs, ys, rows, strict=True)
        )


def pixel_centres(layer: Layer) -> tuple[Array, Array]:
    """Return the abscissas (C,) and the ordinates (R,) of the pixels of a map."""
    columns = layer.columns
    rows, count = np.asarray(columns["image"][0]).shape
    x = columns["x"][0] + (np.arange(count) + 0.5) / count * columns["dw"][0]
    y = columns["y"][0] + (np.arange(rows) + 0.5) / rows * columns["dh"][0]
    return x, y


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
    letter : str
        Of the panel of a figure; empty for a chart that stands alone.
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
    letter: str = ""

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

    def of_kind(self, *kinds: str) -> tuple[Layer, ...]:
        """Return the layers of some kinds."""
        return tuple(layer for layer in self.layers if layer.kind in kinds)

    def curves(self, *kinds: str) -> tuple[Curve, ...]:
        """Return the rows of all layers of some kinds."""
        return tuple(curve for layer in self.of_kind(*kinds) for curve in layer.curves())

    @property
    def shows_floquet(self) -> bool:
        """Whether it shows what Floquet finds unstable."""
        return bool(self.of_kind("bands", "outlines"))

    @property
    def series(self) -> tuple[Curve, ...]:
        """Lines and points."""
        return self.curves("lines", "points")

    @property
    def regions(self) -> tuple[Curve, ...]:
        """Bolotin's regions."""
        return self.curves("regions")

    @property
    def unstable(self) -> tuple[Curve, ...]:
        """Outlines of what Floquet finds unstable."""
        return self.curves("outlines")

    def group(self, name: str) -> tuple[Curve, ...]:
        """Return the lines and points of one group."""
        return tuple(curve for curve in self.series if curve.group == name)

    def boundary(self, group: str, mode: str) -> Curve:
        """Return the line of a group that follows one mode, such as "1F"."""
        return next(
            line for line in self.group(group) if line.mode is not None and line.mode.name == mode
        )

    def plot(self) -> Any:
        """Return the chart as a HoloViews object, for a notebook.

        Call ``holoviews.extension("bokeh")`` once in the notebook.

        Returns
        -------
        holoviews.Overlay
            With a title and a legend, styled for Bokeh.

        Raises
        ------
        ImportError
            If HoloViews or Bokeh is not installed; the message says how to install them.
        """
        from ..drawing.notebook import notebook_element

        return notebook_element(self)
