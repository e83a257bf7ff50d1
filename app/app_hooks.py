"""Bokeh reads this once, when a server loads the app and before it listens."""

from .serving import install

install()
