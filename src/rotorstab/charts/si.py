"""Charts in SI: the only place where axes, marks, maps and names are converted for a picture."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..rotors.shaft_disk import Scales
from .numbers import LOAD_UNITS, load_unit, written
from .quantities import AXES, GROWTH, Amount, Measure, Quantity, ShareOf
from .roles import ROLES
from .structure import Chart, Layer

__all__ = ["SIUnits", "chart_factors", "in_seconds", "in_si", "unit_in_si"]

_TURN = 2 * math.pi
_SI_MEANINGS = {role.meaning: role.si_meaning for role in ROLES.values() if role.si_meaning}


def unit_in_si(measure: Measure, scales: Scales, load: str | None = None) -> tuple[float, str]:
    """Return what one non-dimensional unit is in SI, and the name of the unit in SI.

    Parameters
    ----------
    measure : Measure
    scales : Scales
        Of the shaft.
    load : str, optional
        Unit of loads, a key of `LOAD_UNITS`; `load_unit` of the shaft by default.
    """
    hertz = scales.frequency / _TURN
    if measure is Measure.LOAD:
        load = load or load_unit(scales)
        return scales.load / LOAD_UNITS[load], load
    factor = {
        Measure.FREQUENCY: hertz,
        Measure.SPIN: 60 * hertz,
        Measure.RATE: scales.frequency,
        Measure.MASS: scales.mass,
        Measure.INERTIA: scales.mass * scales.length**2,
        Measure.NUMBER: 1.0,
    }[measure]
    return factor, measure.value


@dataclass(frozen=True)
class SIUnits:
    """What the quantities of one rotor's charts are in SI.

    Parameters
    ----------
    scales : Scales
        Of the shaft.
    fundamental_frequency, reference_load : float
        ω_n [√(EI/(ρAL⁴))], and what β_d = 1 stands for [EI/L²].
    load : str, optional
        Unit of loads; `load_unit` of the shaft by default.
    """

    scales: Scales
    fundamental_frequency: float
    reference_load: float
    load: str | None = None

    def factor(self, quantity: Quantity) -> float:
        """Return what a value of 1 is in SI; 1 for a quantity without a form in SI."""
        if quantity.si is None:
            return 1.0
        share = {
            None: 1.0,
            ShareOf.FUNDAMENTAL_FREQUENCY: self.fundamental_frequency,
            ShareOf.REFERENCE_LOAD: self.reference_load,
        }[quantity.si.of]
        return share * unit_in_si(quantity.si.measure, self.scales, self.load)[0]

    def quantity(self, quantity: Quantity) -> Quantity:
        """Return the quantity as it is named and measured in SI."""
        form = quantity.si
        if form is None:
            return quantity
        unit = unit_in_si(form.measure, self.scales, self.load)[1]
        return Quantity(form.words or quantity.words, form.symbol, unit or "-")


def chart_factors(
    key: str,
    scales: Scales,
    fundamental_frequency: float,
    reference_load: float,
    unit: str | None = None,
) -> tuple[float, float]:
    """Return what one unit of each axis is in SI: (1, 1) for a chart without dimensions.

    Parameters
    ----------
    key : str
        Of the chart.
    scales, fundamental_frequency, reference_load, unit
        As in `in_si`.
    """
    units = SIUnits(scales, fundamental_frequency, reference_load, unit)
    x, y = (units.factor(quantity) for quantity in AXES[key]) if key in AXES else (1.0, 1.0)
    return x, y


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
    if chart.in_si or chart.x.si is None or chart.y.si is None:
        return chart
    units = SIUnits(scales, fundamental_frequency, reference_load, unit)
    x, y = units.factor(chart.x), units.factor(chart.y)
    convert = _Converter(x, y, units)
    return replace(
        chart,
        x=units.quantity(chart.x),
        y=units.quantity(chart.y),
        x_range=(chart.x_range[0] * x, chart.x_range[1] * x),
        y_range=(chart.y_range[0] * y, chart.y_range[1] * y),
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
    units: SIUnits

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
        shown = self.units.quantity(amount.quantity)
        value = amount.value * self.units.factor(amount.quantity)
        text = f"{written(value, 5)} {shown.unit}"
        return text if amount.bare else f"{shown.symbol}{amount.index} = {text}"

    def _bands(self, layer: Layer) -> Layer:
        assert layer.quantity is not None
        rate = self.units.factor(layer.quantity)
        factors = {"x": self.x, "y": self.y, "growth": rate, "top": rate}
        columns: dict[str, Any] = {
            name: [column[0] * factors[name]] if name in factors else column
            for name, column in layer.columns.items()
        }
        return replace(layer, columns=columns, quantity=self.units.quantity(layer.quantity))

    def _map(self, layer: Layer) -> Layer:
        factors = {"x": self.x, "dw": self.x, "y": self.y, "dh": self.y}
        columns: dict[str, Sequence[Any]] = {
            name: [value * factors[name] for value in column] if name in factors else column
            for name, column in layer.columns.items()
        }
        if layer.quantity is None:
            return replace(layer, columns=columns)
        shown, rate = self.units.factor(layer.quantity), self.units.factor(GROWTH)
        columns["image"] = [columns["image"][0] * np.float32(shown)]
        columns["rate"] = [columns["rate"][0] * np.float32(rate)]
        columns["frequency"] = [_TURN]  # the hover's θ is 2π times the abscissa in Hz
        return replace(layer, columns=columns, quantity=self.units.quantity(layer.quantity))
