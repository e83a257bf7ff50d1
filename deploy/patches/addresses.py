"""Addresses that are not there, and queries that Panel would fail on."""

import functools
import logging
import urllib.parse

import panel.io.location as panel_location
from bokeh.server.views.metadata_handler import MetadataHandler
from panel.io.server import AutoloadJsHandler, ComponentResourceHandler, DocHandler, RootHandler
from tornado.web import HTTPError

from .patching import replace

LONGEST_VALUE = 300

panel_parse_query = panel_location.parse_query
panel_location_params = panel_location._get_location_params


async def not_found(self):
    """Answer 404 before the handler does anything."""
    raise HTTPError(404)


async def head_page(self, *args, **kwargs):
    """Answer HEAD with the page's type, without building it."""
    self.set_header("Cache-Control", "no-store")
    self.set_header("Content-Type", "text/html")


# Panel parses each page's address, and a failure is a blank page.


@functools.wraps(panel_parse_query)
def parse_query(query):
    """Panel's reading of a query, less what it would fail on (a number of 5000 digits)."""
    parsed = {}
    for key, value in urllib.parse.parse_qsl(query.removeprefix("?")):
        if len(value) <= LONGEST_VALUE:
            try:
                parsed |= panel_parse_query("?" + urllib.parse.urlencode({key: value}))
            except Exception:  # int("²") and their like
                logging.getLogger("rotorstab").info("unreadable query value of %r", key)
    return parsed


@functools.wraps(panel_location_params)
def location_params(protocol, host, uri):
    """Panel's parts of an address, and only its path where the rest cannot be taken apart."""
    try:
        return panel_location_params(protocol, host, uri)
    except Exception:  # two question marks, an IPv6 host
        return panel_location_params(protocol, "", (uri or "").partition("?")[0].partition("#")[0])


def install(settings):
    """Shut and mend the addresses of this process's server."""
    # /components/<module>/... imports the module it names.
    replace(ComponentResourceHandler, "prepare", not_found)
    # autoload.js makes a session for any other site; nothing embeds this dashboard.
    replace(AutoloadJsHandler, "prepare", not_found)
    replace(MetadataHandler, "prepare", not_found)  # nothing asks for it
    replace(DocHandler, "head", head_page)
    replace(RootHandler, "head", RootHandler.get)  # a redirect
    replace(panel_location, "parse_query", parse_query)
    replace(panel_location, "_get_location_params", location_params)
