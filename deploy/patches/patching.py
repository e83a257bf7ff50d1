"""Replaces parts of Panel, Bokeh and Tornado, and raises an error if such a part has moved."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version
from typing import Any

PATCHED = ("panel", "bokeh", "tornado")
hardened = False
"""Whether `deploy/setup.py` has installed every patch in this process; it sets this itself.

It is a variable of the module: `app/main.py` asks for it through `plain_serving`, and Panel starts
both files by itself, without a place to hand anything over.
"""


class Moved(AttributeError):
    """A part that a patch replaces does not exist."""


def replace(owner: Any, name: str, new: Any) -> None:
    """Replace a part of a class or module.

    Raises
    ------
    Moved
        If there is no such part. Without this error the server would run unprotected.
    """
    if not hasattr(owner, name):
        raise Moved(f"{getattr(owner, '__name__', owner)} has no {name}")
    setattr(owner, name, new)


def explain(problem: Exception) -> str:
    """Return why the server cannot be hardened, in one line."""
    installed = []
    for name in PATCHED:
        try:
            installed.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            installed.append(f"no {name}")
    return (
        f"cannot harden this server, {', '.join(installed)}: {problem}."
        " pip install 'rotorstab[app]' installs versions that are known"
    )
