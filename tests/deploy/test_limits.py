"""What one sender may use of a worker: messages and work per second, while others are active."""

import inspect
import time
from types import SimpleNamespace

import pytest

from deploy.patches import connections, limits
from deploy.patches.limits import Bucket


def test_a_bucket_earns_by_its_own_clock():
    now = [0.0]
    bucket = Bucket(10, 3, clock=lambda: now[0])
    assert [bucket.wait() for _ in range(3)] == [0, 0, 0]
    assert bucket.wait() == pytest.approx(0.1)
    now[0] = 1000.0
    assert [bucket.wait() for _ in range(3)] == [0, 0, 0]
    assert bucket.wait() > 0


def test_a_jump_of_the_machines_time_changes_no_limit():
    for limited in (Bucket, connections.RareWarning, connections.Accepted):
        assert inspect.signature(limited).parameters["clock"].default is time.monotonic


def test_a_drag_at_the_screens_rate_never_waits():
    now = [0.0]
    bucket = Bucket(limits.RATE * limits.FRAGMENTS, limits.BURST * limits.FRAGMENTS, lambda: now[0])
    for _ in range(60 * 60):  # a minute of it, with a size and a range with every message
        now[0] += 1 / 60
        assert bucket.wait(2 * limits.FRAGMENTS) == 0


class Sender:
    """A socket that keeps the thread busy; `limits` counts its seconds."""


@pytest.fixture
def clock(monkeypatch):
    """A clock that advances only where a message works or waits."""

    class Clock:
        now = worked = 0.0

        async def sleep(self, seconds):
            self.now += seconds

        def work(self, seconds):
            async def handle(socket, fragment):
                self.now += seconds
                self.worked += seconds

            return handle

    clock = Clock()
    monkeypatch.setattr(limits, "is_closing", lambda socket: False)
    monkeypatch.setattr(limits, "active", {})
    monkeypatch.setattr(limits, "asyncio", SimpleNamespace(sleep=clock.sleep))
    monkeypatch.setattr(
        limits,
        "time",
        SimpleNamespace(monotonic=lambda: clock.now, thread_time=lambda: clock.worked),
    )
    monkeypatch.setattr(limits.Bucket.__init__, "__defaults__", (lambda: clock.now,))
    return clock


def send(clock, socket, seconds, other=None):
    """Have a message handled that takes so many seconds of the thread; nothing really waits."""
    if other is not None:
        limits.active[other] = clock.now
    with pytest.raises(StopIteration):
        limits.paced(socket, "", handle=clock.work(seconds)).send(None)


def test_a_sender_alone_is_never_held_back(clock):
    sender = Sender()
    for _ in range(1000):
        send(clock, sender, 0.2)
    assert clock.now == pytest.approx(clock.worked)


@pytest.mark.parametrize(
    ("seconds", "share"),
    [(0.02, limits.THREAD_SHARE), (0.2, limits.LONG_SHARE), (2.0, limits.LONG_SHARE)],
)
def test_a_sender_among_others_pays_its_whole_debt(clock, monkeypatch, seconds, share):
    """It once waited 2 s at most, whatever it owed, and so had four fifths of the thread."""
    sender, other = Sender(), Sender()
    monkeypatch.setattr(
        limits, "others_wait", lambda socket, ask=limits.others_wait: ask(socket) or True
    )
    for _ in range(int(600 / seconds)):
        send(clock, sender, seconds, other)
    assert clock.worked / clock.now == pytest.approx(share, rel=0.1)


def test_a_debt_is_forgiven_once_nobody_else_is_active(clock):
    sender, other = Sender(), Sender()
    for _ in range(60):
        send(clock, sender, 1.0, other)
        assert clock.now <= clock.worked + 60 * (limits.ACTIVE + limits.LOOK_AGAIN)


def test_an_honest_drag_among_others_is_not_held_back(clock):
    """Half a minute of moves of 36 ms each, one page in between that takes 0.5 s."""
    sender, other = Sender(), Sender()
    send(clock, sender, 0.5, other)
    before = clock.now
    while clock.now < before + 27:
        send(clock, sender, 0.036, other)
        clock.now += 0.07
    assert clock.now - before <= 28
