"""One user's session: a state, its pages, and the answers to the browser's messages."""

from __future__ import annotations

import errno
import logging
from base64 import b64encode
from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from typing import Any

import panel as pn

from rotorstab.charts import chart_figure
from rotorstab.figures import FIGURES

from .analysis import CHARTS, solve
from .comparisons import paper_figure
from .controls import Controls
from .growth import Detail
from .pages import PAGES, Page
from .pages.base import Reply
from .printing import FORMATS, MIME, gather, printer
from .processes import background
from .report import page_address, report_html
from .settling import Settling
from .share import describe_problems, from_arguments, pins_from_arguments, to_query
from .snippet import python_snippet
from .state import State
from .units import named_inputs

__all__ = ["Session"]

_LOG = logging.getLogger("rotorstab.app")
_MAKES = ("export", "report", "figure")
MOST_FILES, MOST_WAITING = 8, 60  # being made at a time, for one session and for all
_FAILED = "these values could not be computed; the charts show the last ones that could"


def _file(name: str, kind: str, data: bytes) -> dict[str, Any]:
    """Return a file as the browser takes it."""
    return {
        "told": f"{name} is ready",
        "file": {"name": name, "mime": MIME[kind], "base64": b64encode(data).decode()},
    }


def _excuse(future: Future[Any]) -> str:
    """Return what the user is told of a file that was not made."""
    problem = None if future.cancelled() else future.exception()
    if isinstance(problem, OSError) and problem.errno in (errno.ENOSPC, errno.EDQUOT):
        return "the server’s disk is full: the file was not made"
    return "the picture could not be made: ask once more"


class Session:
    """Ties `State` to the pages; the only place where a message becomes a redraw.

    Only the page in view is computed and patched; another one catches up when it is opened.
    """

    def __init__(self, arguments: Mapping[str, Sequence[bytes | str]] | None = None) -> None:
        self.state = State()
        values, doubtful = from_arguments(arguments or {})
        refused = self.state.change(values)
        # solved with the first message: a bare request for the page costs no more for them
        self._pins, bad = pins_from_arguments(arguments or {}, self.state.inputs())
        self._problems = [*doubtful, *bad], refused
        self.pages: dict[str, Page] = {page.key: page() for page in PAGES}
        self.active = PAGES[0].key
        self._files: list[Future[Any]] = []  # that this session waits for
        self.controls = Controls(self.respond)
        self.notice = ""
        self.settling = Settling(self._show_better)
        self._shown: tuple[Page, Detail] | None = None  # since the last change of anything
        self._heard = False
        # what the first paint looks like and keeps room for, so that the first answer moves nothing
        looks = ("units", "growth_unit", "show_growth", "show_bolotin", "show_disagreement")
        found = self.redraw()
        whirl = found["numbers"]["whirl"].values() if found else ()
        self.first = {
            "words": found.get("verdict_room", ""),
            "looks": {name: getattr(self.state, name) for name in looks}
            | {"complex": any(abs(imaginary) > 1e-9 for _, imaginary in whirl)},
        }

    def roots(self) -> dict[str, Any]:
        """Return everything the template embeds."""
        found: dict[str, Any] = {"controls": self.controls}
        for page in self.pages.values():
            found |= page.roots()
        return found

    def respond(self, message: Mapping[str, Any]) -> dict[str, Any]:
        """Act on one message and describe the state that follows."""
        self._heard = True
        self._restore_pins()
        errors: dict[str, str] = {}
        reply = Reply()
        values = message.get("values")
        # a forged message may hold anything; lists and arrays have no hash and no truth value
        message = {key: one for key, one in message.items() if isinstance(one, str | int | float)}
        kind, name = message.get("type"), message.get("name")
        if kind != "settle":
            background.touch(id(self))
            self._shown = None
        elif self._shown == (self.pages[self.active], False) and not self._detail():
            return {"resting": True}  # all else was told; the full picture is being made
        if kind == "change" and isinstance(values, Mapping):
            errors = self.state.change(values)
        elif kind == "preset":
            errors = self.state.apply_preset(name)
        elif kind == "reset":
            self.state.reset()
            self.reset_view()
        elif kind == "view":
            self.reset_view()
        elif kind == "page" and name in self.pages:
            self.active = str(name)
        elif kind in _MAKES and (
            len(self._waiting()) >= MOST_FILES or printer.pending() >= MOST_WAITING
        ):
            reply = Reply({"told": "files are still being made: wait for one, then ask again"})
        elif kind == "export":
            reply = self.export(message)
        elif kind == "python":
            reply = self.python()
        elif kind == "report":
            reply = self.report(message)
        else:
            takers = (page for page in self.pages.values() if kind in page.takes)
            reply = next(takers, self.pages[self.active]).handle(message, self.state)
        if reply.reset_view:
            self.reset_view()
        if reply.keep_colours is not None:
            for page in self.pages.values():
                page.keep_colours(reply.keep_colours)
        if reply.later is not None:
            self._deliver(reply)
        # a change is one step of many: the full picture comes when the browser says so
        at_rest = kind != "change"
        return self.redraw(at_rest) | reply.now | self._described(errors, at_rest)

    def _described(self, errors: Mapping[str, str], at_rest: bool = True) -> dict[str, Any]:
        return {
            "values": self.state.inputs(),
            "errors": errors,
            "notice": self.notice,
            "address_notice": describe_problems(*self._problems),
            "query": self.query(),
            "at_rest": at_rest,
            "page": self.active,
        }

    def query(self) -> str:
        """Return the address query of the state and its pins."""
        pins = [one for page in self.pages.values() for one in page.kept()]
        return to_query(self.state.inputs(), pins)

    def _restore_pins(self) -> None:
        pins, self._pins = self._pins, []
        if pins:
            named, refused = self._problems
            found = [one for page in self.pages.values() for one in page.restore(pins)]
            self._problems = [*named, *found], refused

    def export(self, message: Mapping[str, Any]) -> Reply:
        """Start making a file of a live chart or of a figure of the paper."""
        kind, chart, number = (message.get(key) for key in ("format", "chart", "number"))
        if kind not in FORMATS:
            return Reply({"told": "no such file format"})
        if isinstance(chart, str) and chart in self.pages[self.active].charts:
            name = f"rotorstab-{chart}.{kind}"
            inputs = self.state.inputs()
            page = self.pages[self.active]
            drawn = page.compute(self.state).get(chart)
            if drawn is None:  # the inspector's, after its marker is gone
                return Reply({"told": "no such chart"})
            key = (chart, *inputs.values(), *page.stamp())
            later = printer.file(key, chart_figure(drawn, named_inputs(inputs)), kind)
        elif isinstance(number, int) and not isinstance(number, bool) and number in FIGURES:
            floquet = message.get("floquet") is True
            name = f"rotorstab-figure-{number}{'-floquet' if floquet else ''}.{kind}"
            later = printer.file((number, floquet), paper_figure(number, floquet), kind)
        else:
            return Reply({"told": "no such chart"})
        return Reply({"told": f"making {name} …"}, later, lambda data: _file(name, kind, data))

    def python(self) -> Reply:
        """Return the view as a program."""
        try:
            return Reply({"python": python_snippet(self.state)})
        except ValueError as error:
            return Reply({"told": str(error)})

    def report(self, message: Mapping[str, Any]) -> Reply:
        """Start making the one-page report of the Explore view, with its marker and pins."""
        explore = self.pages[PAGES[0].key]
        try:
            result = solve(self.state)
            drawn = explore.compute(self.state)
            said = explore.answer(self.state)
        except ValueError as error:
            return Reply({"told": str(error)})
        inputs = self.state.inputs()
        stamp = explore.stamp()
        pictures = {
            drawn[key].title: printer.file(
                (key, *inputs.values(), *stamp),
                chart_figure(drawn[key], named_inputs(inputs)),
                "svg",
            )
            for key in CHARTS
        }
        words = [said["verdict"]]
        if said["inspector"]:
            words.append(f"The marked point: {said['inspector']['sentence']}")
        if said["pins"]:
            names = ", ".join(one["name"] for one in said["pins"]["names"])
            words.append(f"Thin lines are pinned curves of earlier settings: {names}.")
        # the state of now, not of when the pictures are ready
        page = partial(
            report_html,
            State(**inputs),
            result.numbers,
            words,
            query=self.query(),
            address=page_address(message.get("at")),
        )
        name = "rotorstab-report.html"

        def wrap(drawn: list[bytes]) -> dict[str, Any]:
            titled = {title: svg.decode() for title, svg in zip(pictures, drawn, strict=True)}
            return _file(name, "html", page(pictures=titled).encode())

        return Reply({"told": f"making {name} …"}, gather(list(pictures.values())), wrap)

    def _deliver(self, reply: Reply) -> None:
        """Send what comes later, from the server's own loop, when it is there."""
        document = pn.state.curdoc

        assert reply.later is not None
        self._files = [*self._waiting(), reply.later]

        def send(future: Future[Any]) -> None:
            if future.cancelled() or future.exception() is not None:
                _LOG.error(
                    "picture failed", exc_info=None if future.cancelled() else future.exception()
                )
                content: Mapping[str, Any] = {"told": _excuse(future)}
            else:
                content = reply.wrap(future.result())
            if document is None or not document.session_context:
                return
            with suppress(RuntimeError):  # the session may have ended meanwhile
                document.add_next_tick_callback(lambda: self.controls.tell(content))

        reply.later.add_done_callback(send)

    def _waiting(self) -> list[Future[Any]]:
        return [one for one in self._files if not one.done()]

    def reset_view(self) -> None:
        """Undo every zoom on every page."""
        for page in self.pages.values():
            page.reset_view()

    def _show_better(self, detail: Detail) -> None:
        """Show what was asked for and is there now: the full map, then its edges.

        BokehJS drops what comes while it builds the page: the first message asks for all again.
        """
        if not self._heard:
            return
        with pn.io.hold():
            answer = self._redraw(detail)
            self.controls.tell(answer | self._described({}))

    def redraw(self, settled: bool = True) -> dict[str, Any]:
        """Solve and patch; a failure is told and leaves the last good picture.

        A full picture that takes long is made elsewhere and shown when it is there; until
        then a coarse one is.
        """
        if settled:
            return self._redraw(self._detail())
        self.settling.drop()
        return self._redraw(False)

    def _detail(self) -> Detail:
        """Return how much of the page's picture can be shown, and have the rest made."""
        return self.settling.detail(self.pages[self.active].awaited(self.state))

    def _redraw(self, detail: Detail) -> dict[str, Any]:
        page = self.pages[self.active]
        try:
            if self._shown != (page, detail):
                self._shown = None
                with pn.io.hold():
                    page.show(self.state, detail)
                self._shown = page, detail
            self.notice = ""
            found = page.answer(self.state, detail)
            for one in self.pages.values():
                found |= one.beside(self.state)
            return found
        except ValueError as error:
            self.notice = str(error)
        except Exception:
            _LOG.exception("redraw failed for %r", self.state.inputs())
            self.notice = _FAILED
        return {}
