"""What a session waits for: the full map first, then its edges, and nothing that is superseded."""

import asyncio
from concurrent.futures import Future
from dataclasses import replace
from threading import Thread

import panel as pn
import pytest
from panel.io.state import set_curdoc

from app.background import settling
from app.background.settling import Settling
from app.background.threads import Scheduler
from app.results import growth_maps
from app.results.analysis import window_of
from app.results.growth_maps import known_detail, known_map
from app.state import State
from tests.testing.serving import run

WINDOW = replace(window_of(State()), spin_speed=1.2345)


class Page:
    """A document as far as `Settling` knows one."""

    session_context = object()

    def __init__(self):
        self.callbacks = []

    def on_session_destroyed(self, callback):
        self.destroyed = callback

    def add_next_tick_callback(self, callback):
        self.callbacks.append(callback)

    async def ticks(self, count):
        """Run that many callbacks, each when it comes."""
        for _ in range(count):
            for _ in range(2000):
                if self.callbacks:
                    break
                await asyncio.sleep(0.01)
            self.callbacks.pop(0)()


class Here:
    """A background that works in a thread, unless it fails, and notes what it is asked."""

    def __init__(self, failing=(), refused=()):
        self.asked, self.withdrawn, self.failing = [], [], failing
        self.refused = list(refused)

    def request(self, function, *arguments):
        if function.__name__ in self.refused:
            self.refused.remove(function.__name__)
            raise RuntimeError("no running event loop")
        self.asked.append(function.__name__)
        made = Future()

        def work():
            if function.__name__ in self.failing:
                made.set_exception(MemoryError())
            else:
                made.set_result(function(*arguments))

        Thread(target=work).start()
        return made

    def withdraw(self, function, *arguments):
        self.withdrawn.append(function.__name__)


@pytest.fixture
def fresh(monkeypatch):
    """No map is known, and none is left behind."""
    monkeypatch.setattr(growth_maps, "_full", type(growth_maps._full)())
    monkeypatch.setattr(growth_maps, "_whole", type(growth_maps._whole)())


def settle(monkeypatch, work, act):
    """Run `act(settling, page)`; return what was shown, in order."""
    monkeypatch.setattr(settling, "background", work)
    shown = []

    async def play():
        page = Page()
        with set_curdoc(page):
            await act(Settling(shown.append, Scheduler()), page)

    run(play())
    return shown


def test_the_map_is_shown_before_its_edges(fresh, monkeypatch):
    async def act(one, page):
        assert one.detail(WINDOW) is False
        assert one.detail(WINDOW) is False  # asked once
        await page.ticks(1)
        assert one.detail(WINDOW) in ("map", True)
        await page.ticks(1)
        assert one.detail(WINDOW) is True

    work = Here()
    assert settle(monkeypatch, work, act) == ["map", True]
    assert work.asked == ["floquet_map", "whole_map"]
    assert known_map(WINDOW, "map").outlines == ()
    assert len(known_map(WINDOW, True).outlines) > 3
    rough, fine = (known_map(WINDOW, one).growth for one in ("map", True))
    assert rough.refined == 0 < fine.refined
    assert (rough.error >= fine.error).all()


def test_what_was_superseded_is_never_shown(fresh, monkeypatch):
    other = replace(WINDOW, spin_speed=2.3456)

    async def act(one, page):
        one.detail(WINDOW)
        while not page.callbacks:
            await asyncio.sleep(0.01)
        one.drop()  # a slider moves before the map's turn comes
        assert one.detail(other) is False
        await page.ticks(3)

    assert settle(monkeypatch, Here(), act) == ["map", True]
    assert known_detail(other) is True


def test_a_map_that_cannot_be_made_elsewhere_is_shown_all_the_same(fresh, monkeypatch):
    async def act(one, page):
        one.detail(WINDOW)
        await page.ticks(1)
        assert one.detail(WINDOW) is False  # asked anew

    work = Here(failing=["floquet_map"])
    assert settle(monkeypatch, work, act) == [True]
    assert work.asked == ["floquet_map", "floquet_map"]


def test_a_request_that_failed_is_made_again_by_the_next_message(fresh, monkeypatch):
    """Nothing is noted as asked for before it is."""

    async def act(one, page):
        with pytest.raises(RuntimeError):
            one.detail(WINDOW)
        assert one.detail(WINDOW) is False
        await page.ticks(2)

    work = Here(refused=["floquet_map"])
    assert settle(monkeypatch, work, act) == ["map", True]
    assert work.asked == ["floquet_map", "whole_map"]


def test_a_worker_thread_may_ask_and_is_answered_with_the_documents_lock(fresh, monkeypatch):
    """As from Panel 1.10 on; what is shown is shown by a callback of the document alone."""
    told = []

    async def act(one, page):
        told.append(await asyncio.to_thread(one.detail, WINDOW))
        while not page.callbacks:
            await asyncio.sleep(0.01)
        told.append(len(told))
        await asyncio.to_thread(page.callbacks.pop(0))
        await page.ticks(1)

    assert settle(monkeypatch, Here(), act) == ["map", True]
    assert told == [False, 1]


def test_only_edges_are_asked_for_where_the_map_is_there(fresh, monkeypatch):
    async def act(one, page):
        known_map(WINDOW, "map")
        assert one.detail(WINDOW) == "map"
        await page.ticks(1)
        page.destroyed(None)
        assert work.withdrawn == []

    work = Here()
    assert settle(monkeypatch, work, act) == [True]
    assert work.asked == ["whole_map"]


def test_without_a_server_everything_is_made_at_once(fresh):
    assert pn.state.curdoc is None
    assert Settling(lambda detail: None, Scheduler()).detail(WINDOW) is True
