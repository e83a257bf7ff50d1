"""Caches that all sessions share: each is bounded and has a name, under which it is measured.

Whatever is kept is immutable, its arrays included: sessions share it.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from functools import lru_cache
from threading import Lock
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

if TYPE_CHECKING:
    from functools import _lru_cache_wrapper

__all__ = ["CacheInfo", "Store", "cache_infos", "shared_cache"]

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class CacheInfo(NamedTuple):
    """How often a cache had a result, how often it had not, and how many results it holds."""

    hits: int
    misses: int
    maxsize: int
    currsize: int


_caches: dict[str, Callable[[], CacheInfo]] = {}


def cache_infos() -> Iterator[tuple[str, CacheInfo]]:
    """Yield name and figures of every shared cache of the modules that have been imported."""
    for name, info in _caches.items():
        yield name, info()


def shared_cache(
    maxsize: int,
) -> Callable[[Callable[..., Value]], _lru_cache_wrapper[Value]]:
    """Return a decorator that keeps the last `maxsize` results of a function for all sessions."""

    def decorate(function: Callable[..., Value]) -> _lru_cache_wrapper[Value]:
        cached = lru_cache(maxsize)(function)
        module = function.__module__.rpartition(".")[2]
        name = f"{module}.{function.__name__.lstrip('_')}"
        _caches[name] = lambda: CacheInfo(*cached.cache_info())  # type: ignore[arg-type]
        return cached

    return decorate


class Store(Generic[Key, Value]):
    """Keeps the last results for all sessions, also those that another process has made.

    Every thread may use it.

    Parameters
    ----------
    name : str
        Under which it is measured.
    maxsize : int
        Largest number of results.
    """

    def __init__(self, name: str, maxsize: int) -> None:
        self._maxsize = maxsize
        self._kept: OrderedDict[Key, Value] = OrderedDict()
        self._lock = Lock()
        self._hits = self._misses = 0
        _caches[name] = self.info

    def __contains__(self, key: Key) -> bool:
        with self._lock:
            return key in self._kept

    def keep(self, key: Key, value: Value) -> None:
        """Keep a result; the one that has not been used for longest gives way."""
        with self._lock:
            self._kept[key] = value
            self._kept.move_to_end(key)
            while len(self._kept) > self._maxsize:
                self._kept.popitem(last=False)

    def get(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return the result of a key, made where it is not kept."""
        with self._lock:
            if key in self._kept:
                self._hits += 1
                self._kept.move_to_end(key)
                return self._kept[key]
            self._misses += 1
        value = make()
        self.keep(key, value)
        return value

    def clear(self) -> None:
        """Forget every result."""
        with self._lock:
            self._kept.clear()

    def info(self) -> CacheInfo:
        """Return the figures of the cache."""
        with self._lock:
            return CacheInfo(self._hits, self._misses, self._maxsize, len(self._kept))
