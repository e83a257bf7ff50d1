"""Bokeh reads this once, when a server loads the app and before it listens."""

from deploy.patches import plain_serving

plain_serving.install()
