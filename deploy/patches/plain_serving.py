"""Plain `panel serve app`: its addresses, and what can be hardened without settings.

`deploy/start.sh` hardens a server before it loads the app. What is done here, for plain Panel,
is what one person at a desk needs: it sets no limits and counts nobody.
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
from tornado.web import Application, RedirectHandler, RequestHandler

from . import addresses, faults, headers, messages, patching, sockets, versions

__all__ = ["harden", "install", "is_own_name", "listens_to_others", "prepare", "warn"]

_LOG = logging.getLogger("rotorstab.app")
_NO_PROCESSES = (
    "rotorstab: --num-procs is not possible: the processes that it starts would go on serving "
    "after the first one was stopped. Start workers instead: make lab WORKERS=2 (docs/deploy.md)"
)
_OPEN = (
    "rotorstab listens on %s: anybody in the network can open it, without limits and without TLS. "
    "For yourself, end it and run: panel serve app --address 127.0.0.1. "
    "For others: ADDRESS=0.0.0.0 ROTORSTAB_ORIGINS=name-of-this-machine:5006 sh deploy/start.sh "
    "(docs/deploy.md)"
)


def listens_to_others(address: str | None) -> bool:
    """Whether an address of `--address` can be reached from other machines."""
    if address == "localhost":
        return False
    try:
        return not ipaddress.ip_address(address or "0.0.0.0").is_loopback
    except ValueError:
        return True  # a name


@functools.cache
def _own_names() -> frozenset[str]:
    """Return the names of this machine; asking for them may take seconds."""
    own = {socket.gethostname().lower(), socket.getfqdn().lower()}
    return frozenset(own | {f"{one.partition('.')[0]}.local" for one in own})


def is_own_name(host: str, known: Any) -> bool:
    """Whether a Host is this machine's: a name that it has, a listed one, or a number.

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


class _Refused(RequestHandler):
    """Answers nothing but an error."""

    def initialize(self, status: int) -> None:
        self.status = status

    def prepare(self) -> None:
        self.send_error(self.status)


class _Moved(RedirectHandler):
    """Leads to the page with the query that was given."""

    head = RedirectHandler.get


def warn(server: Server) -> None:
    """Say once that others can reach a server which is not hardened, and what to start instead."""
    listens = server.port and listens_to_others(server.address)  # no port: a Unix socket
    if listens and not patching.hardened:
        _LOG.warning(_OPEN, server.address or "every address of this machine")


def _find(find: Any, self: Application, request: Any, **kwargs: Any) -> Any:
    """Return the handler of a request to this server."""
    paths = getattr(self, "app_paths", None)
    if paths is None:  # an application of somebody else
        return find(self, request, **kwargs)
    if not patching.hardened and not is_own_name(request.host, self.websocket_origins):
        return self.get_handler_delegate(request, _Refused, {"status": 421})
    if "\0" in unquote(request.path):  # no file has it in its name, and Tornado looks for one
        return self.get_handler_delegate(request, _Refused, {"status": 404})
    prefix = self.prefix
    wanted = request.path.rstrip("/")
    pages = {f"{prefix}{path}": f"{prefix}{path}" for path in paths}
    if len(paths) == 1:  # else Panel lists them
        pages |= dict.fromkeys(("", prefix), f"{prefix}{next(iter(paths))}")
    if wanted in pages and request.path != pages[wanted]:
        arguments = {"url": pages[wanted], "permanent": False}
        return self.get_handler_delegate(request, _Moved, arguments)
    if prefix and request.path == f"{prefix}/favicon.ico":
        request.path = "/favicon.ico"
    return find(self, request, **kwargs)


@functools.cache
def harden() -> None:
    """Install, once, the patches that need no settings; `deploy/setup.py` installs them all."""
    if patching.hardened:
        return
    for part in (faults, headers, addresses, messages):
        part.install(None)


def prepare() -> None:
    """Prepare this process for the dashboard, however it is served; again changes nothing."""
    sockets.install()
    install()
    harden()
    versions.tell()


def install() -> None:
    """Prepare this process's server, once: the app may be loaded several times."""
    if hasattr(Application, "rotorstab_serves"):
        return
    Application.rotorstab_serves = True
    find, start = Application.find_handler, Server.__init__

    @functools.wraps(find)
    def find_handler(self: Application, request: Any, **kwargs: Any) -> Any:
        return _find(find, self, request, **kwargs)

    @functools.wraps(start)
    def begin(self: Server, *args: Any, **kwargs: Any) -> None:
        if kwargs.get("num_procs", 1) != 1:
            sys.exit(_NO_PROCESSES)
        harden()  # --setup has run by now
        start(self, *args, **kwargs)
        warn(self)

    Application.find_handler = find_handler
    Server.__init__ = begin
