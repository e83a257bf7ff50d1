"""Processes for work that may wait: done once, dropped, made anew, gone with their server."""

import asyncio
import os
import signal
import subprocess
import sys
import time

import pytest

from app.processes import ACTIVE, CROWD, PATIENCE, PAUSE, Background
from tests.serving import run

SERVER = """
import os, sys
from app.processes import start_pool
if __name__ == "__main__":
    print(start_pool().submit(os.getpid).result(), flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def background():
    made = Background(niceness=3)
    yield made
    made.close()


def test_equal_work_is_done_once_in_a_process_that_gives_way(background):
    async def ask():
        tasks = [background.request(os.getpid) for _ in range(3)]
        return {id(task) for task in tasks}, await tasks[0], await background.request(os.nice, 0)

    tasks, process, niceness = run(ask())
    assert len(tasks) == 1
    assert process != os.getpid()
    assert niceness == min(19, os.nice(0) + 3)


def test_work_that_nobody_waits_for_is_dropped(background):
    async def ask():
        running = background.request(time.sleep, 0.5)
        dropped, kept = background.request(os.getcwd), background.request(os.getpid)
        background.request(os.getpid)
        background.withdraw(os.getcwd)
        background.withdraw(os.getpid)  # one of two who wait
        again = background.request(os.getcwd)
        await running
        return await asyncio.gather(dropped, kept, again, return_exceptions=True)

    dropped, kept, again = run(ask())
    assert isinstance(dropped, asyncio.CancelledError)
    assert isinstance(kept, int)
    assert again == os.getcwd()


def test_in_a_crowd_work_waits_for_a_pause_but_not_for_ever(background, monkeypatch):
    waits = []
    clock = iter(range(0, 10_000))
    now = [0.0]

    async def sleep(seconds):
        waits.append(seconds)
        now[0] += seconds
        if now[0] < busy:
            background.touch(next(clock) % CROWD)

    monkeypatch.setattr("app.processes.monotonic", lambda: now[0])
    monkeypatch.setattr("app.processes.asyncio.sleep", sleep)

    busy = 0.0
    for _ in range(50):
        background.touch("one")
        background.touch("another")
    run(background._pause(PATIENCE))
    assert waits == []  # two are no crowd
    for who in range(CROWD):
        background.touch(who)
    run(background._pause(PATIENCE))
    assert sum(waits) == pytest.approx(PAUSE)
    waits.clear()
    busy = 1e9  # they never stop
    background.touch(0)
    start = now[0]
    run(background._pause(start + PATIENCE))
    assert now[0] - start == pytest.approx(PATIENCE)
    busy = 0.0
    now[0] += ACTIVE + 0.1  # all have left
    waits.clear()
    run(background._pause(now[0] + PATIENCE))
    assert waits == []


def test_a_killed_process_is_replaced(background):
    async def ask():
        process = await background.request(os.getpid)
        os.kill(process, signal.SIGKILL)
        return process, await background.request(os.getpid)

    first, second = run(ask())
    assert first != second


def test_an_error_of_the_work_is_its_tasks(background):
    async def ask():
        with pytest.raises(FileNotFoundError):
            await background.request(os.stat, "/nowhere/at/all")
        return await background.request(os.getpid)

    assert run(ask()) > 0


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
