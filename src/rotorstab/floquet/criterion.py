"""What counts as unstable: the one criterion of points, multipliers and charts.

`is_unstable` decides wherever a growth rate is known with its error. On charts the growth rates are
interpolated, and `is_unstable_on_chart` says how far their error bounds count. Whirls without
pulsation have the criterion `mean_is_unstable`. Outlines and edges of tongues, and the margins of
damped rotors, are no verdicts but limits: roots of the growth rate, or of the distance of two
multipliers.
"""

from __future__ import annotations

import numpy as np

from .._tolerances import SMALLEST_GROWTH, TRUE_PART_OF_BOUND, UNSTABLE_MEAN
from .._types import AnyArray, ArrayLike, Mask

__all__ = ["grows_or_decays", "is_unstable", "is_unstable_on_chart", "mean_is_unstable"]


def is_unstable(growth: ArrayLike, error: ArrayLike) -> Mask:
    """Tell where a growth rate σ̄ exceeds both its own error and 1e-8.

    A multiplier is known to 1e-8 only where two of them meet: at the edge of every tongue.

    Parameters
    ----------
    growth, error : (...) float
        σ̄ and the bound on its error [√(EI/(ρAL⁴))], which broadcast; NaN counts as stable.

    Returns
    -------
    (...) bool

    Examples
    --------
    >>> is_unstable([1e-9, 1e-7, 1e-7], [0, 1e-9, 1e-6]).tolist()
    [False, True, False]
    """
    return np.asarray(np.greater(growth, np.maximum(error, SMALLEST_GROWTH)))


def is_unstable_on_chart(growth: ArrayLike, bound: ArrayLike, damped: bool) -> Mask:
    """Tell at which points of a chart an interpolated growth rate counts as growth.

    Parameters
    ----------
    growth, bound : (...) float
        σ̄ and the cautious bound on its error [√(EI/(ρAL⁴))], which broadcast; NaN counts as stable.
    damped : bool
        Whether the rotor is damped. With damping the growth rate passes 0 at an edge, and an error
        moves the edge by no more than it moves the growth rate: there the bound does not count.
        Without damping growth is exactly 0 outside of the tongues, and rounding alone may lift it.

    Returns
    -------
    (...) bool

    Examples
    --------
    >>> growth, bound = [1e-9, 6e-7, 6e-7], [0, 1e-6, 2e-6]
    >>> is_unstable_on_chart(growth, bound, damped=False).tolist()
    [False, True, False]
    >>> is_unstable_on_chart(growth, bound, damped=True).tolist()
    [False, True, True]
    """
    part = 0.0 if damped else TRUE_PART_OF_BOUND
    return is_unstable(growth, part * np.asarray(bound))


def grows_or_decays(frequencies: AnyArray) -> Mask:
    """Tell which whirls of a rotor grow or decay by more than rounding, without pulsation.

    Parameters
    ----------
    frequencies : (..., 2n) float or complex
        All whirl frequencies of one rotor, as `whirl_frequencies` returns them.

    Returns
    -------
    (..., 2n) bool
        True where |Im ω| exceeds 1e-9 of the largest |ω|.

    Examples
    --------
    >>> import numpy as np
    >>> grows_or_decays(np.array([-2.0 + 1e-13j, 3.0 + 0.1j])).tolist()
    [False, True]
    """
    largest = np.abs(frequencies).max(axis=-1, keepdims=True)
    return np.asarray(np.abs(np.imag(frequencies)) > UNSTABLE_MEAN * largest)


def mean_is_unstable(frequencies: AnyArray) -> Mask:
    """Tell whether a rotor is unstable without pulsation: flutter, buckling, rotating damping.

    Parameters
    ----------
    frequencies : (..., 2n) float or complex
        All whirl frequencies of one rotor, as `whirl_frequencies` returns them.

    Returns
    -------
    (...) bool
        True where a whirl grows, Im ω < 0, by more than rounding (see `grows_or_decays`).

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped, whirl_frequencies
    >>> loads = [1.0, 2.0, 3.0]  # the shaft buckles at 2.36
    >>> mean_is_unstable(whirl_frequencies(lumped(ShaftDisk(), 0.0), loads)).tolist()
    [False, False, True]
    """
    return np.asarray(((np.imag(frequencies) < 0) & grows_or_decays(frequencies)).any(axis=-1))
