"""The versions of Panel and related libraries for which the app is made, and its methods.

The app and its server replace and override parts of these libraries that are no public interface
and may move at any release. pyproject.toml has the bounds of the versions.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from functools import cache
from importlib import metadata

from packaging.requirements import Requirement
from panel.custom import JSComponent

__all__ = ["OVERRIDDEN", "PATCHED", "moved", "unknown", "warn"]

LOG = logging.getLogger("rotorstab.app")
PATCHED = ("panel", "holoviews", "bokeh", "tornado")
OVERRIDDEN = ("_server_event", "_comm_event", "_process_bokeh_event", "_process_event")
"""Methods of Panel's `JSComponent` that `app/live/controls.py` overrides or calls."""


def _requirements() -> list[str]:
    try:
        return metadata.requires("rotorstab") or []
    except metadata.PackageNotFoundError:  # run from its sources
        return []


def unknown(requirements: Sequence[str], installed: Callable[[str], str]) -> list[str]:
    """Return which of `PATCHED` have a version that the requirements exclude, in words.

    Parameters
    ----------
    requirements : sequence of str
        Requirements of rotorstab.
    installed : callable
        Returns the installed version of a library.
    """
    bounds = {
        each.name: each.specifier for each in map(Requirement, requirements) if each.name in PATCHED
    }
    return [
        f"{name} {installed(name)} (made for {bound})"
        for name, bound in bounds.items()
        if not bound.contains(installed(name), prereleases=True)
    ]


def moved() -> list[str]:
    """Return which of `OVERRIDDEN` this Panel does not have, in words."""
    return [
        f"panel.custom.JSComponent has no {name}"
        for name in OVERRIDDEN
        if not hasattr(JSComponent, name)
    ]


@cache
def warn() -> None:
    """Log once where a library is not the one for which the app is made."""
    if problems := [*unknown(_requirements(), metadata.version), *moved()]:
        LOG.warning(
            "this may not work as it should: %s; "
            "pip install 'rotorstab[app]' installs what it is made for",
            ", ".join(problems),
        )
