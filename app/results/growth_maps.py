"""Growth maps that are kept for all sessions, whichever process made them."""

from __future__ import annotations

from .caches import Store
from .limits import Detail
from .window import FloquetMap, Window, floquet_map

__all__ = ["clear", "keep", "known_detail", "known_map"]

MOST_KEPT = 48

_maps: dict[Detail, Store[Window, FloquetMap]] = {
    detail: Store(f"growth_maps.{detail.name.lower()}", MOST_KEPT) for detail in Detail
}


def known_detail(window: Window) -> Detail:
    """Return the finest map of a window that is kept; a coarse one takes under 0.1 s."""
    return Detail.FULL if window in _maps[Detail.FULL] else Detail.COARSE


def keep(window: Window, detail: Detail, made: FloquetMap) -> None:
    """Keep a map, also one that another process has made."""
    _maps[detail].keep(window, made)


def known_map(window: Window, detail: Detail) -> FloquetMap:
    """Return a map that is kept, or make and keep it."""
    return _maps[detail].get(window, lambda: floquet_map(window, detail))


def clear() -> None:
    """Forget every map."""
    for store in _maps.values():
        store.clear()
