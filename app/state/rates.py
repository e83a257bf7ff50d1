"""One non-dimensional unit of frequency in the units that the page writes."""

from __future__ import annotations

import math

from rotorstab import Scales

__all__ = ["hertz", "rpm"]


def hertz(scales: Scales) -> float:
    """Return one unit of frequency [Hz]."""
    return scales.frequency / (2 * math.pi)


def rpm(scales: Scales) -> float:
    """Return one unit of spin speed [revolutions per minute]."""
    return 60 * hertz(scales)
