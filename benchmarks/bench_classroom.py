"""Measure a whole class on the real deployment, nginx and two workers; `--quick` is a short form.

Each row of the table gives the target, the measured value and whether the target is met. The
simulated class, nginx and the workers share one machine, so other programs on it affect every
value.
"""

import asyncio
import os
import tempfile
import time
from dataclasses import dataclass

from benchmarks.classroom import faults, floor, opening
from benchmarks.classroom.deployment import Deployment, Others
from benchmarks.classroom.in_browser import kill_under_a_page
from benchmarks.classroom.moving import close_class, lesson_moves, move_class, open_class
from benchmarks.classroom.table import Row, percentile, print_head


@dataclass(frozen=True)
class Size:
    """How much of everything."""

    users: int = 30
    seconds: int = 20
    idle: int = 200
    hold: int = 60
    opens: int = 30
    minute: int = 60
    kills: int = 20
    cycles: int = 2000
    early: int = 400  # of the cycles
    judged: bool = True  # whether there are enough cycles for a verdict on memory
    stalled: int = 5


LONG = Size()
QUICK = Size(6, 5, 12, 5, 6, 12, 2, 40, 20, False, 2)
NEAR = 0.3  # s
BACK = 15.0  # s


async def openings(deployment, size):
    """30 opens in a minute, and what a session costs."""
    before, start = sum(deployment.memory().values()), cpu(deployment)
    others = Others(deployment)
    users, refused = await opening.arrive(deployment.origin, size.opens, size.minute)
    p95 = percentile([user.seconds["data"] for user in users])
    page = percentile([user.seconds["page"] for user in users], 0.5)
    yield Row(
        f"{size.opens} opens in {size.minute} s from one address",
        "p95 ≤ 3 s, none refused",
        f"page, socket and first data: p95 {p95:.1f} s (page alone, p50 {page:.1f} s);"
        f" {len(refused)} refused; {words(others)}",
        p95 <= 3 and not refused,
    )
    each = (sum(deployment.memory().values()) - before) / max(1, len(users))
    spent = 1e3 * (cpu(deployment) - start) / size.opens
    yield Row(
        "cost of a session",
        "printed",
        f"{each:.1f} MB, {spent:.0f} ms of a worker to open",
    )
    await close_class(users)
    await opening.empty(deployment)


def words(others):
    """Say how busy the machine was with other things."""
    return f"other programs took {100 * others.share():.0f} % of the cores"


def cpu(deployment):
    """Return the processor time of all workers [s]."""
    return deployment.total("process_cpu_seconds_total")


async def slides(deployment, size, folder):
    """A class that moves sliders, each on its own and all on one lesson; and the floor."""
    users = await open_class(deployment.origin, size.users)
    await move_class(users, 3)
    start, others = cpu(deployment), Others(deployment)
    own = await move_class(users, size.seconds)
    spent = 1e3 * (cpu(deployment) - start) / max(1, len(own.moved))
    hits, misses = (
        deployment.total(f"rotorstab_cache_{kind}_total analysis.solve")
        for kind in ("hits", "misses")
    )
    busy = words(others)
    same = await move_class(users, size.seconds, lesson_moves)
    hits = deployment.total("rotorstab_cache_hits_total analysis.solve") - hits
    misses = deployment.total("rotorstab_cache_misses_total analysis.solve") - misses
    await close_class(users)
    with floor.serve(folder) as origins:
        bare = await floor.move_floor(origins, size.users, size.seconds)
    limit = max(NEAR, 2 * bare.p95)
    yield Row(
        f"{size.users} users, one slider move a second each, all different",
        "p95 ≤ 300 ms or ≤ 2 × a bare Bokeh page; 0 errors",
        f"{own.words()}; bare page p50 {1e3 * percentile(bare.moved, 0.5):.0f},"
        f" p95 {1e3 * bare.p95:.0f} ms; {spent:.0f} ms of a worker a move and rest; {busy}",
        own.p95 <= limit and not own.errors,
    )
    yield Row(
        "the same, all on the same lesson",
        "p95 ≤ 300 ms or ≤ 2 × a bare Bokeh page; 0 errors",
        f"{same.words()}; cache hits {100 * hits / max(1, hits + misses):.0f} %",
        same.p95 <= limit and not same.errors,
    )
    for name, found in (("all different", own), ("same lesson", same)):
        part = 100 * len(found.settled) / max(1, len(found.rested))
        full = f", p50 {1e3 * percentile(found.settled, 0.5):.0f} ms" if found.settled else ""
        yield Row(
            f"the full map at rest, {name}",
            "printed",
            f"{part:.0f} % came before the next move{full}; the rest was superseded",
        )
    problems = [*own.errors, *same.errors]
    if problems:
        print(f"<!-- first errors: {problems[:3]} -->")


async def full_house(folder, size):
    """Idle pages are held, the next is refused with words."""
    places = -(-size.idle // 2)
    deployment = Deployment(folder, ROTORSTAB_MAX_SESSIONS=str(places))
    try:
        deployment.wait()
        users, refusal = await opening.fill(deployment.origin, size.idle + 1)
        opened = len(users)
        await asyncio.sleep(size.hold)
        held = sum(user.connected for user in users)
        if refusal is None:
            _, refusal = await opening.fill(deployment.origin, 1)
        polite = refusal is not None and opening.is_polite(refusal)
        answered = await asyncio.gather(
            *(user.change(shear=0.02) for user in users[:20] if user.connected)
        )
        memory = deployment.memory()
        yield Row(
            f"{size.idle} connected, idle for {size.hold} s",
            "held; the next one gets 503 with Retry-After",
            f"{opened} opened, {held} held, {len(answered)} of 20 asked answered;"
            f" the next: {refusal.code if refusal else 'not refused'},"
            f" Retry-After {refusal.headers.get('Retry-After') if refusal else '–'}"
            f" ({max(memory.values()):.0f} MB the larger worker)",
            held == opened >= size.idle and polite,
        )
        await close_class(users)
    finally:
        deployment.stop()


async def stalls(deployment, size):
    """Clients that read nothing or never finish; a bystander goes on."""
    users = await open_class(deployment.origin, 4 + size.stalled)
    crowd, slow = users[:4], users[4:]
    before = await move_class(crowd, size.seconds // 2)
    memory = sum(deployment.memory().values())
    silent = await faults.half_a_request(deployment.origin, 50)
    jobs = [asyncio.create_task(faults.stall(user, 20 * size.seconds)) for user in slow]
    during = await move_class(crowd, size.seconds)
    await asyncio.gather(*jobs, return_exceptions=True)
    grown = sum(deployment.memory().values()) - memory
    for writer in silent:
        writer.close()
    await close_class(users)
    # a client that reads nothing is let go after a ping or two; until then its socket is counted
    await opening.empty(deployment)
    yield Row(
        f"{size.stalled} clients that send 20 moves/s and read nothing, 50 half requests",
        "the server keeps running; no errors of other users",
        f"other users: p95 {1e3 * before.p95:.0f} ms before, {1e3 * during.p95:.0f} ms during,"
        f" {len(during.errors)} errors; workers grew {grown:.0f} MB",
        not during.errors and len(deployment.workers()) == 2,
    )


async def kills(deployment, size):
    """Workers killed outright under a class."""
    class_ = faults.Kills(deployment, await open_class(deployment.origin, 6))
    for number in range(size.kills):
        await class_.kill(number)
    await close_class(class_.users)
    worst = max(class_.back, default=float("nan"))
    yield Row(
        f"worker killed (−9) {size.kills} times",
        "no errors of other users; affected users back with their state within 15 s",
        f"{len(class_.back)} affected users back: p50 {percentile(class_.back, 0.5):.1f} s,"
        f" worst {worst:.1f} s, {class_.lost_state} without their state;"
        f" other users: {len(class_.disturbed)} errors",
        worst <= BACK and not class_.lost_state and not class_.disturbed,
    )
    if class_.disturbed:
        print(f"<!-- first errors: {class_.disturbed[:3]} -->")
    seconds = await kill_under_a_page(deployment)
    yield Row(
        "the same in Chromium",
        "back with its state within 15 s",
        "no browser" if seconds is None else f"{seconds:.1f} s",
        seconds is not None and seconds <= BACK,
    )
    await asyncio.to_thread(deployment.wait)


async def cycles(folder, size):
    """Months of visitors: pages opened, used and closed, on workers that have just started.

    Modules, fonts and bounded caches fill within the first cycles; what grows afterwards is lost.
    """
    deployment = Deployment(folder, ROTORSTAB_UNUSED_LIFETIME="5")
    try:
        deployment.wait()
        start = sum(deployment.memory().values())
        early = await opening.come_and_go(deployment, 0, size.early, 4)
        late = await opening.come_and_go(deployment, size.early, size.cycles, 8)
        left = await opening.empty(deployment)
        yield Row(
            f"the first {size.early} open–use–close cycles of workers that have just started",
            "printed",
            f"{opening.slope(*early):.3f} MB a cycle, from {start:.0f} to {early[1, -1]:.0f} MB"
            " in two workers",
        )
        grown = opening.slope(*late)
        yield Row(
            f"cycles {size.early} to {size.cycles}",
            "≤ 0.05 MB a cycle, no session left",
            f"{grown:.3f} MB a cycle, to {late[1, -1]:.0f} MB; {left} sessions left",
            (grown <= opening.SLOPE or not size.judged) and not left,
        )
    finally:
        deployment.stop()


async def rows(size, folder):
    """Yield the rows, each once it is measured."""
    deployment = Deployment(folder)
    try:
        deployment.wait()
        for part in (
            openings(deployment, size),
            slides(deployment, size, folder),
            stalls(deployment, size),
            kills(deployment, size),
        ):
            async for row in part:
                yield row
    finally:
        deployment.stop()
    for part in (cycles(folder, size), full_house(folder, size)):
        async for row in part:
            yield row


def main(quick=False):
    """Print the table; return whether every row is met."""
    size = QUICK if quick else LONG

    async def measure():
        found = []
        print_head()
        with tempfile.TemporaryDirectory() as folder:
            async for row in rows(size, folder):
                print(row, flush=True)
                found.append(row)
        return found

    start = time.perf_counter()
    found = asyncio.run(measure())
    minutes = (time.perf_counter() - start) / 60
    load = ", ".join(f"{one:.1f}" for one in os.getloadavg())
    print(f"\n{minutes:.0f} minutes; load of the machine at the end: {load}")
    return all(row.met is not False for row in found)
