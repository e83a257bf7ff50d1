"""Explore: the instability chart, the load–frequency chart and the Campbell diagram."""

from __future__ import annotations

import logging
from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from bokeh.models import CustomJS

from rotorstab.charts import Chart, chart_factors, fitted_top, with_top

from ..live.chart import LiveChart
from ..live.low import make_low
from ..live.small import make_small
from ..reading.user_error import UserError
from ..results.analysis import CHARTS, Result, home_view, solve, window_of
from ..results.curves import load_cases
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..results.views import View, view_of
from ..results.window import Window
from ..state import SYMBOLS, State
from ..state.address import MOST_PINS, PinnedInputs
from ..state.rotor_file import read_rotor_file, write_rotor_file
from ..words.details import details
from ..words.refusals import user_message
from ..words.si import displayed, shaft_words, shown_scales, si_answer
from ..words.verdict import verdict
from .base import FRAGMENTS, Page, Reply, Stage
from .marked_point import INSPECTOR_CHARTS, Inspection, inspect, with_marks
from .pins import Pin, differences, pin, solve_pin, with_pins

__all__ = ["Explore"]

_LOG = logging.getLogger("rotorstab.app")
VIEW_BOUNDS = (
    *State.param["lowest_frequency"].bounds[:1],
    *State.param["highest_frequency"].bounds[1:],
    0.0,
    *State.param["largest_factor"].bounds[1:],
)
"""Smallest and largest θ/ω_n and β_d that a zoom may show."""


class Explore(Page):
    """The three live charts, the key numbers, the verdict, the inspector and the pins."""

    key = "explore"
    title = "Explore"
    chart_keys = (*CHARTS, *INSPECTOR_CHARTS)
    takes = frozenset({"use_shaft", "rotor_file", "save_rotor_file"})

    def __init__(self) -> None:
        super().__init__()
        self.pins: list[Pin] = []
        self._unsolved_pins: list[PinnedInputs] = []  # of the address
        # the last inspection, and what it was made of
        self._inspected: tuple[tuple[Any, ...], Result, Inspection | str] | None = None
        self.view: View | None = None  # the part of the instability chart that a zoom shows
        self.fitted: dict[str, float] = {}  # upper ends of the colours that the user has asked for

    @classmethod
    def fragment(cls) -> str:
        """Return the page's layout with the marker's and the inspector's."""
        text = super().fragment()
        for name in ("marker", "inspector"):
            part = (FRAGMENTS / f"{name}.html").read_text(encoding="utf-8")
            text = text.replace(f"<!-- {name} -->", part)
        return text

    def compute(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Chart]:
        """Return the three charts, and those of the marked point once there is time for them."""
        result = solve(state, detail, self.view)
        marked = state.marker and self.stage is Stage.COMPLETE
        charts = with_marks(result.charts, state, result) if marked else result.charts
        top = self.fitted.get(state.growth_unit)
        if top is not None:
            charts = charts | {"instability": with_top(charts["instability"], top)}
        charts = with_pins(displayed(charts, state, result.numbers), self.pins, shown_scales(state))
        if marked:
            inspection = self._inspect(state, result)
            if isinstance(inspection, Inspection):
                charts = charts | inspection.charts
        return charts

    def awaited(self, state: State) -> Window | None:
        """Return the window of the growth map until its refined map is there."""
        try:
            window = window_of(state, self.view)
        except ValueError:  # `compute` raises the same error, for the user
            return None
        return None if known_detail(window) is Detail.REFINED else window

    def cache_key(self) -> tuple[Any, ...]:
        """Return names, numbers and inputs of the pins, and the scales of the colours."""
        pins = ((pin.name, pin.number, *pin.inputs.values()) for pin in self.pins)
        return *pins, *self.fitted.items(), self.view

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
            "disagreement": state.show_disagreement,
            "Bolotin region": state.show_bolotin,
            "boundary": state.show_bolotin,
            "boundary name": state.show_bolotin,
        }

    def homes(self, state: State) -> dict[str, tuple[tuple[float, float], tuple[float, float]]]:
        """Return the ranges that the instability chart has without a zoom."""
        home = home_view(state.inputs())
        x, y = 1.0, 1.0
        scales = shown_scales(state)
        if scales is not None:
            numbers = solve(state, Detail.COARSE, self.view).numbers
            x, y = chart_factors(
                "instability", scales, numbers["fundamental"], numbers["reference"]
            )
        return {"instability": ((home.left * x, home.right * x), (home.low * y, home.high * y))}

    def reset_view(self) -> None:
        """Undo every zoom."""
        super().reset_view()
        self.view = None

    def built(self, key: str, chart: LiveChart) -> None:
        """Fit a chart into its place; a click on the instability chart places the marker."""
        if key in CHARTS:
            chart.figure.min_height = None  # the page gives each chart its height
        if key in ("load-frequency", "campbell"):
            make_low(chart.figure)
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
            return self._pin(message.get("label"), state)
        if kind == "unpin":
            self.pins = [pin for pin in self.pins if pin.number != message.get("number")]
        elif kind == "window":
            if message.get("chart") == "instability":
                self.view = view_of(message, VIEW_BOUNDS, home_view(state.inputs()))
        elif kind == "colours":
            self._fit_colours(message.get("fit") is True, state)
        elif kind == "use_shaft":
            return _use_shaft(state)
        elif kind == "rotor_file":
            return _open_rotor_file(message.get("text"), state)
        elif kind == "save_rotor_file":
            return _save_rotor_file(state)
        return Reply()

    def _fit_colours(self, fit: bool, state: State) -> None:
        """Fit the colours to the growth in the chart, or give them their usual scale again."""
        self.fitted = {}
        if fit:
            bands = solve(state, Detail.COARSE, self.view).charts["instability"].layer("unstable")
            growth = np.where(bands.columns["edge"][0] > 0, bands.columns["growth"][0], 0.0)
            self.fitted = {state.growth_unit: fitted_top(growth)}

    def _pin(self, name: object, state: State) -> Reply:
        try:
            made = pin(state, name, self.pin_inputs())
        except ValueError as error:
            return Reply({"told": user_message(error)})
        if made is None:
            return Reply({"told": f"at most {MOST_PINS} pins: remove one first"})
        self._add(made)
        return Reply({"told": f"{made.name} is kept"})

    def _add(self, made: Pin) -> None:
        self.pins = sorted([*self.pins, made], key=lambda pin: pin.number)

    def pin_inputs(self) -> Sequence[PinnedInputs]:
        """Return the pins, for the address."""
        return sorted([*self.pins, *self._unsolved_pins], key=lambda pin: pin.number)

    def set_address_pins(self, pins: Sequence[PinnedInputs]) -> None:
        """Note the pins of an address, which `restore_next_pin` solves one by one."""
        self._unsolved_pins = list(pins)

    def restore_next_pin(self) -> str | None:
        """Solve one pin of the address; return None if no pin was waiting."""
        if not self._unsolved_pins:
            return None
        unsolved = self._unsolved_pins.pop(0)
        try:
            self._add(solve_pin(unsolved))
        except ValueError as error:
            return f"p{unsolved.number} ({user_message(error)})"
        except Exception:
            _LOG.exception("a pin of the address failed: %r", unsolved.inputs)
            return f"p{unsolved.number} (it could not be computed)"
        return ""

    def sidebar_answer(self, state: State) -> dict[str, Any]:
        """Return what the shaft in SI gives, for the sidebar, which is beside every page."""
        return {"shaft": shaft_words(state)}

    def answer(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Any]:
        """Return the key numbers, the verdict, the marked point and the pins."""
        result = solve(state, detail, self.view)
        answer = {
            "numbers": result.numbers,
            "verdict": verdict(
                result.floquet,
                shown_scales(state),
                state.show_bolotin or state.show_disagreement,
            ),
            "details": details(result.floquet, shown_scales(state)),
            "settled": detail is Detail.REFINED,
            "curves": [
                case.name
                for case in load_cases(state.model, state.effective_tangency(), state.stiffness)
            ],
            "inspector": None,
            "colours_fitted": state.growth_unit in self.fitted,
            "si": si_answer(state, result.numbers, CHARTS) if state.units == "SI" else None,
            "pins": differences(state, result, self.pins) if self.pins else None,
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


def _use_shaft(state: State) -> Reply:
    """Set the non-dimensional inputs from the shaft in SI."""
    errors = state.use_shaft()
    problem = "; ".join(f"{SYMBOLS.get(name, name)} {reason}" for name, reason in errors.items())
    return Reply({"shaft_error": problem})


def _save_rotor_file(state: State) -> Reply:
    data = b64encode(write_rotor_file(state).encode()).decode()
    name = "rotor.toml"
    file = {"name": name, "mime": "application/toml", "base64": data}
    return Reply({"file": file, "told": f"{name} is ready", "shaft_error": ""})


def _open_rotor_file(text: object, state: State) -> Reply:
    """Set the inputs from a rotor file; a bad file leaves every input as it was."""
    try:
        values, left_out = read_rotor_file(text if isinstance(text, str) else "")
    except UserError as error:
        return Reply({"shaft_error": str(error), "told": "the rotor file was not taken"})
    state.change(values)
    if left_out:
        notice = f"The rotor was taken, but not {'; '.join(left_out)}."
        return Reply({"shaft_notice": notice, "told": "the rotor file was taken in part"})
    return Reply({"shaft_error": "", "told": "the rotor file is open"})
