"""The whole view on one page: the charts as seen, the marked point, tables, the link."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from functools import partial
from typing import Any

from rotorstab.charts.sheet import Sheet
from rotorstab.drawing.formats import PICTURE_FORMATS

from ..background.printing import printer
from ..live.chart import Zoom
from ..pages.base import Page, Reply
from ..pages.marked_point import INSPECTOR_CHARTS
from ..results.analysis import CHARTS, solve
from ..state import State
from ..words.refusals import user_message
from ..words.si import named_inputs, shown_scales
from .files import file_message, making_message, prepared, snapshot
from .report import view_link
from .rows import number_rows, parameter_rows, pin_sentence
from .seen import as_seen, zooms

__all__ = ["picture", "view_sheet"]

HEADING = "Parametric instability of a shaft–disk rotor"


def picture(explore: Page, owner: State, query: str, message: Mapping[str, Any]) -> Reply:
    """Return the answer to a request for a picture of the whole Explore view."""
    kind = message.get("format")
    if not isinstance(kind, str) or kind not in PICTURE_FORMATS:
        return Reply({"toast": "no such file format"})
    name = f"rotorstab.{kind}"
    page, state = snapshot(explore, owner)
    seen = zooms(explore)
    link = view_link(message.get("at"), query)

    def answer() -> Reply:
        try:
            sheet = view_sheet(page, state, link, seen)
        except ValueError as error:
            return Reply({"toast": user_message(error)})
        cache_key = ("picture", link, tuple(seen.items()), *page.cache_key())
        file: Future[bytes] = printer.file(cache_key, sheet, kind, owner)
        mime = PICTURE_FORMATS[kind].mime
        return Reply(making_message(name), file, partial(file_message, name, mime))

    return Reply(making_message(name), follow_up=(None, partial(prepared, page, state, answer)))


def view_sheet(
    page: Page, state: State, link: str, seen: Mapping[str, Zoom] | None = None
) -> Sheet:
    """Return the Explore view as a sheet.

    Parameters
    ----------
    page : Page
        Explore, with its pins.
    state : State
    link : str
        Address of the view.
    seen : mapping of str to Zoom, optional
        Of charts in which the user has zoomed.

    Raises
    ------
    ValueError
        With words for the page, where these inputs have no answer.
    """
    charts = as_seen(page.compute(state), page, state, seen or {})
    content = page.answer(state)
    hints = (content["si"] or {}).get("hints", {})
    point = content["inspector"] or {"sentence": "", "explanation": "", "facts": []}
    numbers = number_rows(solve(state).numbers, shown_scales(state))
    tables = (
        ("The marked point", tuple((name, value) for name, value in point["facts"])),
        ("Key numbers", tuple(numbers)),
    )
    paragraphs = (point["explanation"], content["verdict"], pin_sentence(state, page.pin_inputs()))
    return Sheet(
        heading=HEADING,
        charts=tuple(charts[key] for key in CHARTS),
        point_charts=tuple(charts[key] for key in INSPECTOR_CHARTS if key in charts),
        sentence=point["sentence"],
        paragraphs=tuple(text for text in paragraphs if text),
        tables=tuple(table for table in tables if table[1]),
        settings=("Parameters", tuple(parameter_rows(state, hints))),
        parameters=named_inputs(state.inputs()),
        link=link,
    )
