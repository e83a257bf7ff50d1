"""One user's session: a state, its pages, and the answers to the browser's messages."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

import panel as pn

from .controls import Controls
from .pages import PAGES, Page
from .state import State

__all__ = ["Session"]

_LOG = logging.getLogger("rotorstab.app")
_FAILED = "these values could not be computed; the charts show the last ones that could"


class Session:
    """Ties `State` to the pages; the only place where a message becomes a redraw.

    Only the page in view is computed and patched; another one catches up when it is opened.
    """

    def __init__(self) -> None:
        self.state = State()
        self.pages: dict[str, Page] = {page.key: page() for page in PAGES}
        self.active = PAGES[0].key
        self.controls = Controls(self.respond)
        self.notice = ""
        self.redraw()

    def roots(self) -> dict[str, Any]:
        """Return everything the template embeds."""
        found: dict[str, Any] = {"controls": self.controls}
        for page in self.pages.values():
            found |= page.roots()
        return found

    def respond(self, message: Mapping[str, Any]) -> dict[str, Any]:
        """Act on one message and describe the state that follows."""
        errors: dict[str, str] = {}
        kind, values, name = (message.get(key) for key in ("type", "values", "name"))
        if kind == "change" and isinstance(values, Mapping):
            errors = self.state.change(values)
        elif kind == "preset":
            errors = self.state.apply_preset(name)
        elif kind == "reset":
            self.state.reset()
            self.reset_view()
        elif kind == "view":
            self.reset_view()
        elif kind == "page" and isinstance(name, str) and name in self.pages:
            self.active = name
        answer = self.redraw()
        return answer | {
            "values": self.state.inputs(),
            "errors": errors,
            "notice": self.notice,
            "page": self.active,
        }

    def reset_view(self) -> None:
        """Undo every zoom on every page."""
        for page in self.pages.values():
            page.reset_view()

    def redraw(self) -> dict[str, Any]:
        """Solve and patch; a failure is told and leaves the last good picture."""
        page = self.pages[self.active]
        try:
            with pn.io.hold():
                page.show(self.state)
            self.notice = ""
            return page.answer(self.state)
        except ValueError as error:
            self.notice = str(error)
        except Exception:
            _LOG.exception("redraw failed for %r", self.state.inputs())
            self.notice = _FAILED
        return {}
