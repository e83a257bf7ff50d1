"""The charts of pins: computed once for what is seen, and drawn into the present charts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotorstab import Scales
from rotorstab.charts import Chart, Layer, chart_factors, load_unit, outline_name
from rotorstab.drawing import contours

from ..results.analysis import CHARTS, Result, home_view, solve, window_of
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..results.operation import operation_of
from ..results.views import View
from ..results.whirl_charts import whirl_chart
from ..results.window import Window
from ..state import State
from ..words.si import chart_in_si, shown_scales
from .pins import Pin

__all__ = ["PINNED_LABELS", "PinnedCharts"]

PINNED_LABELS = ("pinned boundary", "pinned edge", "pin name", "pins")
"""Labels of the layers of pins: Bolotin's boundaries, Floquet's outlines and the names at them in
the instability chart, and whirl curves in the other charts."""
_BOUNDARY, _EDGE, _NAME, _WHIRL = PINNED_LABELS

_LINE = ("xs", "ys", "name")


@dataclass(frozen=True, eq=False)
class _Seen:
    """What is computed of a pin for one view, in its own non-dimensional numbers."""

    pin: Pin
    view: View
    window: Window
    result: Result
    outlines: Layer

    @property
    def is_exact(self) -> bool:
        """Whether its outlines are those of a full map."""
        return self.result.floquet.detail is Detail.FULL


class PinnedCharts:
    """Computes what is seen of pins, and keeps it while the sliders move."""

    def __init__(self) -> None:
        self._kept: dict[int, _Seen] = {}  # by the number of the pin

    def windows(
        self, pins: Sequence[Pin], state: State, now: Result, view: View | None
    ) -> tuple[Window, ...]:
        """Return the windows of growth maps that make the outlines of pins exact."""
        found = [self._seen(pin, state, now, view) for pin in pins]
        return tuple(seen.window for seen in found if not seen.is_exact)

    def added(
        self,
        charts: Mapping[str, Chart],
        pins: Sequence[Pin],
        state: State,
        now: Result,
        views: Mapping[str, View],
    ) -> dict[str, Chart]:
        """Return charts with the curves of pins that differ from the present ones.

        Parameters
        ----------
        charts : mapping of str to Chart
            As the user sees them, in SI or not.
        pins : sequence of Pin
        state : State
        now : Result
            Of the present state.
        views : mapping of str to View
            The parts of charts that zooms show.
        """
        if not pins:
            return dict(charts)
        found = dict(charts)
        for key in CHARTS:
            layers: list[Layer] = []
            for pin in pins:
                own = self._own(key, pin, state, now, views.get(key))
                layers += _pinned(pin, _in_present_units(own, pin, state), charts[key])
            found[key] = replace(charts[key], layers=(*charts[key].layers, *_joined(layers)))
        return found

    def beside(self, pin: Pin, state: State, now: Result, view: View | None) -> Chart:
        """Return the instability chart of a pin for what is seen of the present one."""
        seen = self._seen(pin, state, now, view)
        result = seen.result
        if state.growth_unit != pin.state.growth_unit:
            shown = State(**pin.inputs, growth_unit=state.growth_unit)
            result = solve(shown, result.floquet.detail, seen.view)
        return _in_present_units(result.charts["instability"], pin, state)

    def _own(self, key: str, pin: Pin, state: State, now: Result, view: View | None) -> Chart:
        """Return a chart of a pin, in its own non-dimensional numbers, with what is drawn of it."""
        if key != "instability":
            view = view and _view_of_pin(key, view, pin, state, now)
            chart = whirl_chart(key, operation_of(pin.state), pin.state.stiffness, view)
            return replace(chart, layers=(chart.layer("whirl"),))
        seen = self._seen(pin, state, now, view)
        chart = seen.result.charts[key]
        layers = [chart.layer("boundary")]
        if seen.window != window_of(state, view):
            layers.append(seen.outlines)
        return replace(chart, layers=tuple(layers))

    def _seen(self, pin: Pin, state: State, now: Result, view: View | None) -> _Seen:
        """Return what is computed of a pin for the window that is seen of the present chart."""
        seen = _view_of_pin("instability", view or home_view(state.inputs()), pin, state, now)
        kept = self._kept.get(pin.number)
        if kept is not None and kept.pin is pin and kept.view == seen and kept.is_exact:
            return kept
        window = window_of(pin.state, seen)
        detail = Detail.FULL if known_detail(window) is Detail.FULL else Detail.COARSE
        if kept is None or kept.pin is not pin or kept.view != seen or detail is Detail.FULL:
            result = solve(pin.state, detail, seen)
            kept = _Seen(pin, seen, window, result, _outlines(result))
            self._kept[pin.number] = kept
        return kept


def _outlines(result: Result) -> Layer:
    """Return what bounds the unstable tongues of a result as lines."""
    lines: dict[str, list[Any]] = {name: [] for name in _LINE}
    for layer in result.charts["instability"].layers:
        if layer.label == "tongue edge":
            x, y = contours.outline(layer)
            rows = [(x, y, layer.columns["name"][0])]
        elif layer.label == "thin tongue":
            rows = list(zip(*(layer.columns[name] for name in lines), strict=True))
        else:
            continue
        for row in rows:
            for column, value in zip(lines.values(), row, strict=True):
                column.append(value)
    return Layer("lines", _EDGE, lines)


def _view_of_pin(key: str, view: View, pin: Pin, state: State, now: Result) -> View:
    """Return in the pin's own numbers what is seen of the present chart."""
    scales = shown_scales(state)
    if scales is None:  # both charts have the same non-dimensional axes
        return view
    here, there = (
        _units(key, units, result.numbers)
        for units, result in ((scales, now), (pin.scales, pin.result))
    )
    return view.scaled(here[0] / there[0], here[1] / there[1])


def _units(key: str, scales: Scales, numbers: Mapping[str, Any]) -> tuple[float, float]:
    """Return what one unit of each axis of a chart is in SI, with loads in N."""
    return chart_factors(key, scales, numbers["fundamental"], numbers["reference"], "N")


def _in_present_units(chart: Chart, pin: Pin, state: State) -> Chart:
    scales = shown_scales(state)
    if scales is None:
        return chart
    return chart_in_si(chart, pin.scales, pin.result.numbers, load_unit(scales))


def _pinned(pin: Pin, own: Chart, now: Chart) -> list[Layer]:
    """Return the lines of a pin that differ from the present ones, and its name."""
    role = f"pin {pin.number}"
    layers = []
    for layer in own.layers:
        present = [one.columns for one in now.layers if one.label == layer.label]
        rows = [
            (x, y, f"{pin.name}: {name}", role, pin.name)
            for x, y, name in zip(*(layer.columns[name] for name in _LINE), strict=True)
            if not name.startswith("synchronous") and not _is_drawn(x, y, present)
        ]
        label = {"boundary": _BOUNDARY, "whirl": _WHIRL}.get(layer.label, layer.label)
        names = (*_LINE, "role", "group")
        columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
        layers.append(Layer("lines", label, columns))
        if label == _EDGE and rows:
            outline = rows[0][0], rows[0][1]
            layers.append(outline_name(pin.name, pin.number, outline, (now.x_range, now.y_range)))
    return layers


def _is_drawn(x: Any, y: Any, present: Sequence[Mapping[str, Any]]) -> bool:
    """Whether one of the present lines is the same."""
    return any(
        np.array_equal(y, new_y, equal_nan=True) and np.array_equal(x, new_x, equal_nan=True)
        for columns in present
        for new_x, new_y in zip(columns["xs"], columns["ys"], strict=True)
    )


def _joined(layers: Sequence[Layer]) -> list[Layer]:
    """Return one layer for each label, with the rows of all layers of that label."""
    found: dict[str, Layer] = {}
    for layer in layers:
        known = found.get(layer.label)
        if known is not None:
            columns = {name: [*known.columns[name], *layer.columns[name]] for name in layer.columns}
            layer = replace(layer, columns=columns)
        found[layer.label] = layer
    return list(found.values())
