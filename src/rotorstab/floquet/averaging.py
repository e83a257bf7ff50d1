"""Growth, width and threshold of one pair of modes by the method of averaging."""

from __future__ import annotations

import math

__all__ = ["averaged_tongue"]


def averaged_tongue(
    coupling: complex, decay: tuple[float, float], load: float
) -> tuple[float, float, float, float]:
    """Return growth per load, growth, half-width and threshold of one resonant pair.

    The averaged pair is a' = −σ_i a + (jp/2)B_ij b, b' = (±jδ − σ_j) b + (jp/2)B_ji a. With a
    complex g the detuning δ of largest growth splits the phase of g evenly, so that the pair acts
    like one with g_eff = (|g| + Re g)/2.

    Parameters
    ----------
    coupling : complex
        g.
    decay : (float, float)
        σ_i and σ_j, decay rates of the two modes.
    load : float
        p̄_t.
    """
    low, high = sorted(decay)
    strength = (abs(coupling) + coupling.real) / 2
    per_load = strength**0.5 / 2
    drive = load**2 * strength / 4
    growth = -(low + high) / 2 + (((high - low) / 2) ** 2 + drive) ** 0.5
    if strength == 0:
        return 0.0, growth, 0.0, math.inf
    if low < 0:
        return per_load, math.nan, math.nan, 0.0
    product = low * high
    if product == 0:  # no decay, or so little that the product underflows
        return per_load, growth, 2 * drive**0.5, 0.0
    width = (low + high) * max(drive / product - 1, 0.0) ** 0.5
    return per_load, growth, width, 2 * (product / strength) ** 0.5
