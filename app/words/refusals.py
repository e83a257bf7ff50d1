"""Messages for a user where the solver has no answer, without names of arguments or of Python."""

from __future__ import annotations

import logging

from rotorstab.model.stiffness import PastPole

from ..reading.user_error import UserError

__all__ = ["FAILED", "user_message"]

_LOG = logging.getLogger("rotorstab.app")
FAILED = "these values could not be computed; the charts show the last ones that could"
_PAST_POLE = (
    "the load is past the one at which the stiffness law ends: choose a smaller load, or the "
    "linear law"
)


def user_message(error: ValueError) -> str:
    """Return the message of an error for a user.

    That of a `UserError` is returned as it is. That of another error, which names an argument or
    advises a programmer, goes to the log, and the user reads `FAILED`.
    """
    if isinstance(error, UserError):
        return str(error)
    if isinstance(error, PastPole):
        return _PAST_POLE
    _LOG.warning("the solver has no answer: %.300s", error)
    return FAILED
