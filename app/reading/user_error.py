"""The error whose message the user reads as it is."""

from __future__ import annotations

__all__ = ["UserError"]


class UserError(ValueError):
    """Input, or a state, that has no answer; the message is a sentence for the user.

    A ValueError of another type, such as one of the solver, names arguments of functions.
    """
