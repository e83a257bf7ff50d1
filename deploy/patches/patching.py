"""How parts of Panel, Bokeh and Tornado are replaced: only where they are what they were."""

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
        Where there is no such part: the server would run without what the new one guards.
    """
    if not hasattr(owner, name):
        raise Moved(f"{getattr(owner, '__name__', owner)} has no {name}")
    setattr(owner, name, new)


def explain(problem: Exception) -> str:
    """Return why the server cannot be hardened, in one line."""
    found = []
    for one in PATCHED:
        try:
            found.append(f"{one} {version(one)}")
        except PackageNotFoundError:
            found.append(f"no {one}")
    return (
        f"cannot harden this server, {', '.join(found)}: {problem}."
        " pip install 'rotorstab[app]' installs versions that are known"
    )
