"""The propagator of one period at the sample times of a response."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._types import Complex
from ..model.modal import ModalBasis, splitting_basis
from ..model.system import System
from .integrator import POINT_LEVELS, fastest_rate, fine_and_coarse, segment_propagators
from .schemes import POINT_SCHEME

__all__ = ["SampledPeriod", "sampled_period"]

_TOLERANCE = 1e-11  # relative difference of the extrapolants of order 10 and 8 that is accepted


@dataclass(frozen=True)
class SampledPeriod:
    """The propagator of one period at evenly spaced times.

    Parameters
    ----------
    basis : ModalBasis
        The coordinates of the propagators.
    from_start : (samples + 1, 2n, 2n) complex
        Y(0 → t) from the start of the period to each sample; the last one is the monodromy.
    error : float
        Estimated relative error of one sample interval.
    """

    basis: ModalBasis
    from_start: Complex
    error: float


def sampled_period(
    system: System, static: float, pulsating: float, period: float, samples: int, most_steps: int
) -> SampledPeriod:
    """Return the propagator at the sample times, halving the steps until it has converged."""
    basis = splitting_basis(system, static)
    loads = np.array([static]), np.array([pulsating])
    span = np.array([period])
    rate = float(fastest_rate(system, basis, loads)[0])
    turned = max(rate * period, 2 * np.pi * system.pulsation.highest) / samples
    factor = int(turned / POINT_LEVELS[-1]) + 1

    def propagators(steps: int) -> Complex:
        return segment_propagators(
            system, basis, loads, span, 2 * np.pi, steps, POINT_SCHEME, samples
        )[..., 0]

    def steps_per_period(factor: int) -> int:
        return factor * POINT_LEVELS[-1] * samples

    if steps_per_period(factor) > most_steps:
        raise ValueError(
            "`excitation_frequency` is so low that one period takes "
            f"{steps_per_period(factor)} steps, more than `most_steps`, {most_steps}"
        )
    while True:
        fine, coarse = fine_and_coarse(propagators, factor)
        error = float(np.abs(fine - coarse).max() / np.abs(fine).max())
        if not error > _TOLERANCE or steps_per_period(2 * factor) > most_steps:
            break
        factor *= 2
    parts = np.moveaxis(fine, -1, 0)
    from_start = np.empty((samples + 1, *parts.shape[1:]), complex)
    from_start[0] = np.eye(parts.shape[-1])
    for index, part in enumerate(parts):
        from_start[index + 1] = part @ from_start[index]
    return SampledPeriod(basis, from_start, error)
