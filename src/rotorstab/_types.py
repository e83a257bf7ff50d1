"""Types of the arrays that the solver passes around."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["AnyArray", "Array", "ArrayLike", "Complex", "Index", "Mask"]

Array: TypeAlias = NDArray[np.float64]
"""Real numbers."""

Complex: TypeAlias = NDArray[np.complex128]
"""Complex numbers."""

AnyArray: TypeAlias = NDArray[Any]
"""Real numbers without damping, complex numbers with damping."""

Mask: TypeAlias = NDArray[np.bool_]
"""True or false for each entry."""

Index: TypeAlias = NDArray[np.intp]
"""Positions in another array."""
