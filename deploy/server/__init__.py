"""Patches that harden `panel serve`: one module a concern, each with an `install`.

Panel and Bokeh trust whoever reaches the port. These modules close what a teaching lab meets:
foreign modules imported by an address, sockets from other sites, sessions without end, tracebacks
in replies, log lines of megabytes. They patch Panel 1.9, Bokeh 3.9 and Tornado 6.5 to 6.6, have no
effect outside the server's process, and `tests/test_deploy.py` checks each point on a real server.
"""
