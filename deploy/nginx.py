"""nginx in front of the workers: its configuration, and where its program is."""

import os
import re
import secrets
import shutil
from collections.abc import Sequence
from ipaddress import ip_address
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from .constants import HEADER_BUFFER, HEADERS, LONGEST_ADDRESS, PAGE_FILES
from .error_pages import error_page, retry_seconds
from .settings import LOOPBACK, Settings, host_name

TEMPLATE = "nginx.conf.j2"
CONNECTIONS_OF_A_PAGE = 20  # six of the browser, the socket, and others that only wait
FEWEST_CONNECTIONS, MOST_CONNECTIONS = 500, 16_000
STATUSES = (400, 403, 404, 405, 408, 413, 414, 421, 429, 431, 500, 501, 505)
PAGES = {str(status): (status, False) for status in STATUSES} | {
    "full": (503, False),
    "restarts": (503, True),
}
"""The error pages that nginx shows by itself: status, and whether the server restarts, by name."""


def find_nginx() -> str | None:
    """Return the path of nginx, also where only root has its folder in PATH; None without nginx."""
    return shutil.which("nginx", path=os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin"]))


def is_ip_address(host: str) -> bool:
    """Return whether a host is an IP address."""
    try:
        ip_address(host)
    except ValueError:
        return False
    return True


def in_server_name(host: str) -> str:
    """Return a host as nginx compares it with the host of a request."""
    return f"[{host}]" if ":" in host else host


def variables(settings: Settings, workers: Sequence[str]) -> dict[str, Any]:
    """Return the variables of the template that depend on the settings and the workers."""
    origins = {in_server_name(host_name(origin)): origin for origin in settings.origins}
    places = settings.max_sessions * max(len(workers), 1)
    connections = max(
        FEWEST_CONNECTIONS, CONNECTIONS_OF_A_PAGE * settings.max_sessions * len(workers)
    )
    return {
        "address": f"[{settings.address}]" if ":" in settings.address else settings.address,
        "port": settings.port,
        # "::" listens for IPv4 as well
        "family": " ipv6only=off" if settings.address == "::" else "",
        "http_port": settings.http_port,
        "origins": origins,
        # no other site can own a loopback name, and a technician uses one
        "names": list(dict.fromkeys([*origins, *map(in_server_name, LOOPBACK)])),
        # a browser sends no host name in the TLS handshake where the address is a number
        "by_number": any(map(is_ip_address, map(host_name, settings.origins))),
        # nothing listens on port 9, the discard port: every request fails, and the error page says
        # that the server restarts
        "workers": list(workers) or ["127.0.0.1:9"],
        "places": places,
        "connections": min(connections, MOST_CONNECTIONS),
        "tls": bool(settings.tls_certificate),
        "certificate": settings.tls_certificate,
        "key": settings.tls_key,
        "keep_alive": settings.keep_alive,
        "log_level": settings.log_level,
        "hsts": settings.hsts,
        "prefix": settings.prefix,
        "secure": bool(settings.tls_certificate) or settings.outside_tls == "yes",
        "page_files": re.escape(settings.prefix) + PAGE_FILES,
    }


def render(settings: Settings, workers: Sequence[str], folder: Path) -> str:
    """Return the configuration of nginx.

    Parameters
    ----------
    settings : Settings
        Of this server.
    workers : sequence of str
        Addresses of the workers, as host:port; may be empty.
    folder : Path
        Holds the files of nginx, the error pages among them.
    """
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
        keep_trailing_newline=True,
    )
    return environment.get_template(TEMPLATE).render(
        folder=folder,
        pages={name: retry_seconds(*page) for name, page in PAGES.items()},
        headers=HEADERS,
        generation=secrets.token_hex(4),
        longest_address=LONGEST_ADDRESS,
        header_buffer=HEADER_BUFFER,
        **variables(settings, workers),
    )


def write(settings: Settings, workers: Sequence[str], folder: Path) -> Path:
    """Write the configuration and the error pages into a folder; return the former's path."""
    (folder / "_errors").mkdir(exist_ok=True)
    for name, (status, restarting) in PAGES.items():
        page = error_page(status, restarting, settings.prefix)
        (folder / "_errors" / f"{name}.html").write_text(page, encoding="utf-8")
    path = folder / "nginx.conf"
    path.write_text(render(settings, workers, folder), encoding="utf-8")
    return path


def command(nginx: str, configuration: Path, *more: str) -> list[str]:
    """Return the command that runs nginx in the foreground, or tests its configuration."""
    files = ["-p", str(configuration.parent), "-c", str(configuration)]
    return [nginx, "-e", "stderr", *files, "-g", "daemon off;", *more]
