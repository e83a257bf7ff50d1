"""Growth maps that are kept for all sessions, whoever made them."""

from __future__ import annotations

from collections import OrderedDict
from functools import lru_cache

from rotorstab.window import FloquetMap, Window, floquet_map

__all__ = ["is_known", "keep", "known_map"]

MOST_KEPT = 48


@lru_cache(maxsize=MOST_KEPT)
def _moving_map(window: Window) -> FloquetMap:
    return floquet_map(window, settled=False)


_settled_maps: OrderedDict[Window, FloquetMap] = OrderedDict()


def is_known(window: Window) -> bool:
    """Whether the settled map of a window is there already."""
    return window in _settled_maps


def keep(window: Window, made: FloquetMap) -> None:
    """Keep a settled map, also one that another process has made."""
    _settled_maps[window] = made
    while len(_settled_maps) > MOST_KEPT:
        _settled_maps.popitem(last=False)


def known_map(window: Window, settled: bool) -> FloquetMap:
    """Return a map that is kept, or make and keep it."""
    if not settled:
        return _moving_map(window)
    if window not in _settled_maps:
        keep(window, floquet_map(window, True))
    _settled_maps.move_to_end(window)
    return _settled_maps[window]
