"""A system reduced to what the slow whirls of one chart need.

The reduction of `rotorstab.model.rotor_reduction` serves every spin speed and load of a rotor. That
of a chart serves one spin speed and the loads of the chart, so it needs fewer coordinates.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..._numerics.chebyshev import chebyshev_nodes
from ...model.reduction import whirl_shapes
from ...model.system import System, single_speed

__all__ = ["SlowSystems", "slow_systems"]

_LOADS = 3  # at which the shapes of the slow whirls are taken
_NEGLECTED = (
    5e-5  # directions of a shape that are smaller than this part of the largest are left out
)
_SLOWEST = 1e-9  # frequency that stands for slower ones; the sizes of the shapes are not used


class SlowSystems(NamedTuple):
    """A system in the coordinates that the slow whirls of one chart need.

    Parameters
    ----------
    reduced : System
        The system itself where it has no more coordinates than they need.
    rougher : System or None
        With one coordinate less; None where nothing is reduced.
    gain : float
        By about this factor the error of `reduced` is smaller than that of `rougher`.
    """

    reduced: System
    rougher: System | None = None
    gain: float = 0.0


@lru_cache(maxsize=16)
def slow_systems(
    system: System, static_load: float, largest_load: float, whirls: int
) -> SlowSystems:
    """Return a system reduced to the leading directions of its slow whirls under some loads.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load, largest_load : float
        p̄₀ and the largest p̄_t of the chart [EI/L²].
    whirls : int
        How many of the slowest whirls are kept, half of them of each direction.

    Returns
    -------
    SlowSystems

    Notes
    -----
    Right and left eigenvectors are taken, for under a follower load a projection needs both. Their
    errors are about the squares of what the basis leaves out.
    """
    if not system.is_linear:
        return SlowSystems(system)
    swing = largest_load * system.pulsation.largest
    loads = chebyshev_nodes(_LOADS, static_load - swing, static_load + swing)
    shapes = whirl_shapes(system, loads, [single_speed(system)], whirls // 2, _SLOWEST)
    if not np.isfinite(shapes).all():
        return SlowSystems(system)
    factor = np.linalg.cholesky(system.mass).T
    directions, sizes, _ = np.linalg.svd(factor @ shapes)
    count = max(whirls // 2 + 1, int((sizes > _NEGLECTED * sizes[0]).sum()))
    if count >= system.size:
        return SlowSystems(system)
    reduced, rougher = (
        system.projected(np.linalg.solve(factor, directions[:, :size]))
        for size in (count, count - 1)
    )
    gain = float(sizes[count] / sizes[count - 1]) if count < len(sizes) else 0.0
    return SlowSystems(reduced, rougher, gain)
