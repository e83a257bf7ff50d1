"""Plain `panel serve app`: its addresses, and the patches that need no settings.

`deploy/start.sh` hardens a server before it loads the app. This module does for plain Panel what
one person at a desk needs: it sets no limits and counts nobody.
"""

from __future__ import annotations

import functools
import ipaddress
import logging
import socket
import sys
from typing import Any
from urllib.parse import unquote, urlsplit

from bokeh.server.server import Server
from bokeh.server.util import check_allowlist
from tornado.httputil import HTTPServerRequest
from tornado.web import Application, RedirectHandler

from . import addresses, faults, headers, messages, patching, sockets, versions
from .hosts import Refused

__all__ = ["harden", "install", "is_own_name", "listens_to_others", "prepare", "warn"]

LOG = logging.getLogger("rotorstab.app")
SEVERAL_PROCESSES = (
    "rotorstab: --num-procs is not possible: the processes that it starts would go on serving "
    "after the first one was stopped. Start workers instead: make lab WORKERS=2 (docs/deploy.md)"
)
OPEN_TO_OTHERS = (
    "rotorstab listens on %s: anybody in the network can open it, without limits and without TLS. "
    "For yourself, end it and run: panel serve app --address 127.0.0.1. "
    "For others: ADDRESS=0.0.0.0 ROTORSTAB_ORIGINS=name-of-this-machine:5006 sh deploy/start.sh "
    "(docs/deploy.md)"
)


def listens_to_others(address: str | None) -> bool:
    """Return whether other machines can reach an address of the option `--address`."""
    if address == "localhost":
        return False
    try:
        return not ipaddress.ip_address(address or "0.0.0.0").is_loopback
    except ValueError:
        return True  # a name


@functools.cache
def _own_names() -> frozenset[str]:
    """Return the names of this machine; looking them up may take seconds."""
    names = {socket.gethostname().lower(), socket.getfqdn().lower()}
    return frozenset(names | {f"{name.partition('.')[0]}.local" for name in names})


def is_own_name(host: str, known: Any) -> bool:
    """Return whether a Host is this machine's: a name of its own, a listed name, or an IP address.

    A site that points a name of its own at this machine has none of these (DNS rebinding).
    """
    try:
        name = (urlsplit(f"//{host}").hostname or "").rstrip(".")
        if name == "localhost" or name.endswith(".localhost"):
            return True
        try:
            ipaddress.ip_address(name.partition("%")[0])
            return True
        except ValueError:
            return check_allowlist(host.lower(), known) or name in _own_names()
    except ValueError:  # brackets without an end, a port that is no number
        return False


class _Redirect(RedirectHandler):
    """Leads to the page, with the query of the request."""

    head = RedirectHandler.get


def warn(server: Server) -> None:
    """Log that others can reach a server that is not hardened, and what to start instead."""
    listens = server.port and listens_to_others(server.address)  # no port: a Unix socket
    if listens and not patching.hardened:
        LOG.warning(OPEN_TO_OTHERS, server.address or "every address of this machine")


def _find(find: Any, application: Any, request: HTTPServerRequest, **kwargs: Any) -> Any:
    """Return the handler of a request to this server."""
    paths = getattr(application, "app_paths", None)
    if paths is None:  # an application of another library
        return find(application, request, **kwargs)
    if not patching.hardened and not is_own_name(request.host, application.websocket_origins):
        return application.get_handler_delegate(request, Refused, {"status": 421})
    if "\0" in unquote(request.path):  # Tornado would look for a file of that name and fail
        return application.get_handler_delegate(request, Refused, {"status": 404})
    prefix = application.prefix
    wanted = request.path.rstrip("/")
    pages = {f"{prefix}{path}": f"{prefix}{path}" for path in paths}
    if len(paths) == 1:  # Panel shows a list where there are several
        pages |= dict.fromkeys(("", prefix), f"{prefix}{next(iter(paths))}")
    if wanted in pages and request.path != pages[wanted]:
        arguments = {"url": pages[wanted], "permanent": False}
        return application.get_handler_delegate(request, _Redirect, arguments)
    if prefix and request.path == f"{prefix}/favicon.ico":
        request.path = "/favicon.ico"
    return find(application, request, **kwargs)


def _first_time(mark: str) -> bool:
    """Return whether this is the first call in this process.

    Tornado's class keeps the mark: with `--autoreload` Panel imports this module anew.
    """
    if hasattr(Application, mark):
        return False
    setattr(Application, mark, True)
    return True


def harden() -> None:
    """Install, once, the patches that need no settings; `deploy/setup.py` installs all patches."""
    if patching.hardened or not _first_time("rotorstab_hardens"):
        return
    try:
        for part in (faults, headers, addresses, messages):
            part.install(None)
    except AttributeError as problem:
        sys.exit(f"rotorstab: {patching.explain(problem)}")


def prepare() -> None:
    """Prepare this process for the dashboard, however it is served; each page calls this."""
    sockets.install()
    install()
    harden()
    versions.warn()


def install() -> None:
    """Prepare this process's server, once: the app may be loaded several times."""
    if not _first_time("rotorstab_serves"):
        return
    find, start = Application.find_handler, Server.__init__

    @functools.wraps(find)
    def find_handler(self: Application, request: HTTPServerRequest, **kwargs: Any) -> Any:
        return _find(find, self, request, **kwargs)

    @functools.wraps(start)
    def begin(self: Server, *args: Any, **kwargs: Any) -> None:
        if kwargs.get("num_procs", 1) != 1:
            sys.exit(SEVERAL_PROCESSES)
        harden()  # by now `--setup` has run
        start(self, *args, **kwargs)
        warn(self)

    patching.replace(Application, "find_handler", find_handler)
    patching.replace(Server, "__init__", begin)
