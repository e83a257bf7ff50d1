"""One user's session: a state, its pages, and the answers to the browser's messages."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

import panel as pn

from .analysis import Result, solve
from .controls import Controls
from .pages import PAGES
from .state import State

__all__ = ["Session"]

_LOG = logging.getLogger("rotorstab.app")


class Session:
    """Ties `State` to the pages; the only place where a message becomes a redraw."""

    def __init__(self) -> None:
        self.state = State()
        self.result: Result = solve(self.state)
        self.pages = {page.key: page(self.result) for page in PAGES}
        self.controls = Controls(self.respond)
        self.notice = ""

    def roots(self) -> dict[str, Any]:
        """Return everything the template embeds."""
        found: dict[str, Any] = {"controls": self.controls}
        for page in self.pages.values():
            found |= page.roots()
        return found

    def respond(self, message: Mapping[str, Any]) -> dict[str, Any]:
        """Act on one message and describe the state that follows."""
        errors: dict[str, str] = {}
        kind = message.get("type")
        values = message.get("values")
        if kind == "change" and isinstance(values, Mapping):
            errors = self.state.change(values)
        elif kind == "preset":
            errors = self.state.apply_preset(str(message.get("name")))
        elif kind == "reset":
            self.state.change({n: State.param[n].default for n in self.state.inputs()})
            self.view_reset()
        elif kind == "view":
            self.view_reset()
        self.redraw()
        return {
            "values": self.state.inputs(),
            "errors": errors,
            "numbers": self.result.numbers,
            "notice": self.notice,
        }

    def view_reset(self) -> None:
        """Undo every zoom on every page."""
        for page in self.pages.values():
            page.reset_view()

    def redraw(self) -> None:
        """Solve and patch; a failure is told and leaves the last good picture."""
        try:
            with pn.io.hold():
                self.result = solve(self.state)
                for page in self.pages.values():
                    page.show(self.result)
            self.notice = ""
        except ValueError as error:
            self.notice = str(error)
        except Exception:
            _LOG.exception("redraw failed for %r", self.state.inputs())
            self.notice = (
                "these values could not be computed; the charts show the last ones that could"
            )
