"""Files, which take longer than an answer may: charts, figures of the paper, the report.

A map that is not there yet is made in the background, then the printer makes the file. Meanwhile
the session answers other messages; the browser is told when the file is ready, or why there is
none.
"""

from __future__ import annotations

import errno
import logging
from base64 import b64encode
from collections.abc import Callable, Mapping
from concurrent.futures import CancelledError, Future
from copy import copy
from dataclasses import replace
from functools import partial
from typing import Any

from rotorstab.charts import Chart, chart_figure
from rotorstab.drawing.formats import FORMATS, PICTURE_FORMATS
from rotorstab.drawing.plain_text import parameter_words

from ..background.printing import gather, printer
from ..background.processes import background
from ..background.threads import Scheduler
from ..pages.base import Need, Page, Reply
from ..pages.paper import Choice, figure_need, is_figure
from ..results.analysis import CHARTS, solve
from ..results.comparisons import paper_figure
from ..state import State
from ..words.refusals import user_message
from ..words.si import named_inputs
from .report import page_address, report_html, report_paragraphs, view_link
from .rows import parameter_sentence
from .seen import as_seen, cut, zooms

__all__ = [
    "Files",
    "export",
    "file_message",
    "making",
    "making_message",
    "prepared",
    "report",
    "snapshot",
]

_LOG = logging.getLogger("rotorstab.app")
MOST_FILES, MOST_WAITING = 8, 60
"""Largest numbers of files that one session waits for, and that all sessions together do."""

_making: set[object] = set()


def making() -> int:
    """Return the number of files that all sessions together wait for."""
    return len(_making)


def failure_message(problem: BaseException) -> str:
    """Return what the user is told about a file that was not made."""
    if isinstance(problem, OSError) and problem.errno in (errno.ENOSPC, errno.EDQUOT):
        return "the server’s disk is full: the file was not made"
    return "the picture could not be made: try again"


class Files:
    """The files that one session waits for.

    Parameters
    ----------
    scheduler : Scheduler
        Of the session's document.
    send : callable
        Sends the browser what it did not wait for.
    owner : State
        On whose behalf the printer works.
    """

    def __init__(
        self, scheduler: Scheduler, send: Callable[[Mapping[str, Any]], None], owner: State
    ) -> None:
        self._scheduler = scheduler
        self._send = send
        self._owner = owner
        self._waiting: dict[object, Need | None] = {}  # by a ticket of each file
        scheduler.at_end(self.close)

    def full(self) -> bool:
        """Whether this session must wait before it asks for more.

        While all sessions together wait for many files, each has one at a time.
        """
        most = MOST_FILES if making() < MOST_WAITING else 1
        return len(self._waiting) >= most

    def start(self, reply: Reply) -> Mapping[str, Any]:
        """Return what the browser is sent at once, and have the rest made and sent."""
        if reply.follow_up is not None:
            need, answer = reply.follow_up
            if need is not None and self._scheduler.document is None:  # nobody else waits
                need.keep(need.function(*need.arguments))
                need = None
            if need is None:
                return {**reply.content, **self.start(answer())}
            made = background.request(need.function, *need.arguments)
            self._follow(made, need, partial(self._go_on, need, answer), reply.failure)
        elif reply.file is not None:
            self._follow(
                reply.file, None, lambda made: reply.file_content(made.result()), reply.failure
            )
        return reply.content

    def _go_on(
        self, need: Need, answer: Callable[[], Reply], made: Future[Any]
    ) -> Mapping[str, Any]:
        """Keep what was needed and start the rest of the answer."""
        need.keep(made.result())
        return self.start(answer())

    def _follow(
        self,
        made: Future[Any],
        need: Need | None,
        content: Callable[[Future[Any]], Mapping[str, Any]],
        failure: Mapping[str, Any],
    ) -> None:
        """Once a future is done, send the browser the content that follows from it, or why not."""
        ticket = object()
        self._waiting[ticket] = need
        _making.add(ticket)

        def send() -> None:
            if ticket not in self._waiting:  # the session has ended
                return
            try:
                message = content(made)
            except Exception as problem:
                # a server that ends cancels the future: that is no fault
                if not isinstance(problem, CancelledError):
                    _LOG.error("a file was not made", exc_info=problem)
                message = {**failure, "toast": failure_message(problem)}
            self._forget(ticket)
            self._send(message)

        made.add_done_callback(lambda _: self._scheduler.call(send))

    def _forget(self, ticket: object) -> Need | None:
        _making.discard(ticket)
        return self._waiting.pop(ticket, None)

    def close(self) -> None:
        """Cancel everything that the session waits for."""
        printer.drop(self._owner)
        for ticket in list(self._waiting):
            need = self._forget(ticket)
            if need is not None:
                background.withdraw(need.function, *need.arguments)


def file_message(name: str, mime: str, data: bytes) -> dict[str, Any]:
    """Return a file in the form that the browser saves."""
    return {
        "toast": f"{name} is ready",
        "file": {"name": name, "mime": mime, "base64": b64encode(data).decode()},
    }


def snapshot(page: Page, state: State) -> tuple[Page, State]:
    """Return copies of a page and a state: a file shows the page as it was at the request."""
    return copy(page), State(**state.inputs())


def export(page: Page, state: State, message: Mapping[str, Any], query: str = "") -> Reply:
    """Return the answer to a request for a live chart or a figure of the paper as a file.

    Parameters
    ----------
    page : Page
        Whose live charts they are.
    state : State
    message : mapping
        From the browser.
    query : str
        The view's address query, which the file gives.
    """
    kind, chart, number = (message.get(key) for key in ("format", "chart", "number"))
    if not isinstance(kind, str) or kind not in FORMATS:
        return Reply({"toast": "no such file format"})
    if isinstance(chart, str) and chart in page.charts:
        link = view_link(message.get("at"), query)
        return _export_chart(page, state, chart, kind, link)
    if is_figure(number):
        return _export_figure(state, number, message.get("floquet") is True, kind, message)
    return Reply({"toast": "no such chart"})


def prepared(page: Page, state: State, answer: Callable[[], Reply]) -> Reply:
    """Return an answer once every map is there that the page shows, also those of its pins."""
    need = page.need(state)
    if need is None:
        return answer()
    return Reply(follow_up=(need, partial(prepared, page, state, answer)))


def making_message(name: str) -> dict[str, str]:
    """Return what the user is told while a file is being made."""
    return {"toast": f"making {name} …"}


def _export_chart(page: Page, owner: State, chart: str, kind: str, link: str) -> Reply:
    name = f"rotorstab-{chart}.{kind}"
    seen = zooms(page)
    page, state = snapshot(page, owner)

    def answer() -> Reply:
        try:
            drawn = page.compute(state).get(chart)
        except ValueError as error:
            return Reply({"toast": user_message(error)})
        if drawn is None:  # the inspector's, after its marker is gone
            return Reply({"toast": "no such chart"})
        if kind in PICTURE_FORMATS:
            drawn = as_seen({chart: drawn}, page, state, seen)[chart]
        else:
            drawn = cut(drawn)
        parameters = named_inputs(state.inputs())
        figure = chart_figure(drawn, parameters, parameter_sentence(state), link)
        cache_key = (chart, link, seen[chart], *state.inputs().values(), *page.cache_key())
        file = printer.file(cache_key, figure, kind, owner)
        return Reply(making_message(name), file, partial(file_message, name, FORMATS[kind].mime))

    return Reply(making_message(name), follow_up=(None, partial(prepared, page, state, answer)))


def _export_figure(
    owner: State, number: int, floquet: bool, kind: str, message: Mapping[str, Any]
) -> Reply:
    name = f"rotorstab-figure-{number}{'-floquet' if floquet else ''}.{kind}"
    address = page_address(message.get("at"))
    link = f"{address}{Choice(number, floquet).fragment}" if address else ""

    def answer() -> Reply:
        figure = paper_figure(number, floquet)
        figure = replace(figure, footer=parameter_words(figure.parameters), link=link)
        file = printer.file((number, floquet, link), figure, kind, owner)
        return Reply(making_message(name), file, partial(file_message, name, FORMATS[kind].mime))

    return Reply(making_message(name), follow_up=(figure_need(number, floquet), answer))


def report(explore: Page, owner: State, query: str, message: Mapping[str, Any]) -> Reply:
    """Return the answer to a request for the report of the Explore view, with marker and pins."""
    name = "rotorstab-report.html"
    page, state = snapshot(explore, owner)

    def answer() -> Reply:
        try:
            result = solve(state)
            charts = page.compute(state)
            content = page.answer(state)
        except ValueError as error:
            return Reply({"toast": user_message(error)})
        pictures = {
            charts[key].title: _print_part(charts[key], page, state, owner) for key in CHARTS
        }

        def file_content(svgs: list[bytes]) -> dict[str, Any]:
            by_title = {title: svg.decode() for title, svg in zip(pictures, svgs, strict=True)}
            address = page_address(message.get("at"))
            paragraphs = report_paragraphs(content)
            html = report_html(state, result.numbers, paragraphs, by_title, query, address)
            return file_message(name, "text/html", html.encode())

        return Reply(making_message(name), gather(list(pictures.values())), file_content)

    return Reply(making_message(name), follow_up=(None, partial(prepared, page, state, answer)))


def _print_part(chart: Chart, page: Page, state: State, owner: State) -> Future[bytes]:
    """Return the future of a chart as a part of the report, which names the parameters itself."""
    inputs = state.inputs()
    cache_key = ("report", chart.key, *inputs.values(), *page.cache_key())
    return printer.file(cache_key, chart_figure(chart, named_inputs(inputs)), "svg", owner)
