"""Which requests reach a handler: those to a name of this server, of a sensible length."""

import functools
import logging
from urllib.parse import urlsplit

from bokeh.server.util import check_allowlist
from tornado.web import Application, RequestHandler

log = logging.getLogger("rotorstab.hosts")

LONGEST_ADDRESS = 8_000  # characters; the token of a page carries its query in a header
LONGEST_CUT = 250_000  # up to here the page is served without its query
LOOPBACK = ("localhost", "127.0.0.1", "::1")  # no other site can take these names
FOR_MACHINES = ("/health", "/metrics")  # asked by whatever name a probe uses

find_handler = Application.find_handler


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


def cut(request):
    """Drop a query that is too long, and leave one argument that says so."""
    length = len(request.uri)
    request.query = ""
    request.uri = request.path
    for arguments in (request.arguments, request.query_arguments):
        arguments.clear()
        # shown by the page among what it ignored
        arguments[f"{length // 1000} kB of text"] = [b""]
    log.info("dropped a query of %d characters", length)


@functools.wraps(find_handler)
def find_known(self, request, **kwargs):
    """Tornado's choice of a handler, once the request's host and length are sensible."""
    known = getattr(self, "websocket_origins", None)
    if (
        known is not None
        and request.path not in FOR_MACHINES
        and not is_known_host(request.host, known)
    ):
        log.warning("refused a request to the host %.100r", request.host)
        return self.get_handler_delegate(request, Refused, {"status": 421})
    if len(request.uri) > LONGEST_CUT or len(request.path) > LONGEST_ADDRESS:
        return self.get_handler_delegate(request, Refused, {"status": 414})
    if len(request.uri) > LONGEST_ADDRESS:
        cut(request)
    return find_handler(self, request, **kwargs)


def install(settings):
    """Check every request of this process's server."""
    Application.find_handler = find_known
