"""Higher-order Bolotin boundaries: truncations of Hill's infinite determinant."""

from __future__ import annotations

import numpy as np

from .._arguments import choice, numbers, whole_number
from .._numerics.companion import companion_matrix
from .._numerics.roots import is_real
from .._tolerances import MASSLESS
from .._types import AnyArray, Array, ArrayLike
from ..model.system import System

__all__ = ["hill_boundary_frequencies"]


def hill_boundary_frequencies(
    system: System,
    static_load: ArrayLike,
    pulsating_load: ArrayLike,
    harmonics: int = 1,
    period: str = "2T",
) -> Array:
    """Return θ̄ at which a solution of period 2T or T exists, to a given number of harmonics.

    q = Σ q_m e^{jmθ̄t/2}, m odd (2T) or even (T), |m| ≤ 2·harmonics, makes a block matrix with
    K₀ − (mθ̄/2)²M + j(mθ̄/2)D on its diagonal and K_l/2 off it; θ̄ makes it singular.

    Parameters
    ----------
    system : System
    static_load, pulsating_load : (...) float
        p̄₀ and p̄_t [EI/L²]; broadcast with each other and the spin speed.
    harmonics : int
        1 to 20. One with period 2T is Bolotin's first approximation, Eq. (24).
    period : {"2T", "T"}
        Period of the solution, T = 2π/θ̄.

    Returns
    -------
    (..., 2n·harmonics) float
        Positive θ̄, rising, NaN where a root is not real [√(EI/(ρAL⁴))].

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    At Ω̄ = 0 h harmonics give the first 2T boundary with an error of order p̄_t^{2h}. At
    Ω̄ ≠ 0 such a boundary need not separate stable from unstable, however many the harmonics:
    a multiplier may pass through ±1 without loss of stability. With damping and spin no real
    root is left.

    References
    ----------
    Eqs. (18)–(24) of the source paper; V. V. Bolotin, The Dynamic Stability of Elastic Systems.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> theta = hill_boundary_frequencies(lumped(ShaftDisk(), 0.0), 0.0, 1.17789865)
    >>> (theta[:2] / 0.6466913).round(5).tolist()
    [1.73774, 2.23094]
    """
    kind = choice("period", period, ("2T", "T"))
    harmonics = whole_number("harmonics", harmonics, 1, 20)
    static, pulsating, _ = np.broadcast_arrays(
        numbers("static_load", static_load),
        numbers("pulsating_load", pulsating_load),
        system.spin_speed,
    )
    n = system.size
    # multiples of θ̄/2 (2T) or θ̄ (T)
    orders = np.arange(-harmonics, harmonics + 1)
    orders = 2 * orders[:-1] + 1 if kind == "2T" else orders
    count = len(orders)
    series = system.load_harmonics(static, pulsating, count)
    shift = system.stiffness(static) - system.load_stiffness(static)
    lag = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
    blocks = [series[0] + shift, *(k / 2 for k in series[1:])]
    shape = (*np.shape(static), count, n, count, n)
    stiffness = np.zeros(shape, dtype=np.result_type(*blocks))
    for i in range(count):
        for k in range(count):
            stiffness[..., i, :, k, :] = blocks[lag[i, k]]
    rate = 1j * system.damping() if system.is_damped else system.spin_matrix()
    mass = np.kron(np.diag(orders**2), system.mass)
    spin = np.zeros((*np.shape(rate)[:-2], count, n, count, n), dtype=rate.dtype)
    for i, order in enumerate(orders):
        spin[..., i, :, i, :] = order * rate
    size = count * n
    stiffness = stiffness.reshape(*np.shape(static), size, size)
    spin = np.broadcast_to(spin.reshape(*spin.shape[:-4], size, size), stiffness.shape)
    return _positive_roots(stiffness, spin, mass, 2 * n * harmonics, 2.0 if kind == "2T" else 1.0)


def _positive_roots(
    stiffness: AnyArray,
    spin: AnyArray,
    mass: AnyArray,
    count: int,
    scale: float,
) -> Array:
    """Return scale/u of the positive real roots u of det(K u² + G u − M), rising, NaN after."""
    constant = np.linalg.solve(stiffness, np.broadcast_to(mass, spin.shape))
    inverse = np.linalg.eigvals(companion_matrix(constant, -np.linalg.solve(stiffness, spin)))
    largest = np.abs(inverse).max(axis=-1, keepdims=True)
    # the mean term of period T has no inertia here: its roots are 0 to rounding
    real = is_real(inverse) & (inverse.real > MASSLESS * largest)
    theta = np.where(real, scale / np.where(real, inverse.real, 1.0), np.nan)
    return np.asarray(np.sort(theta, axis=-1)[..., :count])
