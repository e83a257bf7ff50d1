"""How a process that works for another one behaves."""

from __future__ import annotations

import multiprocessing
import os
from multiprocessing.connection import wait
from threading import Thread

__all__ = ["prepare"]


def _end_with_parent() -> None:
    """Wait for the parent's end, however it comes, and end too."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


def prepare(niceness: int = 0) -> None:
    """Give way to other processes and never outlive the parent; for a pool's `initializer`."""
    if hasattr(os, "nice"):  # POSIX
        os.nice(niceness)
    Thread(target=_end_with_parent, daemon=True).start()
