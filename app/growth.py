"""Growth maps that are kept for all sessions, whoever made them."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal

from rotorstab.window import FloquetMap, Window, floquet_map, tongue_outlines

__all__ = ["Detail", "keep", "known_detail", "known_map"]

Detail = Literal[False, "map", True]
"""How fine a picture is: a coarse growth map, the full one, the full one with exact edges."""

MOST_KEPT = 48

_full_maps: OrderedDict[Window, FloquetMap] = OrderedDict()
_edges: OrderedDict[Window, Any] = OrderedDict()


@lru_cache(maxsize=MOST_KEPT)
def _moving_map(window: Window) -> FloquetMap:
    return floquet_map(window, settled=False)


def known_detail(window: Window) -> Detail:
    """Return how much of a window is there already."""
    if window not in _full_maps:
        return False
    return True if window in _edges else "map"


def keep(window: Window, made: Any) -> None:
    """Keep what a step has made, also in another process."""
    store = _full_maps if isinstance(made, FloquetMap) else _edges
    store[window] = made
    while len(store) > MOST_KEPT:
        store.popitem(last=False)


def known_map(window: Window, detail: Detail) -> FloquetMap:
    """Return a map that is kept, or make and keep it."""
    if not detail:
        return _moving_map(window)
    if window not in _full_maps:
        keep(window, floquet_map(window, True))
    _full_maps.move_to_end(window)
    if detail == "map":
        return _full_maps[window]
    if window not in _edges:
        keep(window, tongue_outlines(window))
    _edges.move_to_end(window)
    return replace(_full_maps[window], outlines=_edges[window])
