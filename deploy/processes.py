"""Processes that are started again when they end: nginx and the workers of a class."""

import asyncio
import ctypes
import logging
import os
import signal
from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import suppress

from .settings import BAD_SETTING

LOG = logging.getLogger("rotorstab.lab")
SHORTEST_WAIT, LONGEST_WAIT = 0.5, 10.0  # s before a process is started again
STEADY = 30.0  # s that a process must run before the next wait is the shortest one again
PR_SET_PDEATHSIG = 1  # <linux/prctl.h>

Relay = Callable[[], Awaitable[tuple[int, asyncio.Task[None]]]]
"""Opens a pipe for the standard error of a process; returns its end to write to, and the task that
reads the other end."""


def end_with_parent() -> None:
    """Have the kernel end this process when its parent is gone, however it ended (Linux)."""
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


def end_group(leader: int) -> None:
    """End the processes that the leader of a process group has left behind."""
    with suppress(ProcessLookupError):
        os.killpg(leader, signal.SIGKILL)


async def wait_for(event: asyncio.Event, seconds: float) -> bool:
    """Wait for an event, at most some seconds; return whether it came."""
    with suppress(asyncio.TimeoutError):
        await asyncio.wait_for(event.wait(), seconds)
    return event.is_set()


async def run_once(
    name: str,
    command: Sequence[str],
    ending: asyncio.Event,
    patience: float,
    environment: Mapping[str, str] | None = None,
    relay: Relay | None = None,
) -> int:
    """Run a command until it ends or the event comes, and then end it; return its exit code."""
    pipe, relaying = await relay() if relay else (None, None)
    process = await asyncio.create_subprocess_exec(
        *command,
        env=environment,
        preexec_fn=end_with_parent,
        start_new_session=True,
        stderr=pipe,
    )
    LOG.info("started %s: process %d", name, process.pid)
    if pipe is not None:
        os.close(pipe)
    ended = asyncio.create_task(process.wait())
    stop_requested = asyncio.create_task(ending.wait())
    await asyncio.wait({ended, stop_requested}, return_when=asyncio.FIRST_COMPLETED)
    stop_requested.cancel()
    if not ended.done():
        process.terminate()
        await asyncio.wait({ended}, timeout=patience)
        if not ended.done():
            LOG.error("%s does not end: killed", name)
            process.kill()
    code = await ended
    # the workers of nginx outlive a master that was killed, and hold its port
    end_group(process.pid)
    if relaying:
        await relaying
    return code


async def keep_running(
    name: str,
    command: Sequence[str],
    ending: asyncio.Event,
    patience: float,
    environment: Mapping[str, str] | None = None,
    relay: Relay | None = None,
) -> int:
    """Run a command, and run it again whenever it ends, until the event comes.

    Parameters
    ----------
    name : str
        Of the process, for the log.
    command : sequence of str
        Program and arguments.
    ending : asyncio.Event
        Set when the process is to end.
    patience : float
        Time that the process has to end after SIGTERM, before it is killed [s].
    environment : mapping, optional
        Environment variables; this process's own by default.
    relay : Relay, optional
        Takes the standard error of the process.

    Returns
    -------
    int
        Exit code of the last run; `BAD_SETTING` at once where the first run ends with it, which
        starting again cannot help.
    """
    loop, wait, is_first = asyncio.get_running_loop(), SHORTEST_WAIT, True
    while not ending.is_set():
        began = loop.time()
        code = await run_once(name, command, ending, patience, environment, relay)
        if ending.is_set():
            return code
        # Only the first run: a later one may find its port not free yet, which passes.
        if is_first and code == BAD_SETTING:
            return BAD_SETTING
        is_first = False
        wait = SHORTEST_WAIT if loop.time() - began > STEADY else min(2 * wait, LONGEST_WAIT)
        LOG.error("%s ended with %s; again in %g s", name, code, wait)
        await wait_for(ending, wait)
    return 0
