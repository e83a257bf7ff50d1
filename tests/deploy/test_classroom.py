"""A small class on the real deployment; `python -m benchmarks classroom` is the long form."""

import asyncio

import pytest

from benchmarks.classroom import faults, opening
from benchmarks.classroom.deployment import Deployment
from benchmarks.classroom.moving import close_class, move_class, open_class, wrong
from tests.testing.serving import run

pytestmark = pytest.mark.long

PLACES = 3  # of each of two workers
SECONDS = 3


@pytest.fixture(scope="module")
def deployment(tmp_path_factory):
    """nginx and two workers, whose sessions end soon after their pages."""
    started = Deployment(
        tmp_path_factory.mktemp("lab"),
        ROTORSTAB_MAX_SESSIONS=str(PLACES),
        ROTORSTAB_UNUSED_LIFETIME="5",
    )
    try:
        yield started.wait()
    finally:
        started.stop()


def test_a_class_moves_rests_and_survives_a_killed_worker(deployment):
    async def lesson():
        users = await open_class(deployment.origin, PLACES)
        moved = await move_class(users, SECONDS)
        await asyncio.gather(*(user.settle() for user in users))
        settled = [user.last["settled"] for user in users]
        kills = faults.Kills(deployment, users)
        await kills.kill(0)
        await close_class(kills.users)
        return moved, settled, kills

    moved, settled, kills = run(lesson())
    assert moved.errors == []
    assert len(moved.moved) == PLACES * SECONDS
    assert settled == [True] * PLACES
    assert kills.disturbed == []
    assert kills.lost_state == 0


def test_the_full_picture_of_a_superseded_state_never_comes(deployment):
    async def hurry():
        (user,) = await open_class(deployment.origin, 1)
        for speed in (0.31, 0.32, 0.33):
            await user.change(spin_speed=speed)
            await user.ask(type="settle")  # and on it goes, without waiting for the picture
        await user.settle()
        pictures = [one for one in user.unasked if one.get("settled")]
        await user.close()
        return user.last, [one["values"]["spin_speed"] for one in pictures]

    last, pictures = run(hurry())
    assert last["settled"]
    assert last["values"]["spin_speed"] == 0.33
    # whatever came in between was of the state of its time, in order
    assert pictures == sorted(pictures)


def test_a_full_house_is_refused_politely_and_leaves_no_session(deployment):
    async def evening():
        users, refusal = await opening.fill(deployment.origin, 2 * PLACES + 1, together=2)
        held = [user.connected for user in users]
        answer = await users[0].change(shear=0.02)
        await close_class(users)
        return refusal, held, answer, await opening.empty(deployment)

    refusal, held, answer, left = run(evening())
    assert refusal is not None
    assert opening.is_polite(refusal)
    assert held
    assert all(held)
    assert wrong({"shear": 0.02}, answer.content, 0) == []
    assert left == 0
