"""What Floquet's method and Bolotin's say of one pixel, and whether they agree."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from .._types import Array, Mask

__all__ = ["Agreement", "agreement"]


class Agreement(IntEnum):
    """The answers of both methods on one pixel of the instability chart."""

    NEITHER = 0
    FLOQUET_ONLY = 1
    BOLOTIN_ONLY = 2
    BOTH = 3
    NOT_COMPUTED = 4

    @property
    def words(self) -> str:
        """What a reader of the chart is told."""
        return _WORDS[self]


_WORDS = {
    Agreement.NEITHER: "stable by both",
    Agreement.FLOQUET_ONLY: "Floquet: unstable, Bolotin: no region",
    Agreement.BOLOTIN_ONLY: "Floquet: stable, Bolotin region",
    Agreement.BOTH: "both: unstable",
    Agreement.NOT_COMPUTED: "not computed",
}


def agreement(growth: Array, unstable: Mask, bolotin: Mask | None) -> NDArray[np.uint8]:
    """Return the `Agreement` of each pixel.

    Parameters
    ----------
    growth : (R, C) float
        Growth rate; a pixel without a finite one is not computed.
    unstable : (R, C) bool
        Whether Floquet's method finds the rotor unstable.
    bolotin : (R, C) bool or None
        Whether the pixel lies in a Bolotin region; None where there is none to compare with.

    Returns
    -------
    (R, C) uint8
        Values of `Agreement`.
    """
    found = np.where(unstable, Agreement.FLOQUET_ONLY, Agreement.NEITHER)
    if bolotin is not None:
        found[bolotin] = np.where(unstable, Agreement.BOTH, Agreement.BOLOTIN_ONLY)[bolotin]
    found[~np.isfinite(growth)] = Agreement.NOT_COMPUTED
    return found.astype(np.uint8)
