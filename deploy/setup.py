"""Harden `panel serve`: pass this file as `--setup deploy/setup.py`. See `deploy/server`."""

import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from deploy.server import (
    addresses,
    faults,
    headers,
    health,
    hosts,
    limits,
    logs,
    messages,
    sessions,
    settings,
)

for part in (logs, faults, headers, hosts, addresses, limits, messages, sessions, health):
    part.install()

if settings.LESSONS:
    # a broken lesson is reported now, not when the first student comes
    import_module("app.lessons").library()
