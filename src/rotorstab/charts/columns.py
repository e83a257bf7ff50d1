"""Columns of layers, built row by row, and the range of an axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._types import Array, Complex, Mask
from ..floquet.criterion import grows_or_decays
from ..whirl.campbell import WhirlCurves
from .modes import Mode, modes
from .quantities import Wording
from .roles import ROLES
from .structure import Layer

__all__ = [
    "Lines",
    "around_zero",
    "label_columns",
    "mark_columns",
    "points_layer",
    "where_growing",
    "widened",
]

_LABEL = 0.15  # height of a label, in heights of a low chart
_TWIN = 1e-6  # of a frequency: two that differ from a conjugate pair by less are one


class Lines:
    """Collects polylines or polygons into the columns of a layer of lines, regions or outlines."""

    def __init__(self) -> None:
        """Start empty."""
        keys = ("xs", "ys", "name", "role", "group", "mode", "wording", "pair", "order")
        self.columns: dict[str, list[Any]] = {key: [] for key in keys}

    def add(
        self,
        xs: Array,
        ys: Array,
        name: str | Wording,
        role: str,
        group: str | None = None,
        mode: Mode | None = None,
        pair: str = "",
        order: int = 0,
    ) -> None:
        """Add one polyline or polygon.

        Parameters
        ----------
        xs, ys : (m,) float
            NaN where the line has a gap.
        name : str or Wording
        role : str
            A key of `ROLES`.
        group : str, optional
            Its entry in a printed legend, by default the meaning of its role.
        mode : Mode, optional
            The whirl mode that it follows.
        pair, order
            Of a tongue: see `Curve`.
        """
        group = ROLES[role].meaning if group is None else group
        wording = name if isinstance(name, Wording) else None
        row = (xs, ys, str(name), role, group, mode, wording, pair, order)
        for column, value in zip(self.columns.values(), row, strict=True):
            column.append(value)

    def vertical(
        self, x: float, y_range: tuple[float, float], name: str | Wording, role: str
    ) -> None:
        """Add a vertical line across the chart."""
        self.add(np.array([x, x]), np.array(y_range), name, role)

    def whirl(self, curves: WhirlCurves, roles: tuple[str, str], name: str) -> None:
        """Add every mode in its role, and apart from it the stretches where its whirl grows.

        Parameters
        ----------
        curves : WhirlCurves
        roles : (str, str)
            Of backward and of forward modes.
        name : str
            With a place {} for the name of the mode.
        """
        grows = where_growing(curves.frequencies)
        columns = zip(curves.frequencies.real.T, grows.T, modes(curves.names), strict=True)
        for column, growing, mode in columns:
            text = name.format(mode.name)
            steady = np.where(growing, np.nan, column)
            self.add(curves.parameter, steady, text, roles[mode.forward], mode=mode)
            if growing.any():
                stretch = np.where(widened(growing), column, np.nan)
                self.add(curves.parameter, stretch, f"{text}, growing", "growing", mode=mode)


def widened(stretch: Mask) -> Mask:
    """Return a stretch of samples with one more on each side, so that neighbours meet."""
    wider = stretch.copy()
    wider[1:] |= stretch[:-1]
    wider[:-1] |= stretch[1:]
    return wider


def where_growing(frequencies: Complex) -> Mask:
    """Return where whirls (m, 2n) grow, and where they are the decaying half of such a pair.

    Without damping two frequencies that have met are complex conjugates: one whirl grows, the
    other decays, and both have one Re ω.
    """
    size = np.abs(frequencies)
    grows = (frequencies.imag < 0) & grows_or_decays(frequencies)
    twins = frequencies[:, :, None] - frequencies[:, None, :].conj()
    near = np.abs(twins) <= _TWIN * size[:, :, None]
    return np.asarray(grows | (near & grows[:, None, :]).any(axis=2))


def mark_columns(rows: Sequence[tuple[Any, ...]], *extra: str) -> dict[str, Sequence[Any]]:
    """Return columns x, y, name, wording and any extra ones from rows (x, y, name, *extra).

    A name may be a str or a `Wording`.
    """
    columns: list[Sequence[Any]] = [list(column) for column in zip(*rows, strict=True)]
    columns = columns or [[] for _ in range(3 + len(extra))]
    x, y, names, *others = columns
    result: dict[str, Any] = {
        "x": np.array(x, float),
        "y": np.array(y, float),
        "name": [str(name) for name in names],
        "wording": [name if isinstance(name, Wording) else None for name in names],
    }
    return result | dict(zip(extra, others, strict=True))


def points_layer(
    label: str,
    rows: Sequence[tuple[float, float, str | Wording]],
    group: str | None = None,
    role: str = "place",
) -> Layer:
    """Return a layer of points from rows (x, y, name).

    Parameters
    ----------
    label : str
    rows : sequence of (float, float, str or Wording)
    group : str, optional
        Their entry in a printed legend, by default the label.
    role : str
        A key of `ROLES`: how they look.
    """
    group = label if group is None else group
    extra = {"role": [role] * len(rows), "group": [group] * len(rows)}
    return Layer("points", label, mark_columns(rows) | extra, role=role)


def label_columns(rows: Sequence[tuple[float, float, str, str]]) -> dict[str, Sequence[Any]]:
    """Return label columns of (x, y, text, side) rows; the side is where the text goes.

    "frame top left" and "frame top right" are for points on the upper edge of the frame: the text
    stands above it in print and below it on the screen, which cuts off what lies outside the frame.
    """
    return mark_columns(rows, "side")


def around_zero(low: float, high: float) -> tuple[float, float]:
    """Return a range from below 0 to above it, in steps so that it rarely moves.

    Parameters
    ----------
    low, high : float
        Smallest and largest value of the curves, in the unit of the axis.

    Returns
    -------
    (float, float)
        In the same unit. There is room for a line of text beyond each end, also where the chart is
        110 pixels high.
    """
    step = 0.5 if max(-low, high) < 4 else 2.0
    room = _LABEL * (high - low)
    below, above = (step * max(1.0, float(np.ceil((end + room) / step))) for end in (-low, high))
    return -below, above
