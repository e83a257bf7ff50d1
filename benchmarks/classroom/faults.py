"""Faults: workers killed outright, clients that stall or say nothing."""

import asyncio
import os
import random
import signal
import time
from contextlib import suppress

from .client import Lost, Refused, User

WORDS = b"GET /app HTTP/1.1\r\nHost: "


async def stay(user, values, back, patience=60):
    """Wait until the connection is lost, then do what page.js does until the state is back.

    Note the seconds in `back`, NaN where the state was another one.
    """
    await asyncio.wait([user._reader])
    start = time.perf_counter()
    wait, query = 0.8, user.last["query"]
    while time.perf_counter() < start + patience:
        await asyncio.sleep(wait * (0.7 + 0.6 * random.random()))
        wait = min(15.0, 1.6 * wait)
        again = User(user.origin, query=query)
        again.cookies = user.cookies
        with suppress(Refused, Lost, OSError, TimeoutError):
            await again.open()
            same = all(again.last["values"][name] == value for name, value in values.items())
            back.append(time.perf_counter() - start if same else float("nan"))
            return again
        await again.close()
    back.append(float("inf"))
    return None


async def kill_one(deployment, users, number):
    """Kill a worker outright; return seconds of the victims and the bystanders that were lost."""
    ports = sorted(deployment.workers())
    port = ports[number % len(ports)]
    victims, others = [], []
    for user in users:
        (victims if user.worker == port else others).append(user)
    os.kill(deployment.workers()[port], signal.SIGKILL)
    return port, victims, others


class Silent:
    """A client that opens the page, asks for much and reads nothing."""

    def __init__(self, user):
        self._user = user

    async def stall(self, messages):
        """Stop reading, then send moves as fast as the network takes them."""
        user = self._user
        user._reader.cancel()
        for number in range(messages):
            await asyncio.wait_for(user.send(type="change", values={"spin_speed": number / 100}), 5)
            await asyncio.sleep(0.02)


async def half_a_request(origin, count):
    """Open connections that never finish their request; return how to close them."""
    host, _, port = origin.removeprefix("http://").partition(":")
    pairs = [await asyncio.open_connection(host, int(port)) for _ in range(count)]
    for _, writer in pairs:
        writer.write(WORDS)
    return [writer for _, writer in pairs]
