"""Search for the request or message that takes most time of the thread that serves the pages.

An evolutionary search over every input, three pins and a marker looks for the address whose
opening or whose messages take the most time. Each candidate runs in its own forked process, so
that no cache shortens it and a failure affects nothing else. As on the server, another process
computes the full growth map, and the thread computes the coarse one.
"""

import argparse
import json
import os
import random
import resource
import sys
import time
from concurrent.futures import Future
from pathlib import Path
from unittest import mock
from urllib.parse import unquote_plus

from app.background import printing, settling, threads
from app.exports import files
from app.results.growth_maps import known_detail
from app.results.limits import Detail
from app.session import Session
from app.state import State
from app.state.address import PINNED, PinnedInputs, to_query

SEED = 20261127
LONG, QUICK = 600.0, 150.0  # s
MOST_SECONDS, MOST_MEGABYTES = 0.5, 100.0  # of one request or message
LIMIT = 20  # s of processor time after which a candidate is ended
ELITE = 10
CLOSE = 0.8  # share of the bound above which a candidate is measured three times
TURN = "a turn after it"  # one pin of the address
MESSAGES = {
    "first message": {"type": "settle"},
    "a move": {"type": "change", "values": {"spin_speed": 1.99}},
    "at rest": {"type": "settle"},
    "Stiffness": {"type": "page", "name": "stiffness"},
    "Lessons": {"type": "page", "name": "lessons"},
    "Explore": {"type": "page", "name": "explore"},
    "a pin": {"type": "pin", "label": "one more"},
    "as Python": {"type": "python"},
    "rotor file": {"type": "save_rotor_file"},
    "export": {"type": "export", "chart": "instability", "format": "csv"},
    "picture": {"type": "export", "chart": "campbell", "format": "pdf"},
    "report": {"type": "report"},
}
NUMBERS = [name for name in State().inputs() if getattr(State.param[name], "bounds", None)]
CHOICES = {
    name: getattr(State.param[name], "objects", None) or [False, True]
    for name in State().inputs()
    if name not in NUMBERS
}


class Candidate:
    """A state with up to three pins."""

    def __init__(self, inputs, pins=()):
        self.inputs, self.pins = inputs, list(pins)

    def arguments(self):
        """Return the arguments of the address."""
        pins = [PinnedInputs(f"p{number}", number, one) for number, one in enumerate(self.pins, 1)]
        pairs = (pair.split("=", 1) for pair in to_query(self.inputs, pins).split("&"))
        return {key: [unquote_plus(value)] for key, value in pairs}


def _number(rng, name, old=None):
    low, high = State.param[name].bounds
    kind = rng.random()
    if kind < 0.3:
        return float(rng.choice((low, high)))
    if kind < 0.65 and old is not None:
        return min(high, max(low, old + rng.gauss(0, 0.1) * (high - low)))
    if kind < 0.8 and low > 0:
        return low * (high / low) ** rng.random()
    return rng.uniform(low, high)


def _mutated(rng, inputs, count):
    """Return inputs of which some are others; a legal state."""
    state = State()
    state.change(inputs)
    names = rng.sample([*NUMBERS, *CHOICES], count)
    values = {
        name: _number(rng, name, inputs[name]) if name in NUMBERS else rng.choice(CHOICES[name])
        for name in names
    }
    state.change(values)
    if rng.random() < 0.3:
        state.change({"law": "exact", "model": "lumped", "reference": "flutter"})
    return state.inputs()


def child(rng, elite):
    """Return a new candidate: a mutation of a good one, or a random one."""
    if not elite or rng.random() < 0.25:
        inputs = _mutated(rng, State().inputs(), rng.randrange(5, len(NUMBERS)))
        parent = Candidate(inputs)
    else:
        parent = rng.choice(elite)[1]
    inputs = _mutated(rng, parent.inputs, rng.randrange(1, 5))
    pins = list(parent.pins)
    kind = rng.random()
    if kind < 0.3:
        pins = [_mutated(rng, inputs, rng.randrange(1, 3)) for _ in range(3)]
    elif kind < 0.4:
        pins = []
    if rng.random() < 0.7:
        inputs = inputs | {"marker": True}
    return Candidate(inputs, [{name: one[name] for name in PINNED} for one in pins])


def _memory(field):
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(field):
            return int(line.split()[1]) / 1024
    return 0.0


def _spent(work):
    """Return what some work gives, the thread's time [s] and the memory it takes more [MB]."""
    Path("/proc/self/clear_refs").write_text("5")
    before, start = _memory("VmRSS"), time.thread_time()
    result = work()
    return result, time.thread_time() - start, _memory("VmHWM") - before


def _detail(self, window):
    """Return what is there, as on a server that has begun to make the rest."""
    return Detail.FULL if window is None else known_detail(window)


def _start(self, reply):
    """Leave to other processes what a server leaves to them; do the rest."""
    if reply.follow_up is not None and reply.follow_up[0] is None:
        return {**reply.content, **_start(self, reply.follow_up[1]())}
    return reply.content


def _costs(candidate, messages):
    """Give (name, seconds, megabytes) of opening a page and of each message, one by one."""
    later: list[object] = []  # what the server does in turns of its own, between messages
    with (
        mock.patch.object(settling.Settling, "detail", _detail),
        mock.patch.object(threads.Scheduler, "call", lambda _, work: later.append(work)),
        mock.patch.object(files.Files, "start", _start),
        mock.patch.object(printing.Worker, "call", return_value=Future()),
    ):
        session, *spent = _spent(lambda: Session(candidate.arguments()))
        yield "opening", *spent
        for name in messages:
            message = MESSAGES[name]
            _, *spent = _spent(lambda message=message: session.respond(message))
            yield name, *spent
            while later:
                _, *spent = _spent(later.pop(0))
                yield TURN, *spent


def measure(candidate, messages=tuple(MESSAGES)):
    """Return a candidate's costs, from a process of its own.

    A message that takes `LIMIT` or fails is the last one, with that time.
    """
    read, write = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(read)
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 1))
        with os.fdopen(write, "w") as out:
            for cost in _costs(candidate, messages):
                print(json.dumps(cost), file=out, flush=True)
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as lines:
        costs = [json.loads(line) for line in lines]
    os.waitpid(process, 0)
    answered = [name for name, *_ in costs if name != TURN]
    for name in ["opening", *messages][len(answered) :][:1]:  # it was ended, or failed
        costs.append((name, float(LIMIT), 0.0))
    return costs


def share_of_bound(cost):
    """Return how much of its bound a cost takes."""
    return max(cost[1] / MOST_SECONDS, cost[2] / MOST_MEGABYTES)


def warm():
    """Import and draw all once: a server has done that before its first page."""
    for _ in _costs(Candidate(State().inputs() | {"marker": True}), MESSAGES):
        pass


def search(seconds, messages=tuple(MESSAGES), seed=SEED, say=print):
    """Return {name of a message: (cost, candidate)} of the worst found in a time."""
    rng = random.Random(seed)
    warm()
    usual = [measure(Candidate(State().inputs()), ())[0][1] for _ in range(3)]
    say(f"opening the default page: {min(usual):.2f} to {max(usual):.2f} s of the thread")
    worst, elite, count = {}, [], 0
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        candidate = child(rng, elite)
        costs = measure(candidate, messages)
        count += 1
        if max(map(share_of_bound, costs)) > CLOSE:  # perhaps another process took the core
            again = [measure(candidate, messages) for _ in range(2)]
            costs = [min(one, key=lambda cost: cost[1]) for one in zip(costs, *again, strict=False)]
        for cost in costs:
            if share_of_bound(cost) > share_of_bound(worst.get(cost[0], (("", 0.0, 0.0),))[0]):
                worst[cost[0]] = cost, candidate
        top = max(costs, key=share_of_bound)
        elite = sorted([*elite, (share_of_bound(top), candidate)], key=lambda one: -one[0])[:ELITE]
    say(f"{count} states in {seconds:.0f} s")
    return worst


def main(quick=False, seconds=None):
    """Search, print the worst of every message; return whether all are within bounds."""
    worst = search(seconds or (QUICK if quick else LONG))
    print("\n| request or message | s | MB more |\n|---|---|---|")
    for name, (cost, _) in worst.items():
        print(f"| {name} | {cost[1]:.2f} | {cost[2]:.0f} |")
    met = True
    for name, (cost, candidate) in worst.items():
        if share_of_bound(cost) > 1:
            met = False
            pins = [PinnedInputs(f"p{n}", n, one) for n, one in enumerate(candidate.pins, 1)]
            print(f"\n{name}: /app?{to_query(candidate.inputs, pins)}")
    words = f"{MOST_SECONDS:g} s and {MOST_MEGABYTES:.0f} MB"
    print(f"\ntarget (no request or message above {words}): {'met' if met else 'MISSED'}")
    return met


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=LONG)
    sys.exit(0 if main(seconds=parser.parse_args().seconds) else 1)
