"""Unstable intervals of one row of a chart from single points, without the search of the library.

Growth rates and multipliers are computed on a fine scan, and each of the four multipliers is
followed along it. Where two of them pass each other, or where the growth has a peak, the interval
is scanned again, each time three times finer.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, permutations

import numpy as np
from numpy.typing import NDArray

from rotorstab import System
from rotorstab.floquet.point import floquet_solution

Array = NDArray[np.float64]

_ORDERS = np.array(list(permutations(range(4))))
_PAIRS = list(combinations(range(4), 2))
_NOTHING = 1e-8  # growth of a point that counts as stable


@dataclass(frozen=True)
class Scan:
    """Growth at the frequencies of a scan, and the peaks that pass between them."""

    frequencies: Array
    growth: Array
    peaks: Array
    heights: Array


def _wrapped(angle: Array) -> Array:
    return angle - 2 * np.pi * np.round(angle / (2 * np.pi))


def _followed(multipliers: NDArray[np.complex128]) -> Array:
    """Return the phases of four multipliers (N, 4), each column one of them along the scan."""
    phase, size = np.angle(multipliers), np.log(np.abs(multipliers))
    step = np.zeros(4)
    for k in range(1, len(phase)):
        turn = _wrapped(phase[k][_ORDERS] - phase[k - 1] - step)
        cost = np.abs(turn) + np.abs(size[k][_ORDERS] - size[k - 1])
        best = _ORDERS[cost.sum(axis=1).argmin()]
        phase[k], size[k] = phase[k][best], size[k][best]
        step = _wrapped(phase[k] - phase[k - 1])
    return phase


def _places(phase: Array, growth: Array, damped: bool) -> NDArray[np.intp]:
    """Return columns after which two multipliers pass, or a peak of the growth is near."""
    found = []
    for i, j in _PAIRS:
        gap = _wrapped(phase[:, i] - phase[:, j])
        close = np.abs(gap)
        here = (gap[:-1] * gap[1:] <= 0) & (close[:-1] < 1.5) & (close[1:] < 1.5)
        inner = close[1:-1]
        here[1:] |= (inner <= close[:-2]) & (inner <= close[2:]) & (inner < 0.5)
        found.append(np.flatnonzero(here))
    if damped:
        inner = growth[1:-1]
        found.append(np.flatnonzero((inner >= growth[:-2]) & (inner >= growth[2:])))
    place = np.unique(np.concatenate(found))
    stable = growth < _NOTHING
    return place[stable[place] & stable[place + 1]]


def scan(
    system: System, static: float, load: float, low: float, high: float, columns: int = 2500
) -> Scan:
    """Return growth rates of one load on columns even in T, and all peaks between them."""
    periods = np.linspace(2 * np.pi / high, 2 * np.pi / low, columns)
    solution = floquet_solution(system, static, load, 2 * np.pi / periods)
    growth = solution.growth_rate
    place = _places(_followed(solution.multipliers.copy()), growth, system.is_damped)
    reach = float(periods[1] - periods[0])
    centre = periods[place] + reach / 2
    peak, height = centre.copy(), np.full(len(centre), -np.inf)
    row = np.arange(len(centre))
    for _ in range(3 if len(centre) else 0):
        grid = np.clip(centre[:, None] + reach * np.linspace(-1, 1, 31), periods[0], periods[-1])
        solution = floquet_solution(system, static, load, 2 * np.pi / grid)
        value = rate = solution.growth_rate
        if not system.is_damped:
            phase = np.angle(solution.multipliers)
            near = np.max([-(_wrapped(phase[..., i] - phase[..., j]) ** 2) for i, j in _PAIRS], 0)
            value = np.where(rate > _NOTHING, 1 + rate, near)
        best = value.argmax(axis=1)
        centre, top = grid[row, best], rate[row, best]
        peak, height = np.where(top > height, centre, peak), np.maximum(top, height)
        reach /= 12
    return Scan(2 * np.pi / periods, growth, 2 * np.pi / peak, height)


@dataclass(frozen=True)
class Verdict:
    """How intervals compare with a scan."""

    missed: list[tuple[float, float]]  # θ̄ and growth of peaks that lie in no interval
    narrow: int  # peaks that the columns of the scan do not show
    false: list[tuple[float, float]]  # θ̄ inside an interval that is stable, width of that gap/θ̄


def compare(found: Scan, intervals: list[tuple[float, float]], least: float) -> Verdict:
    """Compare intervals (left, right) of θ̄ with a scan, for growth above `least`."""
    ends = np.array(intervals).reshape(-1, 2)

    def inside(theta: Array, margin: float) -> NDArray[np.bool_]:
        low, high = ends[:, 0] * (1 + margin), ends[:, 1] * (1 - margin)
        return np.asarray(((low <= theta[:, None]) & (theta[:, None] <= high)).any(axis=1))

    theta = np.concatenate([found.frequencies, found.peaks])
    growth = np.concatenate([found.growth, found.heights])
    lost = (growth > least) & ~inside(theta, -1e-6)
    stable = found.growth < 1e-9
    # from the last unstable column below to the next one above
    after = np.minimum.accumulate(np.where(stable, np.inf, found.frequencies))
    before = np.maximum.accumulate(np.where(stable, 0.0, found.frequencies)[::-1])[::-1]
    wrong = stable & inside(found.frequencies, 1e-6)
    return Verdict(
        list(zip(theta[lost].tolist(), growth[lost].tolist(), strict=True)),
        int((found.heights > least).sum()),
        list(
            zip(
                found.frequencies[wrong].tolist(),
                ((after - before) / found.frequencies)[wrong].tolist(),
                strict=True,
            )
        ),
    )
