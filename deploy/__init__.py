"""Serving the dashboard to a class."""
