"""Paper: every figure as live charts, its parameters, what the text says and what we compute."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeGuard

from rotorstab import paper
from rotorstab.charts import Chart
from rotorstab.charts.numbers import written
from rotorstab.paper import FIGURES, FLOQUET_FIGURES, Figure, table_1

from ..live.chart import LiveChart
from ..live.low import make_low
from ..results.comparisons import figure_known, keep_figure, paper_figure
from ..results.limits import Detail
from ..results.paper_charts import PANEL_KEYS, floquet_charts, paper_charts
from ..state import PRESETS, SYMBOLS, State
from ..words.typography import keep_units_together
from .base import Need, Page, Reply

__all__ = ["Choice", "Paper", "figure_need", "is_figure"]

_FIELDS = ("shear", "disk_mass", "diametral_inertia", "polar_inertia")


def _settings(figure: Figure) -> list[dict[str, Any]]:
    """Return for each panel of a figure the page and the inputs that show the same case.

    A setting without a letter belongs to the whole figure.
    """
    parameters = figure.parameters
    common: dict[str, Any] = {name: parameters[name] for name in _FIELDS if name in parameters}
    common["load_type"] = "follower" if parameters.get("tangency") else "axial"
    common["reference"] = "buckling"
    factors = parameters.get("static_load_factors", parameters.get("static_load_factor"))
    if factors is not None:
        common["static_load_factor"] = factors[-1] if isinstance(factors, list) else factors
    if figure.number in (2, 3):
        return [{"letter": "", "page": "stiffness", "values": common}]
    if figure.number == 4:
        presets = ("Table 1, at rest", "Table 1, 1000 rpm")
        values = [PRESETS[name] for name in presets]
    else:
        speeds = parameters["spin_speeds"]
        assert isinstance(speeds, list)  # one for each panel
        values = [{**common, "spin_speed": speed} for speed in speeds]
    return [
        {"letter": panel.letter, "page": "explore", "values": inputs}
        for panel, inputs in zip(figure.panels, values, strict=True)
    ]


def _legend(figure: Figure) -> list[dict[str, str]]:
    """Return the groups of a figure's curves, with the strokes that the charts draw."""
    return [
        {"name": name, "color": curve.look.color, "dash": curve.look.dash}
        for name, curve in figure.groups().items()
    ]


def _panels(figure: Figure) -> list[dict[str, str]]:
    """Return the letter and the title of each panel, and what its charts are called."""
    paper_s, ours = "as in the paper", ""
    if any(panel.regions for panel in figure.panels):
        paper_s, ours = "Bolotin’s method (the paper)", "Floquet’s method: unstable"
    elif figure.number in FLOQUET_FIGURES:
        ours = "Floquet’s method: pairs of whirls that a pulsation makes grow"
    return [
        {"letter": panel.letter, "title": panel.title, "paper": paper_s, "floquet": ours}
        for panel in figure.panels
    ]


def _shown(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(map(_shown, value))
    return written(value, 6) if isinstance(value, (int, float)) else str(value)


def _symbol(name: str) -> str:
    return SYMBOLS.get(name, SYMBOLS.get(name.removesuffix("s"), ""))


def describe(number: int, floquet: bool) -> dict[str, Any]:
    """Return a figure's words and numbers as plain values for the browser."""
    figure = paper_figure(number, floquet)
    return {
        "number": number,
        "floquet": floquet,
        "has_floquet": number in FLOQUET_FIGURES,
        "title": figure.title,
        "caption": keep_units_together(figure.caption),
        "parameters": [
            [f"{name.replace('_', ' ')} {_symbol(name)}".strip(), _shown(value)]
            for name, value in figure.parameters.items()
        ],
        "reading": [
            {
                "text": keep_units_together(reading.text),
                "ours": keep_units_together(reading.ours),
                "verdict": reading.verdict,
                "note": keep_units_together(reading.note),
            }
            for reading in figure.reading
        ],
        "settings": _settings(figure),
        "legend": _legend(figure),
        "panels": _panels(figure),
        "regions": any(panel.regions for panel in figure.panels),
    }


def describe_table() -> list[list[str]]:
    """Return the rows of Table 1: quantity, symbol, unit, paper, ours."""
    return [
        [
            row.name,
            row.symbol,
            row.unit.strip("-"),
            "" if row.text is None else written(row.text, 6),
            "given" if row.given else written(row.ours, 6),
        ]
        for row in table_1().rows
    ]


def is_figure(number: object) -> TypeGuard[int]:
    """Whether a value from the browser is the number of a figure."""
    return isinstance(number, int) and not isinstance(number, bool) and number in FIGURES


NOT_DRAWN = {"not_drawn": "This could not be computed. Choose the figure once more."}


def figure_need(number: int, floquet: bool) -> Need | None:
    """Return what must be made before `paper_figure` is quick, if anything."""
    if figure_known(number, floquet):
        return None
    return Need(paper.paper_figure, (number, floquet), partial(keep_figure, number, floquet))


@dataclass(frozen=True)
class Choice:
    """What the user has chosen to see.

    Parameters
    ----------
    number : int
        Of the figure.
    floquet : bool
        Whether Floquet's charts stand beside the paper's own.
    hidden : frozenset of str
        Groups of curves that are switched off.
    """

    number: int
    floquet: bool
    hidden: frozenset[str] = frozenset()

    @property
    def fragment(self) -> str:
        """The part of an address that names the choice, as `app/assets/paper.js` writes it."""
        only = "" if self.floquet or self.number not in FLOQUET_FIGURES else "/paper-only"
        return f"#paper/{self.number}{only}"


class Paper(Page):
    """The paper's figures as live charts, Floquet's method beside the paper's own."""

    key = "paper"
    title = "Paper"
    chart_keys = PANEL_KEYS

    def __init__(self) -> None:
        super().__init__()
        self.choice: Choice | None = None  # until the browser has named a figure

    def compute(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Chart]:
        """Return the charts of the chosen figure, with Floquet's once they are there."""
        if self.choice is None:
            return {}
        number, hidden = self.choice.number, self.choice.hidden
        charts = paper_charts(paper_figure(number), hidden)
        if self._floquet_is_seen() and figure_known(number, floquet=True):
            charts |= floquet_charts(paper_figure(number, floquet=True), hidden)
        return charts

    def cache_key(self) -> tuple[Any, ...]:
        """Return what is chosen."""
        return (self.choice,)

    def built(self, key: str, chart: LiveChart) -> None:
        """Leave the height of a chart to its curves, in one place in all charts."""
        chart.figure.update(min_height=None, min_border_left=52)
        make_low(chart.figure)

    def _floquet_is_seen(self) -> bool:
        choice = self.choice
        return choice is not None and choice.floquet and choice.number in FLOQUET_FIGURES

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Answer a request for a figure with its words, and with Floquet's once they are there."""
        number = message.get("number")
        if message.get("type") != "figure" or not is_figure(number):
            return Reply()
        before = self.choice
        groups = list(paper_figure(number).groups())
        switched = str(message.get("hidden", "")).split(",")
        hidden = frozenset(name for place, name in enumerate(groups) if str(place) in switched)
        self.choice = Choice(number, message.get("floquet") is True, hidden)
        if before is None or before.number != number:
            for chart in self.charts.values():  # a zoom belongs to its figure
                chart.reset_view()
        floquet = self._floquet_is_seen()
        table = {"table_1": describe_table()}
        need = figure_need(number, floquet)
        if need is None:
            return Reply({"figure": describe(number, floquet), **table})

        def answer() -> Reply:
            # the browser then asks for the figure once more, and the charts come with the answer
            return Reply({"figure": describe(number, floquet), "figure_made": True})

        content = {"figure": describe(number, False) | {"floquet": floquet, "waits": True}, **table}
        return Reply(content, follow_up=(need, answer), failure=NOT_DRAWN)
