"""Which requests reach a handler.

Those to a host name of this server and of a sensible length; of the static files only those that
the page uses.
"""

from __future__ import annotations

import functools
import logging
import re
from collections.abc import Sequence
from typing import Any
from urllib.parse import unquote, urlsplit

import bokeh.server.server as bokeh_server
from bokeh.server.util import check_allowlist
from tornado.escape import parse_qs_bytes
from tornado.httputil import HTTPServerRequest
from tornado.web import Application, RequestHandler

from ..constants import LONGEST_ADDRESS, PAGE_FILES
from ..settings import LOOPBACK, Settings
from .patching import replace

LOG = logging.getLogger("rotorstab.hosts")

LONGEST_KEPT = 8_000  # characters of an address; the page's token carries its query in a header
LONGEST_VALUE = 3_000  # characters of one value with its %-escapes; no page of ours has as many
LONGEST_NAME = 20  # characters of a key that are kept where the key is too long
UNCHECKED_HOST_PATHS = ("/health", "/metrics")  # a probe asks for them by whatever name it uses

allowlist = bokeh_server.create_hosts_allowlist


class Refused(RequestHandler):
    """Answers with nothing but an error page, whatever the method."""

    def initialize(self, status: int) -> None:
        self.status = status

    def prepare(self) -> None:
        self.send_error(self.status)


def is_known_host(host: str, known: Sequence[str]) -> bool:
    """Return whether the Host of a request is a listed origin or a loopback name."""
    try:
        name = urlsplit(f"//{host}").hostname
        return name in LOOPBACK or bool(check_allowlist(host.lower(), known))
    except ValueError:  # brackets without an end, a port that is no number
        return False


def is_page_file(path: str) -> bool:
    """Return whether a path of a request is that of a script or style that the page uses."""
    return re.fullmatch(PAGE_FILES, unquote(path)) is not None


def shortened(query: str, room: int = LONGEST_KEPT) -> str:
    """Return a query without values that are too long, and no longer than `room` characters.

    Of a value that is left out the key stays, with the length in words; the page lists it among
    what it ignores. What does not fit at all is counted in one last key.
    """
    kept: list[str] = []
    left = len(query)
    for part in query.split("&"):
        key, equals, value = part.partition("=")
        if len(key) > LONGEST_VALUE:
            key = key[:LONGEST_NAME]
        if len(value) > LONGEST_VALUE:
            value = f"{len(value)}+characters"
        room -= len(key) + len(value) + 2
        if room < 0:
            return "&".join([*kept, f"{max(1, left // 1000)}+kB+of+text="])
        kept.append(key + equals + value)
        left -= len(part) + 1
    return "&".join(kept)


def shorten(request: HTTPServerRequest) -> None:
    """Shorten the query of a request."""
    LOG.info("shortened an address of %d characters", len(request.uri or ""))
    request.query = shortened(request.query)
    request.uri = f"{request.path}?{request.query}"
    parsed = parse_qs_bytes(request.query, keep_blank_values=True)
    for arguments in (request.arguments, request.query_arguments):
        arguments.clear()
        arguments.update({key: list(values) for key, values in parsed.items()})


def refusal(application: Application, request: HTTPServerRequest, prefix: str) -> int | None:
    """Return the status with which a request is refused; None where it is not."""
    known = getattr(application, "websocket_origins", None)
    path = request.path.removeprefix(prefix)
    if (
        known is not None
        and path not in UNCHECKED_HOST_PATHS
        and not is_known_host(request.host, known)
    ):
        LOG.warning("refused a request to the host %.100r", request.host)
        return 421
    if path.startswith("/static/") and not is_page_file(path):
        return 404
    if len(request.uri or "") > LONGEST_ADDRESS or len(request.path) > LONGEST_KEPT:
        return 414
    return None


@functools.wraps(allowlist)
def allowlist_with_ipv6(hosts: Sequence[str] | None, port: int | None) -> list[str]:
    """Return Bokeh's list of origins, and with it the IPv6 addresses, which Bokeh does not take."""
    numbers = [host for host in hosts or () if host.startswith("[")]
    others = [host for host in hosts or () if not host.startswith("[")]
    return [*numbers, *(allowlist(others, port) if others or not numbers else ())]


def install(settings: Settings) -> None:
    """Check every request to this process's server."""
    find_handler = Application.find_handler  # `plain_serving` may have replaced Tornado's

    @functools.wraps(find_handler)
    def find_known(self: Application, request: HTTPServerRequest, **kwargs: Any) -> Any:
        status = refusal(self, request, settings.prefix)
        if status is not None:
            return self.get_handler_delegate(request, Refused, {"status": status})
        if len(request.uri or "") > LONGEST_KEPT:
            shorten(request)
        return find_handler(self, request, **kwargs)

    replace(bokeh_server, "create_hosts_allowlist", allowlist_with_ipv6)
    replace(Application, "find_handler", find_known)
