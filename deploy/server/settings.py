"""Settings from the environment, checked at start."""

import os


def whole_number(name, default, lowest=1):
    """A whole number from the environment."""
    text = os.environ.get(name, str(default))
    try:
        number = int(text)
    except ValueError:
        number = lowest - 1
    if number < lowest:
        # SystemExit: the server must not start with a limit that nobody meant.
        raise SystemExit(f"{name} must be an integer above {lowest - 1}, got {text!r}")
    return number


MAX_SESSIONS = whole_number("ROTORSTAB_MAX_SESSIONS", 60)
LESSONS = os.environ.get("ROTORSTAB_LESSONS", "")
RETRY_SECONDS = 30
