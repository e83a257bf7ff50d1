"""What the motion at a point does in the long run."""

from __future__ import annotations

from enum import Enum

from rotorstab import FloquetSolution, is_unstable

__all__ = ["Motion", "motion_of"]


class Motion(Enum):
    """What the motion at a point does in the long run."""

    GROWS = "grows"
    DECAYS = "decays"
    NEITHER = "neither"


def motion_of(solution: FloquetSolution) -> Motion:
    """Return whether the motion at one point grows, decays, or neither within the error."""
    if solution.unstable:
        return Motion.GROWS
    # the mirror image: a decay that exceeds its error
    decays = is_unstable(-solution.growth_rate, solution.error)
    return Motion.DECAYS if decays else Motion.NEITHER
