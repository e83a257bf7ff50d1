"""Exact against linear influence coefficients: four charts, their errors, and limits."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._numerics.roots import bracketed_roots
from .._tolerances import COEFFICIENTS_SHORT_OF_POLE
from .._types import Array, Index
from ..model.stiffness import exact_stiffness, largest_exact_load, linear_stiffness
from ..whirl.critical_loads import critical_load
from .columns import Lines, label_columns
from .quantities import LOAD, Quantity
from .structure import Chart, Layer

__all__ = ["error_loads", "stiffness_charts", "stiffness_loads"]

ENTRIES = (
    (0, 0, "k̄₁₁", "EI/L³"),
    (0, 1, "k̄₁₂", "EI/L²"),
    (1, 0, "k̄₂₁", "EI/L²"),
    (1, 1, "k̄₂₂", "EI/L"),
)
"""Row, column, symbol and unit of each stiffness influence coefficient."""

LEVELS = (0.01, 0.05)
_PERCENT = 100.0
_NAME_HEIGHT = 0.1  # of the error chart: room that a name takes above or below its point
_LARGEST_ERROR = 50.0  # most that the error chart shows [%]
_SMALLEST_TOP = 5.5  # least of its upper end [%], so that the levels are seen
_FOOT = 0.13  # of the largest error: room for a name under a curve near 0
_VISIBLE = 0.94  # of an axis: a curve is named before it leaves the chart
_NAMED_AT = 0.75  # of an axis: where a straight line is named
_LEVELS_AT = 0.35  # of the largest tension: where the names of the levels begin
_LOAD_TOLERANCE = 1e-12  # relative, of the loads at which an error reaches a level


def _largest_load(shear: float) -> float:
    """Return the load [EI/L²] at which the charts end, somewhat below the pole."""
    return float(largest_exact_load(shear)) * (1 - COEFFICIENTS_SHORT_OF_POLE)


def _both(loads: Array, shear: float, tangency: float) -> tuple[Array, Array]:
    """Return the exact and the linear K (m, 2, 2)."""
    elastic, geometric = linear_stiffness(shear, tangency)
    return (
        exact_stiffness(loads, shear, tangency),
        elastic + loads[:, None, None] * geometric,
    )


def _errors(loads: Array, shear: float, tangency: float) -> Array:
    """Return |linear − exact| over |k(0)|, (m, 2, 2)."""
    exact, linear = _both(loads, shear, tangency)
    return np.asarray(np.abs(linear - exact) / np.abs(linear_stiffness(shear, tangency)[0]))


def stiffness_loads(shear: float) -> tuple[float, float]:
    """Return the loads p̄ [EI/L²] between which the two laws are compared.

    They are five times p̄_cr in tension, and in compression a load somewhat below the pole of the
    exact formula, at which a shaft clamped at both ends buckles. Towards the pole the laws part.
    """
    return -5 * float(critical_load(shear)), _largest_load(shear)


def error_loads(shear: float, tangency: float, level: float) -> Array:
    """Return the tension and compression at which a coefficient's error reaches a level.

    Parameters
    ----------
    shear, tangency : float
        Φ in [0, 1) and μ in [0, 1].
    level : float
        Error as a share of the coefficient's value at p̄ = 0.

    Returns
    -------
    (2, 2, 2) float
        [row, column, (tension, compression)] loads p̄ [EI/L²]; −inf or inf where the level
        is not reached within five times p̄_cr in tension, or before the pole in compression.

    Raises
    ------
    ValueError
        If Φ or μ is out of range.

    Examples
    --------
    >>> error_loads(0.0192, 0.0, 0.01).shape
    (2, 2, 2)
    """
    ends = stiffness_loads(shear)
    result = np.empty((4, 2))

    def below(load: Array, entry: Index) -> Array:
        error = _errors(load, shear, tangency).reshape(-1, 4)
        return np.asarray(level - error[np.arange(len(load)), entry])

    for side, end in enumerate(ends):
        # an error grows with the load's distance from 0
        root = bracketed_roots(below, np.zeros(4), np.full(4, end), _LOAD_TOLERANCE)
        result[:, side] = np.where(np.isfinite(root), root, np.copysign(np.inf, end))
    return result.reshape(2, 2, 2)


def stiffness_charts(
    shear: float, tangency: float, loads: tuple[float, float] | None = None, points: int = 201
) -> tuple[Chart, ...]:
    """Return the charts of k̄₁₁, k̄₁₂, k̄₂₁, k̄₂₂ and of the linear law's errors.

    Parameters
    ----------
    shear, tangency : float
        Φ in [0, 1) and μ in [0, 1].
    loads : (float, float), optional
        Range of p̄ [EI/L²], by default that of `stiffness_loads`; its upper end is cut below the
        pole of the exact formula.
    points : int
        Loads, 2 or more.

    Returns
    -------
    tuple of Chart
        Keys k11, k12, k21, k22, errors. Errors are in per cent of the coefficient at p̄ = 0.

    Raises
    ------
    ValueError
        If Φ or μ is out of range.
    """
    low, high = stiffness_loads(shear) if loads is None else loads
    x_range = low, min(high, _largest_load(shear))
    axis = np.linspace(*x_range, points)
    exact, linear = _both(axis, shear, tangency)
    charts = []
    for row, column, name, unit in ENTRIES:
        both = exact[:, row, column], linear[:, row, column]
        lines = Lines()
        for values, law in zip(both, ("exact", "linear"), strict=True):
            lines.add(axis, values, f"{name}, {law}", law)
        # the linear law's span, with room: the exact one may run away at its pole
        room = 0.35 * float(np.ptp(both[1])) + 0.5
        y_range = float(both[1].min()) - room, float(both[1].max()) + room
        charts.append(
            Chart(
                key=f"k{row + 1}{column + 1}",
                title=name,
                x=LOAD,
                y=Quantity("coefficient", name, unit),
                x_range=x_range,
                y_range=y_range,
                layers=(
                    Layer("lines", "coefficient", lines.columns),
                    Layer("labels", "names", label_columns(_law_names(axis, *both, y_range))),
                ),
            )
        )
    errors = _PERCENT * _errors(axis, shear, tangency)
    return (*charts, _error_chart(axis, errors, x_range))


def _law_names(
    axis: Array, exact: Array, linear: Array, y_range: tuple[float, float]
) -> list[tuple[float, float, str, str]]:
    """Name both laws where they have parted: the exact one before it leaves the chart."""
    middle, half = np.mean(y_range), np.ptp(y_range) / 2
    last = int(np.flatnonzero(np.abs(exact - middle) <= _VISIBLE * half)[-1])
    at = int(_NAMED_AT * (axis.size - 1))
    side = "upper right" if linear[last] >= exact[last] else "lower right"
    return [
        (float(axis[last]), float(exact[last]), "exact", "left"),
        (float(axis[at]), float(linear[at]), "linear", side),
    ]


def _error_chart(axis: Array, errors: Array, x_range: tuple[float, float]) -> Chart:
    """Return the chart of the linear law's errors (m, 2, 2) [%] with the levels of 1 % and 5 %."""
    lines = Lines()
    # force balance, k̄₁₁ + k̄₁₂ + k̄₂₁ = −(1 − μ)p̄, is linear in p̄: three of the errors are one
    top = min(_LARGEST_ERROR, 1.1 * max(float(errors.max()), _SMALLEST_TOP / 1.1))
    height = _NAME_HEIGHT * (1 + _FOOT) * top
    levels = [_PERCENT * level for level in LEVELS]
    # without load the errors are 0, so that there is room for the names of the levels
    names = [f"{level:.0f} %" for level in levels]
    at = _LEVELS_AT * x_range[0]
    if levels[1] - levels[0] >= height:
        rows = [(at, *row, "foot") for row in zip(levels, names, strict=True)]
    else:
        rows = [(at, levels[1], " and ".join(names), "foot")]
    for entry, name, role, side in (
        ((0, 0), "k̄₁₁, k̄₁₂, k̄₂₁", "k11", "lower left"),
        ((1, 1), "k̄₂₂", "k22", "upper left"),
    ):
        error = errors[:, entry[0], entry[1]]
        lines.add(axis, error, f"error of {name}", role)
        last = int(np.flatnonzero(error <= top * _VISIBLE)[-1])
        place = float(axis[last]), _beside_levels(float(error[last]), side, height, levels)
        if side == "lower left" and error[last] > levels[1] + 3 * height:
            # below a steep curve, since another one may be near on its left
            place, side = (x_range[1], levels[1]), "upper left"
        rows.append((*place, name, side))
    for level in levels:
        name = f"{level:.0f} % of k̄(0)"
        lines.add(np.array(x_range), np.array([level, level]), name, "level")
    return Chart(
        key="errors",
        title="Error of the linear law",
        x=LOAD,
        y=Quantity("", "error in % of k̄(0)"),
        x_range=x_range,
        y_range=(-_FOOT * top, top),
        layers=(
            Layer("lines", "errors", lines.columns),
            Layer("labels", "names", label_columns(rows)),
        ),
    )


def _beside_levels(error: float, side: str, height: float, levels: Sequence[float]) -> float:
    """Return where a name at an error begins, so that no line of a level crosses it."""
    if side.startswith("lower"):
        return next((level for level in levels if error - height < level <= error), error)
    return next((level for level in levels if error <= level < error + height), error)
