"""Explore: the instability chart, the load–frequency chart and the Campbell diagram."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from bokeh.models import CustomJS, WheelZoomTool

from rotorstab.charts import Chart, chart_factors, fitted_top, with_top

from ..live.chart import LiveChart
from ..live.low import make_low
from ..live.small import make_small
from ..results.analysis import CHARTS, Result, home_view, solve, window_of
from ..results.curves import load_cases
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..results.operation import operation_of
from ..results.views import Frame, View, fineness_of, view_of
from ..results.whirl_charts import WHIRL_CHARTS, whirl_bounds, whirl_chart
from ..results.window import Window
from ..state import State
from ..state.address import PinnedInputs
from ..words.details import details
from ..words.refusals import user_message
from ..words.si import displayed, shaft_words, shown_scales, si_answer
from ..words.verdict import verdict
from .base import FRAGMENTS, Page, Reply, Stage
from .marked_point import INSPECTOR_CHARTS, Inspection, inspect, with_marks
from .pin_list import PinList
from .pinned_charts import PinnedCharts
from .pins import Pin, differences, side_by_side
from .rotor_messages import open_rotor_file, save_rotor_file, use_shaft

__all__ = ["Explore"]

COMPARISON = "comparison"
"""The key of a pin's instability chart beside the present one."""
BOUNDS = View(
    State.param["lowest_frequency"].bounds[0],
    State.param["highest_frequency"].bounds[1],
    0.0,
    State.param["largest_factor"].bounds[1],
)
"""The largest part of the instability chart that a zoom may show."""


class Explore(Page):
    """The three live charts, the key numbers, the verdict, the inspector and the pins."""

    key = "explore"
    title = "Explore"
    chart_keys = (*CHARTS, COMPARISON, *INSPECTOR_CHARTS)
    takes = frozenset({"use_shaft", "rotor_file", "save_rotor_file"})

    def __init__(self) -> None:
        super().__init__()
        self._pins = PinList()
        self._pinned = PinnedCharts()
        # the last inspection, and what it was made of
        self._inspected: tuple[tuple[Any, ...], Result, Inspection | str] | None = None
        self.views: Mapping[str, View] = {}  # the part that a zoom shows, by the key of the chart
        self.fineness = 1  # of the instability chart, for the pixels that it has on the screen
        self.fitted: dict[str, float] = {}  # upper ends of the colours that the user has asked for

    @classmethod
    def fragment(cls) -> str:
        """Return the page's layout with the marker's and the inspector's."""
        text = super().fragment()
        for name in ("marker", "inspector"):
            part = (FRAGMENTS / f"{name}.html").read_text(encoding="utf-8")
            text = text.replace(f"<!-- {name} -->", part)
        return text

    def compute(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Chart]:
        """Return the three charts, and those of the marked point once there is time for them."""
        view = self.view(state)
        result = self._result(state, detail)
        marked = state.marker and self.stage is Stage.COMPLETE
        charts = result.charts | self._zoomed(state)
        if marked:
            charts = with_marks(charts, state, result)
        top = self.fitted.get(state.growth_unit)
        if top is not None:
            charts = charts | {"instability": with_top(charts["instability"], top)}
        charts = displayed(charts, state, result.numbers)
        views = self.views if view is None else {**self.views, "instability": view}
        charts = self._pinned.added(charts, self.pins, state, result, views)
        beside = self._compared(state)
        if beside is not None:
            chart = self._pinned.beside(beside, state, result, view)
            top = charts["instability"].layer("unstable").columns["top"][0]
            title = side_by_side(state, beside)["pin"]
            charts[COMPARISON] = replace(with_top(chart, top), key=COMPARISON, title=title)
        if marked:
            inspection = self._inspect(state, result)
            if isinstance(inspection, Inspection):
                charts = charts | inspection.charts
        return charts

    @property
    def pins(self) -> Sequence[Pin]:
        """The pins whose curves are drawn: none beside a lesson."""
        return () if self.in_lesson else self._pins.solved

    def _compared(self, state: State) -> Pin | None:
        """Return the pin whose chart stands beside the present one."""
        return next((pin for pin in self.pins if f"pin {pin.number}" == state.compared), None)

    def view(self, state: State) -> View | None:
        """Return what is seen of the instability chart; None for all of it as finely as usual."""
        zoomed = self.views.get("instability")
        if self.fineness == 1:
            return zoomed
        return replace(zoomed or home_view(state.inputs()), fineness=self.fineness)

    def _result(self, state: State, detail: Detail) -> Result:
        """Return what is computed for what is seen."""
        return solve(state, detail, self.view(state))

    def resize(self, message: Mapping[str, Any]) -> bool:
        """Note how finely the instability chart is computed for its pixels on the screen."""
        before, told = self.fineness, fineness_of(message)
        self.fineness = before if told is None else told
        return self.fineness != before

    def _zoomed(self, state: State) -> dict[str, Chart]:
        """Return the other charts in which the user has zoomed, of the part that is seen."""
        operation = operation_of(state)
        return {
            key: whirl_chart(key, operation, state.stiffness, view)
            for key, view in self.views.items()
            if key in WHIRL_CHARTS
        }

    def awaited(self, state: State) -> Window | None:
        """Return the window of the growth map until its full map is there."""
        try:
            window = window_of(state, self.view(state))
        except ValueError:  # `compute` raises the same error, for the user
            return None
        return None if known_detail(window) is Detail.FULL else window

    def later(self, state: State) -> tuple[Window, ...]:
        """Return the windows whose full maps make the outlines of pins exact."""
        try:
            now = self._result(state, Detail.COARSE)
            return self._pinned.windows(self.pins, state, now, self.view(state))
        except ValueError:
            return ()

    def cache_key(self) -> tuple[Any, ...]:
        """Return names, numbers and inputs of the pins, and the scales of the colours."""
        pins = ((pin.name, pin.number, *pin.inputs.values()) for pin in self.pins)
        return *pins, self.fineness, *self.fitted.items(), *self.views.items()

    def _inspect(self, state: State, result: Result) -> Inspection | str:
        """Return the inspection of the marked point, or the reason why there is none.

        The charts and the answer to one message share it.
        """
        inputs = tuple(state.inputs().values())
        if self._inspected is None or self._inspected[:2] != (inputs, result):
            found: Inspection | str
            try:
                found = inspect(state, result)
            except ValueError as error:
                found = user_message(error)
            self._inspected = inputs, result, found
        return self._inspected[2]

    def visible(self, state: State) -> dict[str, bool]:
        """Return by label whether a layer of the instability chart is switched on."""
        return {
            "growth": state.show_growth,
            "unstable": state.show_growth,
            "tongue edge": state.show_growth,
            "thin tongue": state.show_growth,
            "tongue": state.show_growth,
            "not computed": state.show_growth,
            "reason": state.show_growth,
            "disagreement": state.show_disagreement,
            "Bolotin region": state.show_bolotin,
            "boundary": state.show_bolotin,
            "boundary name": state.show_bolotin,
            "pinned edge": state.show_growth,
            "pin name": state.show_growth,
            "pinned boundary": state.show_bolotin,
        }

    def frames(self, state: State) -> dict[str, Frame]:
        """Return the ranges of the charts, in the units that the user chose."""
        result = self._result(state, Detail.COARSE)
        frames = self._frames(state, result)
        scales = shown_scales(state)
        if scales is None:
            return frames | {COMPARISON: frames["instability"]}
        numbers = result.numbers
        scaled = {
            key: frame.scaled(
                *chart_factors(key, scales, numbers["fundamental"], numbers["reference"])
            )
            for key, frame in frames.items()
        }
        return scaled | {COMPARISON: scaled["instability"]}

    def _frames(self, state: State, result: Result) -> dict[str, Frame]:
        """Return the non-dimensional ranges of the charts."""
        operation = operation_of(state)
        frames = {"instability": Frame(home_view(state.inputs()), BOUNDS)}
        for key in WHIRL_CHARTS:
            whole = result.charts[key]
            home = View(*whole.x_range, *whole.y_range)
            frames[key] = Frame(home, whirl_bounds(whole, operation))
        return frames

    def reset_view(self) -> None:
        """Undo every zoom."""
        super().reset_view()
        self.views = {}

    def built(self, key: str, chart: LiveChart) -> None:
        """Fit a chart into its place; a click on the instability chart places the marker."""
        if key in (*CHARTS, COMPARISON):
            chart.figure.min_height = None  # the page gives each chart its height
            # where one axis has reached its bounds the other one still zooms out
            chart.figure.select_one(WheelZoomTool).maintain_focus = False
        if key in ("load-frequency", "campbell"):
            make_low(chart.figure)
        if key == COMPARISON:
            chart.move_with(self.charts["instability"])
        if key in INSPECTOR_CHARTS:
            make_small(chart.figure)
        if key == "instability":
            chart.figure.js_on_event(
                "tap", CustomJS(code="window.rotorstab.marker.tap(cb_obj.x, cb_obj.y)")
            )

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Pin curves, remove a pin, zoom, fit the colours, or read or write the rotor."""
        kind = message.get("type")
        if kind == "pin":
            return self._pins.pin(message.get("label"), state)
        if kind == "unpin":
            self._pins.remove(message.get("number"))
            if self._compared(state) is None:
                state.change({"compared": "none"})
        elif kind == "window":
            self._see(message, state)
        elif kind == "colours":
            self._fit_colours(message.get("fit") is True, state)
        elif kind == "use_shaft":
            return use_shaft(state)
        elif kind == "rotor_file":
            return open_rotor_file(message.get("text"), state)
        elif kind == "save_rotor_file":
            return save_rotor_file(state)
        return Reply()

    def _see(self, message: Mapping[str, Any], state: State) -> None:
        """Note which part of a chart a zoom shows."""
        key = message.get("chart")
        if key not in CHARTS:
            return
        try:
            frame = self._frames(state, self._result(state, Detail.COARSE))[key]
        except ValueError:  # these inputs have no charts, and `compute` tells the user why
            return
        view = view_of(message, frame)
        views = {other: seen for other, seen in self.views.items() if other != key}
        self.views = views if view is None else {**views, key: view}

    def _fit_colours(self, fit: bool, state: State) -> None:
        """Fit the colours to the growth in the chart, or give them their usual scale again."""
        self.fitted = {}
        if fit:
            bands = self._result(state, Detail.COARSE).charts["instability"].layer("unstable")
            growth = np.where(bands.columns["edge"][0] > 0, bands.columns["growth"][0], 0.0)
            self.fitted = {state.growth_unit: fitted_top(growth)}

    def pin_inputs(self) -> Sequence[PinnedInputs]:
        """Return the pins, for the address."""
        return self._pins.inputs()

    def set_address_pins(self, pins: Sequence[PinnedInputs]) -> None:
        """Note the pins of an address, which `restore_next_pin` solves one by one."""
        self._pins.unsolved = list(pins)

    def restore_next_pin(self) -> str | None:
        """Solve one pin of the address; return None if no pin was waiting."""
        return self._pins.solve_next()

    def sidebar_answer(self, state: State) -> dict[str, Any]:
        """Return what the shaft in SI gives, for the sidebar, which is beside every page."""
        return {"shaft": shaft_words(state)}

    def answer(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Any]:
        """Return the key numbers, the verdict, the marked point and the pins."""
        result = self._result(state, detail)
        beside = self._compared(state)
        answer = {
            "numbers": result.numbers,
            "verdict": verdict(
                result.floquet,
                shown_scales(state),
                state.show_bolotin or state.show_disagreement,
            ),
            "details": details(result.floquet, shown_scales(state)),
            "settled": detail is Detail.FULL,
            "curves": [
                case.name
                for case in load_cases(state.model, state.effective_tangency(), state.stiffness)
            ],
            "inspector": None,
            "colours_fitted": state.growth_unit in self.fitted,
            "si": si_answer(state, result.numbers, CHARTS) if state.units == "SI" else None,
            "pins": differences(state, result, self.pins) if self.pins else None,
            "side_by_side": None if beside is None else side_by_side(state, beside),
        }
        if state.marker and self.stage is not Stage.OPENING:
            answer["inspector"] = self._point_answer(state, result)
        return answer

    def _point_answer(self, state: State, result: Result) -> dict[str, Any]:
        """Return the words and the motion of the marked point, or why it has none."""
        found = self._inspect(state, result)
        if isinstance(found, str):
            return {"sentence": found, "explanation": "", "facts": [], "motion": None}
        return {
            "sentence": found.sentence,
            "explanation": found.explanation,
            "facts": found.facts,
            "motion": found.motion,
        }
