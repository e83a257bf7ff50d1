"""The pins of a page: those whose curves are drawn, and those of an address that are not yet."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from ..state import State
from ..state.address import MOST_PINS, PinnedInputs
from ..words.refusals import user_message
from .base import Reply
from .pins import Pin, pin, solve_pin

__all__ = ["PinList"]

_LOG = logging.getLogger("rotorstab.app")


class PinList:
    """At most `MOST_PINS` pins, in the order of their numbers.

    Attributes
    ----------
    solved : list of Pin
        Those whose curves are drawn.
    unsolved : list of PinnedInputs
        Those of an address that wait for `solve_next`.
    """

    def __init__(self) -> None:
        self.solved: list[Pin] = []
        self.unsolved: list[PinnedInputs] = []

    def inputs(self) -> Sequence[PinnedInputs]:
        """Return all pins, for the address."""
        return sorted([*self.solved, *self.unsolved], key=lambda pin: pin.number)

    def pin(self, name: object, state: State) -> Reply:
        """Pin the curves of a state; the reply says so, or why not."""
        try:
            made = pin(state, name, self.inputs())
        except ValueError as error:
            return Reply({"toast": user_message(error)})
        if made is None:
            return Reply({"toast": f"at most {MOST_PINS} pins: remove one first"})
        self._add(made)
        return Reply({"toast": f"{made.name} was added"})

    def remove(self, number: object) -> None:
        """Remove the pin of a number, if there is one."""
        self.solved = [pin for pin in self.solved if pin.number != number]

    def solve_next(self) -> str | None:
        """Solve one pin of the address.

        Returns
        -------
        str or None
            Empty if it was solved, else its key in the address with the reason; None if no pin was
            waiting.
        """
        if not self.unsolved:
            return None
        unsolved = self.unsolved.pop(0)
        try:
            self._add(solve_pin(unsolved))
        except ValueError as error:
            return f"p{unsolved.number} ({user_message(error)})"
        except Exception:
            _LOG.exception("a pin of the address failed: %r", unsolved.inputs)
            return f"p{unsolved.number} (it could not be computed)"
        return ""

    def _add(self, made: Pin) -> None:
        self.solved = sorted([*self.solved, made], key=lambda pin: pin.number)
