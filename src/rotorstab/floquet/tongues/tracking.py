"""Following tongues of instability from their roots as the load grows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..resonance import Resonance

__all__ = ["LEVELS", "Measure", "follow", "polish", "tongue_centres"]

Array = NDArray[np.float64]
Measure = Callable[[Array, Array], Array]

LEVELS = 12  # loads at which tongues are followed from their root
_DRIFT = 0.05  # of θ̄: a centre that moves farther in one step has been lost
_FAR = 0.5  # of its root: a centre farther off has been lost


def _vertex(
    measure: Measure, load: Array, guess: Array, reach: Array
) -> tuple[Array, Array, Array]:
    """Return centre, height and curvature of parabolas through three points around guesses."""
    offsets = np.array([-1.0, 0.0, 1.0])
    points = guess[..., None] + reach[..., None] * offsets
    height = measure(np.broadcast_to(load[..., None], points.shape), points)
    slope = (height[..., 2] - height[..., 0]) / 2
    bend = height[..., 2] - 2 * height[..., 1] + height[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = np.where(bend < 0, -slope / bend, np.nan)
    shift = np.clip(shift, -2, 2)
    top = height[..., 1] + slope * shift + bend * shift**2 / 2
    return guess + shift * reach, top, -bend / reach**2


def follow(measure: Measure, levels: Array, rows: tuple[Resonance, ...]) -> tuple[Array, Array]:
    """Return centres and first-guess half-widths (K, levels), NaN once a tongue is lost."""
    roots = np.array([row.centre for row in rows])
    strength = np.array([2 * row.growth_per_load for row in rows])
    knots, path = [np.zeros(1)], [roots]
    centre = np.full((len(rows), len(levels)), np.nan)
    width = np.full_like(centre, np.nan)
    lost = np.zeros(len(rows), dtype=np.bool_)
    for index, level in enumerate(levels):
        # the centre is even in the load: extrapolate in its square
        squares = np.concatenate(knots)
        recent = slice(max(0, len(squares) - 4), None)
        weights = [
            np.prod([(level**2 - b) / (a - b) for b in squares[recent] if b != a])
            for a in squares[recent]
        ]
        guess = np.tensordot(weights, np.array(path[recent]), 1)
        guess = np.where(np.abs(guess - roots) < _FAR * roots, guess, roots)
        load = np.full(len(rows), level)
        reach = np.maximum(2 * strength * level, 1e-3 * roots)
        reach = np.minimum(reach, 0.02 * roots)
        for shrink in (1.0, 0.5, 0.25):
            new, top, bend = _vertex(measure, load, guess, shrink * reach)
            near = np.abs(new - guess) <= _DRIFT * roots
            # once lost a tongue stays so: what is found at its root again is another one
            lost |= ~(near & (np.abs(new - roots) < _FAR * roots))
            # it still needs a number to be evaluated at
            guess = np.where(lost, roots, new)
        with np.errstate(invalid="ignore", divide="ignore"):
            width[:, index] = np.sqrt(np.maximum(top, 0) / bend)
        centre[:, index] = np.where(lost, np.nan, guess)
        knots.append(np.array([level**2]))
        path.append(np.where(lost, path[-1], guess))
    return centre, width


def polish(
    measure: Measure,
    loads: Array,
    levels: Array,
    rows: tuple[Resonance, ...],
    path: Array,
) -> tuple[Array, Array]:
    """Return refined centres and half-widths (K, R) at the loads above 0, NaN where lost."""
    centre, half_width = (np.full((len(rows), len(loads)), np.nan) for _ in range(2))
    for k, row in enumerate(rows):
        good = np.isfinite(path[k])
        squares = np.concatenate([[0.0], levels[good] ** 2])
        guess = np.interp(loads**2, squares, np.concatenate([[row.centre], path[k, good]]))
        lost = (loads**2 > 1.0001 * squares[-1]) | (loads == 0)
        centre[k] = np.where(lost, np.nan, guess)
    tongue, at = np.nonzero(np.isfinite(centre))
    if not len(tongue):
        return centre, half_width
    theta, load = centre[tongue, at], loads[at]
    strength = np.array([2 * row.growth_per_load for row in rows])[tongue]
    reach = np.clip(strength * load, 3e-4 * theta, 0.02 * theta)
    for shrink in (1.0, 0.5, 0.5):
        new, top, bend = _vertex(measure, load, theta, shrink * reach)
        theta = np.where(np.abs(new - theta) < 0.05 * theta, new, theta)
    with np.errstate(invalid="ignore", divide="ignore"):
        width = np.sqrt(np.maximum(top, 0) / bend)
    centre[tongue, at] = theta
    half_width[tongue, at] = np.where(width > 0, width, strength * load)
    return centre, half_width


def tongue_centres(measure: Measure, loads: Array, rows: tuple[Resonance, ...]) -> Array:
    """Return θ̄ (K, R) of the strongest collision of each tongue at rising loads, NaN if lost.

    `measure` maps loads and frequencies to any smooth measure of a collision.
    """
    levels = float(loads[-1]) * np.linspace(0.1, 1, LEVELS)
    path, _ = follow(measure, levels, rows)
    return polish(measure, loads, levels, rows, path)[0]
