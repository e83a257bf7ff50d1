"""`rotorstab serve`: serves the dashboard, with the options that one person needs.

The command line of the library finds `add_command` through the entry-point group
`rotorstab.commands` of pyproject.toml, so the library never imports the dashboard. This module
needs the standard library only: `rotorstab --help` loads it.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from dataclasses import fields
from importlib.util import find_spec
from typing import Any

from .kinds import Kind
from .settings import LONGEST_SHOWN, SettingError, Settings, read

NEEDED = (
    "panel",
    "holoviews",
    "bokeh",
    "tornado",
    "matplotlib",
    "packaging",
    "pint",
    "prometheus_client",
    "jinja2",
    "markupsafe",
    "markdown_it",
    "param",
)
"""Modules that the extra `app` installs; a test compares them with pyproject.toml."""
OPTIONS = ("address", "port", "workers")
"""Settings that are options too."""


def add_command(commands: Any) -> None:
    """Add the command `serve` to the sub-parsers of argparse."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "serve",
        help="serve the dashboard",
        description="Serve the dashboard until Ctrl-C or SIGTERM; several workers are served "
        "behind nginx. Other settings are environment variables (docs/deploy.md): to serve other "
        "machines, set ROTORSTAB_ORIGINS to the host:port that their browsers show.",
    )
    for entry in fields(Settings):
        if entry.name in OPTIONS:
            setting = entry.metadata
            parser.add_argument(
                f"--{entry.name}",
                type=_checked(setting["kind"]),
                help=f"{setting['meaning']} (default {setting['default']}, or what the environment "
                f"variable {setting['name']} says)",
            )
    parser.set_defaults(run=serve)


def _checked(kind: Kind) -> Callable[[str], str]:
    """Return a type of argparse that accepts what a kind of setting accepts."""

    def check(text: str) -> str:
        try:
            kind.read(text)
        except ValueError:
            shown = text[:LONGEST_SHOWN]
            raise argparse.ArgumentTypeError(f"must be {kind.allowed}, got {shown!r}") from None
        return text

    return check


def serve(arguments: argparse.Namespace) -> None:
    """Replace this process by a worker, or by nginx and several workers.

    Raises
    ------
    SettingError
        Where the extra `app` is not installed, or a setting of the environment is wrong.
    """
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise SettingError(
            f"the dashboard needs {', '.join(missing)}, which is not installed: "
            "pip install 'rotorstab[app]'"
        )
    environment = dict(os.environ)
    for entry in fields(Settings):
        value = getattr(arguments, entry.name, None)
        if value is not None:
            environment[entry.metadata["name"]] = value
    module = "deploy.lab" if read(environment).workers > 1 else "deploy.worker"
    # A new program, because the command line computes with floating-point errors raised. -P: a
    # folder `app` or `deploy` in the working directory is not taken for the installed one.
    os.execve(sys.executable, [sys.executable, "-P", "-m", module], environment)
