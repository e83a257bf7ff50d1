"""Critical speeds: spin speeds at which a whirl is synchronous with the rotation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigvals

from .._arguments import number
from .._numerics.roots import is_real
from .._tolerances import NEGLIGIBLE
from .._types import Array
from ..model.system import System

__all__ = ["CriticalSpeeds", "critical_speeds"]


@dataclass(frozen=True, eq=False)
class CriticalSpeeds:
    """Spin speeds at which a whirl is synchronous, ω = Ω̄ or ω = −Ω̄.

    Parameters
    ----------
    forward, backward : (k,) float
        Ω̄, ascending [√(EI/(ρAL⁴))].
    """

    forward: Array
    backward: Array


def critical_speeds(system: System, load: float = 0.0) -> CriticalSpeeds:
    """Return the spin speeds at which an undamped whirl is synchronous, ω = ±Ω̄.

    Parameters
    ----------
    system : System
        Its own spin speed and damping are not used.
    load : float
        p̄ [EI/L²].

    Returns
    -------
    CriticalSpeeds

    Raises
    ------
    ValueError
        If the load is not finite, or past the pole of the stiffness.

    Notes
    -----
    With ω = ±Ω̄ the determinant of `whirl_frequencies` is det[K − Ω̄²(M ∓ H)]: a generalised
    eigenvalue problem whose positive real eigenvalues are Ω̄². A disk with Ī_P > Ī_D has no forward
    critical speed of its second mode.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> speeds = critical_speeds(lumped(ShaftDisk(), 0.0))
    >>> speeds.forward.size, speeds.backward.size
    (1, 2)
    """
    stiffness = system.load_stiffness(number("load", load))
    return CriticalSpeeds(
        forward=_synchronous_speeds(stiffness, system.mass - system.gyroscopic),
        backward=_synchronous_speeds(stiffness, system.mass + system.gyroscopic),
    )


def _synchronous_speeds(stiffness: Array, inertia: Array) -> Array:
    """Return the positive Ω̄, ascending, at which K − Ω̄²(M ∓ H) is singular."""
    # 1/Ω̄² is the eigenvalue, so that a singular M ∓ H gives 0 and not infinity
    inverse_squares = eigvals(inertia, stiffness, check_finite=False)
    with np.errstate(invalid="ignore"):
        size = np.abs(inverse_squares)
        real = is_real(inverse_squares)
    smallest = NEGLIGIBLE * size[np.isfinite(size)].max(initial=0.0)
    squares = inverse_squares.real[real & (inverse_squares.real > smallest)]
    return np.sort(1 / np.sqrt(squares))
