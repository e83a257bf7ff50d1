"""Which points of the load–frequency plane lie in a Bolotin region, P < 0 in Eq. (24)."""

from __future__ import annotations

import numpy as np

from .._arguments import number, numbers, series
from .._numerics.roots import is_real
from .._types import ArrayLike, Mask
from ..model.system import System
from .boundaries import boundary_squares, mean_and_half_swing

__all__ = ["bolotin_mask", "in_bolotin_region"]


def in_bolotin_region(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    excitation_frequency: ArrayLike,
) -> Mask:
    """Return whether points lie in a Bolotin region: P(λ) < 0 in Eq. (24), λ = θ̄²/4.

    Parameters
    ----------
    system : System
        Undamped. Its spin speed broadcasts against the other arguments.
    static_load, pulsating_load : (...) float
        p̄₀ and p̄_t [EI/L²].
    excitation_frequency : (...) float
        θ̄ [√(EI/(ρAL⁴))], 0 or more.

    Returns
    -------
    (...) bool

    Raises
    ------
    ValueError
        If the system is damped, or an argument is not finite or past the pole of the exact
        stiffness.

    Notes
    -----
    The answer is not a statement about stability: at Ω̄ ≠ 0 a rotor is stable in parts of a
    Bolotin region. Use `growth_rate` for that.

    References
    ----------
    Eq. (24) of the source paper.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> bool(in_bolotin_region(lumped(ShaftDisk(), 0.0), 0.0, 1.0, 1.3))
    True
    """
    _refuse_damping(system)
    half = numbers("excitation_frequency", excitation_frequency, 0.0)[..., None, None] / 2
    static = numbers("static_load", static_load)
    pulsating = numbers("pulsating_load", pulsating_load)
    mean, swing, y = mean_and_half_swing(system, static, pulsating)
    shift = y[..., None, None] * swing
    inertia = half**2 * system.mass
    # Eq. (24) after b → jb
    minus, plus, coupling = np.broadcast_arrays(
        mean - shift - inertia, mean + shift - inertia, -half * system.spin_matrix()
    )
    rows = [np.concatenate(pair, axis=-1) for pair in ((minus, coupling), (coupling, plus))]
    return np.asarray(np.linalg.det(np.concatenate(rows, axis=-2)) < 0)


def bolotin_mask(
    system: System,
    static_load: float,
    pulsating_loads: ArrayLike,
    excitation_frequencies: ArrayLike,
) -> Mask:
    """Return which points of a grid lie in a Bolotin region.

    Parameters
    ----------
    system : System
        Undamped, with one spin speed.
    static_load : float
        p̄₀ [EI/L²].
    pulsating_loads : (R,) float
        p̄_t [EI/L²].
    excitation_frequencies : (C,) float
        θ̄ [√(EI/(ρAL⁴))], 0 or more.

    Returns
    -------
    (R, C) bool
        As `in_bolotin_region` on the grid, from the boundaries of each row: the cost is that of R
        calls of `boundary_frequencies`.

    Raises
    ------
    ValueError
        If the system is damped, or an argument is not finite or past the pole of the exact
        stiffness.
    """
    _refuse_damping(system)
    static = np.asarray(number("static_load", static_load))
    loads = series("pulsating_loads", pulsating_loads)
    level = (series("excitation_frequencies", excitation_frequencies, 0.0) / 2) ** 2
    squares = boundary_squares(system, static, loads)
    # P is positive below its first real root and changes its sign at every one
    roots = np.where(is_real(squares), squares.real, np.inf)
    passed = (roots[:, None, :] < level[:, None]).sum(axis=-1)
    return np.asarray(passed % 2 == 1)


def _refuse_damping(system: System) -> None:
    """Raise ValueError if the system is damped: P is real for undamped systems only."""
    if system.is_damped:
        raise ValueError("`system` must be undamped for the sign of Eq. (24), got a damped one")
