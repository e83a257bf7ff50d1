"""What a process does first that works for the server."""

from __future__ import annotations

import multiprocessing
import os
from multiprocessing.connection import wait
from threading import Thread

__all__ = ["prepare"]


def _end_with_parent() -> None:
    """Wait until the parent has ended, for whatever reason, and end too."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


def prepare(niceness: int = 0) -> None:
    """Lower the priority and never outlive the parent; the `initializer` of a process pool.

    Parameters
    ----------
    niceness : int
        By which the priority is lowered, 0 to 19 (POSIX).
    """
    if hasattr(os, "nice"):  # POSIX
        os.nice(niceness)
    Thread(target=_end_with_parent, daemon=True).start()
