"""Figure 8: whirl frequencies over the steady load."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..critical import critical_load, flutter_load
from ..rotor import BASE_CASE, ShaftDisk
from ..system import System, lumped
from ..whirl import load_frequency_curves, whirl_frequencies
from .readings import read_figure_8
from .structure import Array, Figure, Panel, Series, Style, parameters

__all__ = ["figure_8"]

_REAL = 1e-9  # |Im ω|/|ω| below which a frequency is real
_KINDS: tuple[tuple[str, float, Style], ...] = (
    ("axial force", 0.0, "solid"),
    ("follower force", 1.0, "dashed"),
)
_COMPLEX = "complex pair"


def _complex_count(system: System, loads: Array) -> Array:
    """Return how many whirl frequencies are complex at each load."""
    frequencies = whirl_frequencies(system, loads)
    return np.asarray((np.abs(frequencies.imag) > _REAL * np.abs(frequencies)).sum(axis=-1))


def _refined(system: System, loads: Array) -> Array:
    """Return the loads with graded ones added at every meeting of two frequencies.

    There the frequency turns as a square root.
    """
    count = _complex_count(system, loads)
    changes = np.flatnonzero(count[1:] != count[:-1])
    if not changes.size:
        return loads
    low, high, below = loads[changes], loads[changes + 1], count[changes]
    for _ in range(48):
        middle = (low + high) / 2
        same = _complex_count(system, middle) == below
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    grading = (np.linspace(0.0, 1.0, 12)[1:-1] ** 2)[:, None]
    before = low - (low - loads[changes]) * grading
    after = high + (loads[changes + 1] - high) * grading
    return np.unique(np.concatenate([loads, low, high, before.ravel(), after.ravel()]))


def _curves(group: str, style: Style, system: System, loads: Array) -> list[Series]:
    """Return every mode's real stretches, and its complex ones as dotted lines of Re ω."""
    curves = load_frequency_curves(system, _refined(system, loads))
    series = []
    for mode, column in zip(curves.names, curves.frequencies.T, strict=True):
        complex_ = np.abs(column.imag) > _REAL * np.abs(column)
        real = np.where(complex_, np.nan, column.real)
        series.append(Series(f"{group}, {mode}", group, style, curves.parameter, real))
        if complex_.any():
            # one sample more on each side, so that the stretches meet
            near = complex_.copy()
            near[1:] |= complex_[:-1]
            near[:-1] |= complex_[1:]
            pair = np.where(near, column.real, np.nan)
            name = f"{group}, {mode}, {_COMPLEX}"
            series.append(Series(name, _COMPLEX, "dotted", curves.parameter, pair))
    return series


def figure_8(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = (0.0, 2.0),
    largest_load: float = 7.0,
    points: int = 281,
) -> Figure:
    """Return Fig. 8: load–frequency curves, axial and follower load.

    Parameters
    ----------
    rotor : ShaftDisk
    spin_speeds : sequence of float
        Ω̄, a panel each.
    largest_load : float
        p̄ runs from 0 to this [EI/L²].
    points : int
        Even loads; more are added where two frequencies meet.

    Returns
    -------
    Figure
        Where two frequencies have met and become a complex pair, its real part is a
        series of its own in the group "complex pair".
    """
    loads = np.linspace(0.0, largest_load, points)
    panels = []
    limits: dict[str, float] = {"critical_load": float(critical_load(rotor.shear))}
    for letter, spin in zip("abcdef", spin_speeds, strict=False):
        series: list[Series] = []
        for group, tangency, style in _KINDS:
            system = lumped(rotor, spin, tangency)
            series += _curves(group, style, system, loads)
            if tangency:
                flutter = flutter_load(system)
                if np.isfinite(flutter):
                    limits[f"flutter_load_spin_{spin:g}"] = flutter
        top = float(np.ceil(1.05 * max(np.nanmax(np.abs(one.y)) for one in series)))
        panels.append(
            Panel(
                letter=letter,
                title=f"Ω̄ = {spin:g}",
                x_label="p̄",
                y_label="ω̄",
                x_unit="EI/L²",
                y_unit="√(EI/ρAL⁴)",
                series=tuple(series),
                labels=tuple(
                    (0.0, float(one.y[0]), one.name.rsplit(", ", 1)[1])
                    for one in series
                    if one.group == "axial force"
                ),
                x_range=(0.0, largest_load),
                y_range=(-top, top),
            )
        )
    return Figure(
        number=8,
        title="Load–frequency curves",
        caption="Solid: axial force. Dashed: follower force. Dotted: real part of a complex pair.",
        parameters=parameters(rotor, spin_speeds=list(spin_speeds), **limits),
        panels=tuple(panels),
        reading=read_figure_8(tuple(panels), rotor),
    )
