"""How parts of Panel, Bokeh and Tornado are replaced: only parts that are still there."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version
from typing import Any

PATCHED = ("panel", "bokeh", "tornado")
hardened = False
"""Whether `deploy/setup.py` has installed every patch in this process."""


class Moved(AttributeError):
    """A part that is to be replaced is not there."""


def replace(owner: Any, name: str, new: Any) -> None:
    """Replace a part of a class or module.

    Raises
    ------
    Moved
        Where there is no such part: the server would run without what the new part guards.
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
