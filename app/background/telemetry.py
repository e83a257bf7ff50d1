"""What the app tells whoever measures it; nobody does unless a server installs an observer."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["observe", "observers"]

observers: list[Callable[[str, float], None]] = []
"""Called with the name of what happened and its value."""


def observe(name: str, value: float = 1.0) -> None:
    """Tell the observers: "update" [s], from a message of a page to its answer."""
    for observer in observers:
        observer(name, value)
