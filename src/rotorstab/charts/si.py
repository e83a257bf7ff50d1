"""Charts in SI: the one place where axes, marks and hover texts take units."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..rotors.shaft_disk import Scales
from .numbers import LOAD_UNITS, load_unit, written
from .structure import Chart, Layer

__all__ = ["chart_factors", "in_seconds", "in_si"]

_TURN = 2 * math.pi


@dataclass(frozen=True)
class _Axis:
    """What an axis is in SI: its label, and one non-dimensional unit."""

    label: str
    factor: float


def _axes(
    scales: Scales, frequency: float, load: float, unit: str
) -> dict[str, tuple[_Axis, _Axis]]:
    """Return both axes by a chart's key; `frequency` and `load` are what the ratios stand for."""
    hertz = scales.frequency / _TURN
    force = scales.load / LOAD_UNITS[unit]
    whirl = _Axis("whirl frequency ω/2π [Hz]", hertz)
    return {
        "instability": (
            _Axis("excitation frequency θ/2π [Hz]", frequency * hertz),
            _Axis(f"pulsating load P_t [{unit}]", load * force),
        ),
        "load-frequency": (_Axis(f"steady load P [{unit}]", force), whirl),
        "campbell": (_Axis("spin speed Ω [rpm]", 60 * hertz), whirl),
    }


def chart_factors(
    key: str, scales: Scales, fundamental_frequency: float, reference_load: float
) -> tuple[float, float]:
    """Return what one unit of each axis is in SI; (1, 1) for a chart without dimensions.

    Parameters
    ----------
    key : str
        Of the chart.
    scales, fundamental_frequency, reference_load
        As in `in_si`.
    """
    unit = load_unit(scales)
    axes = _axes(scales, fundamental_frequency, reference_load, unit).get(key)
    return (1.0, 1.0) if axes is None else (axes[0].factor, axes[1].factor)


def in_si(
    chart: Chart,
    scales: Scales,
    fundamental_frequency: float,
    reference_load: float,
    unit: str | None = None,
) -> Chart:
    """Return a chart with its axes in rpm, Hz and N, or what suits the shaft: kN, MN.

    Parameters
    ----------
    chart : Chart
        Non-dimensional; one of a kind without dimensions, or one in SI, comes back as it is.
    scales : Scales
        Of the shaft.
    fundamental_frequency : float
        ω_n [√(EI/(ρAL⁴))], by which the instability chart divides θ̄.
    reference_load : float
        What β_d = 1 stands for [EI/L²].
    unit : str, optional
        Of loads, a key of `LOAD_UNITS`; `load_unit` of the shaft by default.

    Returns
    -------
    Chart
        Growth becomes σ [1/s], unless it is per period; texts that name a load or a frequency
        name it in SI.
    """
    unit = unit or load_unit(scales)
    axes = _axes(scales, fundamental_frequency, reference_load, unit).get(chart.key)
    if axes is None or chart.units == "SI":
        return chart
    x, y = axes
    per_period = any(_per_period(layer) for layer in chart.layers)
    growth = 1.0 if per_period else scales.frequency
    convert = _Converter(x.factor, y.factor, growth, scales, unit)
    return replace(
        chart,
        x_label=x.label,
        y_label=y.label,
        x_range=(chart.x_range[0] * x.factor, chart.x_range[1] * x.factor),
        y_range=(chart.y_range[0] * y.factor, chart.y_range[1] * y.factor),
        layers=tuple(map(convert.layer, chart.layers)),
        units="SI",
    )


def in_seconds(chart: Chart, period: float) -> Chart:
    """Return the chart of a response with its abscissa in seconds.

    Parameters
    ----------
    chart : Chart
        Of `response_chart`, over t/T.
    period : float
        T [s].
    """
    layers = tuple(
        replace(layer, columns={**layer.columns, "xs": [x * period for x in layer.columns["xs"]]})
        for layer in chart.layers
    )
    low, high = chart.x_range
    return replace(
        chart,
        x_label="time t [s]",
        x_range=(low * period, high * period),
        layers=layers,
        units="SI",
    )


def _per_period(layer: Layer) -> bool:
    """Whether a map of growth is coloured by σ̄T, a number of its own in any unit."""
    if layer.kind != "map" or "rate" not in layer.columns:
        return False
    image = np.asarray(layer.columns["image"][0])
    seen = np.isfinite(image)
    return not np.array_equal(image[seen], np.asarray(layer.columns["rate"][0])[seen])


@dataclass(frozen=True)
class _Converter:
    """Turns the layers of one chart."""

    x: float
    y: float
    growth: float
    scales: Scales
    unit: str

    def layer(self, layer: Layer) -> Layer:
        columns: dict[str, Any] = dict(layer.columns)
        if layer.kind == "map":
            return replace(layer, columns=self._map(columns))
        long = layer.kind in ("lines", "regions")
        xs, ys = ("xs", "ys") if long else ("x", "y")
        if long:
            columns[xs] = [one * self.x for one in columns[xs]]
            columns[ys] = [one * self.y for one in columns[ys]]
        else:
            columns[xs] = np.asarray(columns[xs]) * self.x
            columns[ys] = np.asarray(columns[ys]) * self.y
        if layer.kind != "labels":
            columns["name"] = [
                _name(name, np.atleast_1d(x), np.atleast_1d(y), self.unit)
                for name, x, y in zip(columns["name"], columns[xs], columns[ys], strict=True)
            ]
        return replace(layer, columns=columns)

    def _map(self, columns: Mapping[str, Sequence[Any]]) -> dict[str, Sequence[Any]]:
        factors = {"x": self.x, "dw": self.x, "y": self.y, "dh": self.y}
        found = {
            name: [one * factors[name] for one in column] if name in factors else column
            for name, column in columns.items()
        }
        if "rate" in columns:
            found["image"] = [columns["image"][0] * np.float32(self.growth)]
            found["rate"] = [columns["rate"][0] * np.float32(self.scales.frequency)]
            found["frequency"] = [_TURN]  # the hover's θ is 2π times the abscissa in Hz
        return found


_NUMBER = r"[−-]?\d[\d.]*(?:e[+−-]?\d+)?"
_VALUE = re.compile(rf"(p̄₀|p̄|Ω̄|ω̄|θ̄) = {_NUMBER}(?: from {_NUMBER})?")


def _name(name: str, x: np.ndarray, y: np.ndarray, unit: str) -> str:
    """Return a mark's text with its values in SI, taken from where the mark stands."""

    def value(found: re.Match[str]) -> str:
        symbol = found[1].replace("\u0304", "")
        if symbol.startswith("p"):
            return f"{symbol.upper()} = {written(x[0], 5)} {unit}"
        if symbol == "Ω":
            return f"Ω = {written(x[0], 5)} rpm"
        if symbol == "θ":  # the ruler
            return f"θ/2π = {written(y[-1] - y[0], 5)} Hz from {written(y[0], 5)} Hz"
        return f"ω/2π = {written(y[0], 5)} Hz"

    return _VALUE.sub(value, name).replace("ω̄ = ", "ω = ").replace("Ω̄", "Ω")
