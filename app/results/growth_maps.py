"""Growth maps that are kept for all sessions, whoever made them."""

from __future__ import annotations

from collections import OrderedDict
from functools import lru_cache
from threading import Lock
from typing import Literal

from rotorstab.maps.window import FloquetMap, Window, floquet_map, whole_map

__all__ = ["Detail", "keep", "known_detail", "known_map"]

Detail = Literal[False, "map", True]
"""How fine a picture is: a coarse growth map, the full one, that with doubtful pixels refined and
exact edges."""

MOST_KEPT = 48

_full: OrderedDict[Window, FloquetMap] = OrderedDict()
_whole: OrderedDict[Window, FloquetMap] = OrderedDict()
_lock = Lock()  # of both: what another process has made is kept by a thread of its own


@lru_cache(maxsize=MOST_KEPT)
def _moving_map(window: Window) -> FloquetMap:
    return floquet_map(window, settled=False)


def known_detail(window: Window) -> Detail:
    """Return how much of a window is there already."""
    with _lock:
        if window in _whole:
            return True
        return "map" if window in _full else False


def keep(window: Window, made: FloquetMap, whole: bool) -> None:
    """Keep a full or a whole map, also one that another process has made."""
    store = _whole if whole else _full
    with _lock:
        store[window] = made
        store.move_to_end(window)
        while len(store) > MOST_KEPT:
            store.popitem(last=False)


def known_map(window: Window, detail: Detail) -> FloquetMap:
    """Return a map that is kept, or make and keep it."""
    if not detail:
        return _moving_map(window)
    whole = detail is True
    store = _whole if whole else _full
    with _lock:
        known = store.get(window)
    made = known or (whole_map(window) if whole else floquet_map(window, True))
    keep(window, made, whole)
    return made
