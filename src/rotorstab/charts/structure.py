"""What a chart is, as data: axes and layers of named columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._numerics.roots import is_real
from ..whirl.campbell import WhirlCurves

__all__ = [
    "ROLES",
    "Chart",
    "Layer",
    "Lines",
    "Role",
    "around_zero",
    "axis_symbol",
    "label_columns",
    "mark_columns",
]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Role:
    """How lines of one meaning look; never by colour alone."""

    color: str
    dash: str  # "solid" or lengths in pixels
    width: float
    meaning: str


# Okabe–Ito hues, each at least 3:1 on both the light and the dark ground
ROLES: Mapping[str, Role] = {
    "backward": Role("#1f7fbf", "9 5", 2.2, "backward whirl (B)"),
    "forward": Role("#cf5a12", "solid", 2.2, "forward whirl (F)"),
    "axial": Role("#1f7fbf", "solid", 2.2, "axial load"),
    "follower": Role("#cf5a12", "9 5", 2.2, "follower load"),
    "partly": Role("#0f8a6a", "8 4 2 4", 2.0, "partly follower load"),
    "partly exact": Role("#0f8a6a", "12 3 2 3 2 3", 2.0, "partly follower, exact stiffness"),
    "axial exact": Role("#1f7fbf", "12 3 2 3", 2.0, "axial, exact stiffness"),
    "follower exact": Role("#cf5a12", "2 4 8 4", 1.6, "follower, exact stiffness"),
    "edge": Role("#9a4fd0", "solid", 1.3, "edge of a tongue (Floquet)"),
    "growing": Role("#a8518a", "2 4", 2.6, "Re ω̄ of a whirl that grows"),
    "synchronous": Role("#80868f", "8 4 2 4", 1.4, "synchronous, |ω̄| = Ω̄"),
    "current": Role("#0f8a6a", "solid", 1.8, "present setting"),
    "exact": Role("#1f7fbf", "solid", 2.2, "exact (Appendix A)"),
    "linear": Role("#cf5a12", "9 5", 2.2, "linear (Appendix B)"),
    "k11": Role("#1f7fbf", "solid", 2.2, "k̄₁₁, k̄₁₂ and k̄₂₁: one curve"),
    "k22": Role("#a8518a", "8 4 2 4", 2.2, "k̄₂₂"),
    "level": Role("#80868f", "9 5", 1.4, "1 % and 5 %"),
    "unit circle": Role("#80868f", "solid", 1.6, "unit circle"),
    "tip V": Role("#1f7fbf", "solid", 1.5, "V of the tip"),
    "tip W": Role("#cf5a12", "6 3", 1.5, "W of the tip"),
    "envelope": Role("#80868f", "9 5", 1.6, "envelope e^σt"),
    "orbit": Role("#1f7fbf", "solid", 1.1, "path of the tip"),
    "marker": Role("#c2255c", "solid", 4.0, "point looked into, θ̄ as a ruler"),
    "pin 1": Role("#7a6fd8", "3 3", 1.6, "first pin"),
    "pin 2": Role("#9a7b00", "7 3", 1.6, "second pin"),
    "pin 3": Role("#2f8f8f", "7 3 2 3", 1.6, "third pin"),
    "limit": Role("#80868f", "9 5", 1.4, "buckling or flutter load"),
}


@dataclass(frozen=True, eq=False)
class Layer:
    """One kind of mark with its columns.

    Parameters
    ----------
    kind : {"map", "regions", "lines", "points", "labels"}
        A map has one row: a 2-d `image` (rows upwards, NaN is clear) and further 2-d columns
        for hovering, over the rectangle `x`, `y`, `dw`, `dh`. Regions and lines hold a list
        of arrays in `xs`, `ys`; the others one value a row in `x`, `y`. All but maps have a
        `name`; lines also a `role`, a key of `ROLES`; labels also a `side` of their point.
    label : str
        Unique within its chart.
    columns : mapping of str to sequence
        Equal lengths; arrays become read-only, because charts are shared.
    """

    kind: str
    label: str
    columns: Mapping[str, Sequence[Any]]

    def __post_init__(self) -> None:
        """Guard the arrays."""
        for column in self.columns.values():
            for array in (column, *column):
                if isinstance(array, np.ndarray):
                    array.flags.writeable = False


@dataclass(frozen=True, eq=False)
class Chart:
    """Axes and layers of one chart."""

    key: str
    title: str
    x_label: str
    y_label: str
    x_range: tuple[float, float]
    y_range: tuple[float, float]
    layers: tuple[Layer, ...]
    square: bool = False  # both axes to one scale, in a square place
    units: str = "non-dimensional"  # or "SI"

    def layer(self, label: str) -> Layer:
        """Return the layer of that label."""
        return next(layer for layer in self.layers if layer.label == label)


class Lines:
    """Collects polylines into the columns of a "lines" layer."""

    def __init__(self) -> None:
        """Start empty."""
        self.columns: dict[str, list[Any]] = {"xs": [], "ys": [], "name": [], "role": []}

    def add(self, xs: Array, ys: Array, name: str, role: str) -> None:
        """Add one polyline (m,), (m,) of a role."""
        for key, value in zip(self.columns, (xs, ys, name, role), strict=True):
            self.columns[key].append(value)

    def vertical(self, x: float, y_range: tuple[float, float], name: str, role: str) -> None:
        """Add a vertical line across the chart."""
        self.add(np.array([x, x]), np.array(y_range), name, role)

    def whirl(self, curves: WhirlCurves, roles: tuple[str, str], name: str) -> None:
        """Add every mode in its role, stretches where the whirl grows as growing.

        `roles` is for backward and forward modes; `name` has a place for the mode.
        """
        grows = _growing(curves.frequencies)
        columns = zip(curves.frequencies.real.T, grows.T, curves.names, strict=True)
        for column, growing, mode in columns:
            calm = np.where(growing, np.nan, column)
            self.add(curves.parameter, calm, name.format(mode), roles[mode.endswith("F")])
            if growing.any():
                # one sample more on each side, so that the stretches meet
                near = growing.copy()
                near[1:] |= growing[:-1]
                near[:-1] |= growing[1:]
                stretch = np.where(near, column, np.nan)
                self.add(curves.parameter, stretch, f"{name.format(mode)}, growing", "growing")


def _growing(frequencies: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Return where whirls (m, 2n) grow, or are the decaying twin of one: a conjugate pair.

    Without damping a pair that has met shares its real part, and one of the two grows.
    """
    size = np.abs(frequencies)
    grows = (frequencies.imag < 0) & ~is_real(frequencies)
    twins = frequencies[:, :, None] - frequencies[:, None, :].conj()
    near = np.abs(twins) <= 1e-6 * size[:, :, None]
    return np.asarray(grows | (near & grows[:, None, :]).any(axis=2))


def axis_symbol(label: str) -> tuple[str, str]:
    """Return the symbol and the unit at the end of an axis label; the unit may be empty.

    Examples
    --------
    >>> axis_symbol("spin speed Ω [rpm]")
    ('Ω', 'rpm')
    >>> axis_symbol("steady load p̄")
    ('p̄', '')
    """
    words, _, unit = label.removesuffix("]").partition(" [")
    return words.split()[-1], unit


def mark_columns(rows: Sequence[tuple[Any, ...]], *extra: str) -> dict[str, Sequence[Any]]:
    """Return columns x, y, name and any extra ones from rows in that order."""
    columns: list[Sequence[Any]] = [list(column) for column in zip(*rows, strict=True)]
    columns = columns or [[] for _ in range(3 + len(extra))]
    x, y, *words = columns
    result: dict[str, Any] = {"x": np.array(x, float), "y": np.array(y, float)}
    return result | dict(zip(("name", *extra), words, strict=True))


def label_columns(rows: Sequence[tuple[float, float, str, str]]) -> dict[str, Sequence[Any]]:
    """Return label columns of (x, y, text, side) rows; the side is where the text goes."""
    return mark_columns(rows, "side")


def around_zero(low: float, high: float) -> tuple[float, float]:
    """Return a range from below 0 to above it, with room, in steps so that it rarely moves."""
    step = 0.5 if max(-low, high) < 4 else 2.0
    below, above = (step * max(1.0, float(np.ceil(one * 1.08 / step))) for one in (-low, high))
    return -below, above
