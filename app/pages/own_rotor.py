"""Your rotor: any rotor from a file or an example, its drawing, whirls and unstable tongues."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from bokeh.models import CustomJS

from rotorstab import Rotor
from rotorstab.charts import Chart, load_unit
from rotorstab.rotors.rotor_file import rotor_to_toml

from ..live.chart import LiveChart
from ..live.low import make_low
from ..live.small import make_small
from ..reading.numbers import printable
from ..reading.user_error import UserError
from ..results.growth_maps import known_detail
from ..results.limits import Detail
from ..results.own_charts import (
    OWN_CHARTS,
    OwnPoint,
    marked,
    own_chart,
    own_factors,
    own_floquet,
    own_point,
    own_tongues,
    own_window,
)
from ..results.own_model import (
    OwnModel,
    OwnOperation,
    Parts,
    keep_opened,
    opened_model,
    own_model,
    scaled_rotor,
)
from ..results.window import Window
from ..state import State
from ..state.own_edits import edited, tables
from ..state.own_file import LARGEST_OWN_FILE, OpenedRotor, elements_of, plain_line
from ..state.own_link import OWN_KEY, packed, packed_of, unpacked
from ..state.own_presets import OWN_FILE, OWN_PRESETS
from ..state.rates import rpm
from ..words.own_rotor import own_facts, own_sentence, point_facts
from .base import Need, Page, Reply

__all__ = ["OwnRotor"]

INSTABILITY = "rotor-instability"
_FACTORS = ("own_disk_mass", "own_inertia", "own_stiffness", "own_damping")
_QUICK = 20_000  # characters of a file that is read at once
_LOST = "This link was made with the rotor of a file: open that file again. Shown is an example."


class OwnRotor(Page):
    """The drawing of a rotor, its stability chart, Campbell diagram and load–frequency curves."""

    key = "rotor"
    title = "Your rotor"
    chart_keys = OWN_CHARTS
    takes = frozenset({"own_file", "own_save", "own_edit"})

    def __init__(self) -> None:
        super().__init__()
        self._opened: Rotor | None = None  # the rotor of a file, an edit or a link
        self._packed = ""  # the rotor of a link until it is needed
        self._lost = _LOST
        self._origin = ""  # in words
        self._notes: tuple[str, ...] = ()

    def rotor(self, state: State) -> Rotor:
        """Return the chosen rotor without its factors."""
        if state.own_rotor == OWN_FILE:
            self._unpack()
            if self._opened is not None:
                return self._opened
        chosen = OWN_PRESETS.get(state.own_rotor, next(iter(OWN_PRESETS.values())))
        return chosen.rotor

    def operation(self, state: State) -> OwnOperation:
        """Return the rotor with its factors, its speed and its load."""
        factors = (getattr(state, name) for name in _FACTORS)
        return OwnOperation(Parts(self.rotor(state), *factors), state.own_spin, state.own_load)

    def compute(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Chart]:
        """Return the four charts; the growth comes once another process has made it."""
        operation = self.operation(state)
        charts = {key: own_chart(key, operation, detail) for key in OWN_CHARTS}
        point = self._point(state)
        return charts | {INSTABILITY: marked(charts[INSTABILITY], point)}

    def _point(self, state: State) -> OwnPoint:
        return own_point(self.operation(state), state.own_frequency, state.own_factor)

    def awaited(self, state: State) -> Window | None:
        """Return the window of the growth map until the map is there."""
        try:
            window = own_window(self.operation(state))
        except ValueError:  # `compute` raises the same error, for the user
            return None
        return None if known_detail(window) is Detail.FULL else window

    def cache_key(self) -> tuple[Any, ...]:
        """Return the rotor of the file."""
        return (self._opened,)

    def built(self, key: str, chart: LiveChart) -> None:
        """Leave the height of a chart to the page; the drawing has no tools."""
        chart.figure.min_height = None
        if key == "rotor-drawing":
            make_small(chart.figure)
        elif key == INSTABILITY:
            chart.figure.js_on_event(
                "tap", CustomJS(code="window.rotorstab.rotor.tap(cb_obj.x, cb_obj.y)")
            )
        else:
            make_low(chart.figure)

    def answer(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Any]:
        """Return the words and numbers of the page."""
        operation = self.operation(state)
        model, table = operation.model, own_tongues(operation)
        waits = detail is not Detail.FULL and self.awaited(state) is not None
        point = self._point(state)
        solution = own_floquet(point)
        (across, up), load = own_factors(model.scales), load_unit(model.scales)
        return {
            "own": {
                "inputs": {
                    "own_spin": {"factor": rpm(model.scales), "unit": "rpm", "symbol": "Ω"},
                    "own_frequency": {"factor": across, "unit": "Hz", "symbol": "θ/2π"},
                    "own_factor": {"factor": up, "unit": load, "symbol": "Pₜ"},
                },
                "sentence": own_sentence(point, solution, table, waits),
                "point": point_facts(point, solution, model),
                "waits": waits,
                "facts": own_facts(scaled_rotor(operation.parts), model, table),
                "source": self._source(state),
                "notes": self._all_notes(state, model),
                "linked": bool(self.address_pairs(state)) or state.own_rotor != OWN_FILE,
                "tables": tables(operation.parts.rotor),
            }
        }

    def _source(self, state: State) -> str:
        if state.own_rotor == OWN_FILE:
            return self._origin if self._opened is not None else self._lost
        return OWN_PRESETS[state.own_rotor].source

    def _all_notes(self, state: State, model: OwnModel) -> list[str]:
        notes = [model.note] if model.note else []
        if state.own_rotor == OWN_FILE and self._opened is not None:
            notes += self._notes
        return notes

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Open a file, or return the rotor as one."""
        if message.get("type") == "own_save":
            return self._save(state)
        if message.get("type") == "own_file":
            return self._open(message, state)
        if message.get("type") == "own_edit":
            return self._edit(message, state)
        return Reply()

    def _edit(self, message: Mapping[str, Any], state: State) -> Reply:
        """Change a cell or a row of the tables; an edit that is refused changes nothing."""
        operation = self.operation(state)
        try:
            rotor = edited(operation.parts.rotor, message)
            elements_of(rotor)
            own_model(replace(operation.parts, rotor=rotor))
        except UserError as error:
            return Reply({"own_edited": str(error)})
        except ValueError as error:  # of the library, which has SI units
            return Reply({"own_edited": f"{plain_line(str(error))} (in m, kg, N)"})
        origin = self._source(state).removesuffix(".").removesuffix(", edited")
        if state.own_rotor != OWN_FILE:
            origin, self._notes = OWN_PRESETS[state.own_rotor].title, ()
        self._opened, self._origin = rotor, f"{origin}, edited."
        state.change({"own_rotor": OWN_FILE})
        return Reply({"own_edited": ""})

    def take_address(self, arguments: Mapping[str, Sequence[bytes | str]]) -> None:
        """Note the rotor of a link; it is read when the page is opened."""
        self._packed = packed_of(arguments)

    def address_pairs(self, state: State) -> Mapping[str, str]:
        """Return the rotor for the address, unless it is an example or too large."""
        if state.own_rotor != OWN_FILE:
            return {}
        text = self._packed if self._opened is None else packed(self._opened)
        return {OWN_KEY: text} if text else {}

    def _unpack(self) -> None:
        """Read the rotor of a link once."""
        if self._opened is None and self._packed:
            opened = unpacked(self._packed)
            self._packed = ""
            self._opened, self._origin = opened.rotor, "From this link."
            if opened.rotor is None:
                self._lost = f"Not opened: {opened.problem}. Shown is an example."

    def _save(self, state: State) -> Reply:
        rotor = scaled_rotor(self.operation(state).parts)
        data = b64encode(rotor_to_toml(rotor).encode()).decode()
        name = "rotor.toml"
        file = {"name": name, "mime": "application/toml", "base64": data}
        return Reply({"file": file, "told": f"{name} is ready"})

    def _open(self, message: Mapping[str, Any], state: State) -> Reply:
        """Read a file, a large one elsewhere: it takes longer than an answer may."""
        text, name = message.get("text"), message.get("name")
        if not isinstance(text, str) or len(text) > LARGEST_OWN_FILE:
            words = f"the file is larger than {LARGEST_OWN_FILE // 1000} kB"
            return Reply({"own_opened": {"problem": words}})
        found: list[tuple[OpenedRotor, OwnModel | None]] = []

        def keep(made: tuple[OpenedRotor, OwnModel | None]) -> None:
            found.append(made)
            keep_opened(made)

        shown = printable(name, 60) if isinstance(name, str) else "rotor"
        if len(text) <= _QUICK:
            keep(opened_model(text))
            return self._take(found, shown, state)
        answer = partial(self._take, found, shown, state)
        failed = {"own_opened": {"problem": "the file could not be read: try again"}}
        content = {"own_opening": shown}
        return Reply(content, follow_up=(Need(opened_model, (text,), keep), answer), failure=failed)

    def _take(
        self, found: list[tuple[OpenedRotor, OwnModel | None]], name: str, state: State
    ) -> Reply:
        """Show the rotor of a file; a refused one leaves everything as it was."""
        opened, _ = found[-1]
        if opened.rotor is None:
            return Reply({"own_opened": {"problem": opened.problem}, "told": f"{name} was refused"})
        self._opened, self._notes = opened.rotor, opened.notes
        self._origin = f"From the file {name}."
        defaults = {one: State.param[one].default for one in _FACTORS}
        state.change({"own_rotor": OWN_FILE, **defaults})
        for chart in self.charts.values():  # a zoom belongs to its rotor
            chart.reset_view()
        # the browser then asks once more, and the charts come with the answer
        return Reply({"own_opened": {"problem": ""}, "told": f"{name} is open"})
