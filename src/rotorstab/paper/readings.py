"""What the text says of Figs 2, 3 and 8, against what their arrays show.

Every number in a statement is computed from the arrays handed over.
"""

from __future__ import annotations

import numpy as np

from ..bolotin.boundaries import boundary_frequencies
from ..charts.figure import Panel, Series, Statement
from ..model.lumped import lumped
from ..model.stiffness import largest_exact_load
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.critical_loads import critical_load
from .verdicts import judge, percent, say

__all__ = ["read_figure_2", "read_figure_3", "read_figure_8"]

Panels = tuple[Panel, ...]
_CLOSE = 0.05  # of a coefficient's own change over the interval


def _worst(panel: Panel) -> float:
    """Return the largest |linear − exact| over the exact one's change in the interval."""
    exact, linear = panel.series
    return float(np.abs(linear.y - exact.y).max() / np.ptp(exact.y))


def _coefficient_errors(panels: Panels) -> str:
    return ", ".join(f"{panel.title} {percent(_worst(panel))}" for panel in panels)


def read_figure_2(panels: Panels) -> tuple[Statement, ...]:
    """Return the reading of Fig. 2."""
    largest = panels[0].x_range[1]
    relative = max(
        float((np.abs(linear.y - exact.y) / np.abs(exact.y)).max())
        for exact, linear in (panel.series for panel in panels)
    )
    return (
        Statement(
            "The critical load of the axially loaded shaft is 2.3558.",
            f"p̄_cr = {largest:.5f}.",
            judge(round(largest, 4) == 2.3558),
        ),
        Statement(
            "The approximate values are very close to the exact ones over a considerable range.",
            "Largest error, as a part of the coefficient's change over the interval: "
            f"{_coefficient_errors(panels)}; relative to its value at most {percent(relative)}.",
            judge(all(_worst(panel) < _CLOSE for panel in panels)),
        ),
    )


def read_figure_3(panels: Panels, rotor: ShaftDisk) -> tuple[Statement, ...]:
    """Return the reading of Fig. 3."""
    largest = panels[0].x_range[1]
    k11, k12, k21, k22 = (_worst(panel) for panel in panels)
    pole = float(largest_exact_load(rotor.shear))
    crossing = panels[0].series[0]
    lost = float(np.interp(0.0, -crossing.y, crossing.x))
    return (
        Statement(
            "The critical load of the shaft under a follower load is 12.3019.",
            f"{largest:.5f}: the flutter load of the shaft alone, with its own mass, shear and "
            "rotary inertia (Beck's column).",
            judge(abs(largest - 12.3019) < 1e-4),
            "It is not a load of the lumped model, and the load factors do not use it.",
        ),
        Statement(
            "All but k̄₂₁ and k̄₂₂ are very close to their exact values.",
            "Largest error, as a part of the coefficient's change over the interval: "
            f"{_coefficient_errors(panels)}.",
            judge(k11 < _CLOSE and k12 < _CLOSE, k21 > _CLOSE and k22 > _CLOSE),
            f"The exact coefficients stay finite to their pole at p̄ = {pole:.3f}; the exact "
            f"k̄₁₁ changes sign at p̄ = {lost:.3f}.",
        ),
    )


def _trend(line: Series, up_to: float, size: bool = True) -> float:
    """Return +1 or −1 for a monotonic |y| (or y) over 0 to a load, 0 for neither."""
    inside = line.y[(line.x <= up_to) & np.isfinite(line.y)]
    steps = np.diff(np.abs(inside) if size else inside)
    return 1.0 if (steps >= -1e-12).all() else -1.0 if (steps <= 1e-12).all() else 0.0


def _first_zero(line: Series) -> float:
    """Return the first load at which a line crosses zero, NaN where it does not."""
    real = np.isfinite(line.y)
    x, y = line.x[real], line.y[real]
    crossings = np.flatnonzero(np.sign(y[1:]) != np.sign(y[:-1]))
    if not crossings.size:
        return float("nan")
    i = int(crossings[0])
    return float(x[i] - y[i] * (x[i + 1] - x[i]) / (y[i + 1] - y[i]))


def read_figure_8(panels: Panels, rotor: ShaftDisk) -> tuple[Statement, ...]:
    """Return the reading of Fig. 8."""
    buckling = float(critical_load(rotor.shear))
    rest, spinning = panels[0], panels[-1]
    axial, follower = "axial force", "follower force"
    symmetric = all(
        np.allclose(
            rest.boundary(group, f"{n}F").y, -rest.boundary(group, f"{n}B").y, equal_nan=True
        )
        for group in (axial, follower)
        for n in (1, 2)
    )
    fall = all(_trend(rest.boundary(axial, mode), buckling) < 0 for mode in ("1F", "2F"))
    rise = _trend(rest.boundary(follower, "1F"), buckling) > 0
    both = all(_trend(spinning.boundary(axial, mode), buckling) < 0 for mode in ("1F", "1B"))
    forward = spinning.boundary(follower, "1F")
    backward = spinning.boundary(follower, "1B")
    at = float(np.interp(buckling, forward.x, forward.y))
    low = float(np.interp(buckling, backward.x, backward.y))
    slow = lumped(rotor, 1.0, tangency=1.0)
    slow_forward = [float(boundary_frequencies(slow, load, 0.0)[1]) / 2 for load in (0.0, buckling)]
    crossing = _first_zero(spinning.boundary(axial, "1B"))
    # a line has a gap where its frequency is complex; the last sample before it is the meeting
    gaps = [(line.x, np.isnan(line.y)) for line in rest.group(follower) if np.isnan(line.y).any()]
    met = min((float(x[max(int(gap.argmax()) - 1, 0)]) for x, gap in gaps), default=np.inf)
    return (
        Statement(
            f"{rest.title}: all curves are symmetric about ω̄ = 0.",
            "Forward and backward frequencies are "
            + say(symmetric, "equal in size.", "not equal in size."),
            judge(symmetric),
        ),
        Statement(
            f"{rest.title}: both frequencies decrease with the axial load; the first increases "
            "with the follower load.",
            f"Up to the buckling load: {say(fall, 'true', 'not true')} of the axial, "
            f"{say(rise, 'true', 'not true')} of the follower load."
            + say(bool(gaps), f" Under the follower load 1 and 2 meet at p̄ = {met:.4f}.", ""),
            judge(fall, rise),
        ),
        Statement(
            f"{spinning.title}: 1F and 1B decrease with the axial load until it exceeds 2.3558.",
            say(both, "Both fall", "Not both fall")
            + f" in size; 1B reaches ω̄ = 0 at p̄ = {crossing:.4f}.",
            judge(both),
            "There the linear coefficients buckle; p̄_cr is the exact buckling load "
            f"{buckling:.4f}.",
        ),
        Statement(
            f"{spinning.title}: with the follower load 1F increases and 1B decreases.",
            f"From p̄ = 0 to p̄_cr 1B goes from {backward.y[0]:.4f} to {low:.4f}, 1F from "
            f"{forward.y[0]:.4f} to {at:.4f}.",
            judge(
                _trend(forward, buckling) > 0,
                _trend(backward, buckling, size=False) < 0,
            ),
            f"At Ω̄ = 1, 1F goes from {slow_forward[0]:.4f} to {slow_forward[1]:.4f}. A fall at "
            f"{spinning.title} is what the text's own reading of Fig. 7(c), “shifted inwardly”, "
            "needs.",
        ),
    )
