"""Explore: the instability chart, the load–frequency chart and the Campbell diagram."""

from __future__ import annotations

import logging
from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

from bokeh.models import CustomJS

from rotorstab.charts import Chart

from ..live.chart import LiveChart
from ..results.analysis import CHARTS, Result, solve, window_of
from ..results.curves import load_kinds
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..results.window import Window
from ..state import SYMBOLS, State
from ..state.address import MOST_PINS, PinnedInputs
from ..state.rotor_file import read_rotor_file, write_rotor_file
from ..words.refusals import user_message
from ..words.si import displayed, shaft_words, shown_scales, si_answer
from ..words.verdict import verdict, verdict_room
from .base import FRAGMENTS, Page, Reply
from .marked_point import INSPECTOR_CHARTS, Inspection, inspect, with_marks
from .pins import Pin, differences, ghosted, pin, solved

__all__ = ["Explore"]

_LOG = logging.getLogger("rotorstab.app")


class Explore(Page):
    """The three live charts, the key numbers, the verdict, the inspector and the pins."""

    key = "explore"
    title = "Explore"
    chart_keys = (*CHARTS, *INSPECTOR_CHARTS)
    takes = frozenset({"use_shaft", "rotor_file", "save_rotor_file"})

    def __init__(self) -> None:
        super().__init__()
        self.pins: list[Pin] = []
        self._expected: list[PinnedInputs] = []  # pins of the address that are not solved yet

    @classmethod
    def fragment(cls) -> str:
        """Return the page's layout with the marker's and the inspector's."""
        text = super().fragment()
        for name in ("marker", "inspector"):
            part = (FRAGMENTS / f"{name}.html").read_text(encoding="utf-8")
            text = text.replace(f"<!-- {name} -->", part)
        return text

    def compute(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Chart]:
        """Return the three charts, and the inspector's where a point is marked.

        The map of growth is coarser while sliders move.
        """
        result = solve(state, detail)
        charts = with_marks(result.charts, state, result) if state.marker else result.charts
        charts = ghosted(displayed(charts, state, result.numbers), self.pins, shown_scales(state))
        if state.marker and not self.opening:
            inspection = self._inspect(state, result)
            if isinstance(inspection, Inspection):
                charts = charts | inspection.charts
        return charts

    def awaited(self, state: State) -> Window | None:
        """Return the window of the growth map until all of its picture is there."""
        try:
            window = window_of(state)
        except ValueError:  # `compute` says it in words
            return None
        return None if known_detail(window) is Detail.REFINED else window

    def cache_key(self) -> tuple[Any, ...]:
        """Return what tells these charts from others of the same inputs."""
        return tuple((one.name, one.number, *one.inputs.values()) for one in self.pins)

    @staticmethod
    def _inspect(state: State, result: Result) -> Inspection | str:
        """Return the inspection or, where there is none, why."""
        try:
            return inspect(state, result)
        except ValueError as error:
            return user_message(error)

    def visible(self, state: State) -> dict[str, bool]:
        """Return the layers of the instability chart that can be switched."""
        return {
            "growth": state.show_growth,
            "tongue edge": state.show_growth,
            "tongue": state.show_growth,
            "disagreement": state.show_disagreement,
            "Bolotin region": state.show_bolotin,
            "boundary": state.show_bolotin,
            "boundary name": state.show_bolotin,
        }

    def built(self, key: str, chart: LiveChart) -> None:
        """Let a click on the instability chart place the marker."""
        if key == "instability":
            chart.figure.js_on_event(
                "tap", CustomJS(code="window.rotorstab.inspector.tap(cb_obj.x, cb_obj.y)")
            )

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Keep the present curves as a ghost, or let one go."""
        kind = message.get("type")
        if kind == "pin":
            try:
                made = pin(state, message.get("label"), self.pin_inputs())
            except ValueError as error:
                return Reply({"told": user_message(error)})
            if made is None:
                return Reply({"told": f"at most {MOST_PINS} pins: remove one first"})
            self.pins = sorted([*self.pins, made], key=lambda one: one.number)
            return Reply({"told": f"{made.name} is kept"})
        if kind in self.takes:
            return self._shaft(kind, message.get("text"), state)
        if kind == "unpin":
            self.pins = [one for one in self.pins if one.number != message.get("number")]
        return Reply()

    def pin_inputs(self) -> Sequence[PinnedInputs]:
        """Return the pins, for the address."""
        return sorted([*self.pins, *self._expected], key=lambda one: one.number)

    def set_address_pins(self, pins: Sequence[PinnedInputs]) -> None:
        """Take the pins of an address."""
        self._expected = list(pins)

    def restore_next_pin(self) -> str | None:
        """Solve one pin of the address; return None if no pin was waiting."""
        if not self._expected:
            return None
        one = self._expected.pop(0)
        try:
            self.pins = sorted([*self.pins, solved(one)], key=lambda pin: pin.number)
        except ValueError as error:
            return f"p{one.number} ({user_message(error)})"
        except Exception:
            _LOG.exception("a pin of the address failed: %r", one.inputs)
            return f"p{one.number} (it could not be computed)"
        return ""

    @staticmethod
    def _shaft(kind: object, text: object, state: State) -> Reply:
        """Put a shaft in SI into the sliders, or read or write a rotor file."""
        if kind == "use_shaft":
            errors = state.use_shaft()
            problem = "; ".join(f"{SYMBOLS.get(name, name)} {one}" for name, one in errors.items())
            return Reply({"shaft_error": problem})
        if kind == "save_rotor_file":
            data = b64encode(write_rotor_file(state).encode()).decode()
            name = "rotor.toml"
            file = {"name": name, "mime": "application/toml", "base64": data}
            return Reply({"file": file, "told": f"{name} is ready", "shaft_error": ""})
        try:
            # the rotor whole or not at all: a bad file leaves every input as it was
            values, left_out = read_rotor_file(text if isinstance(text, str) else "")
        except ValueError as error:
            return Reply({"shaft_error": str(error), "told": "the rotor file was not taken"})
        state.change(values)
        if left_out:
            notice = f"The rotor was taken, but not {'; '.join(left_out)}."
            return Reply({"shaft_notice": notice, "told": "the rotor file was taken in part"})
        return Reply({"shaft_error": "", "told": "the rotor file is open"})

    def sidebar_answer(self, state: State) -> dict[str, Any]:
        """Return what the shaft in SI gives, for the sidebar, which every page has."""
        return {"shaft": shaft_words(state)}

    def answer(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Any]:
        """Return the key numbers, the verdict, the marked point and the pins."""
        result = solve(state, detail)
        answer = {
            "numbers": result.numbers,
            "verdict": verdict(
                result.floquet,
                shown_scales(state),
                state.show_bolotin or state.show_disagreement,
            ),
            "verdict_room": verdict_room(result.floquet, shown_scales(state)),
            "settled": detail is Detail.REFINED,
            "curves": [
                name
                for name, *_ in load_kinds(state.model, state.effective_tangency(), state.stiffness)
            ],
            "inspector": None,
            "si": si_answer(state, result.numbers, CHARTS) if state.units == "SI" else None,
            "pins": differences(state, result, self.pins) if self.pins else None,
        }
        if state.marker and not self.opening:
            found = self._inspect(state, result)
            if isinstance(found, str):
                answer["inspector"] = {"sentence": found, "facts": []}
            else:
                # the animation waits for rest: it needs no message a frame
                moving = {} if detail is Detail.COARSE else {"motion": found.motion}
                answer["inspector"] = {"sentence": found.sentence, "facts": found.facts} | moving
        return answer
