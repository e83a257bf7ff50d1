"""nginx and identical workers for a class: `python -m deploy.lab [app]`, in the foreground.

It starts ROTORSTAB_WORKERS workers on loopback and nginx in front of them, starts again what ends,
and ends all of them on SIGTERM, the workers first, so that a running export still leaves through
nginx. With ROTORSTAB_UPSTREAM the workers run elsewhere (in containers): their addresses are looked
up again and again, and nginx is reloaded when they change.

supervisord is not used, because it cannot log to the socket of journald, and because its children
keep running when it is killed.
"""

import asyncio
import logging
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from . import nginx, nginx_log
from .patches import logs
from .processes import keep_running, wait_for
from .secret import find_secret
from .settings import SettingError, Settings, check_port, exit_with, read

LOG = logging.getLogger("rotorstab.lab")
PATIENCE = 4.0  # s that a process has to end, beyond the time that it needs
LOOK_AGAIN = 2.0  # s between two look-ups of the workers' addresses
FOLDER_PREFIX = "rotorstab-lab-"  # of the temporary folder, before the process id


def remove_stale_folders() -> None:
    """Remove the temporary folders of launchers that were killed."""
    for folder in Path(tempfile.gettempdir()).glob(f"{FOLDER_PREFIX}*"):
        process = folder.name.removeprefix(FOLDER_PREFIX).partition("-")[0]
        if process.isdigit() and not Path(f"/proc/{process}").exists():
            shutil.rmtree(folder, ignore_errors=True)  # the folder of another user stays


def look_up(upstream: Sequence[str]) -> list[str]:
    """Return the sorted addresses of names such as `worker:5006`; names without one are omitted."""
    addresses: set[str] = set()
    for name in upstream:
        host, _, port = name.rpartition(":")
        with suppress(OSError):
            infos = socket.getaddrinfo(host, int(port), socket.AF_INET, socket.SOCK_STREAM)
            addresses |= {"{}:{}".format(*address) for *_, address in infos}
    return sorted(addresses)


async def follow(
    settings: Settings, binary: str, folder: Path, known: list[str], ending: asyncio.Event
) -> None:
    """Reload nginx whenever the addresses of the workers change, until the event comes."""
    while not await wait_for(ending, LOOK_AGAIN):
        addresses = await asyncio.to_thread(look_up, settings.upstream)
        # A name is unknown for a moment while its container starts; nginx tries another worker.
        if addresses and addresses != known:
            LOG.info("workers are at %s", ", ".join(addresses))
            configuration = nginx.write(settings, addresses, folder)
            pipe, relaying = await nginx_log.relay()
            reload = await asyncio.create_subprocess_exec(
                *nginx.command(binary, configuration, "-s", "reload"),
                stderr=pipe,
            )
            os.close(pipe)
            if await reload.wait() == 0:
                known = addresses
            await relaying


def start_workers(settings: Settings, ending: asyncio.Event) -> list[asyncio.Task[int]]:
    """Start the workers on loopback; return the tasks that keep them running."""
    # -P: a folder `app` or `deploy` in the working directory is not taken for the installed one
    command = [sys.executable, "-P", "-m", "deploy.worker", *sys.argv[1:]]
    environment = os.environ | {
        "ADDRESS": "127.0.0.1",
        "ROTORSTAB_ORIGINS": ",".join(settings.origins),
    }
    return [
        asyncio.create_task(
            keep_running(
                f"worker {port}",
                command,
                ending,
                settings.drain + PATIENCE,
                environment | {"PORT": str(port)},
            )
        )
        for port in worker_ports(settings)
    ]


def worker_ports(settings: Settings) -> range:
    """Return the ports of the workers on loopback."""
    return range(settings.worker_port, settings.worker_port + settings.workers)


async def serve(settings: Settings, binary: str, folder: Path) -> int:
    """Run nginx and the workers until a signal comes; return the exit code."""
    loop = asyncio.get_running_loop()
    ending, workers_ended = asyncio.Event(), asyncio.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, ending.set)
    if settings.upstream:
        addresses = look_up(settings.upstream)
    else:
        addresses = [f"127.0.0.1:{port}" for port in worker_ports(settings)]
    configuration = nginx.write(settings, addresses, folder)
    proxy: asyncio.Task[int] = asyncio.create_task(
        keep_running(
            "nginx",
            nginx.command(binary, configuration),
            workers_ended,
            PATIENCE,
            relay=nginx_log.relay,
        )
    )
    others: list[asyncio.Task[int] | asyncio.Task[None]]
    if settings.upstream:
        others = [asyncio.create_task(follow(settings, binary, folder, addresses, ending))]
    else:
        others = [*start_workers(settings, ending)]
    scheme = "https" if settings.tls_certificate or settings.outside_tls == "yes" else "http"
    LOG.info("serving %s://%s%s/", scheme, settings.origins[0], settings.prefix)
    done, _ = await asyncio.wait([*others, proxy], return_when=asyncio.FIRST_COMPLETED)
    failed = not ending.is_set()
    ending.set()
    await asyncio.gather(*others)
    workers_ended.set()
    await proxy
    LOG.info("stopped")
    return max(task.result() or 0 for task in done) if failed else 0


def main() -> None:
    """Check the settings and nginx's configuration, then serve until a signal comes."""
    try:
        settings = read()
        if not settings.upstream:
            os.environ["BOKEH_SECRET_KEY"] = find_secret(settings, make=True)
        check_port(settings.address, settings.port)
        if settings.http_port:  # only nginx listens on it; the workers do not check it
            check_port(settings.address, settings.http_port, "ROTORSTAB_HTTP_PORT")
    except SettingError as problem:
        exit_with(problem)
    binary = nginx.find_nginx()
    if binary is None:
        exit_with("nginx is not there: install it (Debian and Ubuntu: apt-get install nginx-light)")
    logs.install(settings)
    remove_stale_folders()
    with tempfile.TemporaryDirectory(prefix=f"{FOLDER_PREFIX}{os.getpid()}-") as name:
        folder = Path(name)
        folder.chmod(0o711)  # nginx that root has started reads its pages as another user
        configuration = nginx.write(settings, (), folder)
        tested = subprocess.run(
            nginx.command(binary, configuration, "-t"), capture_output=True, text=True, check=False
        )
        if tested.returncode != 0:
            exit_with(f"nginx refuses its configuration: {tested.stderr.strip().splitlines()[0]}")
        code = asyncio.run(serve(settings, binary, folder))
    sys.exit(code)


if __name__ == "__main__":
    main()
