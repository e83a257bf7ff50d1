"""nginx and identical workers for a class: `python -m deploy.lab [app]`, in the foreground.

Starts ROTORSTAB_WORKERS workers on loopback and nginx in front of them, starts again what ends,
and ends all on SIGTERM, the workers first: a running export still leaves through nginx. With
ROTORSTAB_UPSTREAM the workers run elsewhere (containers): their addresses are asked for again and
again, and nginx is told when they change.

Not supervisord: it cannot log to journald's socket, and its children outlive it when it is killed.
"""

import asyncio
import ctypes
import logging
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from . import nginx, nginx_log
from .patches import logs
from .secret import find_secret
from .settings import SettingError, Settings, check_port, read, stop

LOG = logging.getLogger("rotorstab.lab")
SOONEST, LATEST = 0.5, 10.0  # s before a process is started again
STEADY = 30.0  # s after which a process counts as well
PATIENCE = 4.0  # s that a process has beyond what it needs to end
ASK_AGAIN = 2.0  # s between looks at where the workers are
BAD_SETTING = 2  # exit code of a worker that starting again cannot help
PREFIX = "rotorstab-lab-"  # of the folder, before the process id
PR_SET_PDEATHSIG = 1


def end_with_parent() -> None:
    """Have the kernel end this process when its parent is gone, however it went (Linux)."""
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


def end_group(process: int) -> None:
    """End what a process has left behind: it was the leader of its group."""
    with suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)


def remove_stale_folders() -> None:
    """Remove the folders of launchers that were killed."""
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        process = folder.name.removeprefix(PREFIX).partition("-")[0]
        if process.isdigit() and not Path(f"/proc/{process}").exists():
            shutil.rmtree(folder, ignore_errors=True)  # another user's stays


async def within(event: asyncio.Event, seconds: float) -> bool:
    """Wait for an event, at most some seconds; return whether it came."""
    with suppress(asyncio.TimeoutError):
        await asyncio.wait_for(event.wait(), seconds)
    return event.is_set()


async def keep(name, command, ending, patience, environment=None, relay=None) -> int:
    """Run a command again and again until the event; return the exit code that ended it.

    `relay` opens a pipe for the process's standard error, and the task that reads it.
    """
    loop, wait, first = asyncio.get_running_loop(), SOONEST, True
    while not ending.is_set():
        began = loop.time()
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
        told = asyncio.create_task(ending.wait())
        await asyncio.wait({ended, told}, return_when=asyncio.FIRST_COMPLETED)
        told.cancel()
        if not ended.done():
            process.terminate()
            await asyncio.wait({ended}, timeout=patience)
            if not ended.done():
                LOG.error("%s does not end: killed", name)
                process.kill()
            await ended
        # nginx's workers outlive a master that was killed, and hold its port
        end_group(process.pid)
        if relaying:
            await relaying
        if ending.is_set():
            return process.returncode
        # later it is a port that was not free yet, and no reason to send a class home
        if first and process.returncode == BAD_SETTING:
            return BAD_SETTING
        first = False
        wait = SOONEST if loop.time() - began > STEADY else min(2 * wait, LATEST)
        LOG.error("%s ended with %s; again in %g s", name, process.returncode, wait)
        await within(ending, wait)
    return 0


def whereabouts(upstream) -> list[str]:
    """Return every address of the workers' names, in a steady order; none where none is known."""
    found = set()
    for one in upstream:
        host, _, port = one.rpartition(":")
        with suppress(OSError):
            for *_, where in socket.getaddrinfo(
                host, int(port), socket.AF_INET, socket.SOCK_STREAM
            ):
                found.add(f"{where[0]}:{where[1]}")
    return sorted(found)


async def follow(settings: Settings, binary: str, folder: Path, known, ending) -> None:
    """Tell nginx where the workers are whenever that changes."""
    while not await within(ending, ASK_AGAIN):
        now = await asyncio.to_thread(whereabouts, settings.upstream)
        # names vanish for a moment while containers start; nginx tries another worker meanwhile
        if now and now != known:
            LOG.info("workers are at %s", ", ".join(now))
            configuration = nginx.write(settings, now, folder)
            pipe, relaying = await nginx_log.relay()
            done = await asyncio.create_subprocess_exec(
                *nginx.command(binary, configuration, "-s", "reload"),
                stderr=pipe,
            )
            os.close(pipe)
            if await done.wait() == 0:
                known = now
            await relaying


async def serve(settings: Settings, binary: str, folder: Path) -> int:
    """Run everything until a signal; return the exit code."""
    loop = asyncio.get_running_loop()
    ending, workers_ended = asyncio.Event(), asyncio.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, ending.set)
    ports = range(settings.worker_port, settings.worker_port + settings.workers)
    places = whereabouts(settings.upstream) if settings.upstream else []
    places = places or [f"127.0.0.1:{port}" for port in ports if not settings.upstream]
    configuration = nginx.write(settings, places, folder)
    front = asyncio.create_task(
        keep(
            "nginx",
            nginx.command(binary, configuration),
            workers_ended,
            PATIENCE,
            relay=nginx_log.relay,
        )
    )
    if settings.upstream:
        others = [asyncio.create_task(follow(settings, binary, folder, places, ending))]
    else:
        worker = [sys.executable, "-m", "deploy.worker", *sys.argv[1:]]
        own = {"ADDRESS": "127.0.0.1", "ROTORSTAB_ORIGINS": ",".join(settings.origins)}
        others = [
            asyncio.create_task(
                keep(
                    f"worker {port}",
                    worker,
                    ending,
                    settings.drain + PATIENCE,
                    os.environ | own | {"PORT": str(port)},
                )
            )
            for port in ports
        ]
    where = settings.origins[0]
    scheme = "https" if settings.tls_certificate or settings.outside_tls == "yes" else "http"
    LOG.info("serving %s://%s%s/", scheme, where, settings.prefix)
    done, _ = await asyncio.wait([*others, front], return_when=asyncio.FIRST_COMPLETED)
    failed = not ending.is_set()
    ending.set()
    await asyncio.gather(*others)
    workers_ended.set()
    await front
    LOG.info("stopped")
    return max(task.result() or 0 for task in done) if failed else 0


def main() -> None:
    """Check everything, then serve until a signal."""
    try:
        settings = read()
        if not settings.upstream:
            os.environ["BOKEH_SECRET_KEY"] = find_secret(settings, make=True)
        check_port(settings)
        check_port(settings, "ROTORSTAB_HTTP_PORT")  # nginx's alone; the workers do not look
    except SettingError as problem:
        stop(problem)
    binary = nginx.find_nginx()
    if binary is None:
        stop("nginx is not there: install it (Debian and Ubuntu: apt-get install nginx-light)")
    logs.install(settings)
    remove_stale_folders()
    with tempfile.TemporaryDirectory(prefix=f"{PREFIX}{os.getpid()}-") as name:
        folder = Path(name)
        folder.chmod(0o711)  # started by root, nginx reads its pages as another user
        configuration = nginx.write(settings, (), folder)
        tested = subprocess.run(
            nginx.command(binary, configuration, "-t"), capture_output=True, text=True, check=False
        )
        if tested.returncode != 0:
            stop(f"nginx refuses its configuration: {tested.stderr.strip().splitlines()[0]}")
        code = asyncio.run(serve(settings, binary, folder))
    sys.exit(code)


if __name__ == "__main__":
    main()
