"""What a figure is, as data: panels of named arrays, parameters and a reading."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from string import ascii_lowercase
from typing import Literal, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..rotors.shaft_disk import ShaftDisk
from .modes import Mode
from .roles import Style

__all__ = [
    "LOAD_KINDS",
    "Figure",
    "Grid",
    "Label",
    "Mark",
    "Panel",
    "Region",
    "Series",
    "Statement",
    "Value",
    "Verdict",
    "lettered",
    "parameters",
    "styled",
]

Array = NDArray[np.float64]
T = TypeVar("T")

LOAD_KINDS: tuple[tuple[str, Style, float], ...] = (
    ("axial force", "solid", 0.0),
    ("follower force", "dashed", 1.0),
)
"""Both kinds of load: name, line style and tangency μ."""
Verdict = Literal[
    "agree",
    "differ",
    "agree in part",
    "survives",
    "does not survive",
    "survives in part",
]
Value = float | str | list[float] | None


def _frozen(values: ArrayLike) -> Array:
    """Return a read-only copy."""
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False)
class Series:
    """One line of a panel.

    Parameters
    ----------
    name : str
        Unique in its panel.
    group : str
        The variant it belongs to: one legend entry.
    style : {"solid", "dashed", "dashdot", "dotted"}
        As in the paper's caption; dotted are complex pairs, which the paper does not mark.
    x, y : (m,) float
        NaN where the line has a gap; a single point is drawn as a mark.
    color : str, optional
        Where the style alone does not tell groups apart; by default the style's own.
    mode : Mode, optional
        The whirl mode that the line follows.
    """

    name: str
    group: str
    style: Style
    x: Array
    y: Array
    color: str | None = None
    mode: Mode | None = None

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        object.__setattr__(self, "x", _frozen(self.x))
        object.__setattr__(self, "y", _frozen(self.y))


@dataclass(frozen=True, eq=False)
class Region:
    """One shaded polygon (x, y), each (m,) float, closed from last to first point.

    The first half of the points goes up its left edge, the second down its right one. A tongue
    has the name of its `pair` of modes and its `order`; others have neither.
    """

    name: str
    group: str
    style: Style
    x: Array
    y: Array
    pair: str = ""
    order: int = 0

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        object.__setattr__(self, "x", _frozen(self.x))
        object.__setattr__(self, "y", _frozen(self.y))


@dataclass(frozen=True, eq=False)
class Grid:
    """Values on the pixels of a panel; a pixel is drawn where its value is above 0.

    Parameters
    ----------
    name, unit : str
        What the values are.
    x : (C,) float
        Pixel centres.
    y : (R,) float
        Pixel centres.
    values : (R, C) float
    """

    name: str
    unit: str
    x: Array
    y: Array
    values: Array

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for field in ("x", "y", "values"):
            object.__setattr__(self, field, _frozen(getattr(self, field)))


@dataclass(frozen=True)
class Label:
    """A text at a point of a line; `low` puts it below the point."""

    x: float
    y: float
    text: str
    low: bool = False


@dataclass(frozen=True)
class Mark:
    """A text at a point: the name of a tongue; vertical texts run upwards."""

    x: float
    y: float
    text: str
    vertical: bool = False


@dataclass(frozen=True, eq=False)
class Panel:
    """One part of a figure.

    Parameters
    ----------
    letter, title : str
        Such as "a" and "Ω̄ = 0".
    x_label, y_label : str
        Symbols.
    x_unit, y_unit : str
        "-" where there is none.
    series, regions : tuple
        What is drawn.
    labels : tuple of Label
        Names of lines.
    x_range, y_range : (float, float)
        Of the axes.
    unstable : tuple of Region
        Where Floquet finds the rotor unstable; `regions` are Bolotin's.
    marks : tuple of Mark
        Names of tongues.
    grid : Grid, optional
        A map below everything else.
    """

    letter: str
    title: str
    x_label: str
    y_label: str
    x_unit: str
    y_unit: str
    series: tuple[Series, ...]
    x_range: tuple[float, float]
    y_range: tuple[float, float]
    regions: tuple[Region, ...] = ()
    labels: tuple[Label, ...] = ()
    unstable: tuple[Region, ...] = ()
    marks: tuple[Mark, ...] = ()
    grid: Grid | None = None

    def group(self, name: str) -> tuple[Series, ...]:
        """Return the series of one group."""
        return tuple(line for line in self.series if line.group == name)

    def boundary(self, group: str, mode: str) -> Series:
        """Return the line of a group that follows one mode, such as "1F"."""
        return next(
            line for line in self.group(group) if line.mode is not None and line.mode.name == mode
        )


@dataclass(frozen=True)
class Statement:
    """One thing that the text says of a figure, against our numbers.

    Parameters
    ----------
    text : str
        What the paper says, in short.
    ours : str
        What was computed, with its numbers.
    verdict : {"agree", "differ", "agree in part"} or "survives" and its like
        The first three compare the text with the paper's own method, the others with Floquet.
    note : str
        Why they differ, or how far the statement goes; may be empty.
    """

    text: str
    ours: str
    verdict: Verdict
    note: str = ""


@dataclass(frozen=True, eq=False)
class Figure:
    """A figure of the paper, computed.

    Parameters
    ----------
    number : int
        2 to 9, or 0 for one that is not in the paper.
    title, caption : str
        What it shows; the caption names the line styles.
    parameters : mapping
        Plain values that made it.
    panels : tuple of Panel
    reading : tuple of Statement
        What the text says of it, with our numbers, computed from these very arrays.
    """

    number: int
    title: str
    caption: str
    parameters: Mapping[str, Value]
    panels: tuple[Panel, ...]
    reading: tuple[Statement, ...] = ()

    def panel(self, letter: str) -> Panel:
        """Return the panel of that letter."""
        return next(panel for panel in self.panels if panel.letter == letter)

    @property
    def has_floquet(self) -> bool:
        """Whether it shows what Floquet finds unstable."""
        return any(panel.unstable for panel in self.panels)

    def groups(self) -> dict[str, Series]:
        """Return one line of every group, in the order of drawing, dotted last."""
        lines = {one.group: one for panel in self.panels for one in panel.series}
        return dict(sorted(lines.items(), key=lambda item: item[1].style == "dotted"))


def parameters(rotor: ShaftDisk, **others: Value) -> dict[str, Value]:
    """Return a rotor's fields and other plain values as one mapping."""
    return {**asdict(rotor), **others}


def _paired(name: str, keys: Sequence[str], values: Sequence[T]) -> list[tuple[str, T]]:
    """Return each value with a key of its own; ValueError where there are too many or none."""
    if not 1 <= len(values) <= len(keys):
        raise ValueError(f"`{name}` must have 1 to {len(keys)} values, got {len(values)}")
    return list(zip(keys[: len(values)], values, strict=True))


def lettered(name: str, values: Sequence[T]) -> list[tuple[str, T]]:
    """Return the values of an argument, 1 to 26, with the letters of their panels."""
    return _paired(name, ascii_lowercase, values)


def styled(name: str, values: Sequence[T]) -> list[tuple[Style, T]]:
    """Return the values of an argument, 1 to 3, with their line styles."""
    return cast("list[tuple[Style, T]]", _paired(name, ("solid", "dashed", "dashdot"), values))
