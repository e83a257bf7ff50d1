"""What the animation of the shaft draws, as plain values for the browser."""

from __future__ import annotations

import math
from base64 import b64encode
from typing import Any

import numpy as np

from rotorstab import Scales, TimeResponse, shaft_shape
from rotorstab._tolerances import CURVES_SHORT_OF_POLE
from rotorstab.model.stiffness import largest_exact_load

from ..results.marked_point import EDGE, Point
from ..words.si import load_in

__all__ = ["animation", "mean_angular_speed"]

_SHAPE_POINTS = 25  # points along the shaft
_LARGEST_LOG = 600.0  # of a factor that is still a double
_LARGEST = 1e6  # beyond the edge; a motion may grow much more between two samples


def animation(
    point: Point, response: TimeResponse, samples: int, scales: Scales | None
) -> dict[str, Any]:
    """Return what the animation draws, displacements relative to `EDGE`, up to which they go."""
    load, unit = (1.0, "") if scales is None else load_in(scales)
    operation, (static, pulsating) = point.operation, point.loads
    rotor = operation.model.rotor
    pole = float(largest_exact_load(rotor.shear))
    load_of_shape = min(static, (1 - CURVES_SHORT_OF_POLE) * pole)
    shapes = shaft_shape(rotor, load_of_shape, np.eye(2), _SHAPE_POINTS).displacement
    shown = response.until(EDGE)
    scale = math.exp(min(response.log_scale, _LARGEST_LOG)) / EDGE
    tip, slope = shown.displacement * scale, shown.slope * scale
    return {
        "tip": _floats([tip.real, tip.imag, slope.real, slope.imag]),
        "edge": EDGE,
        "cut": bool(abs(tip[-1]) > 1),
        "shapes": [[round(float(value), 6) for value in row] for row in shapes],
        "samples": samples,
        "period": response.period,
        "growth": response.growth_rate,
        "static": static * load,
        "pulsating": pulsating * load,
        "load": ["P", f" {unit}"] if unit else ["p̄", ""],
        "tangency": operation.tangency,
        "spin": operation.spin_speed,
        "fastest": float(max(point.excitation, mean_angular_speed(shown))),
        "seconds": None if scales is None else response.period / scales.frequency,
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
    bounded = np.clip(values, -_LARGEST, _LARGEST)
    return b64encode(np.ascontiguousarray(bounded, "<f4").tobytes()).decode()
