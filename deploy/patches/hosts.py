"""Which requests reach a handler.

Those to a name of this server, of a sensible length; of the static files those that the page uses.
"""

import functools
import logging
import re
from urllib.parse import unquote, urlsplit

import bokeh.server.server as bokeh_server
from bokeh.server.util import check_allowlist
from tornado.escape import parse_qs_bytes
from tornado.web import Application, RequestHandler

from ..constants import LONGEST_ADDRESS, PAGE_FILES
from ..settings import LOOPBACK
from .patching import replace

log = logging.getLogger("rotorstab.hosts")

LONGEST_KEPT = 8_000  # characters of an address; a page's token carries its query in a header
LONGEST_VALUE = 3_000  # characters of one value, %-escapes counted; no honest one has as many
LONGEST_NAME = 20  # characters of a key that are told
FOR_MACHINES = ("/health", "/metrics")  # asked by whatever name a probe uses

prefix = ""
find_handler = Application.find_handler
allowlist = bokeh_server.create_hosts_allowlist


class Refused(RequestHandler):
    """Answers nothing but an error."""

    def initialize(self, status):
        """Keep the error's number."""
        self.status = status

    def prepare(self):
        """Answer with the error's page, whatever the method."""
        self.send_error(self.status)


def is_known_host(host, known):
    """Whether a request's Host is one that browsers were told, or a loopback name."""
    try:
        name = urlsplit(f"//{host}").hostname
        return name in LOOPBACK or check_allowlist(host.lower(), known)
    except ValueError:  # brackets without an end, a port that is no number
        return False


def is_page_file(path):
    """Whether a path, as the request has it, is that of a script or style of the page."""
    return re.fullmatch(PAGE_FILES, unquote(path)) is not None


def shortened(query, room=LONGEST_KEPT):
    """A query with no value that is too long, as far as there is room; the rest is counted.

    What is left out stays as a key, or a value in words: the page names it among what it ignored.
    """
    kept = []
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


def cut(request):
    """Shorten a request's query."""
    log.info("shortened an address of %d characters", len(request.uri))
    request.query = shortened(request.query)
    request.uri = f"{request.path}?{request.query}"
    found = parse_qs_bytes(request.query, keep_blank_values=True)
    for arguments in (request.arguments, request.query_arguments):
        arguments.clear()
        arguments.update({key: list(values) for key, values in found.items()})


@functools.wraps(find_handler)
def find_known(self, request, **kwargs):
    """Tornado's choice of a handler, once the request's host and length are sensible."""
    known = getattr(self, "websocket_origins", None)
    path = request.path.removeprefix(prefix)
    if known is not None and path not in FOR_MACHINES and not is_known_host(request.host, known):
        log.warning("refused a request to the host %.100r", request.host)
        return self.get_handler_delegate(request, Refused, {"status": 421})
    if path.startswith("/static/") and not is_page_file(path):
        return self.get_handler_delegate(request, Refused, {"status": 404})
    if len(request.uri) > LONGEST_ADDRESS or len(request.path) > LONGEST_KEPT:
        return self.get_handler_delegate(request, Refused, {"status": 414})
    if len(request.uri) > LONGEST_KEPT:
        cut(request)
    return find_handler(self, request, **kwargs)


@functools.wraps(allowlist)
def allowlist_with_numbers(hosts, port):
    """Bokeh's list of origins, which takes no IPv6 address, with those that are one."""
    numbers = [host for host in hosts or () if host.startswith("[")]
    others = [host for host in hosts or () if not host.startswith("[")]
    return [*numbers, *(allowlist(others, port) if others or not numbers else ())]


def install(settings):
    """Check every request of this process's server."""
    global prefix
    prefix = settings.prefix
    replace(bokeh_server, "create_hosts_allowlist", allowlist_with_numbers)
    replace(Application, "find_handler", find_known)
