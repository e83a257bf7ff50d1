"""How the lines of one meaning look; they are never told apart by colour alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

__all__ = ["ROLES", "STYLES", "Role", "Style"]

Style = Literal["solid", "dashed", "dashdot", "dotted"]
STYLES: tuple[Style, ...] = ("solid", "dashed", "dashdot", "dotted")
"""Line styles of the paper's captions, each also the name of a role."""


@dataclass(frozen=True)
class Role:
    """How lines of one meaning look.

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
    printed : str
        Its colour on white paper, where that is another one.
    """

    color: str
    dash: str
    width: float
    meaning: str
    style: Style = "solid"
    printed: str = ""

    @property
    def print_color(self) -> str:
        """Its colour on white paper."""
        return self.printed or self.color


# Okabe–Ito hues, each at least 3:1 on both the light and the dark ground
ROLES: Mapping[str, Role] = {
    "backward": Role("#1f7fbf", "9 5", 2.2, "backward whirl (B)", "dashed"),
    "forward": Role("#cf5a12", "solid", 2.2, "forward whirl (F)"),
    "axial": Role("#1f7fbf", "solid", 2.2, "axial load"),
    "follower": Role("#cf5a12", "9 5", 2.2, "follower load", "dashed"),
    "partly": Role("#0f8a6a", "8 4 2 4", 2.0, "partly follower load", "dashdot"),
    "partly exact": Role(
        "#0f8a6a", "12 3 2 3 2 3", 2.0, "partly follower, exact stiffness", "dashdot"
    ),
    "axial exact": Role("#1f7fbf", "12 3 2 3", 2.0, "axial, exact stiffness", "dashdot"),
    "follower exact": Role("#cf5a12", "2 4 8 4", 1.6, "follower, exact stiffness", "dashdot"),
    "edge": Role("#9a4fd0", "solid", 1.3, "edge of a tongue (Floquet)", printed="#0072B2"),
    "growing": Role("#a8518a", "2 4", 2.6, "Re ω̄ of a whirl that grows", "dotted"),
    "synchronous": Role("#80868f", "8 4 2 4", 1.4, "synchronous, |ω̄| = Ω̄", "dashdot"),
    "current": Role("#0f8a6a", "solid", 1.8, "present setting"),
    "exact": Role("#1f7fbf", "solid", 2.2, "exact (Appendix A)"),
    "linear": Role("#cf5a12", "9 5", 2.2, "linear (Appendix B)", "dashed"),
    "k11": Role("#1f7fbf", "solid", 2.2, "k̄₁₁, k̄₁₂ and k̄₂₁: one curve"),
    "k22": Role("#a8518a", "8 4 2 4", 2.2, "k̄₂₂", "dashdot"),
    "level": Role("#80868f", "9 5", 1.4, "1 % and 5 %", "dashed"),
    "unit circle": Role("#80868f", "solid", 1.6, "unit circle"),
    "tip V": Role("#1f7fbf", "solid", 1.5, "V of the tip"),
    "tip W": Role("#cf5a12", "6 3", 1.5, "W of the tip", "dashdot"),
    "envelope": Role("#80868f", "9 5", 1.6, "envelope e^σt", "dashed"),
    "orbit": Role("#1f7fbf", "solid", 1.1, "path of the tip"),
    "marker": Role("#c2255c", "solid", 4.0, "point looked into, θ̄ as a ruler"),
    "pin 1": Role("#7a6fd8", "3 3", 1.6, "first pin", "dashdot"),
    "pin 2": Role("#9a7b00", "7 3", 1.6, "second pin", "dashdot"),
    "pin 3": Role("#2f8f8f", "7 3 2 3", 1.6, "third pin", "dashdot"),
    "limit": Role("#80868f", "9 5", 1.4, "buckling or flutter load", "dashed"),
    # variants of a figure of the paper: the style alone tells them apart in grey print
    "solid": Role("#0072B2", "solid", 2.0, ""),
    "dashed": Role("#D55E00", "8 4", 2.0, "", "dashed"),
    "dashdot": Role("#00795A", "9 3 2 3", 2.0, "", "dashdot"),
    "dotted": Role("#7A3E73", "2 2", 2.0, "", "dotted"),
}
