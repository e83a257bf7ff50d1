"""Faults: killed workers, clients that stall or send nothing, and their effect on other users."""

import asyncio
import os
import random
import signal
import time
from contextlib import suppress

from benchmarks.classroom.client import Lost, Refused, User
from benchmarks.classroom.moving import Moves, random_moves, take_turns

NOTICED = 2.0  # s after which every socket of a killed worker is gone


def is_back(user, values):
    """Whether a page shows the values that were set before."""
    return all(user.last["values"][name] == value for name, value in values.items())


async def come_back(user, values, patience=60):
    """Do what page.js does: ask with a growing, jittered wait, then open the same address.

    Return the new user and whether the state is back.
    """
    wait, query, start = 0.8, user.last["query"], time.perf_counter()
    while time.perf_counter() < start + patience:
        await asyncio.sleep(wait * (0.7 + 0.6 * random.random()))
        wait = min(15.0, 1.6 * wait)
        again = User(user.origin, query=query)
        again.cookies = user.cookies
        with suppress(Refused, Lost, OSError, TimeoutError):
            await again.open()
            return again, is_back(again, values)
        await again.close()
    return user, False


class Kills:
    """Workers killed one after another while a class works."""

    def __init__(self, deployment, users):
        self.deployment, self.users = deployment, users
        self.back, self.lost_state, self.disturbed = [], 0, []
        self._undisturbed = 0

    async def kill(self, number):
        """Kill a worker, have its users come back while the others go on; note what they met."""
        states = []
        for place, user in enumerate(self.users):
            states.append({"spin_speed": ((number + place) % 30 + 1) / 10, "shear": 0.03})
            await user.change(**states[-1])
        ports = sorted(self.deployment.workers())
        victim = ports[number % len(ports)]
        process = self.deployment.workers()[victim]
        held = int(self.deployment.metrics()[victim]["rotorstab_sockets"])
        start = time.perf_counter()
        os.kill(process, signal.SIGKILL)
        found, self._undisturbed = Moves(), 0
        tasks = [
            asyncio.create_task(self._live(user, state, start, found))
            for user, state in zip(self.users, states, strict=True)
        ]
        self.users = await asyncio.gather(*tasks)
        self.disturbed += found.errors
        lost = len(self.users) - self._undisturbed
        if lost != held:
            self.disturbed.append(f"{lost} pages were lost, the worker held {held}")
        await asyncio.to_thread(self.deployment.wait)

    async def _live(self, user, state, start, found):
        """Return the user, or who came back for it."""
        await asyncio.wait([user._reader], timeout=NOTICED)
        if user.connected:
            self._undisturbed += 1
            await take_turns(user, random_moves(0), 3, 0.0, found)
            return user
        await user.close()
        again, same = await come_back(user, state)
        self.back.append(time.perf_counter() - start)
        self.lost_state += not same
        return again


async def stall(user, messages):
    """Stop reading, then go on moving: the answers pile up at the server."""
    user._reader.cancel()
    for number in range(messages):
        with suppress(asyncio.TimeoutError):
            await asyncio.wait_for(
                user.send(type="change", values={"spin_speed": number % 300 / 100}), 5
            )
        await asyncio.sleep(0.05)


async def half_a_request(origin, count):
    """Open connections that never end their request; return them."""
    host, _, port = origin.removeprefix("http://").partition(":")
    pairs = [await asyncio.open_connection(host, int(port)) for _ in range(count)]
    for _, writer in pairs:
        writer.write(b"GET /app HTTP/1.1\r\nHost: ")
    return [writer for _, writer in pairs]
