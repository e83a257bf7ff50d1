"""Harden `panel serve`: pass this file as `--setup deploy/setup.py`. See `deploy/server`."""

import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from deploy.server import patching, settings

try:
    found = settings.read()
except settings.SettingError as problem:
    settings.stop(problem)
# logs first, the slow things last
PARTS = (
    "logs",
    "faults",
    "threads",
    "headers",
    "hosts",
    "addresses",
    "limits",
    "connections",
    "messages",
    "sessions",
    "health",
    "metrics",
    "lifecycle",
)
try:
    for name in PARTS:
        import_module(f"deploy.server.{name}").install(found)
except (ImportError, AttributeError) as problem:
    settings.stop(patching.explain(problem))
import_module("deploy.server.dashboard").install(found)
