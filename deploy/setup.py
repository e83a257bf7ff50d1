"""Harden `panel serve`: pass this file as `--setup deploy/setup.py`. See `deploy/server`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from deploy.server import (
    addresses,
    dashboard,
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
    settings,
)

try:
    found = settings.read()
except settings.SettingError as problem:
    settings.stop(problem)
# logs first, the slow things last
for part in (
    logs,
    faults,
    headers,
    hosts,
    addresses,
    limits,
    messages,
    sessions,
    health,
    metrics,
    lifecycle,
    dashboard,
):
    part.install(found)
