"""Caches that sessions share: bounded, counted, and known by a name."""

from threading import Thread

import pytest

from app.results.caches import CacheInfo, Store, cache_infos, shared_cache


def test_a_store_keeps_the_last_results_that_were_used():
    store = Store("test.store", 2)
    for key in "ab":
        assert store.get(key, key.upper) == key.upper()
    assert store.get("a", lambda: pytest.fail("made again")) == "A"
    store.keep("c", "C")  # what was used before "a" gives way
    assert ("a" in store, "b" in store, "c" in store) == (True, False, True)
    assert dict(cache_infos())["test.store"] == CacheInfo(1, 2, 2, 2)
    store.clear()
    assert "a" not in store
    assert store.info().currsize == 0


def test_a_result_that_cannot_be_made_is_not_kept():
    store = Store("test.failing", 2)
    with pytest.raises(ZeroDivisionError):
        store.get("a", lambda: 1 // 0)
    assert "a" not in store
    assert store.get("a", lambda: 7) == 7


def test_any_thread_may_keep_a_result():
    store = Store("test.threads", 8)
    threads = [
        Thread(target=lambda k=k: [store.keep((k, i), i) for i in range(200)]) for k in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert store.info().currsize == 8


def test_a_shared_cache_is_known_by_the_name_of_its_function():
    @shared_cache(3)
    def _square(number):
        return number**2

    assert [_square(number) for number in (1, 2, 3, 4, 4)] == [1, 4, 9, 16, 16]
    (info,) = (info for name, info in cache_infos() if name.endswith(".square"))
    assert info == CacheInfo(hits=1, misses=4, maxsize=3, currsize=3)
