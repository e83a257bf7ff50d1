"""When a growth rate counts as growth, for every word and number of the page."""

from __future__ import annotations

from enum import Enum

from rotorstab.floquet.point import FloquetSolution

__all__ = ["NEGLIGIBLE_GROWTH", "Motion", "motion_of", "shows_growth"]

NEGLIGIBLE_GROWTH = 1e-8
"""Growth rate [√(EI/(ρAL⁴))] below which rounding explains all of it."""
_ERRORS = 3  # estimated errors by which growth must exceed 0 at a point
_SHOWN = 1e-9  # imaginary part of a whirl frequency from which on it is shown


class Motion(Enum):
    """What the motion at a point does in the long run."""

    GROWS = "grows"
    DECAYS = "decays"
    NEITHER = "neither"


def motion_of(solution: FloquetSolution) -> Motion:
    """Return whether the motion at one point grows, decays, or neither within the error."""
    growth = float(solution.growth_rate)
    certain = max(NEGLIGIBLE_GROWTH, _ERRORS * float(solution.error))
    if growth > certain:
        return Motion.GROWS
    return Motion.DECAYS if growth < -certain else Motion.NEITHER


def shows_growth(imaginary: float) -> bool:
    """Whether the growth or decay of a whirl frequency is shown beside its real part."""
    return abs(imaginary) > _SHOWN
