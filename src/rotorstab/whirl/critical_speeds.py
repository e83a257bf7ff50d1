"""Critical speeds: spin speeds at which a whirl is synchronous with the rotation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eig

from .._arguments import number
from .._numerics.roots import is_real
from .._tolerances import NEGLIGIBLE
from .._types import AnyArray, Array, Mask
from ..model.system import System
from .mode_names import kinetic_energy

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
        If the load is not finite, or past the pole of the stiffness, or the coordinates rotate.

    Notes
    -----
    With ω = ±Ω̄ the determinant of `whirl_frequencies` is det[K − Ω̄²(M ∓ H)]: a generalised
    eigenvalue problem whose positive real eigenvalues are Ω̄². A disk with Ī_P > Ī_D has no forward
    critical speed of its second mode. With two planes the determinant is one of both directions,
    and the orbit of each shape tells its direction.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> speeds = critical_speeds(lumped(ShaftDisk(), 0.0))
    >>> speeds.forward.size, speeds.backward.size
    (1, 2)
    """
    if system.is_rotating:
        raise ValueError("`system` must have coordinates at rest, got rotating ones")
    stiffness = system.load_stiffness(number("load", load))
    ahead, shapes = _synchronous_speeds(stiffness, system.mass - system.gyroscopic)
    if system.planes:
        forward = _whirls_forward(system, shapes)
        return CriticalSpeeds(ahead[forward], ahead[~forward])
    behind, _ = _synchronous_speeds(stiffness, system.mass + system.gyroscopic)
    return CriticalSpeeds(ahead, behind)


def _synchronous_speeds(stiffness: Array, inertia: Array) -> tuple[Array, AnyArray]:
    """Return the positive Ω̄ (k,), ascending, at which K − Ω̄²(M ∓ H) is singular, and shapes (n, k).

    With ω = −Ω̄ in place of Ω̄ the sign before H changes.
    """
    # 1/Ω̄² is the eigenvalue, so that a singular M ∓ H gives 0 and not infinity
    inverse_squares, shapes = eig(inertia, stiffness, check_finite=False)
    with np.errstate(invalid="ignore"):
        size = np.abs(inverse_squares)
        real = is_real(inverse_squares)
    smallest = NEGLIGIBLE * size[np.isfinite(size)].max(initial=0.0)
    kept = np.flatnonzero(real & (inverse_squares.real > smallest))
    kept = kept[np.argsort(-inverse_squares.real[kept])]
    return 1 / np.sqrt(inverse_squares.real[kept]), shapes[:, kept]


def _whirls_forward(system: System, shapes: AnyArray) -> Mask:
    """Tell which synchronous shapes (n, k) of two planes go round with the spin."""
    half = system.size // 2
    first, second = shapes[:half], shapes[half:]
    return np.asarray(
        kinetic_energy(system, first + second) > kinetic_energy(system, first - second)
    )
