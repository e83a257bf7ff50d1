"""Processes for work that may wait: done once, dropped, made anew, gone with their server."""

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import CancelledError, Future, wait
from multiprocessing.context import SpawnProcess
from pathlib import Path

import pytest

from app.background import processes
from app.background.processes import ACTIVE, CROWD, PATIENCE, PAUSE, Background, Worker, settle

SERVER = """
import os, sys
from app.background.processes import Worker
if __name__ == "__main__":
    print(Worker().call(os.getpid).result(), flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def background():
    made = Background(niceness=3)
    yield made
    made.close()


def test_equal_work_is_done_once_in_a_process_that_gives_way(background):
    asked = [background.request(os.getpid) for _ in range(3)]
    assert len({id(one) for one in asked}) == 1
    assert asked[0].result(60) != os.getpid()
    assert background.request(os.nice, 0).result(60) == min(19, os.nice(0) + 3)


def test_work_is_asked_for_by_any_thread_without_a_loop(background):
    """From Panel 1.10 on callbacks run in worker threads, several at the same time."""
    found = []

    def ask(seconds):
        found.append(background.request(time.sleep, seconds).result(60))

    threads = [threading.Thread(target=ask, args=(0.001 * (k % 4),)) for k in range(16)]
    for one in threads:
        one.start()
    for one in threads:
        one.join(60)
    assert found == [None] * 16
    assert background.pending() == 0


def test_work_that_nobody_waits_for_is_dropped(background):
    running = background.request(time.sleep, 0.5)
    dropped, kept = background.request(os.getcwd), background.request(os.getpid)
    background.request(os.getpid)
    background.withdraw(os.getcwd)
    background.withdraw(os.getpid)  # one of two who wait
    again = background.request(os.getcwd)
    running.result(60)
    with pytest.raises(CancelledError):
        dropped.result(60)
    assert isinstance(kept.result(60), int)
    assert again.result(60) == os.getcwd()


def test_in_a_crowd_work_waits_for_a_pause_but_not_for_ever(background, monkeypatch):
    waits = []
    clock = iter(range(0, 10_000))
    now = [0.0]

    def sleep(seconds):
        waits.append(seconds)
        now[0] += seconds
        if now[0] < busy:
            background.touch(next(clock) % CROWD)

    def begin():
        """Return how long new work waits for its turn."""
        waits.clear()
        background.request(os.getpid).result(60)
        return sum(waits)

    monkeypatch.setattr(processes, "monotonic", lambda: now[0])
    monkeypatch.setattr(processes, "sleep", sleep)

    busy = 0.0
    for _ in range(50):
        background.touch("one")
        background.touch("another")
    assert begin() == 0  # two are no crowd
    for who in range(CROWD):
        background.touch(who)
    assert begin() == pytest.approx(PAUSE)
    busy = 1e9  # they never stop
    background.touch(0)
    assert begin() == pytest.approx(PATIENCE)
    busy = 0.0
    now[0] += ACTIVE + 0.1  # all have left
    assert begin() == 0


def test_a_killed_process_is_replaced(background):
    first = background.request(os.getpid).result(60)
    os.kill(first, signal.SIGKILL)
    assert background.request(os.getpid).result(60) != first


def test_an_error_of_the_work_is_its_futures(background):
    with pytest.raises(FileNotFoundError):
        background.request(os.stat, "/nowhere/at/all").result(60)
    assert background.request(os.getpid).result(60) > 0


def no_room(*_, **__):
    raise OSError(11, "Resource temporarily unavailable")


def test_nothing_is_left_behind_where_no_process_can_be_started(background, monkeypatch):
    """A second request for the same must be as good as the first one."""
    monkeypatch.setattr(processes, "ProcessPoolExecutor", no_room)
    for _ in range(2):
        with pytest.raises(OSError, match="unavailable"):
            background.request(os.getpid).result(60)
    monkeypatch.undo()
    monkeypatch.setattr(SpawnProcess, "start", no_room)
    with pytest.raises(OSError, match="unavailable"):
        background.request(os.getpid).result(60)
    monkeypatch.undo()
    assert background.request(os.getpid).result(60) > 0


def test_nothing_is_left_behind_where_no_thread_can_be_started(background, monkeypatch):
    def no_thread(self):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", no_thread)
    with pytest.raises(RuntimeError, match="new thread"):
        background.request(os.getpid).result(60)
    monkeypatch.undo()
    assert background.request(os.getpid).result(60) > 0


def open_writer(pipe):
    """Open a pipe for writing once somebody reads from it."""
    for _ in range(6000):
        try:
            return os.open(pipe, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:  # nobody reads yet
            time.sleep(0.01)
    raise AssertionError("nobody reads from the pipe")


def test_an_end_ends_its_own_process_only_and_leaves_nobody_waiting(background, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = None
    other = Worker()
    bystander = multiprocessing.get_context("spawn").Process(target=time.sleep, args=(600,))
    bystander.start()
    try:
        kept = other.call(os.getpid).result(60)
        own = background.request(os.getpid).result(60)
        running = background.request(Path.read_bytes, pipe)
        waiting = background.request(os.getcwd)
        writer = open_writer(pipe)  # the process has begun to read, and waits for an end
        background.close()
        assert wait([running], 60).done
        assert running.exception() is not None
        assert waiting.cancelled()
        assert background.request(os.getppid).cancelled()
        with pytest.raises(ProcessLookupError):
            os.kill(own, 0)
        assert other.call(os.getpid).result(60) == kept
        assert bystander.is_alive()
    finally:
        if writer is not None:
            os.close(writer)
        other.close()
        bystander.kill()
        bystander.join()


@pytest.mark.parametrize("state", ["cancelled", "failed", "made"])
def test_a_future_ends_with_another_however_that_ends(state):
    other, future = Future(), Future()
    if state == "cancelled":
        other.cancel()
    elif state == "failed":
        other.set_exception(KeyError("x"))
    else:
        other.set_result(7)
    settle(future, other.result)
    assert future.done()
    problem = future.exception()
    assert isinstance(problem, {"cancelled": CancelledError, "failed": KeyError}.get(state, object))
    assert (problem is None) == (state == "made")
    settle(future, lambda: 8)  # once only
    assert future.exception() is problem


def test_a_process_ends_with_a_server_that_is_killed(tmp_path):
    script = tmp_path / "server.py"
    script.write_text(SERVER)
    server = subprocess.Popen(
        [sys.executable, script],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    with server:
        process = int(server.stdout.readline())
        server.kill()
    for _ in range(600):
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    pytest.fail("the process outlived its server")
