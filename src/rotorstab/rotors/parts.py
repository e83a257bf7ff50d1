"""What stands on the shaft and acts on it, in SI units: disks, bearings, the axial load.

The rotor lies along x and spins from its direction V to its direction W; `kxx` acts in the first,
`kyy` in the second, as in the field's bearing coefficients.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._types import Array
from .fields import normalise

__all__ = ["AxialLoad", "Bearing", "Disk"]

_LARGEST_INERTIA = 1e12  # of a mass [kg] or a moment of inertia [kg m²]
_LARGEST_COEFFICIENT = 1e18  # of a bearing, either sign [N/m, N s/m]


@dataclass(frozen=True)
class Disk:
    """A rigid disk, or another mass without length, on the shaft.

    Parameters
    ----------
    position : float
        Distance from the left end [m].
    mass : float
        [kg], 0 or more.
    diametral_inertia, polar_inertia : float
        I_D and I_P [kg m²], 0 or more. A rigid body has I_P ≤ 2 I_D; this is not enforced.

    Raises
    ------
    ValueError
        If a value is not finite or out of range.
    """

    position: float
    mass: float
    diametral_inertia: float
    polar_inertia: float

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        inertia = (0.0, _LARGEST_INERTIA)
        normalise(
            self,
            {
                "position": (0.0, math.inf),
                "mass": inertia,
                "diametral_inertia": inertia,
                "polar_inertia": inertia,
            },
        )


@dataclass(frozen=True)
class Bearing:
    """A bearing or a seal: springs and dampers between shaft and ground at one position.

    Its force on the shaft is −k (x, y) − c (ẋ, ẏ) with the matrices [[kxx, kxy], [kyx, kyy]] and
    [[cxx, cxy], [cyx, cyy]].

    Parameters
    ----------
    position : float
        Distance from the left end [m].
    kxx, kyy, kxy, kyx : float
        Stiffness [N/m]; `kyy` is as `kxx` by default. Negative values are allowed.
    cxx, cyy, cxy, cyx : float
        Damping [N s/m]; `cyy` is as `cxx` by default.

    Raises
    ------
    ValueError
        If a value is not finite or out of range.
    """

    position: float
    kxx: float
    kyy: float | None = None
    kxy: float = 0.0
    kyx: float = 0.0
    cxx: float = 0.0
    cyy: float | None = None
    cxy: float = 0.0
    cyx: float = 0.0

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        for name, other in (("kyy", self.kxx), ("cyy", self.cxx)):
            if getattr(self, name) is None:
                object.__setattr__(self, name, other)
        coefficient = (-_LARGEST_COEFFICIENT, _LARGEST_COEFFICIENT)
        names = ("kxx", "kyy", "kxy", "kyx", "cxx", "cyy", "cxy", "cyx")
        normalise(self, {"position": (0.0, math.inf), **dict.fromkeys(names, coefficient)})

    @property
    def stiffness(self) -> Array:
        """[[kxx, kxy], [kyx, kyy]] [N/m]."""
        return np.array([[self.kxx, self.kxy], [self.kyx, self.kyy]], dtype=np.float64)

    @property
    def damping(self) -> Array:
        """[[cxx, cxy], [cyx, cyy]] [N s/m]."""
        return np.array([[self.cxx, self.cxy], [self.cyx, self.cyy]], dtype=np.float64)

    @property
    def is_isotropic(self) -> bool:
        """Whether the bearing is the same in every direction."""
        return (self.kxx, self.kxy, self.cxx, self.cxy) == (
            self.kyy,
            -self.kyx,
            self.cyy,
            -self.cyx,
        )


@dataclass(frozen=True)
class AxialLoad:
    """Where the longitudinal load acts: the shaft between two stations carries it.

    Compression is positive. How large the load is belongs to each analysis.

    Parameters
    ----------
    start, end : float
        Distances from the left end [m]. At `start` the load is held along the undeformed axis, at
        `end` it is applied; `end` may lie on either side. None is the right end of the shaft.
    tangency : float
        μ [-] of the load at `end`, from 0 (axial: it keeps its direction) to 1 (follower: it stays
        tangential to the shaft).

    Raises
    ------
    ValueError
        If a value is out of range.
    """

    start: float = 0.0
    end: float | None = None
    tangency: float = 0.0

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        normalise(self, {"start": (0.0, math.inf), "tangency": (0.0, 1.0)})
        if self.end is not None:
            normalise(self, {"end": (0.0, math.inf)})
