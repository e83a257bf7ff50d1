"""What a user is told where the solver has no answer: no name of an argument, nothing of Python."""

from __future__ import annotations

import logging

from rotorstab.model.stiffness import PastPole

__all__ = ["FAILED", "user_message"]

_LOG = logging.getLogger("rotorstab.app")
FAILED = "these values could not be computed; the charts show the last ones that could"
_PAST_POLE = (
    "the load is past the one at which a shaft clamped at both ends buckles, and there the exact "
    "stiffness law ends: choose a smaller load, or the linear law"
)


def user_message(error: ValueError) -> str:
    """Return an error in words for a user; the log has the solver's own.

    The app's own sentences are handed on. The solver's name an argument in `backticks`.
    """
    text = str(error)
    if isinstance(error, PastPole):
        return _PAST_POLE
    if "`" not in text and "set_int_max_str_digits" not in text:
        return text
    _LOG.warning("the solver has no answer: %.300s", text)
    return FAILED
