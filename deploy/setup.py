"""Harden `panel serve`: pass this file as `--setup deploy/setup.py`. See `deploy/patches`."""

from deploy import dashboard, settings
from deploy.patches import patching

try:
    found = settings.read()
except settings.SettingError as problem:
    settings.exit_with(problem)
try:
    # where Panel, Bokeh or Tornado have moved a part, its patch cannot even be imported
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

    # logs first, the slow things last
    for part in (
        logs,
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
        part.install(found)
except (ImportError, AttributeError) as problem:
    settings.exit_with(patching.explain(problem))
patching.hardened = True
dashboard.warm_up()
