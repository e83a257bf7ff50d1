"""Every patch of Panel, Bokeh and Tornado: one module a concern, each with an `install`.

Panel and Bokeh trust whoever reaches the port. These modules close what a teaching lab meets:
foreign modules that an address imports, sockets from other sites, sessions without end, tracebacks
in replies, log lines of megabytes. They patch Panel 1.9 and 1.10, Bokeh 3.9 and 3.10, Tornado 6.5
and 6.6, and have no effect outside the server's process. `patching.replace` stops the start where a
part has moved; `versions` warns where a version is beyond the bounds. `plain_serving` chooses the
patches for plain `panel serve app`; `deploy/setup.py` installs all of them.

`test_deploy.py` and `test_hardening.py` in `tests/deploy` check each point on a real server,
`test_limits.py` with a clock of its own.
"""
