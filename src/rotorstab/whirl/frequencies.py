"""Whirl frequencies of a rotor under a static load, Eq. (20) with β_d = 0."""

from __future__ import annotations

import numpy as np

from .._arguments import LARGEST_LOAD, numbers
from .._numerics.quartic import quartic_roots
from .._numerics.two_by_two import determinant, entries, mixed_determinant
from .._types import Array, ArrayLike, Complex
from ..model.modal import state_matrix
from ..model.system import System

__all__ = ["frequencies_by_eigenvalues", "whirl_frequencies"]


def whirl_frequencies(system: System, load: ArrayLike) -> Complex:
    """Return the roots ω of det[K(p̄) + jωD − ω²M] = 0.

    Parameters
    ----------
    system : System
        Its spin speed broadcasts against the load.
    load : (...) float
        Static load p̄ [EI/L²].

    Returns
    -------
    (..., 2n) complex
        ω [√(EI/(ρAL⁴))] of solutions exp(jωt), sorted by real, then imaginary part. A positive
        real part is forward precession, a negative imaginary part growth.

    Raises
    ------
    ValueError
        If the load is not finite, or past the pole of the stiffness.

    References
    ----------
    Eq. (20) of the source paper with β_d = 0.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> whirl_frequencies(lumped(ShaftDisk(), 1.0), 0.0).real.round(4).tolist()
    [-1.9348, -0.4041, 0.9092, 3.4297]
    """
    load = numbers("load", load, -LARGEST_LOAD, LARGEST_LOAD)
    if system.size == 2 and not system.is_damped and not system.is_rotating:
        return _quartic_frequencies(system, load)
    return frequencies_by_eigenvalues(system, load)


def frequencies_by_eigenvalues(system: System, load: Array) -> Complex:
    """Return the frequencies (..., 2n) of `whirl_frequencies` as eigenvalues, for any system."""
    matrix = state_matrix(system, system.stiffness(load))
    return np.asarray(np.sort_complex(np.linalg.eigvals(matrix)))


def _quartic_frequencies(system: System, load: Array) -> Complex:
    """Return the roots of det[K(p̄) + ωΩ̄H − ω²M], a real quartic in ω for two coordinates."""
    m, h, spin = entries(system.mass), entries(system.gyroscopic), system.spin_speed
    if system.is_linear:
        # K = Ka + p̄Kb: the determinants are short polynomials in p̄
        a, b = entries(system.elastic), entries(system.geometric)
        with_m = mixed_determinant(a, m) + load * mixed_determinant(b, m)
        with_h = mixed_determinant(a, h) + load * mixed_determinant(b, h)
        det_k = (load * determinant(b) + mixed_determinant(a, b)) * load + determinant(a)
    else:
        k = entries(system.load_stiffness(load))
        with_m, with_h = mixed_determinant(k, m), mixed_determinant(k, h)
        det_k = determinant(k)
    return quartic_roots(
        determinant(m),
        -spin * mixed_determinant(h, m),
        spin**2 * determinant(h) - with_m,
        spin * with_h,
        det_k,
    )
