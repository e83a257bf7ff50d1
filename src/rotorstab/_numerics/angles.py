"""Differences of angles."""

from __future__ import annotations

import numpy as np

from .._types import Array

__all__ = ["wrapped"]


def wrapped(angle: Array) -> Array:
    """Return angles [rad] shifted by whole turns into [−π, π].

    Examples
    --------
    >>> wrapped(np.array([0.5, 2 * np.pi + 0.5])).round(12).tolist()
    [0.5, 0.5]
    """
    return np.asarray(angle - 2 * np.pi * np.round(angle / (2 * np.pi)))
