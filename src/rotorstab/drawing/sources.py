"""A layer in the words of Bokeh: the columns of its data source, and the look of its points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..charts import ROLES, Layer
from ..charts.roles import Shape
from . import contours

__all__ = ["columns", "point_look"]

_SIDES: Mapping[str, Mapping[str, Any]] = {
    "left": {"align": "right", "baseline": "middle", "dx": -5, "dy": 0},
    "right": {"align": "left", "baseline": "middle", "dx": 5, "dy": 0},
    "upper left": {"align": "right", "baseline": "bottom", "dx": -4, "dy": -2},
    "lower left": {"align": "right", "baseline": "top", "dx": -4, "dy": 2},
    "upper right": {"align": "left", "baseline": "bottom", "dx": 5, "dy": -2},
    "lower right": {"align": "left", "baseline": "top", "dx": 5, "dy": 2},
    "frame top left": {"align": "right", "baseline": "top", "dx": -1, "dy": 2},
    "frame top right": {"align": "left", "baseline": "top", "dx": 1, "dy": 2},
    "foot": {"align": "left", "baseline": "bottom", "dx": 3, "dy": 0},
    "upright": {"align": "left", "baseline": "top", "dx": 3, "dy": 0, "angle": math.pi / 2},
}
_MARKERS: Mapping[Shape, str] = {
    "diamond": "diamond",
    "circle": "circle",
    "ring": "circle_dot",
    "triangle": "triangle",
    "square": "square",
    "cross": "x",
}
_STROKE = 3  # width in pixels of a shape without filling


def _thin(width: float) -> float:
    """Return the width of an outline: many of them stand close together."""
    return min(width, ROLES["edge"].width)


def point_look(layer: Layer) -> dict[str, Any]:
    """Return Bokeh's options for the points of a layer; "color" is that of their filling."""
    role = ROLES[layer.role]
    look = {"marker": _MARKERS[role.shape], "size": role.size}
    if role.shape in ("ring", "cross"):
        filling = "white" if role.shape == "ring" else role.color
        return look | {"color": filling, "line_color": role.color, "line_width": _STROKE}
    return look | {"color": role.color, "line_color": "white"}


def columns(layer: Layer) -> dict[str, Any]:
    """Return the Bokeh data-source columns of one layer, by the names HoloViews gives them."""
    data = layer.columns
    if layer.kind == "map":
        return {key: list(value) for key, value in data.items()}
    if layer.kind == "bands":
        found = contours.areas(layer)
        return {
            "xs": [x for _, x, _ in found],
            "ys": [y for _, _, y in found],
            "growth": [growth for growth, _, _ in found],
        }
    if layer.kind == "edges":
        x, y = contours.outline(layer)
        rows = {key: data[key] for key in ("name", "role", "group")}
        return columns(Layer("lines", layer.label, {"xs": [x], "ys": [y], **rows}))
    if layer.kind in ("blanks", "regions"):
        # MultiPolygons nest: polygon, then its outer ring
        return {
            "xs": [[[x]] for x in data["xs"]],
            "ys": [[[y]] for y in data["ys"]],
            "name": list(data["name"]),
        }
    if layer.kind in ("lines", "areas", "outlines"):
        roles = [ROLES[role] for role in data["role"]]
        return {
            "xs": list(data["xs"]),
            "ys": list(data["ys"]),
            "name": list(data["name"]),
            "color": [role.color for role in roles],
            "dash": [role.dash for role in roles],
            "width": [
                _thin(role.width) if layer.kind == "outlines" else role.width for role in roles
            ],
        }
    result = {"x": np.asarray(data["x"]), "y": np.asarray(data["y"]), "name": list(data["name"])}
    if layer.kind == "labels":
        sides = [_SIDES[side] for side in data["side"]]
        keys = ("align", "baseline", "dx", "dy")
        result |= {key: [side[key] for side in sides] for key in keys}
        result["angle"] = [side.get("angle", 0.0) for side in sides]
        if "role" in data:
            result["color"] = [ROLES[role].color for role in data["role"]]
    return result
