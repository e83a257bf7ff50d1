"""Following tongues of instability from their roots as the load grows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..._numerics.parabola import parabola_maximum
from ..._types import Array, Mask
from ..resonance_table import Resonance

__all__ = ["Measure", "follow", "polish", "tongue_centres", "tracking_loads"]

Measure = Callable[[Array, Array], Array]
"""Maps loads and frequencies to a smooth measure of a collision, largest at its centre."""

_LEVELS = 12  # loads at which tongues are followed from their root
_RECENT = 4  # centres from which the next one is extrapolated
_DRIFT = 0.05  # of θ̄: a centre that moves farther in one step has been lost
_FAR = 0.5  # of its root: a centre farther off has been lost
_SAME_SQUARE = 1e-4  # of p̄_t²: by so much a load may lie beyond the last one followed
_MOST_STEPS = 2.0  # half-widths of a parabola by which its maximum may move


def tracking_loads(largest: float) -> Array:
    """Return the rising loads at which tongues are followed from their roots."""
    return largest * np.linspace(0.1, 1, _LEVELS)


def _peak(measure: Measure, load: Array, guess: Array, reach: Array) -> tuple[Array, Array, Array]:
    """Return centre, height and curvature of parabolas through three points around guesses."""
    offsets = np.array([-1.0, 0.0, 1.0])
    points = guess[..., None] + reach[..., None] * offsets
    height = measure(np.broadcast_to(load[..., None], points.shape), points)
    place, top, bend = parabola_maximum(offsets, height)
    shift = np.clip(place, -_MOST_STEPS, _MOST_STEPS)
    return guess + shift * reach, top + bend * (shift - place) ** 2, -2 * bend / reach**2


def _extrapolated(squares: Array, path: list[Array], square: float) -> Array:
    """Return the next centres: they are even in the load, so polynomials in its square."""
    recent = slice(max(0, len(squares) - _RECENT), None)
    weights = [
        np.prod([(square - b) / (a - b) for b in squares[recent] if b != a])
        for a in squares[recent]
    ]
    return np.asarray(np.tensordot(weights, np.array(path[recent]), 1))


def _strengths(rows: tuple[Resonance, ...]) -> Array:
    """Return √g of each tongue, its first-order half-width per unit load."""
    return np.array([2 * row.growth_per_load for row in rows])


def follow(measure: Measure, levels: Array, rows: tuple[Resonance, ...]) -> Array:
    """Return the centres θ̄ (K, levels) of K tongues at rising loads, NaN once a tongue is lost."""
    roots = np.array([row.centre for row in rows])
    strength = _strengths(rows)
    squares, path = np.zeros(1), [roots]
    centre = np.full((len(rows), len(levels)), np.nan)
    lost: Mask = np.zeros(len(rows), dtype=np.bool_)
    for index, level in enumerate(levels):
        guess = _extrapolated(squares, path, level**2)
        guess = np.where(np.abs(guess - roots) < _FAR * roots, guess, roots)
        load = np.full(len(rows), level)
        reach = np.maximum(2 * strength * level, 1e-3 * roots)
        reach = np.minimum(reach, 0.02 * roots)
        for shrink in (1.0, 0.5, 0.25):
            new, *_ = _peak(measure, load, guess, shrink * reach)
            near = np.abs(new - guess) <= _DRIFT * roots
            # a lost tongue stays lost: what is found at its root again is another one
            lost |= ~(near & (np.abs(new - roots) < _FAR * roots))
            # the measure still needs a number there
            guess = np.where(lost, roots, new)
        centre[:, index] = np.where(lost, np.nan, guess)
        squares = np.append(squares, level**2)
        path.append(np.where(lost, path[-1], guess))
    return centre


def _first_guesses(loads: Array, levels: Array, rows: tuple[Resonance, ...], path: Array) -> Array:
    """Return θ̄ (K, R) interpolated in p̄_t² between the followed centres, NaN where lost."""
    centre = np.full((len(rows), len(loads)), np.nan)
    for k, row in enumerate(rows):
        good = np.isfinite(path[k])
        squares = np.concatenate([[0.0], levels[good] ** 2])
        guess = np.interp(loads**2, squares, np.concatenate([[row.centre], path[k, good]]))
        beyond = loads**2 > (1 + _SAME_SQUARE) * squares[-1]
        centre[k] = np.where(beyond | (loads == 0), np.nan, guess)
    return centre


def polish(
    measure: Measure, loads: Array, levels: Array, rows: tuple[Resonance, ...], path: Array
) -> tuple[Array, Array]:
    """Return refined centres and widths (K, R) at the loads above 0, NaN where lost.

    The widths are a first guess from which a march to the edges starts: where the measure is a
    parabola in θ̄, 1/√2 of the half-width.

    Parameters
    ----------
    measure : callable
    loads : (R,) float
        p̄_t at which the centres are wanted.
    levels : (L,) float
        Rising loads of `path`.
    rows : tuple of Resonance
        The K tongues.
    path : (K, L) float
        From `follow`.
    """
    centre = _first_guesses(loads, levels, rows, path)
    width = np.full_like(centre, np.nan)
    tongue, at = np.nonzero(np.isfinite(centre))
    if not len(tongue):
        return centre, width
    theta, load = centre[tongue, at], loads[at]
    strength = _strengths(rows)[tongue]
    reach = np.clip(strength * load, 3e-4 * theta, 0.02 * theta)
    for shrink in (1.0, 0.5, 0.5):
        new, top, bend = _peak(measure, load, theta, shrink * reach)
        theta = np.where(np.abs(new - theta) < _DRIFT * theta, new, theta)
    with np.errstate(invalid="ignore", divide="ignore"):
        guess = np.sqrt(np.maximum(top, 0) / bend)
    centre[tongue, at] = theta
    width[tongue, at] = np.where(guess > 0, guess, strength * load)
    return centre, width


def tongue_centres(measure: Measure, loads: Array, rows: tuple[Resonance, ...]) -> Array:
    """Return θ̄ (K, R) of the strongest collision of each tongue at rising loads, NaN if lost."""
    levels = tracking_loads(float(loads[-1]))
    return polish(measure, loads, levels, rows, follow(measure, levels, rows))[0]
