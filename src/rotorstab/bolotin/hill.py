"""Higher-order Bolotin boundaries: truncations of Hill's infinite determinant."""

from __future__ import annotations

import numpy as np

from .._arguments import choice, numbers, whole_number
from .._numerics.companion import companion_matrix
from .._numerics.roots import is_real
from .._tolerances import MASSLESS
from .._types import AnyArray, Array, ArrayLike, Index
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
    K₀ − (mθ̄/2)²M + j(mθ̄/2)D on its diagonal and K_l/2 off it. It is singular at the boundaries.

    Parameters
    ----------
    system : System
    static_load, pulsating_load : (...) float
        p̄₀ and p̄_t [EI/L²]. They broadcast with each other and with the spin speed.
    harmonics : int
        1 to 20. One harmonic of period 2T is Bolotin's first approximation, Eq. (24).
    period : {"2T", "T"}
        Period of the solution, T = 2π/θ̄.

    Returns
    -------
    (..., 2n·harmonics) float
        Positive θ̄ [√(EI/(ρAL⁴))], ascending, NaN (last) where a root is not real.

    Raises
    ------
    ValueError
        If an argument is out of range, or a load is past the pole of the stiffness.

    Notes
    -----
    At Ω̄ = 0 h harmonics give the first 2T boundary with an error of order p̄_t^{2h}. At Ω̄ ≠ 0 such
    a boundary need not separate stable from unstable, however many the harmonics are: a multiplier
    may pass through ±1 without loss of stability. With damping and spin no real root is left.

    References
    ----------
    Eqs. (18)–(24) of the source paper.

    V. V. Bolotin, The Dynamic Stability of Elastic Systems, Holden-Day, San Francisco, 1964.

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
    orders = np.arange(-harmonics, harmonics + 1)
    if kind == "2T":
        # odd multiples of θ̄/2; the orders of T are multiples of θ̄
        orders = 2 * orders[:-1] + 1
    scale = 2.0 if kind == "2T" else 1.0
    count = 2 * system.size * harmonics
    return _positive_roots(*_hill_matrices(system, static, pulsating, orders), count, scale)


def _hill_matrices(
    system: System, static: Array, pulsating: Array, orders: Index
) -> tuple[AnyArray, AnyArray, AnyArray]:
    """Return K, G and M of Hill's determinant det(K + uG − u²M), u θ̄ or θ̄/2.

    Parameters
    ----------
    system : System
    static, pulsating : (...) float
        Of one shape.
    orders : (h,) int
        Multiples of u in the exponents of the solution.

    Returns
    -------
    K, G : (..., hn, hn) float or complex
    M : (hn, hn) float
    """
    n, count = system.size, len(orders)
    size = count * n
    load_harmonics = system.load_harmonics(static, pulsating, count)
    blocks = [load_harmonics[0] + system.cross_part(), *(k / 2 for k in load_harmonics[1:])]
    stiffness = np.zeros((*np.shape(static), count, n, count, n), dtype=np.result_type(*blocks))
    for i in range(count):
        for k in range(count):
            stiffness[..., i, :, k, :] = blocks[abs(i - k)]
    rate = 1j * system.damping() if system.is_damped else system.spin_matrix()
    spin = np.zeros((*np.shape(rate)[:-2], count, n, count, n), dtype=rate.dtype)
    for i, order in enumerate(orders):
        spin[..., i, :, i, :] = order * rate
    stiffness = stiffness.reshape(*np.shape(static), size, size)
    spin = np.broadcast_to(spin.reshape(*spin.shape[:-4], size, size), stiffness.shape)
    return stiffness, spin, np.kron(np.diag(orders**2), system.mass)


def _positive_roots(
    stiffness: AnyArray, spin: AnyArray, mass: AnyArray, count: int, scale: float
) -> Array:
    """Return scale times the positive real roots u of det(K + uG − u²M), ascending, NaN after.

    The eigenvalues are 1/u, the roots of det(K/u² + G/u − M), so that a singular M is no trouble.
    """
    constant = np.linalg.solve(stiffness, np.broadcast_to(mass, spin.shape))
    inverse = np.linalg.eigvals(companion_matrix(constant, -np.linalg.solve(stiffness, spin)))
    largest = np.abs(inverse).max(axis=-1, keepdims=True)
    positive = is_real(inverse) & (inverse.real > MASSLESS * largest)
    theta = np.where(positive, scale / np.where(positive, inverse.real, 1.0), np.nan)
    return np.asarray(np.sort(theta, axis=-1)[..., :count])
