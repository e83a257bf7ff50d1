"""The streams of a hostile client, each with a fixed seed.

A stream takes the server's address, the token of a page and how much to send. It returns what the
server told of its inside, and how many messages or connections it closed or left unanswered.
"""

import asyncio
import contextlib
import random
from pathlib import Path
from typing import NamedTuple

from tornado.httpclient import AsyncHTTPClient, HTTPRequest

from tests.testing import hostile
from tests.testing.wire import opened

ROOT = Path(__file__).parents[2]
PATH = "/spied"
SEED = 20260601
EACH = len(hostile.NAMES)  # hostile values a message


class Address(NamedTuple):
    """Where a server is."""

    port: int
    origin: str


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
