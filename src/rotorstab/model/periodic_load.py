"""The shape of a pulsating load over its period: a cosine, or any Fourier series."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path

import numpy as np

from .._arguments import number, numbers, whole_number
from .._tolerances import NEGLIGIBLE
from .._types import Array, ArrayLike

__all__ = ["COSINE", "FittedLoad", "PeriodicLoad"]

_MOST_HARMONICS = 64
_ROUNDING = 1e-10  # part of the largest coefficient of a fit below which one is rounding


@dataclass(frozen=True)
class PeriodicLoad:
    """The shape f of a load p̄(t) = p̄₀ + p̄_t f(θ̄t), f(φ) = Σ (c_k cos kφ + s_k sin kφ).

    Parameters
    ----------
    cosine, sine : sequence of float
        c₁, c₂ … and s₁, s₂ … [-], at most 64 of each; a shorter list is filled with zeros.

    Raises
    ------
    ValueError
        If a coefficient is not finite, there are too many, or all are zero.

    Examples
    --------
    >>> shape = PeriodicLoad([1.0, 0.25], [0.0, 0.1])
    >>> shape.at(0.0).item(), shape.highest, shape.is_even
    (1.25, 2, False)
    """

    cosine: tuple[float, ...] = (1.0,)
    sine: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Check the coefficients, and drop zeros at the end."""
        for name in ("cosine", "sine"):
            given = numbers(name, getattr(self, name))
            if given.ndim != 1 or given.size > _MOST_HARMONICS:
                raise ValueError(
                    f"`{name}` must be a list of at most {_MOST_HARMONICS} numbers, "
                    f"got an array of shape {given.shape}"
                )
            kept = np.trim_zeros(given, "b").tolist()
            object.__setattr__(self, name, tuple(kept))
        if not self.cosine and not self.sine:
            raise ValueError("`cosine` and `sine` must not both be zero, got no pulsation")

    @cached_property
    def amplitudes(self) -> tuple[complex, ...]:
        """The numbers a_k = c_k − js_k, k = 1, 2 …, with f(φ) = Re Σ a_k exp(jkφ)."""
        count = self.highest
        c, s = (np.pad(part, (0, count - len(part))) for part in (self.cosine, self.sine))
        return tuple((c - 1j * s).tolist())

    @property
    def highest(self) -> int:
        """Number of the highest harmonic."""
        return max(len(self.cosine), len(self.sine))

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers of the harmonics that are not zero."""
        largest = max(map(abs, self.amplitudes))
        sizes = enumerate(map(abs, self.amplitudes), start=1)
        return tuple(k for k, size in sizes if size > NEGLIGIBLE * largest)

    @property
    def is_even(self) -> bool:
        """Whether f(−φ) = f(φ), so that a motion without damping can be run backwards."""
        return not self.sine

    @property
    def is_antiperiodic(self) -> bool:
        """Whether f(φ + π) = −f(φ), so that −p̄_t is p̄_t half a period later."""
        return all(k % 2 for k in self.harmonics)

    @cached_property
    def largest(self) -> float:
        """Largest |f|, to about 1e-4 of it or better."""
        phase = np.linspace(0.0, 2 * np.pi, 128 * self.highest, endpoint=False)
        return float(np.abs(self.at(phase)).max())

    def at(self, phase: ArrayLike) -> Array:
        """Return f(φ).

        Parameters
        ----------
        phase : (...) float
            φ = θ̄t [rad].

        Returns
        -------
        (...) float
        """
        angle = np.asarray(phase, dtype=np.float64)
        if self == COSINE:
            return np.asarray(np.cos(angle))
        total = np.zeros_like(angle)
        for k, (c, s) in enumerate(((a.real, -a.imag) for a in self.amplitudes), start=1):
            if c:
                total = total + c * np.cos(k * angle)
            if s:
                total = total + s * np.sin(k * angle)
        return np.asarray(total)

    @classmethod
    def from_samples(cls, samples: ArrayLike, harmonics: int | None = None) -> FittedLoad:
        """Return the Fourier series of one period of a load.

        Parameters
        ----------
        samples : (m,) float
            The load at m evenly spaced times of one period, in any unit; the first one is at
            φ = 0, and the end of the period is not repeated.
        harmonics : int, optional
            Highest harmonic, below m/2 and at most 64. By default as many as there can be.

        Returns
        -------
        FittedLoad

        Raises
        ------
        ValueError
            If there are fewer than 3 samples, one is not finite, all are equal, or there are too
            few for the harmonics.

        Examples
        --------
        >>> fit = PeriodicLoad.from_samples([5.0, 4.0, 3.0, 4.0])
        >>> round(fit.static_load, 9), round(fit.pulsating_load, 9), fit.shape.cosine
        (4.0, 1.0, (1.0,))
        """
        values = numbers("samples", samples)
        if values.ndim != 1 or values.size < 3:
            raise ValueError(
                f"`samples` must be a list of 3 numbers or more, got shape {values.shape}"
            )
        phase = 2 * np.pi * np.arange(values.size) / values.size
        return _fitted(phase, values, harmonics, (values.size - 1) // 2)

    @classmethod
    def from_history(
        cls, time: ArrayLike, load: ArrayLike, period: float, harmonics: int = 8
    ) -> FittedLoad:
        """Return the Fourier series that is nearest to a measured load, by least squares.

        Parameters
        ----------
        time : (m,) float
            Times of the samples [s], in any order; φ = 0 at the time 0.
        load : (m,) float
            The load, in any unit.
        period : float
            T [s], above 0. Several periods may be given.
        harmonics : int
            Highest harmonic, 1 to 64.

        Returns
        -------
        FittedLoad
            Its `residual` says how much of the load the series leaves out.

        Raises
        ------
        ValueError
            If the lists differ in length, a number is not finite, the times lie at fewer phases
            than the series has coefficients, or the load does not vary with the period.
        """
        times, values = numbers("time", time), numbers("load", load)
        if times.ndim != 1 or times.shape != values.shape:
            raise ValueError(
                "`time` and `load` must be lists of one length, "
                f"got shapes {times.shape} and {values.shape}"
            )
        length = number("period", period, 0.0, open_low=True)
        phase = 2 * np.pi * np.mod(times / length, 1.0)
        return _fitted(phase, values, harmonics, _MOST_HARMONICS)

    @classmethod
    def from_csv(cls, path: str | PathLike[str], period: float, harmonics: int = 8) -> FittedLoad:
        """Return the Fourier series of a measured load in a CSV file.

        Parameters
        ----------
        path : path
            Two columns, time [s] and load, with commas or semicolons between them. Lines before
            the first line of two numbers are headings.
        period : float
            T [s], above 0.
        harmonics : int
            Highest harmonic, 1 to 64.

        Returns
        -------
        FittedLoad

        Raises
        ------
        ValueError
            If a line below the headings does not hold two numbers; the message names the line.
        OSError
            If the file cannot be read.
        """
        time, load = zip(*_rows(Path(path).read_text(encoding="utf-8-sig")), strict=True)
        return cls.from_history(time, load, period, harmonics)


COSINE = PeriodicLoad()
"""The load of the paper, p̄₀ + p̄_t cos θ̄t."""


@dataclass(frozen=True)
class FittedLoad:
    """A load p₀ + p_t f(θt) fitted to samples.

    Parameters
    ----------
    shape : PeriodicLoad
        f, whose largest harmonic has the amplitude 1.
    static_load, pulsating_load : float
        p₀ and p_t, in the unit of the samples.
    residual : float
        Root mean square of what the series leaves out, as a part of that of the load less p₀.
    """

    shape: PeriodicLoad
    static_load: float
    pulsating_load: float
    residual: float


def _fitted(phase: Array, values: Array, harmonics: int | None, most: int) -> FittedLoad:
    """Return the least-squares series of values at phases; `most` harmonics are possible."""
    most = min(most, _MOST_HARMONICS)
    count = most if harmonics is None else whole_number("harmonics", harmonics, 1, most)
    orders = np.outer(phase, np.arange(1, count + 1))
    matrix = np.hstack([np.ones((len(phase), 1)), np.cos(orders), np.sin(orders)])
    found, _, rank, _ = np.linalg.lstsq(matrix, values, rcond=_ROUNDING)
    if rank < matrix.shape[1]:
        raise ValueError(
            f"`harmonics` must be so few that the samples determine them, got {count} "
            f"with {len(np.unique(phase))} different phases"
        )
    amplitudes = found[1 : count + 1] - 1j * found[count + 1 :]
    amplitudes[np.abs(amplitudes) <= _ROUNDING * np.abs(amplitudes).max()] = 0
    scale = float(np.abs(amplitudes).max())
    if scale <= NEGLIGIBLE * float(np.abs(values).max()):
        raise ValueError("`load` must vary with the period, got one that does not")
    # no part of a coefficient that is rounding: an even load stays exactly even
    parts = np.array([amplitudes.real, -amplitudes.imag]) / scale
    parts[np.abs(parts) < _ROUNDING] = 0.0
    variation = values - found[0]
    left = float(np.linalg.norm(values - matrix @ found)) / float(np.linalg.norm(variation))
    shape = PeriodicLoad(tuple(parts[0].tolist()), tuple(parts[1].tolist()))
    return FittedLoad(shape, float(found[0]), scale, left)


def _rows(text: str) -> list[tuple[float, float]]:
    """Return the pairs of numbers of a CSV text."""
    delimiter = ";" if ";" in text else ","
    rows: list[tuple[float, float]] = []
    for line, cells in enumerate(csv.reader(text.splitlines(), delimiter=delimiter), start=1):
        try:
            time, load, *_ = (float(cell) for cell in cells[:2])
        except ValueError:
            if rows and any(cell.strip() for cell in cells):
                message = f"`path`: line {line} must hold two numbers, got {cells}"
                raise ValueError(message) from None
            continue
        if not (math.isfinite(time) and math.isfinite(load)):
            raise ValueError(f"`path`: line {line} must hold two finite numbers, got {cells}")
        rows.append((time, load))
    if not rows:
        raise ValueError("`path` must name a file with lines of two numbers, got none")
    return rows
