"""Measurements of the dashboard, for a server that installs an observer."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["observe", "observers"]

observers: list[Callable[[str, float], None]] = []
"""Functions that are called with the name of an event and its value."""


def observe(name: str, value: float = 1.0) -> None:
    """Report an event to the observers: "update", seconds from a message to its answer."""
    for observer in observers:
        observer(name, value)
