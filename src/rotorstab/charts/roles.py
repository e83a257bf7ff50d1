"""How the lines and points of one meaning look; they are never told apart by colour alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

__all__ = ["ROLES", "STYLES", "UNSTABLE", "Role", "Shape", "Style"]

Style = Literal["solid", "dashed", "dashdot", "dotted"]
STYLES: tuple[Style, ...] = ("solid", "dashed", "dashdot", "dotted")
"""Line styles of the paper's captions, each also the name of a role."""
Shape = Literal["diamond", "circle", "ring", "triangle", "square", "cross"]


@dataclass(frozen=True)
class Role:
    """How lines or points of one meaning look.

    Parameters
    ----------
    color : str
        Hexadecimal RGB.
    dash : str
        "solid", or the lengths of dashes and gaps in pixels, for the screen.
    width : float
        In pixels, for the screen.
    meaning : str
        The text of a legend; empty where the legend names the line's own group.
    style : {"solid", "dashed", "dashdot", "dotted"}
        The line style in print and in tables.
    si_meaning : str
        The meaning in a chart in SI, where its symbols differ.
    shape : {"diamond", "circle", "ring", "triangle", "square", "cross"}
        Of points.
    size : float
        Of points, in pixels, for the screen.
    """

    color: str
    dash: str
    width: float
    meaning: str
    style: Style = "solid"
    si_meaning: str = ""
    shape: Shape = "diamond"
    size: float = 10.0


# Each colour has a contrast of at least 3:1 on the light and on the dark ground, and one meaning on
# a page: forward and backward whirls, the loads and the pins have colours of their own.
UNSTABLE = "#9a4fd0"
"""Colour of what grows: edges of tongues, growing whirls, multipliers outside the unit circle."""
MARKED = "#d93a72"
"""Colour of the marked point, of its motion and of its multipliers that do not grow."""
PRESENT = "#0f8a6a"
"""Colour of the present setting."""
NEUTRAL = "#80868f"
"""Colour of lines to compare with: limits, levels, the unit circle."""
ROLES: Mapping[str, Role] = {
    "backward": Role("#1f7fbf", "9 5", 2.2, "backward whirl (B)", "dashed"),
    "forward": Role("#cf5a12", "solid", 2.2, "forward whirl (F)"),
    "axial": Role("#758600", "solid", 2.2, "axial load"),
    "follower": Role("#b84f9e", "9 5", 2.2, "follower load", "dashed"),
    "partly": Role("#8a7560", "8 4 2 4", 2.0, "partly follower load", "dashdot"),
    "partly exact": Role(
        "#8a7560", "12 3 2 3 2 3", 2.0, "partly follower, exact stiffness", "dashdot"
    ),
    "axial exact": Role("#758600", "12 3 2 3", 2.0, "axial, exact stiffness", "dashdot"),
    "follower exact": Role("#b84f9e", "2 4 8 4", 1.6, "follower, exact stiffness", "dashdot"),
    "edge": Role(UNSTABLE, "solid", 1.3, "edge of a tongue (Floquet)"),
    "growing": Role(
        UNSTABLE, "2 4", 2.6, "Re ω̄ of a whirl that grows", "dotted", "Re ω of a whirl that grows"
    ),
    "synchronous": Role(
        NEUTRAL, "8 4 2 4", 1.4, "synchronous, |ω̄| = Ω̄", "dashdot", "synchronous, |ω| = Ω"
    ),
    "current": Role(PRESENT, "solid", 1.8, "present setting"),
    "exact": Role("#1f7fbf", "solid", 2.2, "exact (Appendix A)"),
    "linear": Role("#cf5a12", "9 5", 2.2, "linear (Appendix B)", "dashed"),
    "k11": Role("#12889b", "solid", 2.2, "k̄₁₁, k̄₁₂ and k̄₂₁: one curve"),
    "k22": Role("#b84f9e", "8 4 2 4", 2.2, "k̄₂₂", "dashdot"),
    "level": Role(NEUTRAL, "9 5", 1.4, "1 % and 5 %", "dashed"),
    "unit circle": Role(NEUTRAL, "solid", 1.6, "unit circle"),
    "tip V": Role(MARKED, "solid", 1.5, "V of the tip"),
    "tip W": Role("#6b7a90", "6 3", 1.5, "W of the tip", "dashdot"),
    "envelope": Role(UNSTABLE, "9 5", 1.6, "envelope e^σt", "dashed"),
    "orbit": Role(MARKED, "solid", 1.1, "path of the tip"),
    "marker": Role(
        MARKED,
        "solid",
        4.0,
        "marked point, and θ̄ between two whirls",
        si_meaning="marked point, and θ/2π between two whirls",
        shape="ring",
        size=16.0,
    ),
    # points alone
    "place": Role(PRESENT, "solid", 1.8, ""),
    "multiplier": Role(MARKED, "solid", 1.0, "", shape="circle", size=11.0),
    "growing multiplier": Role(UNSTABLE, "solid", 1.0, "", shape="triangle", size=14.0),
    "minus one": Role(NEUTRAL, "solid", 3.0, "", shape="cross", size=14.0),
    "start": Role(PRESENT, "solid", 1.0, "", shape="circle"),
    "end": Role(MARKED, "solid", 1.0, "", shape="square", size=9.0),
    "pin 1": Role("#7a6fd8", "3 3", 1.6, "first pin", "dashdot"),
    "pin 2": Role("#96693a", "7 3", 1.6, "second pin", "dashdot"),
    "pin 3": Role("#2f8f8f", "7 3 2 3", 1.6, "third pin", "dashdot"),
    "limit": Role(NEUTRAL, "9 5", 1.4, "buckling or flutter load", "dashed"),
    # parts of a rotor, and the whirl of one whose bearings differ in two directions
    "shaft": Role(NEUTRAL, "solid", 1.2, "shaft"),
    "disk": Role("#96693a", "solid", 1.4, "disk"),
    "bearing": Role("#7a6fd8", "solid", 1.4, "bearing"),
    "clamp": Role("#6b7a90", "solid", 1.4, "clamp"),
    "load": Role("#758600", "solid", 2.2, "axial load"),
    "axis": Role(NEUTRAL, "12 3 2 3", 1.0, "axis of rotation", "dashdot"),
    "straight": Role("#2f8f8f", "7 3 2 3", 2.0, "whirl on a straight line (S)", "dashdot"),
    "estimate": Role(UNSTABLE, "4 4", 1.2, "first-order estimate of a tongue", "dotted"),
    # variants of a figure of the paper: the style alone tells them apart in grey print
    "solid": Role("#1f7fbf", "solid", 2.0, ""),
    "dashed": Role("#cf5a12", "8 4", 2.0, "", "dashed"),
    "dashdot": Role("#0f8a6a", "9 3 2 3", 2.0, "", "dashdot"),
    "dotted": Role("#b84f9e", "2 2", 2.0, "", "dotted"),
}
