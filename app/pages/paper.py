"""Paper: every figure with its parameters, what the text says of it and what we compute."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, TypeGuard

from rotorstab import paper
from rotorstab.charts.numbers import written
from rotorstab.paper import FIGURES, FLOQUET_FIGURES, Figure, table_1

from ..background.printing import printer
from ..results.comparisons import figure_known, keep_figure, paper_figure
from ..results.limits import Detail
from ..state import PRESETS, SYMBOLS, State
from ..words.typography import keep_units_together
from .base import Need, Page, Reply

__all__ = ["Paper", "figure_need", "is_figure"]

_FIELDS = ("shear", "disk_mass", "diametral_inertia", "polar_inertia")


def _settings(figure: Figure) -> list[dict[str, Any]]:
    """Return for each panel of a figure the page and the inputs that show the same case."""
    parameters = figure.parameters
    common: dict[str, Any] = {name: parameters[name] for name in _FIELDS if name in parameters}
    common["load_type"] = "follower" if parameters.get("tangency") else "axial"
    common["reference"] = "buckling"
    factors = parameters.get("static_load_factors", parameters.get("static_load_factor"))
    if factors is not None:
        common["static_load_factor"] = factors[-1] if isinstance(factors, list) else factors
    if figure.number in (2, 3):
        return [{"label": "Open on the Stiffness page", "page": "stiffness", "values": common}]
    if figure.number == 4:
        presets = ("Table 1, at rest", "Table 1, 1000 rpm")
        return [
            {"label": f"({panel.letter}) {panel.title}", "page": "explore", "values": PRESETS[name]}
            for panel, name in zip(figure.panels, presets, strict=True)
        ]
    speeds = parameters["spin_speeds"]
    assert isinstance(speeds, list)  # one for each panel
    return [
        {
            "label": f"({panel.letter}) {panel.title}",
            "page": "explore",
            "values": {**common, "spin_speed": speed},
        }
        for panel, speed in zip(figure.panels, speeds, strict=True)
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


NOT_DRAWN = {"not_drawn": "This figure could not be drawn. Choose it once more."}


def figure_need(number: int, floquet: bool) -> Need | None:
    """Return what must be made before `paper_figure` is quick, if anything."""
    if figure_known(number, floquet):
        return None
    return Need(paper.paper_figure, (number, floquet), partial(keep_figure, number, floquet))


class Paper(Page):
    """The paper's figures as pictures made by the code that prints them."""

    key = "paper"
    title = "Paper"

    def compute(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Any]:
        """Return no live charts: the figures are pictures."""
        return {}

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Answer a request for a figure with its words at once and its picture when made."""
        number = message.get("number")
        if message.get("type") != "figure" or not is_figure(number):
            return Reply()
        floquet = message.get("floquet") is True and number in FLOQUET_FIGURES

        def answer() -> Reply:
            return Reply(
                content={"figure": describe(number, floquet), "table_1": describe_table()},
                file=printer.file((number, floquet), paper_figure(number, floquet), "svg", state),
                file_content=lambda svg: {
                    "picture": {"number": number, "floquet": floquet, "svg": svg.decode()}
                },
                failure=NOT_DRAWN,
            )

        need = figure_need(number, floquet)
        words = {} if need is None else {"told": f"computing figure {number} with Floquet …"}
        return Reply(words, follow_up=(need, answer), failure=NOT_DRAWN)
