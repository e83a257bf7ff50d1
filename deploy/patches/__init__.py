"""Patches that harden `panel serve`: one module a concern, each with an `install`.

Panel and Bokeh trust whoever reaches the port. These modules close what a teaching lab meets:
foreign modules imported by an address, sockets from other sites, sessions without end, tracebacks
in replies, log lines of megabytes. They patch Panel 1.9 and 1.10, Bokeh 3.9 and 3.10, Tornado 6.5
and 6.6, refuse to start where a part that they patch has moved, and have no effect outside the
server's process. `tests/deploy/test_deploy.py` checks each point on a real server.
"""
