"""The sidebar component and its protocol: one message in, one answer out.

The browser sends the newest values only after it has painted the answer to the last ones
(the latest values win), so nothing is queued, with one user or many. Every message is answered with
its number, in the order of the messages: a page that gets no answer knows that the server is away.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from pathlib import Path
from time import perf_counter
from typing import Any, ClassVar

import panel as pn
import param
from bokeh.document import Document
from bokeh.events import Event
from panel.io.state import set_curdoc

from rotorstab import STIFFNESS_LAWS

from ..background.telemetry import observe
from ..background.threads import turn
from ..state import PRESETS, SI_INPUTS, SYMBOLS, State
from ..state.own_inputs import OWN_SLIDERS
from ..state.own_presets import OWN_FILE, OWN_PRESETS

__all__ = ["Controls", "field"]

_LOG = logging.getLogger("rotorstab.app")
_ASSETS = Path(__file__).parents[1] / "assets"

GROUPS = (
    # the first group has no heading and is always in view
    (
        "",
        True,
        (
            "load_type",
            "tangency",
            "static_load_factor",
            "spin_speed",
            "shear",
            "disk_mass",
            "diametral_inertia",
            "polar_inertia",
        ),
    ),
    ("Damping", False, ("external_damping", "internal_damping")),
    ("Model", False, ("reference", "law", "model")),
    (
        "Charts",
        False,
        (
            "show_growth",
            "show_bolotin",
            "show_disagreement",
            "growth_unit",
            "largest_factor",
            "lowest_frequency",
            "highest_frequency",
            "stiffness",
        ),
    ),
    ("Units", False, ("units", *SI_INPUTS)),
)
OWN_GROUP = ("own_rotor", *OWN_SLIDERS)
"""The inputs of the page Your rotor, which alone shows them."""
# an input that is shown only while another one has a value
ONLY_WITH = {"tangency": ("load_type", "partly")}
WORDS = {
    "axial": "Axial",
    "partly": "Partly",
    "follower": "Follower",
    "buckling": "Buckling load",
    "flutter": "Flutter at rest",
    **{name: name.capitalize() for name in STIFFNESS_LAWS},
    "both": "Both",
    "lumped": "Lumped",
    "finite elements": "Finite elements",
    "per time": "Per time",
    "per period": "Per period",
    "non-dimensional": "Non-dimensional",
    "SI": "SI",
    "own": "Own",
    "steel": "Steel",
    "aluminium": "Aluminium",
    "titanium": "Titanium",
    **{name: preset.title for name, preset in OWN_PRESETS.items()},
    OWN_FILE: "Own rotor",
}


def field(name: str) -> dict[str, Any]:
    """Return the declaration of one input in the state, for the browser."""
    parameter = State.param[name]
    found = {
        "name": name,
        "label": parameter.label,
        "symbol": SYMBOLS.get(name, ""),
        "doc": parameter.doc,
    }
    if name in ONLY_WITH:
        found["only_with"] = list(ONLY_WITH[name])
    if isinstance(parameter, param.Boolean):
        return found | {"switch": True}
    if isinstance(parameter, param.Selector):
        return found | {"options": [[word, WORDS[word]] for word in parameter.objects]}
    low, high = parameter.bounds
    found |= {"low": low, "high": high, "step": parameter.step}
    # a quantity in SI has a box without a slider: its range spans magnitudes
    return found | {"unit": SI_INPUTS[name]} if name in SI_INPUTS else found


class Controls(pn.custom.JSComponent):
    """Sliders, number boxes and choices.

    Parameters
    ----------
    respond : callable
        Takes a message, a mapping with a "type", and returns the content of the answer.
    """

    spec = param.List(doc="Groups of fields.")
    presets = param.List(doc="Names of the presets.")

    _esm = _ASSETS / "controls.js"
    # as text: a path would be fetched from /components/, which deploy/setup.py shuts
    _stylesheets: ClassVar[list[str]] = [(_ASSETS / "controls.css").read_text(encoding="utf-8")]

    def __init__(self, respond: Callable[[Mapping[str, Any]], dict[str, Any]]) -> None:
        self._respond = respond
        super().__init__(
            spec=[
                {"title": title, "open": open_, "fields": [field(name) for name in names]}
                for title, open_, names in GROUPS
            ]
            + [{"title": "Your rotor", "page": "rotor", "fields": [*map(field, OWN_GROUP)]}],
            presets=list(PRESETS),
            sizing_mode="stretch_width",
        )

    def _handle_msg(self, data: Any) -> None:
        """Take a message as Panel hands it over."""
        self.receive(data)

    def receive(self, data: Any) -> None:
        """Answer one message; anything that is not a mapping is ignored."""
        if not isinstance(data, Mapping):
            return
        sequence = data.get("seq")
        number = {"seq": sequence if isinstance(sequence, int) else 0}
        if data.get("type") == "ping":  # asks only whether the server is there
            self.send(number)
            return
        with turn, pn.io.hold():  # patches and answer leave as one message
            began = perf_counter()
            try:
                answer = self._respond(data)
            except Exception:
                _LOG.exception("a message could not be answered")
                answer = {"toast": "the server could not use this message"}
            self.send(answer | number)
        observe("update", perf_counter() - began)

    def _server_event(self, doc: Document, event: Event) -> None:
        """Answer a message at once, while its thread holds the lock of the document.

        Panel postpones messages that come before the page has reported that it is ready. From
        Panel 1.10 on it then works without that lock, and the page gets no answer.
        """
        self._comm_event(doc, event)

    def _process_bokeh_event(self, doc: Document, event: Event) -> None:
        """Process an event without Panel's busy indicator: the page has none, and it costs 10 %."""
        with set_curdoc(doc):
            self._process_event(event)

    def send(self, content: Mapping[str, Any]) -> None:
        """Send the browser a message: an answer, or one that it did not ask for."""
        self._send_msg(dict(content))
