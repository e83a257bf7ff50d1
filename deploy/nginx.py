"""nginx in front of the workers: its configuration, and where to find it."""

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from .server.constants import HEADERS, RESTART_SECONDS, RETRY_SECONDS
from .server.pages import error_page
from .server.settings import Settings

TEMPLATE = "nginx.conf.j2"
CONNECTIONS = 20  # of a page: six of the browser, the socket, and others that only wait
MOST_CONNECTIONS = 16_000
PAGES = {
    # name: status, whether the server restarts, Retry-After
    "404": (404, False, None),
    "414": (414, False, None),
    "full": (503, False, RETRY_SECONDS),
    "restarts": (503, True, RESTART_SECONDS),
}


def find_nginx() -> str | None:
    """Return nginx, also where only root has its folder in PATH."""
    return shutil.which("nginx", path=os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin"]))


def render(settings: Settings, workers: Sequence[str], folder: Path) -> str:
    """Return the configuration for workers at host:port, with files in a folder of its own."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
        keep_trailing_newline=True,
    )
    address = f"[{settings.address}]" if ":" in settings.address else settings.address
    names = dict.fromkeys(origin.rpartition(":")[0] or origin for origin in settings.origins)
    places = settings.max_sessions * len(workers)
    return environment.get_template(TEMPLATE).render(
        folder=folder,
        listen=f"{address}:{settings.port}",
        # no other site can take a loopback name, and a technician asks by one
        names=list(dict.fromkeys([*names, "localhost", "127.0.0.1"])),
        # a port that nobody listens on: the page says that the server restarts
        workers=list(workers) or ["127.0.0.1:9"],
        places=max(places, settings.max_sessions),
        connections=min(max(500, CONNECTIONS * places), MOST_CONNECTIONS),
        tls=bool(settings.tls_certificate),
        certificate=settings.tls_certificate,
        key=settings.tls_key,
        keep_alive=settings.keep_alive,
        log_level=settings.log_level,
        pages={name: wait for name, (_, _, wait) in PAGES.items()},
        headers=HEADERS,
    )


def write(settings: Settings, workers: Sequence[str], folder: Path) -> Path:
    """Write the configuration and the pages that nginx shows by itself; return the former."""
    (folder / "pages").mkdir(exist_ok=True)
    for name, (status, restarting, _) in PAGES.items():
        page = error_page(status, restarting)
        (folder / "pages" / f"_{name}.html").write_text(page, encoding="utf-8")
    path = folder / "nginx.conf"
    path.write_text(render(settings, workers, folder), encoding="utf-8")
    return path


def command(nginx: str, configuration: Path, *more: str) -> list[str]:
    """Return the command that runs nginx in the foreground, or tests its configuration."""
    where = str(configuration.parent)
    return [
        nginx,
        "-e",
        "stderr",
        "-p",
        where,
        "-c",
        str(configuration),
        "-g",
        "daemon off;",
        *more,
    ]
