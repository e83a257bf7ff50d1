"""What the animation of the shaft draws, as plain values for the browser."""

from __future__ import annotations

from base64 import b64encode
from typing import Any

import numpy as np

from rotorstab import Scales, TimeResponse, shaft_shape
from rotorstab._tolerances import CURVES_SHORT_OF_POLE
from rotorstab.model.stiffness import largest_exact_load

from ..results.marked_point import Point
from ..words.si import load_in

__all__ = ["animation", "mean_angular_speed"]

_SHAPE_POINTS = 25  # points along the shaft


def animation(
    point: Point, response: TimeResponse, samples: int, scales: Scales | None
) -> dict[str, Any]:
    """Return what the animation draws, displacements relative to the largest one."""
    load, unit = (1.0, "") if scales is None else load_in(scales)
    pole = float(largest_exact_load(point.model.rotor.shear))
    load_of_shape = min(point.static, (1 - CURVES_SHORT_OF_POLE) * pole)
    shapes = shaft_shape(point.model.rotor, load_of_shape, np.eye(2), _SHAPE_POINTS).displacement
    largest = float(np.abs(response.displacement).max()) or 1.0
    tip, slope = response.displacement / largest, response.slope / largest
    return {
        "tip": _floats([tip.real, tip.imag, slope.real, slope.imag]),
        "shapes": [[round(float(value), 6) for value in row] for row in shapes],
        "samples": samples,
        "period": response.period,
        "growth": response.growth_rate,
        "largest": largest if response.log_scale == 0 else None,
        "static": point.static * load,
        "pulsating": point.pulsating * load,
        "load": ["P", f" {unit}"] if unit else ["p̄", ""],
        "tangency": point.tangency,
        "spin": point.spin_speed,
        "fastest": float(max(point.excitation, mean_angular_speed(response))),
    }


def mean_angular_speed(response: TimeResponse) -> float:
    """Return the mean angular speed of the tip about the axis, weighted with its displacement."""
    turned = np.angle(np.exp(1j * np.diff(np.angle(response.displacement))))
    size = np.abs(response.displacement[1:])
    # growth may have taken the tip near the end of double precision
    weights = size / (size.max() or 1.0)
    total = float(weights.sum())
    if total == 0:
        return 0.0
    return float(np.abs(turned) @ weights / total / (response.time[1] - response.time[0]))


def _floats(values: Any) -> str:
    """Return numbers as little-endian 32-bit floats in base64."""
    return b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode()
