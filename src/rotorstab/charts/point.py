"""Charts of one point of the instability chart, and its marks on the other charts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..floquet.point import FloquetSolution
from ..floquet.response import TimeResponse
from .columns import Lines, points_layer
from .quantities import EXCITATION, WHIRL, Amount, Quantity, Wording
from .structure import Chart, Layer

__all__ = [
    "marker_layer",
    "multiplier_chart",
    "orbit_chart",
    "pair_layers",
    "response_chart",
]

_NICE = np.array([1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 10.0])
_ROUNDING = 1e-9  # of a time in periods
_CIRCLE = np.linspace(0, 2 * np.pi, 181)


def _nice(largest: float) -> float:
    """Return a round number at or above `largest`, so that a range rarely moves."""
    if not 0 < largest < np.inf:
        return 1.0
    power = 10.0 ** np.floor(np.log10(largest))
    return float(power * _NICE[np.searchsorted(_NICE, largest / power * (1 - 1e-12))])


def multiplier_chart(floquet: FloquetSolution) -> Chart:
    """Return the Floquet multipliers in the complex plane, with the unit circle and −1.

    Parameters
    ----------
    floquet : FloquetSolution
        At one point.
    """
    finite = np.isfinite(floquet.multipliers)
    shown, grows = floquet.multipliers[finite], floquet.growing[finite]
    reach = _nice(max(1.3, 1.12 * float(np.abs(shown).max(initial=0.0))))
    lines = Lines()
    lines.add(np.cos(_CIRCLE), np.sin(_CIRCLE), "unit circle, |μ| = 1", "unit circle")
    rows = [(μ.real, μ.imag, f"μ = {μ:.4f}, |μ| = {abs(μ):.6f}".replace("-", "−")) for μ in shown]
    out = [row for row, outside in zip(rows, grows, strict=True) if outside]
    within = [row for row, outside in zip(rows, grows, strict=True) if not outside]
    return Chart(
        key="multipliers",
        title="Floquet multipliers",
        x=Quantity("real part", "Re(μ)"),
        y=Quantity("imaginary part", "Im(μ)"),
        x_range=(-reach, reach),
        y_range=(-reach, reach),
        layers=(
            Layer("lines", "circle", lines.columns),
            points_layer(
                "minus one",
                [(-1.0, 0.0, "−1: multiplier of a motion of period 2T (Bolotin’s method)")],
                role="minus one",
            ),
            points_layer("multipliers", within, role="multiplier"),
            points_layer("growing multipliers", out, role="growing multiplier"),
        ),
        square=True,
    )


def response_chart(motion: TimeResponse) -> Chart:
    """Return the tip's V and W over whole periods of the load, with the envelope e^(σt)."""
    periods = motion.time / motion.period
    envelope = motion.envelope
    lines = Lines()
    thin = slice(None, None, max(1, len(periods) // 200))
    for sign, word in ((1, "upper"), (-1, "lower")):
        lines.add(periods[thin], sign * envelope[thin], f"envelope e^σt, {word}", "envelope")
    lines.add(periods, motion.displacement.imag, "W of the tip", "tip W")
    lines.add(periods, motion.displacement.real, "V of the tip", "tip V")
    largest = max(float(envelope.max()), float(np.abs(motion.displacement).max()))
    reach = _nice(1.04 * largest)
    return Chart(
        key="response",
        title="Response of the tip",
        x=Quantity("time in periods of the load", "t/T"),
        y=Quantity("tip", "V, W"),
        x_range=(0.0, float(np.ceil(periods[-1] - _ROUNDING))),
        y_range=(-reach, reach),
        layers=(Layer("lines", "motion", lines.columns),),
    )


def orbit_chart(motion: TimeResponse) -> Chart:
    """Return the tip's path in the VW plane."""
    path = motion.displacement
    reach = _nice(1.04 * float(np.abs(path).max()))
    lines = Lines()
    lines.add(path.real, path.imag, "path of the tip", "orbit")
    ends = [
        (float(path[0].real), float(path[0].imag), "start"),
        (float(path[-1].real), float(path[-1].imag), "end of the time shown"),
    ]
    return Chart(
        key="orbit",
        title="Orbit of the tip",
        x=Quantity("tip displacement", "V"),
        y=Quantity("tip displacement", "W"),
        x_range=(-reach, reach),
        y_range=(-reach, reach),
        layers=(
            Layer("lines", "orbit", lines.columns),
            points_layer("start", ends[:1], role="start"),
            points_layer("end", ends[1:], role="end"),
        ),
        square=True,
    )


def _marker(rows: Sequence[tuple[float, float, str | Wording]]) -> Layer:
    return points_layer("marker", rows, "marked point", "marker")


def marker_layer(x: float, y: float) -> Layer:
    """Return the mark of the marked point."""
    return _marker([(x, y, "marked point")])


def pair_layers(x: float, pair: tuple[float, float], name: str, excitation: float) -> list[Layer]:
    """Return the pair of frequencies next to θ̄ at one abscissa, and θ̄ as a ruler beside them.

    Parameters
    ----------
    x : float
        Load or spin speed.
    pair : (float, float)
        Signed frequencies.
    name : str
        Of the pair, such as 1B+1F.
    excitation : float
        θ̄; the ruler of this length starts at the lower frequency.
    """
    low, high = sorted(pair)
    lines = Lines()
    ends = np.array([low, low + excitation])
    amounts = Amount(EXCITATION, excitation), Amount(WHIRL, low, bare=True)
    lines.add(np.array([x, x]), ends, Wording("{} from {}", amounts), "marker")
    rows = [(x, end, Wording(f"{name}: {{}}", (Amount(WHIRL, end, 5),))) for end in (low, high)]
    return [
        Layer("lines", "marker ruler", lines.columns),
        _marker(rows),
    ]
