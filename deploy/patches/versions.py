"""Which versions of Panel and its kin the app is made for: the bounds in `pyproject.toml`.

The app and its server patch parts of them that are no public interface and may move at any release.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from functools import cache
from importlib import metadata

from packaging.requirements import Requirement

__all__ = ["PATCHED", "tell", "unknown"]

_LOG = logging.getLogger("rotorstab.app")
PATCHED = ("panel", "holoviews", "bokeh", "tornado")


def _required() -> list[str]:
    try:
        return metadata.requires("rotorstab") or []
    except metadata.PackageNotFoundError:  # run from its sources
        return []


def unknown(required: Sequence[str], installed: Callable[[str], str]) -> list[str]:
    """Return in words which of `PATCHED` have a version that the requirements exclude."""
    bounds = {one.name: one.specifier for one in map(Requirement, required) if one.name in PATCHED}
    return [
        f"{name} {installed(name)} (made for {bound})"
        for name, bound in bounds.items()
        if not bound.contains(installed(name), prereleases=True)
    ]


@cache
def tell() -> None:
    """Log once whether a version is none that the app is made for."""
    if words := unknown(_required(), metadata.version):
        _LOG.warning(
            "this may not work as it should: %s; "
            "pip install 'rotorstab[app]' installs what it is made for",
            ", ".join(words),
        )
