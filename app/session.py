"""One user's session: a state, its pages, and the answers to the browser's messages."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from typing import Any

import panel as pn

from .background.processes import background
from .background.settling import Settling
from .background.threads import Scheduler
from .exports.files import Files, export, report
from .exports.snippet import python_snippet
from .live.controls import Controls
from .pages import PAGES, Page
from .pages.base import Reply
from .results.limits import Detail
from .state import State
from .state.address import describe_problems, from_arguments, pins_from_arguments, to_query
from .words.refusals import FAILED, told

__all__ = ["Session"]

_LOG = logging.getLogger("rotorstab.app")
_MAKES = ("export", "report", "figure")


class Session:
    """Ties `State` to the pages; the only place where a message becomes a redraw.

    Only the page in view is computed and patched; another one catches up when it is opened.
    """

    def __init__(self, arguments: Mapping[str, Sequence[bytes | str]] | None = None) -> None:
        self.state = State()
        values, doubtful = from_arguments(arguments or {})
        refused = self.state.change(values)
        pins, bad = pins_from_arguments(arguments or {}, self.state.inputs())
        self._problems = [*doubtful, *bad], refused
        self.pages: dict[str, Page] = {page.key: page() for page in PAGES}
        for page in self.pages.values():
            page.opening = True
            page.expect(pins)
        self.active = PAGES[0].key
        self.controls = Controls(self.respond)
        self._scheduler = Scheduler()
        self.files = Files(self._scheduler, lambda one: self.controls.tell(one), self.state)
        self.notice = ""
        self.settling = Settling(self._show_refined, self._scheduler)
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
        if not self._heard:
            self._open()
        values = message.get("values")
        # a forged message may hold anything; lists and arrays have no hash and no truth value
        message = {key: one for key, one in message.items() if isinstance(one, str | int | float)}
        kind = message.get("type")
        if kind != "settle":
            background.touch(id(self))
            self._shown = None
        elif self._shown == (self.pages[self.active], Detail.COARSE) and (
            self._detail() is Detail.COARSE
        ):
            return {"resting": True}  # all else was told; the full picture is being made
        try:
            errors, now = self._act(message, values)
        except Exception:
            _LOG.exception("a message of type %r failed", kind)
            errors, now = {}, {"told": "this could not be done: try it once more"}
        # a change is one step of many: the full picture comes when the browser says so
        at_rest = kind != "change"
        return {**self.redraw(at_rest), **now, **self._described(errors, at_rest)}

    def _act(
        self, message: Mapping[str, Any], values: object
    ) -> tuple[dict[str, str], Mapping[str, Any]]:
        """Do what a message asks; return the errors of its values and what is told at once."""
        errors: dict[str, str] = {}
        reply = Reply()
        kind, name = message.get("type"), message.get("name")
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
        elif kind in _MAKES and self.files.full():
            busy = "files are still being made: wait for one, then ask again"
            # a figure's place on the page says it too
            beside = (
                {"not_drawn": f"This figure is not drawn yet: {busy}."} if kind == "figure" else {}
            )
            reply = Reply({"told": busy, **beside})
        elif kind == "export":
            reply = export(self.pages[self.active], self.state, message)
        elif kind == "python":
            reply = self.python()
        elif kind == "report":
            reply = report(self.pages[PAGES[0].key], self.state, self.query(), message)
        else:
            takers = (page for page in self.pages.values() if kind in page.takes)
            reply = next(takers, self.pages[self.active]).handle(message, self.state)
        if reply.reset_view:
            self.reset_view()
        if reply.keep_colours is not None:
            for page in self.pages.values():
                page.keep_colours(reply.keep_colours)
        return errors, self.files.start(reply)

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

    def _open(self) -> None:
        """Prepare for the first message: draw what a bare request for the page does not cost."""
        self._heard = True
        self._shown = None
        for page in self.pages.values():
            page.opening = False
        self._scheduler.call(self._restore_pin)

    def _restore_pin(self) -> None:
        """Solve one pin of the address and show it; the others wait for a turn of their own."""
        found = [page.restore_next() for page in self.pages.values()]
        problems = [one for one in found if one]
        if all(one is None for one in found):
            return
        named, refused = self._problems
        self._problems = [*named, *problems], refused
        self._shown = None
        self._show_refined(self._detail())
        self._scheduler.call(self._restore_pin)

    def python(self) -> Reply:
        """Return the view as a program."""
        try:
            return Reply({"python": python_snippet(self.state)})
        except ValueError as error:
            return Reply({"told": told(error)})

    def reset_view(self) -> None:
        """Undo every zoom on every page."""
        for page in self.pages.values():
            page.reset_view()

    def _show_refined(self, detail: Detail) -> None:
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
        return self._redraw(Detail.COARSE)

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
            self.notice = told(error)
        except Exception:
            _LOG.exception("redraw failed for %r", self.state.inputs())
            self.notice = FAILED
        return {}
