"""Harden `panel serve`, with `--setup deploy/setup.py`: install every patch of `deploy/patches`."""

from deploy import dashboard, settings
from deploy.patches import patching

try:
    values = settings.read()
except settings.SettingError as problem:
    settings.exit_with(problem)
try:
    # Where a part of Panel, Bokeh or Tornado has moved, already the import of its patch fails.
    from deploy.patches import (
        addresses,
        connections,
        faults,
        headers,
        health,
        hosts,
        lifecycle,
        limits,
        logs,
        messages,
        metrics,
        sessions,
        threads,
    )

    logs.install(values, sessions.current_session)  # first, so that the others can log
    for part in (
        faults,
        threads,
        headers,
        hosts,
        addresses,
        limits,
        connections,
        messages,
        sessions,
        health,
        metrics,
        lifecycle,
    ):
        part.install(values)
except (ImportError, AttributeError) as problem:
    settings.exit_with(patching.explain(problem))
patching.hardened = True
dashboard.warm_up()
