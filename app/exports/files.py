"""What takes longer than an answer may: charts as files, figures of the paper, the report.

A map that is not there yet is made in the background, then the file by the printer. Meanwhile the
session answers other messages; the browser is told when the file is ready, or why there is none.
"""

from __future__ import annotations

import errno
import logging
from base64 import b64encode
from collections.abc import Callable, Mapping
from concurrent.futures import CancelledError, Future
from copy import copy
from functools import partial
from typing import Any

from rotorstab.charts import chart_figure

from ..background.printing import FORMATS, MIME, gather, printer
from ..background.processes import background
from ..background.threads import Scheduler
from ..pages.base import Need, Page, Reply
from ..pages.paper import figure_need, is_figure
from ..results.analysis import CHARTS, solve
from ..results.comparisons import paper_figure
from ..state import State
from ..words.refusals import told
from ..words.si import named_inputs
from .report import page_address, report_html

__all__ = ["Files", "export", "making", "report"]

_LOG = logging.getLogger("rotorstab.app")
MOST_FILES, MOST_WAITING = 8, 60  # being made at a time, for one session and for all

_making: set[object] = set()


def making() -> int:
    """Return the number of answers of all sessions that are being made."""
    return len(_making)


def excuse(problem: BaseException) -> str:
    """Return what the user is told of a file that was not made."""
    if isinstance(problem, OSError) and problem.errno in (errno.ENOSPC, errno.EDQUOT):
        return "the server’s disk is full: the file was not made"
    return "the picture could not be made: ask once more"


class Files:
    """What one session waits for.

    `tell` sends the browser what it did not wait for; `owner` is who the printer works for.
    """

    def __init__(
        self, scheduler: Scheduler, tell: Callable[[Mapping[str, Any]], None], owner: State
    ) -> None:
        self._scheduler = scheduler
        self._tell = tell
        self._owner = owner
        self._waiting: dict[object, Need | None] = {}
        scheduler.at_end(self.close)

    def full(self) -> bool:
        """Whether this session must wait before it asks for more.

        While all sessions together ask for much, each has one file at a time.
        """
        most = MOST_FILES if making() < MOST_WAITING else 1
        return len(self._waiting) >= most

    def start(self, reply: Reply) -> Mapping[str, Any]:
        """Return what the browser is told at once, and have the rest made and sent."""
        if reply.then is not None:
            need, answer = reply.then
            if need is None or self._scheduler.document is None:  # nobody else waits
                return {**reply.now, **self.start(answer())}
            made = background.request(need.function, *need.arguments)
            self._follow(made, need, partial(self._go_on, need, answer), reply.failed)
        elif reply.later is not None:
            self._follow(reply.later, None, lambda made: reply.wrap(made.result()), reply.failed)
        return reply.now

    def _go_on(
        self, need: Need, answer: Callable[[], Reply], made: Future[Any]
    ) -> Mapping[str, Any]:
        need.keep(made.result())
        return self.start(answer())

    def _follow(
        self,
        made: Future[Any],
        need: Need | None,
        content: Callable[[Future[Any]], Mapping[str, Any]],
        failed: Mapping[str, Any],
    ) -> None:
        """Tell the browser the content that a future leads to, once that is done, or why not."""
        ticket = object()
        self._waiting[ticket] = need
        _making.add(ticket)

        def send() -> None:
            if ticket not in self._waiting:  # the session has ended
                return
            try:
                told = content(made)
            except Exception as problem:
                if not isinstance(problem, CancelledError):  # the server does not end
                    _LOG.error("a file was not made", exc_info=problem)
                told = {**failed, "told": excuse(problem)}
            self._forget(ticket)
            self._tell(told)

        made.add_done_callback(lambda _: self._scheduler.call(send))

    def _forget(self, ticket: object) -> Need | None:
        _making.discard(ticket)
        return self._waiting.pop(ticket, None)

    def close(self) -> None:
        """Wait for nothing any more."""
        printer.drop(self._owner)
        for ticket in list(self._waiting):
            need = self._forget(ticket)
            if need is not None:
                background.withdraw(need.function, *need.arguments)


def _file(name: str, kind: str, data: bytes) -> dict[str, Any]:
    """Return a file as the browser takes it."""
    return {
        "told": f"{name} is ready",
        "file": {"name": name, "mime": MIME[kind], "base64": b64encode(data).decode()},
    }


def _snapshot(page: Page, state: State) -> tuple[Page, State]:
    """Return a page and a state of now, for an answer that is made later."""
    return copy(page), State(**state.inputs())


def export(page: Page, state: State, message: Mapping[str, Any]) -> Reply:
    """Return the answer to a request for a live chart or a figure of the paper as a file."""
    kind, chart, number = (message.get(key) for key in ("format", "chart", "number"))
    if kind not in FORMATS:
        return Reply({"told": "no such file format"})
    if isinstance(chart, str) and chart in page.charts:
        return _export_chart(page, state, chart, str(kind))
    if is_figure(number):
        return _export_figure(state, number, message.get("floquet") is True, str(kind))
    return Reply({"told": "no such chart"})


def _export_chart(page: Page, owner: State, chart: str, kind: str) -> Reply:
    name = f"rotorstab-{chart}.{kind}"
    page, state = _snapshot(page, owner)

    def answer() -> Reply:
        try:
            drawn = page.compute(state).get(chart)
        except ValueError as error:
            return Reply({"told": told(error)})
        if drawn is None:  # the inspector's, after its marker is gone
            return Reply({"told": "no such chart"})
        inputs = state.inputs()
        key = (chart, *inputs.values(), *page.stamp())
        later = printer.file(key, chart_figure(drawn, named_inputs(inputs)), kind, owner)
        return Reply({"told": f"making {name} …"}, later, partial(_file, name, kind))

    return Reply({"told": f"making {name} …"}, then=(page.need(state), answer))


def _export_figure(owner: State, number: int, floquet: bool, kind: str) -> Reply:
    name = f"rotorstab-figure-{number}{'-floquet' if floquet else ''}.{kind}"

    def answer() -> Reply:
        later = printer.file((number, floquet), paper_figure(number, floquet), kind, owner)
        return Reply({"told": f"making {name} …"}, later, partial(_file, name, kind))

    return Reply({"told": f"making {name} …"}, then=(figure_need(number, floquet), answer))


def report(explore: Page, owner: State, query: str, message: Mapping[str, Any]) -> Reply:
    """Return the answer to a request for the report of the Explore view, with marker and pins."""
    name = "rotorstab-report.html"
    page, state = _snapshot(explore, owner)

    def answer() -> Reply:
        try:
            result = solve(state)
            drawn = page.compute(state)
            said = page.answer(state)
        except ValueError as error:
            return Reply({"told": told(error)})
        inputs = state.inputs()
        stamp = page.stamp()
        pictures = {
            drawn[key].title: printer.file(
                (key, *inputs.values(), *stamp),
                chart_figure(drawn[key], named_inputs(inputs)),
                "svg",
                owner,
            )
            for key in CHARTS
        }
        words = [said["verdict"]]
        if said["inspector"]:
            words.append(f"The marked point: {said['inspector']['sentence']}")
        if said["pins"]:
            names = ", ".join(one["name"] for one in said["pins"]["names"])
            words.append(f"Thin lines are pinned curves of earlier settings: {names}.")

        def wrap(made: list[bytes]) -> dict[str, Any]:
            titled = {title: svg.decode() for title, svg in zip(pictures, made, strict=True)}
            address = page_address(message.get("at"))
            html = report_html(state, result.numbers, words, titled, query, address)
            return _file(name, "html", html.encode())

        return Reply({"told": f"making {name} …"}, gather(list(pictures.values())), wrap)

    return Reply({"told": f"making {name} …"}, then=(page.need(state), answer))
