"""Measure a server under attack: whether it survives, leaks memory or becomes slow for others.

One client, in its own process, sends malformed messages, messages with hostile values and the most
expensive questions that are allowed. It also holds idle connections and requests files. It does
all of this as fast as the server allows. Meanwhile another user, the bystander, moves a slider. A
check inside the server (`tests/testing/spy.py`) asserts that every number that reaches the solver
is finite and within the bounds of `State`. All streams have a fixed seed.
"""

import argparse
import asyncio
import contextlib
import multiprocessing
import os
import random
import re
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

from tornado.httpclient import AsyncHTTPClient, HTTPRequest

from benchmarks.classroom.client import User
from tests.testing import hostile
from tests.testing.serving import Server
from tests.testing.wire import opened, token

ROOT = Path(__file__).parents[1]
PATH = "/spied"
APP = """
import logging, sys
first = "app.document" not in sys.modules
from tests.testing import spy
if first:
    spy.seen, spy.found = spy.watch()
import app.document
from deploy.patches import plain_serving
plain_serving.prepare()
app.document.show()
logging.getLogger("rotorstab.spy").warning(
    "spy: %d calls, %d violations %s", sum(spy.seen.values()), len(spy.found), spy.found[:3])
"""
SEED = 20260601
EACH = len(hostile.NAMES)  # hostile values a message
PAUSE = 0.05  # s between the bystander's moves
PAGES = "pages side by side, none connects"
# A page takes the thread most of a second, and nobody can tell a class that arrives from one
# client: this row is printed and not judged.
UNJUDGED = (PAGES,)
MOST = 2.0  # p95 under abuse over p95 alone


class Address(NamedTuple):
    """Where a server is."""

    port: int
    origin: str


def p95(times):
    """Return the value below which 95 of 100 lie."""
    ordered = sorted(times)
    return ordered[min(len(ordered) - 1, int(0.95 * len(ordered)))]


async def bystand(user, stop, times):
    """Move a slider until told to stop; keep the times to the answer [s]."""
    number = 0
    while not stop.is_set():
        number += 1
        answer = await user.change(spin_speed=round(0.5 + 0.02 * (number % 150), 2))
        times.append(answer.seconds)
        await asyncio.sleep(PAUSE)


async def beside(user, work):
    """Return the bystander's times while some work runs, and the work's result."""
    stop, times = asyncio.Event(), []
    task = asyncio.create_task(bystand(user, stop, times))
    try:
        result = await work
    finally:
        stop.set()
        await task
    return times, result


def leaks(wire):
    """Return what the server told of its inside."""
    words = ("Traceback", 'File "', str(ROOT), "site-packages")
    return [text[:200] for text in wire.heard if any(word in text for word in words)]


async def malformed(server, page, count):
    """Send malformed messages, reconnecting whenever the socket is closed."""
    rng, told, closed, sent, models = random.Random(SEED), [], 0, 0, {}
    while sent < count:
        async with opened(server, PATH, page) as wire:
            if not models:
                await wire.pull()
                models = wire.models
            reading = asyncio.create_task(_drain(wire))
            with contextlib.suppress(Exception):  # the socket was closed meanwhile
                while sent < count and not reading.done():
                    sent += 1
                    await wire.raw(*hostile.fragments(rng, models))
                    if sent % 20 == 0:
                        await asyncio.sleep(0)
            await asyncio.sleep(0)
            closed += wire.connection.close_code is not None
            reading.cancel()
            told += leaks(wire)
    return told, closed


async def _drain(wire):
    while not wire.ended:
        await wire.fragment()


async def values(server, page, count):
    """Ask for changes to hostile values, one answer after another."""
    rng, told, unanswered = random.Random(SEED + 1), [], 0
    left = count
    while left > 0:
        async with opened(server, PATH, page) as wire:
            await wire.pull()
            while left > 0:
                left -= EACH
                data = {"type": "change", "values": hostile.values(rng, EACH)}
                if left % (40 * EACH) < EACH:
                    data = {"type": "reset"}
                answer = None
                with contextlib.suppress(Exception):
                    answer = await wire.ask(data)
                unanswered += answer is None  # refused before it came to the page, or closed
                if wire.connection.close_code is not None:
                    break
            told += leaks(wire)
    return told, unanswered


# each takes the thread long: finite elements, damping, the exact law near its pole, slow loads
DEAR = (
    {"model": "finite elements", "internal_damping": 0.1, "highest_frequency": 16.0},
    {"model": "lumped", "law": "exact", "load_type": "follower", "largest_factor": 2.0},
    {"external_damping": 0.05, "lowest_frequency": 0.1, "highest_frequency": 16.0},
)


async def dear_questions(server, page, count):
    """Ask for one dear picture after another, each of values that nobody has asked for."""
    rng, told, unanswered, sent = random.Random(SEED + 2), [], 0, 0
    while sent < count:
        async with opened(server, PATH, page) as wire:
            await wire.pull()
            while sent < count and wire.connection.close_code is None:
                sent += 1
                values = rng.choice(DEAR) | {"spin_speed": rng.uniform(0, 4)}
                answer = None
                with contextlib.suppress(Exception):
                    answer = await wire.ask({"type": "change", "values": values})
                unanswered += answer is None
            told += leaks(wire)
    return told, unanswered


async def idle_connections(server, page, count):
    """Hold so many connections on which nothing is sent; return those that were closed."""
    pairs = []
    for _ in range(count):
        with contextlib.suppress(OSError):
            pairs.append(await asyncio.open_connection("127.0.0.1", server.port))
    await asyncio.sleep(20)
    closed = count - len(pairs) + sum(reader.at_eof() for reader, _ in pairs)
    for _, writer in pairs:
        writer.close()
    return [], closed


async def pages(server, page, count):
    """Ask for pages side by side and connect to none; return those without an answer."""
    lost, client = 0, AsyncHTTPClient()
    for _ in range(0, count, 10):
        wanted = [
            client.fetch(HTTPRequest(f"{server.origin}{PATH}", request_timeout=120))
            for _ in range(10)
        ]
        lost += sum(
            isinstance(one, Exception)
            for one in await asyncio.gather(*wanted, return_exceptions=True)
        )
    return [], lost


async def rotor_files(server, page, count):
    """Send rotor files that are short to write and long to read."""
    texts = (
        "[shaft]\nlength=1" + " " * 7900 + "m",
        ".".join("a" * 3900) + "=1",
        "a=" + "[" * 3900,
        'length="' + '\\"' * 3900,
        "\n".join(f"k{number}={{a=1}}" for number in range(600)),
    )
    told, unanswered = [], 0
    async with opened(server, PATH, page) as wire:
        await wire.pull()
        for number in range(count):
            answer = None
            with contextlib.suppress(Exception):
                answer = await wire.ask({"type": "rotor_file", "text": texts[number % len(texts)]})
            unanswered += answer is None
        told += leaks(wire)
    return told, unanswered


async def random_versions(server, page, count):
    """Ask for heads of a file, each of a version that never was; return those without an answer."""
    rng, lost = random.Random(SEED + 3), 0
    for _ in range(count):
        path = f"/static/js/bokeh.min.js?v={rng.getrandbits(64):x}"
        request = HTTPRequest(f"http://127.0.0.1:{server.port}{path}", method="HEAD")
        try:
            await AsyncHTTPClient().fetch(request)
        except Exception:
            lost += 1
    return [], lost


def attack(stream, port, origin, page, count):
    """Run a stream of a hostile client; in a process of its own its work is not the bystander's."""
    return asyncio.run(stream(Address(port, origin), page, count))


async def abuse(server, wanted_values, wanted_messages):
    """Return the rows of the table."""
    loop = asyncio.get_running_loop()
    user = User(server.origin, PATH)
    await user.open()
    page = await loop.run_in_executor(None, token, server, PATH)
    await beside(user, asyncio.sleep(5))  # warm
    alone, _ = await beside(user, asyncio.sleep(10))
    rows = []
    pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))
    for name, count, stream in (
        ("malformed messages", wanted_messages, malformed),
        ("hostile values", wanted_values, values),
        ("dear questions", wanted_values // 100, dear_questions),
        ("rotor files", wanted_values // 100, rotor_files),
        ("idle connections", 1200, idle_connections),
        ("heads of files of random versions", wanted_messages // 10, random_versions),
        (PAGES, wanted_messages // 500, pages),
    ):
        work = loop.run_in_executor(pool, attack, stream, server.port, server.origin, page, count)
        start = time.perf_counter()
        times, (told, lost) = await beside(user, work)
        seconds = time.perf_counter() - start
        rows.append((name, count, seconds, lost, len(told), p95(times) / p95(alone), told))
    pool.shutdown()
    await user.close()
    await loop.run_in_executor(None, token, server, PATH)  # the spy's last account is in the log
    return p95(alone), rows


def main(wanted_values=5_000, wanted_messages=10_000):
    """Serve, abuse, print the table; return whether every target is met."""
    with tempfile.TemporaryDirectory() as folder:
        app = Path(folder) / "spied.py"
        app.write_text(APP)
        path = os.pathsep.join([str(ROOT / "src"), str(ROOT)])
        server = Server(Path(folder) / "log.txt", app, PYTHONPATH=path)
        try:
            server.wait()
            alone, rows = asyncio.run(abuse(server, wanted_values, wanted_messages))
            alive = server.process.poll() is None and server.get("/health")[0] == 200
            log = server.log.read_text()
        finally:
            server.stop()
    calls, violations = map(int, re.findall(r"spy: (\d+) calls, (\d+) violations", log)[-1])
    print(f"bystander alone: p95 {1e3 * alone:.0f} ms; spy: {calls} calls of the solver")
    print("\n| stream | sent | s | closed or unanswered | leaks | bystander's p95 ratio |")
    print("|---|---|---|---|---|---|")
    for name, count, seconds, lost, told, ratio, words in rows:
        print(f"| {name} | {count} | {seconds:.0f} | {lost} | {told} | {ratio:.2f} |")
        for one in words[:3]:
            print("  leak:", one)
    longest = max(map(len, log.splitlines()))
    print(f"\nlog: {len(log) / 1e6:.2f} MB, longest line {longest}; violations: {violations}")
    met = alive and calls > 100 and violations == 0 and all(row[4] == 0 for row in rows)
    quick = all(row[5] <= MOST for row in rows if row[0] not in UNJUDGED)
    print(f"target (alive, no leak, nothing unclamped): {'met' if met else 'MISSED'}")
    print(f"target (p95 ratio <= {MOST:g}): {'met' if quick else 'MISSED'}")
    return met and quick


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--values", type=int, default=5_000)
    parser.add_argument("--messages", type=int, default=10_000)
    wanted = parser.parse_args()
    sys.exit(0 if main(wanted.values, wanted.messages) else 1)
