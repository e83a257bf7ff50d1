"""A class that moves sliders: the time until the data arrives."""

import asyncio
import time
from dataclasses import dataclass, field

import numpy as np

from app.state import State
from benchmarks.classroom.client import REST, Lost, User
from benchmarks.classroom.table import percentile

SLIDERS = ("spin_speed", "static_load_factor", "shear", "disk_mass", "diametral_inertia")
LESSON = 20  # steps of the lesson's slider that the whole class takes


@dataclass
class Moves:
    """What a class met: seconds of every answer, and what went wrong."""

    moved: list = field(default_factory=list)
    rested: list = field(default_factory=list)  # the answer to "settle"
    settled: list = field(default_factory=list)  # the full picture, where it was not superseded
    errors: list = field(default_factory=list)

    def words(self):
        """Return the row's words."""
        moved = f"p50 {1e3 * percentile(self.moved, 0.5):.0f}, p95 {1e3 * self.p95:.0f} ms"
        return f"{moved} of {len(self.moved)} moves; {len(self.errors)} errors"

    @property
    def p95(self):
        """95th percentile of slider to data [s]."""
        return percentile(self.moved)


def random_value(rng, name):
    """Return a value of a slider on one of its steps."""
    parameter = State.param[name]
    low, high = parameter.bounds
    steps = int((min(high, 5.0) - low) / parameter.step * 0.9)
    return float(f"{low + rng.integers(0, steps + 1) * parameter.step:.12g}")


def random_moves(seed):
    """Yield moves of all sliders at random; hardly two alike."""
    rng = np.random.default_rng(seed)
    while True:
        name = str(rng.choice(SLIDERS))
        yield {name: random_value(rng, name)}


def lesson_moves(_):
    """Yield the moves of a lesson, the same for everybody."""
    while True:
        for step in range(LESSON):
            yield {"spin_speed": float(f"{0.1 * step:.12g}")}


async def take_turns(user, moves, seconds, delay, found):
    """Move once a second for some seconds; ask for the full picture at each rest."""
    loop = asyncio.get_running_loop()
    start = loop.time() + delay
    last, notes = 0, []
    for number in range(seconds):
        await asyncio.sleep(max(0.0, start + number - loop.time()))
        values = next(moves)
        try:
            answer = await user.change(**values)
            found.moved.append(answer.seconds)
            found.errors += wrong(values, answer.content, last)
            last = answer.content["seq"]
            await asyncio.sleep(REST)
            asked, heard = time.perf_counter(), len(user.unasked)
            rest = await user.ask(type="settle")
        except (Lost, TimeoutError) as problem:
            found.errors.append(repr(problem))
            break
        found.rested.append(rest.seconds)
        if rest.content.get("settled"):
            found.settled.append(rest.seconds)
        else:
            notes.append(asyncio.create_task(note_settled(user, asked, heard, found)))
    await asyncio.gather(*notes)


def wrong(values, content, last):
    """Return what is wrong with an answer to values that followed answer number `last`."""
    problems = [
        f"{name} is {content['values'][name]}, not {value}"
        for name, value in values.items()
        if content["values"][name] != value
    ]
    problems += [f"{name} {why}" for name, why in content["errors"].items()]
    problems += [content["notice"]] if content["notice"] else []
    return problems + (["an answer out of order"] if content["seq"] <= last else [])


async def note_settled(user, asked, since, found):
    """Note when the full picture comes, if it comes before the next move."""
    while user.connected and time.perf_counter() < asked + 1.0 - REST:
        if any(one.get("settled") for one in user.unasked[since:]):
            found.settled.append(time.perf_counter() - asked)
            return
        await asyncio.sleep(0.02)


async def open_class(origin, count, kind=User, together=2, **options):
    """Return users who have opened the page, a few at a time."""
    gate = asyncio.Semaphore(together)

    async def enter():
        async with gate:
            user = kind(origin, **options)
            await user.open()
            return user

    return await asyncio.gather(*(enter() for _ in range(count)))


async def close_class(users):
    """Have everybody leave."""
    await asyncio.gather(*(user.close() for user in users))


async def move_class(users, seconds, moves=random_moves):
    """Have every user move once a second, staggered; return what they met."""
    found = Moves()
    await asyncio.gather(
        *(
            take_turns(user, moves(number), seconds, number / len(users), found)
            for number, user in enumerate(users)
        )
    )
    return found
