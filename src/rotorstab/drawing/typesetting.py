"""Texts of a printed panel: symbols as mathematics, title, and labels beside their points."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..charts import Chart

__all__ = ["finish_panel", "mathtext"]

_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₙₜ", "0123456789nt")
_INDEX = r"([₀-₉ₙₜ]*)(?:_(cr|[0DPdefinst])\b)?"  # as Unicode, or after an underscore
_BARRED = re.compile("(.)\u0304" + _INDEX)
_PLAIN = re.compile(r"([αβζμωIMPf])(?=[₀ₙₜ_])" + _INDEX)
_ROUNDING = 1e-9  # of a range
_TONGUE = "tongue"  # label of the layer whose names stand out from the areas below them


@dataclass(frozen=True)
class _Place:
    """Where a label stands: its offset from the point [pt] and its alignment."""

    dx: float
    dy: float
    horizontal: str
    vertical: str


_PLACES: Mapping[str, _Place] = {
    "left": _Place(-4, 0, "right", "center"),
    "right": _Place(4, 0, "left", "center"),
    "upper left": _Place(-4, 3, "right", "bottom"),
    "lower left": _Place(-4, -3, "right", "top"),
    "upper right": _Place(4, 3, "left", "bottom"),
    "lower right": _Place(4, -9, "left", "bottom"),
    "frame top left": _Place(-1, 2, "right", "bottom"),
    "frame top right": _Place(1, 2, "left", "bottom"),
    "foot": _Place(3, 0, "left", "bottom"),
    "upright": _Place(3, 0, "left", "bottom"),
}


def mathtext(text: str) -> str:
    """Return the text with barred, indexed and Greek symbols as Matplotlib mathtext."""
    text = text.replace("$", r"\$")  # a pin's name may have any sign
    text = text.replace("Ī", "I\u0304")
    text = _PLAIN.sub(lambda m: _symbol(m[1], m[2], m[3]), text)
    text = _BARRED.sub(lambda m: _symbol(rf"\bar{{{m[1]}}}", m[2], m[3]), text)
    return text.replace("e^σt", r"$e^{σt}$")


def _symbol(letter: str, index: str, word: str | None) -> str:
    """Return a letter with its index as mathtext; a letter without index stays text."""
    index = index.translate(_SUBSCRIPTS) + (word or "")
    if not index and not letter.startswith("\\"):
        return letter
    return f"${letter}_{{{index}}}$" if index else f"${letter}$"


def finish_panel(axes: Any, panel: Chart) -> None:
    """Give Matplotlib axes their frame, their title and the labels of a panel."""
    title = mathtext(f"({panel.letter}) {panel.title}") if panel.letter else ""
    axes.set_title(title, pad=12 if panel.regions else 6)
    axes.set_aspect("auto")
    axes.tick_params(direction="in", top=True, right=True)
    axes.spines[:].set_visible(True)
    low, high = panel.y_range
    for layer in panel.of_kind("labels"):
        keys = ("x", "y", "name", "side")
        for x, y, text, side in zip(*(layer.columns[key] for key in keys), strict=True):
            if not (_within(x, panel.x_range) and _within(y, panel.y_range)):
                continue  # the chart is zoomed in
            place = _PLACES[side]
            # a label just under the frame would touch it
            touches = place.vertical == "bottom" and high - 0.06 * (high - low) < y < high
            axes.annotate(
                text,
                (x, y),
                xytext=(place.dx, place.dy),
                textcoords="offset points",
                ha=place.horizontal,
                va="top" if touches else place.vertical,
                rotation=90 if side == "upright" else 0,
                fontsize=7.0,
                annotation_clip=None if layer.label == _TONGUE else False,
                **_weight(layer.label == _TONGUE, on_colours=bool(panel.of_kind("map"))),
            )


def _within(value: float, limits: tuple[float, float]) -> bool:
    """Whether a place lies in a range or on its ends, but for rounding."""
    low, high = limits
    room = _ROUNDING * (high - low)
    return low - room <= value <= high + room


def _weight(strong: bool, on_colours: bool) -> dict[str, Any]:
    """Return the look of a label: one that must stand out from what lies below it has a halo."""
    look = {"color": "#222222", "fontweight": "bold"} if strong else {"color": "#444444"}
    if not (strong or on_colours):
        return look
    from matplotlib.patheffects import withStroke

    return look | {"path_effects": [withStroke(linewidth=2.2, foreground="white")]}
