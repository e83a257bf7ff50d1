"""Charts in SI: the only place where axes, marks, maps and names are converted for a picture."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..rotors.shaft_disk import Scales
from .numbers import LOAD_UNITS, load_unit, written
from .quantities import (
    EXCITATION,
    GROWTH,
    GROWTH_PER_PERIOD,
    GROWTH_SI,
    LOAD,
    SPIN,
    WHIRL,
    Amount,
    Quantity,
)
from .roles import ROLES
from .structure import Chart, Layer

__all__ = ["chart_factors", "in_seconds", "in_si"]

_TURN = 2 * math.pi
_SI_MEANINGS = {role.meaning: role.si_meaning for role in ROLES.values() if role.si_meaning}


@dataclass(frozen=True)
class _Scaled:
    """A quantity in SI, and what one non-dimensional unit of it is."""

    quantity: Quantity
    factor: float


def _in_si(scales: Scales, unit: str) -> dict[Quantity, _Scaled]:
    """Return what each non-dimensional quantity is in SI; loads are in `unit`."""
    hertz = scales.frequency / _TURN
    return {
        LOAD: _Scaled(Quantity("static load", "P", unit), scales.load / LOAD_UNITS[unit]),
        SPIN: _Scaled(Quantity("spin speed", "Ω", "rpm"), 60 * hertz),
        WHIRL: _Scaled(Quantity("whirl", "ω/2π", "Hz"), hertz),
        EXCITATION: _Scaled(Quantity("excitation frequency", "θ/2π", "Hz"), hertz),
        GROWTH: _Scaled(GROWTH_SI, scales.frequency),
        GROWTH_PER_PERIOD: _Scaled(Quantity("growth per period", "σT"), 1.0),
    }


def _axes(
    known: Mapping[Quantity, _Scaled], frequency: float, load: float
) -> dict[str, tuple[_Scaled, _Scaled]]:
    """Return both axes by a chart's key; `frequency` and `load` are what the ratios stand for."""
    excitation, force = known[EXCITATION], known[LOAD]
    return {
        "instability": (
            _Scaled(excitation.quantity, frequency * excitation.factor),
            _Scaled(Quantity("pulsating load", "Pₜ", force.quantity.unit), load * force.factor),
        ),
        "load-frequency": (force, known[WHIRL]),
        "campbell": (known[SPIN], known[WHIRL]),
    }


def chart_factors(
    key: str, scales: Scales, fundamental_frequency: float, reference_load: float
) -> tuple[float, float]:
    """Return what one unit of each axis is in SI: (1, 1) for a chart without dimensions.

    Parameters
    ----------
    key : str
        Of the chart.
    scales, fundamental_frequency, reference_load
        As in `in_si`.
    """
    known = _in_si(scales, load_unit(scales))
    axes = _axes(known, fundamental_frequency, reference_load).get(key)
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
        Non-dimensional. One of a kind without dimensions, and one in SI, are returned unchanged.
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
        Growth becomes σ [1/s], unless it is per period; names that give a load or a frequency
        give it in SI.
    """
    known = _in_si(scales, unit or load_unit(scales))
    axes = _axes(known, fundamental_frequency, reference_load).get(chart.key)
    if axes is None or chart.in_si:
        return chart
    x, y = axes
    convert = _Converter(x.factor, y.factor, known)
    return replace(
        chart,
        x=x.quantity,
        y=y.quantity,
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
        x=Quantity("time", "t", "s"),
        x_range=(low * period, high * period),
        layers=layers,
        units="SI",
    )


@dataclass(frozen=True)
class _Converter:
    """Converts the layers of one chart; `x` and `y` are the factors of its axes."""

    x: float
    y: float
    known: Mapping[Quantity, _Scaled]

    def layer(self, layer: Layer) -> Layer:
        columns: dict[str, Any] = dict(layer.columns)
        if layer.kind == "map":
            return self._map(layer)
        if layer.kind == "bands":
            return self._bands(layer)
        for axis, factor in (("x", self.x), ("y", self.y)):
            if layer.kind == "edges":
                columns[axis] = [columns[axis][0] * factor]
            elif axis in columns:
                columns[axis] = np.asarray(columns[axis]) * factor
            else:
                columns[f"{axis}s"] = [line * factor for line in columns[f"{axis}s"]]
        if "wording" in columns:
            columns["name"] = [
                name
                if wording is None
                else (wording.si_text or wording.text).format(*map(self._amount, wording.amounts))
                for name, wording in zip(columns["name"], columns["wording"], strict=True)
            ]
        if "group" in columns:
            columns["group"] = [_SI_MEANINGS.get(group, group) for group in columns["group"]]
        return replace(layer, columns=columns)

    def _amount(self, amount: Amount) -> str:
        """Return the text of an amount in SI."""
        scaled = self.known[amount.quantity]
        text = f"{written(amount.value * scaled.factor, 5)} {scaled.quantity.unit}"
        return text if amount.bare else f"{scaled.quantity.symbol}{amount.index} = {text}"

    def _bands(self, layer: Layer) -> Layer:
        assert layer.quantity is not None
        shown = self.known[layer.quantity]
        factors = {"x": self.x, "y": self.y, "growth": shown.factor, "top": shown.factor}
        columns: dict[str, Any] = {
            name: [column[0] * factors[name]] if name in factors else column
            for name, column in layer.columns.items()
        }
        return replace(layer, columns=columns, quantity=shown.quantity)

    def _map(self, layer: Layer) -> Layer:
        factors = {"x": self.x, "dw": self.x, "y": self.y, "dh": self.y}
        columns: dict[str, Sequence[Any]] = {
            name: [value * factors[name] for value in column] if name in factors else column
            for name, column in layer.columns.items()
        }
        if layer.quantity is None:
            return replace(layer, columns=columns)
        shown, rate = self.known[layer.quantity], self.known[GROWTH]
        columns["image"] = [columns["image"][0] * np.float32(shown.factor)]
        columns["rate"] = [columns["rate"][0] * np.float32(rate.factor)]
        columns["frequency"] = [_TURN]  # the hover's θ is 2π times the abscissa in Hz
        return replace(layer, columns=columns, quantity=shown.quantity)
