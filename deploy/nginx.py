"""nginx in front of the workers: its configuration, and where to find it."""

import os
import re
import secrets
import shutil
from collections.abc import Sequence
from ipaddress import ip_address
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from .constants import HEADER_BUFFER, HEADERS, LONGEST_ADDRESS, PAGE_FILES
from .error_pages import error_page, retry_seconds
from .settings import LOOPBACK, Settings, host_name

TEMPLATE = "nginx.conf.j2"
CONNECTIONS = 20  # of a page: six of the browser, the socket, and others that only wait
MOST_CONNECTIONS = 16_000
OWN = (400, 403, 404, 405, 408, 413, 414, 421, 429, 431, 500, 501, 505)
PAGES = {str(status): (status, False) for status in OWN} | {
    "full": (503, False),
    "restarts": (503, True),
}
"""Name: status, and whether the server restarts."""


def find_nginx() -> str | None:
    """Return nginx, also where only root has its folder in PATH."""
    return shutil.which("nginx", path=os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin"]))


def is_number(host: str) -> bool:
    """Whether a host is an IP address."""
    try:
        ip_address(host)
    except ValueError:
        return False
    return True


def in_server_name(host: str) -> str:
    """Return a host as nginx compares it with a request's."""
    return f"[{host}]" if ":" in host else host


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
    # "::" listens for IPv4 as well
    family = " ipv6only=off" if settings.address == "::" else ""
    origins = {in_server_name(host_name(origin)): origin for origin in settings.origins}
    places = settings.max_sessions * len(workers)
    return environment.get_template(TEMPLATE).render(
        folder=folder,
        address=address,
        port=settings.port,
        family=family,
        http_port=settings.http_port,
        origins=origins,
        # no other site can take a loopback name, and a technician asks by one
        names=list(dict.fromkeys([*origins, *map(in_server_name, LOOPBACK)])),
        # a browser names no host in the handshake where the address is a number
        by_number=any(map(is_number, map(host_name, settings.origins))),
        # a port that nobody listens on: the page says that the server restarts
        workers=list(workers) or ["127.0.0.1:9"],
        places=max(places, settings.max_sessions),
        connections=min(max(500, CONNECTIONS * places), MOST_CONNECTIONS),
        tls=bool(settings.tls_certificate),
        certificate=settings.tls_certificate,
        key=settings.tls_key,
        keep_alive=settings.keep_alive,
        log_level=settings.log_level,
        pages={name: retry_seconds(*page) for name, page in PAGES.items()},
        headers=HEADERS,
        hsts=settings.hsts,
        prefix=settings.prefix,
        secure=bool(settings.tls_certificate) or settings.outside_tls == "yes",
        page_files=re.escape(settings.prefix) + PAGE_FILES,
        generation=secrets.token_hex(4),
        longest_address=LONGEST_ADDRESS,
        header_buffer=HEADER_BUFFER,
    )


def write(settings: Settings, workers: Sequence[str], folder: Path) -> Path:
    """Write the configuration and the pages that nginx shows by itself; return the former."""
    (folder / "_errors").mkdir(exist_ok=True)
    for name, page_of in PAGES.items():
        page = error_page(*page_of, settings.prefix)
        (folder / "_errors" / f"{name}.html").write_text(page, encoding="utf-8")
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
