"""Stiffness laws of the lumped shaft: K(p̄), and its harmonics under a pulsating load.

K(p̄₀ + p̄_t cos φ) = Σ K_m cos mφ. A law may have a pole, a load at which the coefficient k₂₂ is
infinite. Its harmonics are those of the pole's term, which have a closed form, plus those of the
finite rest, which fall off fast.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from .._numerics.chebyshev import chebyshev_angles, coefficient_weights
from .._types import Array
from .stiffness import exact_stiffness, largest_exact_load, refuse_poles, second_exact_pole

__all__ = ["LINEAR", "STIFFNESS_LAWS", "StiffnessLaw", "exact_law"]

_ROUNDING_LOG = 37.0  # −ln of the rounding error, 1e-16: a smaller part of a sum does not show
_SAMPLES_TOGETHER = 1 << 15  # evaluations of K at a time, which take some 10 MB


@dataclass(frozen=True)
class StiffnessLaw:
    """A stiffness K(p̄) of the lumped shaft that is not linear in the load.

    Parameters
    ----------
    name : str
        Its name in `STIFFNESS_LAWS`.
    stiffness : callable
        Takes loads p̄ (...) [EI/L²] and returns K(p̄) (..., 2, 2); raises ValueError at a load where
        there is no stiffness.
    smooth_to : float
        Load [EI/L²] up to which K without its pole's term is smooth: the nearest singularity
        beyond `pole`. The farther it is, the faster harmonics fall off.
    pole : float
        Smallest load [EI/L²] at which k₂₂ is infinite, inf if there is none.
    residue : float
        R [EI²/L³] of the term −R/(`pole` − p̄) of k₂₂. The other coefficients stay finite there.
    pole_meaning : str
        What happens at the pole, to follow its load in a sentence: "where …".
    """

    name: str
    stiffness: Callable[[Array], Array]
    smooth_to: float
    pole: float = math.inf
    residue: float = 0.0
    pole_meaning: str = ""

    def refuse_peaks(self, static: Array, pulsating: Array) -> None:
        """Raise PastPole if the largest load of a pulsation is at or past the pole."""
        peak = np.add(static, np.abs(pulsating))
        refuse_poles(peak, self.pole, "`static_load` + |`pulsating_load`|", self.name)

    def harmonics(self, static: Array, pulsating: Array, count: int) -> Array:
        """Return K₀ … K_count, (count + 1, ..., 2, 2), at loads (...) of one shape.

        Raises
        ------
        PastPole
            If the peak load is at or past the pole; this is a ValueError too.
        """
        self.refuse_peaks(static, pulsating)
        harmonics = self.smooth_harmonics(static, pulsating, count)
        harmonics[..., 1, 1] += self.pole_harmonics(static, pulsating, count)
        return harmonics

    def smooth_harmonics(self, static: Array, pulsating: Array, count: int) -> Array:
        """Return K₀ … K_count of K(p̄₀ + p̄_t cos φ) without `pole_term`.

        Parameters
        ----------
        static, pulsating : (...) float
            p̄₀ and p̄_t [EI/L²], of one shape; their peak is below the pole.
        count : int
            Highest harmonic.

        Returns
        -------
        (count + 1, ..., 2, 2) float
            Chebyshev coefficients of K over the load, by a cosine sum, right to rounding.
        """
        # the aliasing error falls as ρ^(count − 2 points)
        rate = self._decay(static, pulsating)
        points = math.ceil((count + _ROUNDING_LOG / rate) / 2) + 1
        phase = chebyshev_angles(points)
        weights = coefficient_weights(count + 1, points)
        statics, pulsatings = static.ravel(), pulsating.ravel()
        harmonics = np.empty((count + 1, statics.size, 4))
        batch = max(1, _SAMPLES_TOGETHER // points)
        for start in range(0, statics.size, batch):
            part = slice(start, start + batch)
            load = statics[part] + np.outer(np.cos(phase), pulsatings[part])
            samples = self.stiffness(load)
            samples[..., 1, 1] -= self.pole_term(load)
            harmonics[:, part] = (weights @ samples.reshape(points, -1)).reshape(count + 1, -1, 4)
        return harmonics.reshape(count + 1, *static.shape, 2, 2)

    def harmonic_count(self, static: Array, pulsating: Array) -> int:
        """Return how many harmonics of K, `pole_term` apart, are above rounding."""
        return max(4, math.ceil(_ROUNDING_LOG / self._decay(static, pulsating)))

    def _decay(self, static: Array, pulsating: Array) -> float:
        """Return ln ρ, the smallest of all loads: harmonic m without `pole_term` falls as ρ^−m."""
        peak, size = static + np.abs(pulsating), np.abs(pulsating)
        room = self.smooth_to - np.asarray(peak)
        ratio = float(np.min(room / np.maximum(size, 1e-9 * room), initial=np.inf))
        return math.log1p(ratio + math.sqrt(ratio * (ratio + 2)))

    def pole_term(self, load: Array) -> Array:
        """Return −R/(p̄* − p̄) (...): the part of k₂₂ [EI/L] that is infinite at the pole p̄*."""
        return np.asarray(-self.residue / (self.pole - load))

    def pole_harmonics(self, static: Array, pulsating: Array, count: int) -> Array:
        """Return the cosine coefficients (count + 1, ...) of `pole_term` at p̄₀ + p̄_t cos φ.

        1/(a − b cos φ) = (1 + 2 Σ zᵐ cos mφ)/√(a² − b²) with z = b/(a + √(a² − b²)).
        """
        room = self.pole - static
        root = np.sqrt((room - pulsating) * (room + pulsating))
        ratio = np.asarray(pulsating / (room + root))
        orders = np.arange(count + 1).reshape(-1, *[1] * ratio.ndim)
        coefficients = -2 * self.residue / root * ratio**orders
        coefficients[0] /= 2
        return np.asarray(coefficients)


def exact_law(shear: float, tangency: float) -> StiffnessLaw:
    """Return the law of Appendix A at one Φ [-] and one μ [-], see `exact_stiffness`.

    Its residue at the pole p̄* is R = p̄*²/(2π²).
    """
    pole = float(largest_exact_load(shear))
    return StiffnessLaw(
        name="exact",
        stiffness=partial(exact_stiffness, shear=shear, tangency=tangency),
        smooth_to=second_exact_pole(shear),
        pole=pole,
        residue=pole * pole / (2 * np.pi**2),
        pole_meaning="where a shaft clamped at both ends buckles",
    )


LINEAR = "linear"
"""The name of the law of Eq. (9)."""

STIFFNESS_LAWS: dict[str, Callable[[float, float], StiffnessLaw | None]] = {
    LINEAR: lambda shear, tangency: None,
    "exact": exact_law,
}
"""Every stiffness law by its name: a function of Φ and μ.

The linear law of Eq. (9), K = Ka + p̄ Kb, is that of the system's own matrices and needs no
`StiffnessLaw`. The command line and the page offer the names that stand here.
"""
