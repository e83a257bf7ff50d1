"""What the motion at a point does, and which growth the page shows."""

from __future__ import annotations

from enum import Enum

from rotorstab._tolerances import SMALLEST_GROWTH
from rotorstab.floquet.point import FloquetSolution

__all__ = ["Motion", "motion_of", "shows_growth"]

_SHOWN = 1e-9  # imaginary part of a whirl frequency from which on it is shown


class Motion(Enum):
    """What the motion at a point does in the long run."""

    GROWS = "grows"
    DECAYS = "decays"
    NEITHER = "neither"


def motion_of(solution: FloquetSolution) -> Motion:
    """Return whether the motion at one point grows, decays, or neither within the error."""
    if solution.unstable:
        return Motion.GROWS
    certain = max(SMALLEST_GROWTH, float(solution.error))
    return Motion.DECAYS if float(solution.growth_rate) < -certain else Motion.NEITHER


def shows_growth(imaginary: float) -> bool:
    """Whether the growth or decay of a whirl frequency is shown beside its real part."""
    return abs(imaginary) > _SHOWN
