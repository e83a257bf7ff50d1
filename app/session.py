"""One user's session: a state, its pages, and the answers to the browser's messages."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from typing import Any
from urllib.parse import urlencode

import panel as pn

from .background.processes import background
from .background.settling import Ahead, Settling
from .background.threads import Scheduler
from .exports.files import Files, export, report
from .exports.picture import picture
from .exports.program import notebook_text, program_text
from .exports.snippet import python_cells
from .live.controls import Controls
from .pages import PAGES, Page
from .pages.base import Reply, Stage
from .pages.warming import warming
from .results.default_marker import place_marker
from .results.limits import Detail
from .state import State, Use, names_for
from .state.address import describe_problems, from_arguments, pins_from_arguments, to_query
from .state.point_inputs import PointInputs
from .words.refusals import FAILED, user_message

__all__ = ["Session"]

_LOG = logging.getLogger("rotorstab.app")
_POINT_INPUTS = {name for name in PointInputs.param if name != "name"}
# messages that ask for a file, which takes longer than an answer may
_MAKE_FILES = ("export", "report", "picture", "figure")


class Session:
    """Ties `State` to the pages; the only place where a message becomes a redraw.

    Only the page in view is computed and patched; another one catches up when it is opened.
    """

    def __init__(self, arguments: Mapping[str, Sequence[bytes | str]] | None = None) -> None:
        self.state = State()
        values, doubtful = from_arguments(arguments or {})
        refused = self.state.change(values)
        pins, bad_pins = pins_from_arguments(arguments or {}, self.state.inputs())
        self._problems = [*doubtful, *bad_pins], refused
        self.pages: dict[str, Page] = {page.key: page() for page in PAGES}
        place_marker(self.state)
        for page in self.pages.values():
            page.set_address_pins(pins)
            page.take_address(arguments or {})
        self.active = PAGES[0].key
        self.controls = Controls(self.respond)
        self._scheduler = Scheduler()
        self.files = Files(self._scheduler, lambda content: self.controls.send(content), self.state)
        self.notice = ""
        self.settling = Settling(self.show_finer, self._scheduler)
        self.ahead = Ahead(self._show_anew, self._scheduler)
        # the page and the detail that the browser shows since the last change of anything
        self._shown: tuple[Page, Detail] | None = None
        self._enter(Stage.OPENING)
        self._handlers: dict[object, Callable[[Mapping[str, Any]], Reply]] = {
            "change": self._change,
            "preset": self._apply_preset,
            "reset": self._reset,
            "view": lambda message: Reply(reset_view=True),
            "page": self._turn_to_page,
            "export": lambda message: export(
                self.pages[self.active], self.state, message, self.query()
            ),
            "picture": lambda message: picture(
                self.pages[PAGES[0].key], self.state, self.query(), message
            ),
            "report": lambda message: report(
                self.pages[PAGES[0].key], self.state, self.query(), message
            ),
            "python": lambda message: self.python(),
        }
        self.redraw()

    def looks(self) -> dict[str, Any]:
        """Return the inputs that decide how the page looks before its first answer."""
        return {name: getattr(self.state, name) for name in names_for(Use.LOOK)}

    def roots(self) -> dict[str, Any]:
        """Return everything the template embeds."""
        roots: dict[str, Any] = {"controls": self.controls}
        for page in self.pages.values():
            roots |= page.roots()
        return roots

    def respond(self, message: Mapping[str, Any]) -> dict[str, Any]:
        """Act on one message and describe the state that follows.

        Parameters
        ----------
        message : mapping
            With a "type". It may be forged: only its "values" may be anything but a number or a
            text, since lists and arrays have no hash and no truth value.
        """
        self._advance(message.get("type"))
        values = message.get("values")
        message = {
            key: item
            for key, item in message.items()
            if key != "values" and isinstance(item, str | int | float)
        }
        if isinstance(values, Mapping):
            message["values"] = values
        kind = message.get("type")
        if self.pages[self.active].resize(message):
            self._shown = None
        if kind != "settle":
            background.touch(id(self))
            self._shown = None
        elif self._is_waiting():
            return {"resting": True}
        try:
            reply = self._reply(message)
            place_marker(self.state)
            content = self._start(reply)
        except Exception:
            _LOG.exception("a message of type %r failed", kind)
            reply, content = Reply(), {"toast": "this could not be done: try it once more"}
        # a change is one step of many: the full picture comes when the browser says so
        at_rest = kind not in ("change", "window")
        full = at_rest or self._leaves_the_map(message)
        return {**self.redraw(full), **content, **self._describe(reply.errors, at_rest)}

    def _leaves_the_map(self, message: Mapping[str, Any]) -> bool:
        """Whether a message leaves the map as it is, so that the full one can stay in view."""
        if message.get("type") == "window":
            same = message.get("chart") != "instability"
        else:
            same = set(message.get("values", ())) <= _POINT_INPUTS
        return same and self.pages[self.active].awaited(self.state) is None

    def _is_waiting(self) -> bool:
        """Whether the browser has all but the full picture, which is still being made."""
        coarse = self.pages[self.active], Detail.COARSE
        return self._shown == coarse and self._detail() is Detail.COARSE

    def _reply(self, message: Mapping[str, Any]) -> Reply:
        """Do what a message asks for."""
        kind = message.get("type")
        if kind in _MAKE_FILES and self.files.full():
            busy = "files are still being made: wait for one, then ask again"
            # a figure's place on the page says it too
            place = {"not_drawn": f"This figure is not drawn yet: {busy}."}
            return Reply({"toast": busy, **(place if kind == "figure" else {})})
        if kind in self._handlers:
            return self._handlers[kind](message)
        takers = (page for page in self.pages.values() if kind in page.takes)
        return next(takers, self.pages[self.active]).handle(message, self.state)

    def _start(self, reply: Reply) -> Mapping[str, Any]:
        """Do what follows from a reply for all pages; return what the browser is sent at once."""
        in_lesson = any(page.teaches for page in self.pages.values())
        for page in self.pages.values():
            page.in_lesson = in_lesson
        if reply.reset_view:
            for page in self.pages.values():
                page.reset_view()
        return self.files.start(reply)

    def _change(self, message: Mapping[str, Any]) -> Reply:
        return Reply(errors=self.state.change(message.get("values", {})))

    def _apply_preset(self, message: Mapping[str, Any]) -> Reply:
        return Reply(errors=self.state.apply_preset(message.get("name")))

    def _reset(self, message: Mapping[str, Any]) -> Reply:
        self.state.reset()
        return Reply(reset_view=True)

    def _turn_to_page(self, message: Mapping[str, Any]) -> Reply:
        if message.get("name") in self.pages:
            self.active = str(message["name"])
        return Reply()

    def python(self) -> Reply:
        """Return the view as a program and as a notebook."""
        try:
            cells = python_cells(self.state)
        except ValueError as error:
            return Reply({"toast": user_message(error)})
        return Reply({"python": {"py": program_text(cells), "ipynb": notebook_text(cells)}})

    def _describe(self, errors: Mapping[str, str], at_rest: bool = True) -> dict[str, Any]:
        """Return what every answer says of the session."""
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
        pins = [pin for page in self.pages.values() for pin in page.pin_inputs()]
        query = to_query(self.state.inputs(), pins)
        more = [page.address_pairs(self.state) for page in self.pages.values()]
        return "&".join([query, *(urlencode(pairs) for pairs in more if pairs)])

    def _advance(self, kind: object) -> None:
        """Let the first messages draw what a bare request for the page does not cost."""
        if self._stage is Stage.OPENING:
            self._enter(Stage.GREETED)
            self._scheduler.call(self._restore_pin)
        if self._stage is Stage.GREETED and kind != "hello":
            self._enter(Stage.COMPLETE)
            warming.follow(self._scheduler)

    def _enter(self, stage: Stage) -> None:
        """Begin a stage, in which the pages show more than before."""
        self._stage = stage
        self._shown = None
        for page in self.pages.values():
            page.stage = stage

    def _restore_pin(self) -> None:
        """Solve one pin of the address and show it; the others wait for a turn of their own."""
        results = [page.restore_next_pin() for page in self.pages.values()]
        if all(result is None for result in results):
            return
        named, refused = self._problems
        self._problems = [*named, *(result for result in results if result)], refused
        self._show_anew()
        self._scheduler.call(self._restore_pin)

    def _show_anew(self) -> None:
        """Show what has come without a message of the browser: a pin, or its full map."""
        self._shown = None
        self.show_finer(self._detail())

    def show_finer(self, detail: Detail) -> None:
        """Show a finer picture that has been made in the background.

        BokehJS drops what comes while it builds the page: the first message asks for all again.
        """
        if self._stage is Stage.OPENING:
            return
        with pn.io.hold():
            content = self._redraw(detail)
            self.controls.send(content | self._describe({}))

    def redraw(self, settled: bool = True) -> dict[str, Any]:
        """Solve and patch; a failure is told to the user and leaves the last good picture.

        A full picture that takes long is made elsewhere and shown when it is there; until
        then a coarse one is shown.
        """
        if settled:
            return self._redraw(self._detail())
        self.settling.drop()
        self.ahead.drop()
        return self._redraw(Detail.COARSE)

    def _detail(self) -> Detail:
        """Return how fine a picture of the page can be shown, and have finer ones made."""
        return self.settling.detail(self.pages[self.active].awaited(self.state))

    def _redraw(self, detail: Detail) -> dict[str, Any]:
        page = self.pages[self.active]
        try:
            if self._shown != (page, detail):
                self._shown = None
                with pn.io.hold():
                    page.show(self.state, detail)
                self._shown = page, detail
            if detail is Detail.FULL:
                self.ahead.request(page.later(self.state))
            self.notice = ""
            content = page.answer(self.state, detail)
            for other in self.pages.values():
                content |= other.sidebar_answer(self.state)
            return content
        except ValueError as error:
            self.notice = user_message(error)
        except Exception:
            _LOG.exception("redraw failed for %r", self.state.inputs())
            self.notice = FAILED
        return {}
