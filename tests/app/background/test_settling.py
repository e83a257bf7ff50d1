"""What a session waits for: the full map, and nothing that is superseded."""

import asyncio
from concurrent.futures import Future
from threading import Thread

import panel as pn
import pytest
from panel.io.state import set_curdoc

from app.background import settling
from app.background.settling import Ahead, Settling
from app.background.threads import Scheduler
from app.results import growth_maps
from app.results.analysis import window_of
from app.results.growth_maps import known_detail, known_map
from app.results.limits import Detail
from app.state import State
from tests.testing.serving import run

COARSE, FULL = Detail
WINDOW = window_of(State(spin_speed=1.2345))


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
            for _ in range(6000):
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
        detail = arguments[-1]
        if detail in self.refused:
            self.refused.remove(detail)
            raise RuntimeError("no running event loop")
        self.asked.append(detail)
        made = Future()

        def work():
            if detail in self.failing:
                made.set_exception(MemoryError())
            else:
                made.set_result(function(*arguments))

        Thread(target=work).start()
        return made

    def withdraw(self, function, *arguments):
        self.withdrawn.append(arguments[-1])


@pytest.fixture
def fresh():
    """No map is known."""
    growth_maps.clear()


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


def test_the_full_map_is_asked_for_once_and_shown_when_it_is_there(fresh, monkeypatch):
    async def act(one, page):
        assert one.detail(WINDOW) is COARSE
        assert one.detail(WINDOW) is COARSE  # asked once
        await page.ticks(1)
        assert one.detail(WINDOW) is FULL

    work = Here()
    assert settle(monkeypatch, work, act) == [FULL]
    assert work.asked == [FULL]
    assert known_map(WINDOW, FULL).growth.refined > 0


def test_what_was_superseded_is_never_shown(fresh, monkeypatch):
    other = window_of(State(spin_speed=2.3456))

    async def act(one, page):
        one.detail(WINDOW)
        while not page.callbacks:
            await asyncio.sleep(0.01)
        one.drop()  # a slider moves before the map's turn comes
        assert one.detail(other) is COARSE
        await page.ticks(2)

    assert settle(monkeypatch, Here(), act) == [FULL]
    assert known_detail(other) is FULL


def test_a_map_that_cannot_be_made_elsewhere_is_shown_all_the_same(fresh, monkeypatch):
    async def act(one, page):
        one.detail(WINDOW)
        await page.ticks(1)
        assert one.detail(WINDOW) is COARSE  # asked anew

    work = Here(failing=[FULL])
    assert settle(monkeypatch, work, act) == [FULL]
    assert work.asked == [FULL, FULL]


def test_a_request_that_failed_is_made_again_by_the_next_message(fresh, monkeypatch):
    """Nothing is noted as asked for before it is."""

    async def act(one, page):
        with pytest.raises(RuntimeError):
            one.detail(WINDOW)
        assert one.detail(WINDOW) is COARSE
        await page.ticks(1)

    work = Here(refused=[FULL])
    assert settle(monkeypatch, work, act) == [FULL]
    assert work.asked == [FULL]


def test_a_worker_thread_may_ask_and_is_answered_with_the_documents_lock(fresh, monkeypatch):
    """As from Panel 1.10 on; what is shown is shown by a callback of the document alone."""
    told = []

    async def act(one, page):
        told.append(await asyncio.to_thread(one.detail, WINDOW))
        while not page.callbacks:
            await asyncio.sleep(0.01)
        told.append(len(told))
        await asyncio.to_thread(page.callbacks.pop(0))

    assert settle(monkeypatch, Here(), act) == [FULL]
    assert told == [COARSE, 1]


def test_nothing_is_asked_for_where_the_map_is_there(fresh, monkeypatch):
    async def act(one, page):
        known_map(WINDOW, FULL)
        assert one.detail(WINDOW) is FULL
        page.destroyed(None)
        assert work.withdrawn == []

    work = Here()
    assert settle(monkeypatch, work, act) == []
    assert work.asked == []


def test_without_a_server_everything_is_made_at_once(fresh):
    assert pn.state.curdoc is None
    assert Settling(lambda detail: None, Scheduler()).detail(WINDOW) is FULL


def look_ahead(monkeypatch, work, windows, ticks):
    """Have maps made ahead; return how often they were shown."""
    monkeypatch.setattr(settling, "background", work)
    shown = []

    async def play():
        page = Page()

        def missing():
            return [one for one in windows if known_detail(one) is not FULL]

        def show():
            shown.append(len(missing()))
            ahead.request(missing())

        with set_curdoc(page):
            ahead = Ahead(show, Scheduler())
            ahead.request(missing())
            await page.ticks(ticks)

    run(play())
    return shown


def test_maps_of_pins_are_made_one_after_the_other(fresh, monkeypatch):
    other = window_of(State(spin_speed=2.3456))
    work = Here()
    assert look_ahead(monkeypatch, work, [WINDOW, other], 2) == [1, 0]
    assert work.asked == [FULL, FULL]


def test_a_map_of_a_pin_that_cannot_be_made_does_not_keep_the_next_one_waiting(fresh, monkeypatch):
    other = window_of(State(spin_speed=2.3456))
    work = Here(failing=[FULL])
    look_ahead(monkeypatch, work, [WINDOW, other], 2)
    assert work.asked == [FULL, FULL]  # each of them once
