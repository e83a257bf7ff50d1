"""The versions of Panel and related libraries for which the app is made: pyproject.toml's bounds.

The app and its server replace parts of these libraries that are no public interface and may move
at any release.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from functools import cache
from importlib import metadata

from packaging.requirements import Requirement

__all__ = ["PATCHED", "unknown", "warn"]

LOG = logging.getLogger("rotorstab.app")
PATCHED = ("panel", "holoviews", "bokeh", "tornado")


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


@cache
def warn() -> None:
    """Log once where a library has a version for which the app is not made."""
    if libraries := unknown(_requirements(), metadata.version):
        LOG.warning(
            "this may not work as it should: %s; "
            "pip install 'rotorstab[app]' installs what it is made for",
            ", ".join(libraries),
        )
