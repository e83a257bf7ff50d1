"""Pages that are opened, held and closed: a class that arrives, a full server, many visits."""

import asyncio
import time

import numpy as np

from benchmarks.classroom.client import Refused, User

SLOPE = 0.05  # MB a cycle
VALUES = 20


async def arrive(origin, count, seconds, seed=1):
    """Open pages at random moments of some seconds; return users and the refusals."""
    moments = np.sort(np.random.default_rng(seed).uniform(0, seconds, count))
    refused = []

    async def enter(moment):
        await asyncio.sleep(moment)
        user = User(origin)
        try:
            await user.open()
        except Exception as problem:
            refused.append(repr(problem))
        return user

    users = await asyncio.gather(*map(enter, moments))
    return [user for user in users if user.connected], refused


async def fill(origin, most, together=4):
    """Open pages until one is refused; return the users and the refusal, None where none was."""
    users, refusals = [], []

    async def enter():
        while not refusals and len(users) < most:
            user = User(origin)
            users.append(user)
            try:
                await user.open()
            except Refused as refusal:
                users.remove(user)
                refusals.append(refusal)

    await asyncio.gather(*(enter() for _ in range(together)))
    return users, refusals[0] if refusals else None


def is_polite(refusal):
    """Whether a refusal says when to come again and what happens, in a page of its own."""
    wait = refusal.headers.get("Retry-After", "")
    return refusal.code == 503 and wait.isdigit() and "<html" in refusal.body.lower()


async def cycle(origin, number):
    """Open a page, move a slider, leave; few values, so that the bounded caches fill early."""
    user = User(origin)
    await user.open()
    await user.change(spin_speed=float(f"{number % VALUES / 10:.12g}"))
    await user.close()


async def come_and_go(deployment, first, last, blocks, together=2):
    """Open, use and close; return (cycles, memory of all workers [MB]) as arrays.

    Memory is read after each block, once the workers hold no page any more.
    """
    ends = np.linspace(first, last, blocks + 1).round().astype(int)
    points, done = [], first

    async def worker(end):
        nonlocal done
        while done < end:
            done += 1
            await cycle(deployment.origin, done)

    for end in ends:
        await asyncio.gather(*(worker(end) for _ in range(together)))
        await empty(deployment)
        points.append((end, sum(deployment.memory().values())))
    return np.array(points, float).T


def slope(cycles, memory):
    """Return the growth of memory [MB a cycle], by a straight line."""
    return float(np.polyfit(cycles, memory, 1)[0])


async def empty(deployment, patience=180):
    """Wait until the workers hold no session; return how many they still hold at the end."""
    deadline = time.monotonic() + patience
    while (left := deployment.total("rotorstab_sessions")) and time.monotonic() < deadline:
        await asyncio.sleep(1)
    return int(left)
