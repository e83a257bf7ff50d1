"""Addresses that are shut, and queries on which Panel would fail."""

from __future__ import annotations

import functools
import logging
import urllib.parse
from typing import Any

import panel.io.location as panel_location
from bokeh.server.views.metadata_handler import MetadataHandler
from panel.io.server import AutoloadJsHandler, ComponentResourceHandler, DocHandler, RootHandler
from tornado.web import HTTPError, RequestHandler

from ..settings import Settings
from .patching import replace

LOG = logging.getLogger("rotorstab")
LONGEST_VALUE = 300  # characters of a value that Panel reads; the session reads the query itself

panel_parse_query = panel_location.parse_query
panel_location_params = panel_location._get_location_params


async def not_found(self: RequestHandler) -> None:
    """Answer 404 before the handler does anything."""
    raise HTTPError(404)


async def head_page(self: RequestHandler, *args: Any, **kwargs: Any) -> None:
    """Answer HEAD with the page's type, without building the page."""
    self.set_header("Cache-Control", "no-store")
    self.set_header("Content-Type", "text/html")


@functools.wraps(panel_parse_query)
def parse_query(query: str) -> dict[str, Any]:
    """Return what Panel reads of a query, without the values on which it fails.

    Panel parses the address of each page; a failure, such as of a number of 5000 digits, would be a
    blank page.
    """
    parsed: dict[str, Any] = {}
    for key, value in urllib.parse.parse_qsl(query.removeprefix("?")):
        if len(value) <= LONGEST_VALUE:
            try:
                parsed |= panel_parse_query("?" + urllib.parse.urlencode({key: value}))
            except Exception:  # int("²"), for example
                LOG.info("unreadable query value of %r", key)
    return parsed


@functools.wraps(panel_location_params)
def location_params(protocol: str, host: str, uri: str | None) -> Any:
    """Return Panel's parts of an address; only its path where the rest cannot be taken apart."""
    try:
        return panel_location_params(protocol, host, uri)
    except Exception:  # two question marks, an IPv6 host
        return panel_location_params(protocol, "", (uri or "").partition("?")[0].partition("#")[0])


def install(settings: Settings | None) -> None:
    """Shut and mend the addresses of this process's server."""
    # /components/<module>/... imports the module that it names
    replace(ComponentResourceHandler, "prepare", not_found)
    # autoload.js makes a session for any other site, and no site embeds this dashboard
    replace(AutoloadJsHandler, "prepare", not_found)
    replace(MetadataHandler, "prepare", not_found)  # nobody asks for it
    replace(DocHandler, "head", head_page)
    replace(RootHandler, "head", RootHandler.get)  # a redirect
    replace(panel_location, "parse_query", parse_query)
    replace(panel_location, "_get_location_params", location_params)
