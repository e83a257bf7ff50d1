"""The dashboard's own commands: `rotorstab serve` and `rotorstab picture`.

The command line of the library finds `add_command` through the entry-point group
`rotorstab.commands` of pyproject.toml, so the library never imports the dashboard. `rotorstab
--help` loads this module, so it imports nothing of the extra `app` before a command runs.
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
    "contourpy",
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
    """Add the commands `serve` and `picture` to the sub-parsers of argparse."""
    _add_serve(commands)
    _add_picture(commands)


def _add_serve(commands: Any) -> None:
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


def _add_picture(commands: Any) -> None:
    # loaded already: the library's command line offers these formats too
    from rotorstab.drawing.formats import PICTURE_FORMATS

    endings = " ".join(f".{name}" for name in PICTURE_FORMATS)
    parser: argparse.ArgumentParser = commands.add_parser(
        "picture",
        help="a view of the dashboard as one page, without a browser",
        description="Write what a link of the dashboard shows as one page of A4: the charts, the "
        "marked point, the pins, the parameters and the link.",
    )
    parser.add_argument(
        "view",
        metavar="STATE_OR_LINK",
        help="a link as Copy link gives it (in quotes), its query alone, such as "
        "'as=0.5&spin=2', or a rotor file .toml",
    )
    parser.add_argument(
        "--output", metavar="FILE", required=True, help=f"the file to write: {endings}"
    )
    parser.add_argument("--force", action="store_true", help="overwrite an existing file")
    parser.set_defaults(run=save_picture)


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
    _check_installed()
    environment = dict(os.environ)
    for entry in fields(Settings):
        value = getattr(arguments, entry.name, None)
        if value is not None:
            environment[entry.metadata["name"]] = value
    module = "deploy.lab" if read(environment).workers > 1 else "deploy.worker"
    # A new program, because the command line computes with floating-point errors raised. -P: a
    # folder `app` or `deploy` in the working directory is not taken for the installed one.
    os.execve(sys.executable, [sys.executable, "-P", "-m", module], environment)


def save_picture(arguments: argparse.Namespace) -> None:
    """Write the picture of a view to the file of `--output`.

    Raises
    ------
    ValueError
        With one line, where the view is not understood, the ending of the file is none of a
        picture, or the file exists; `SettingError` where the extra `app` is not installed.
    OSError
        Where a file cannot be read or written.
    """
    _check_installed()
    import numpy as np

    from app.exports.shell import described_sheet
    from rotorstab.cli.output import output_format, output_path
    from rotorstab.drawing.files import write_file
    from rotorstab.drawing.formats import PICTURE_FORMATS
    from rotorstab.drawing.printed_sheet import sheet_files

    kind = output_format(arguments.output, PICTURE_FORMATS)
    path = output_path(arguments)
    # the command line raises floating-point errors; the dashboard's code expects NaN
    with np.errstate(over="warn", divide="warn", invalid="warn"):
        data = sheet_files(described_sheet(arguments.view), (kind,))[kind]
    write_file(path, data, arguments.force)


def _check_installed() -> None:
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise SettingError(
            f"the dashboard needs {', '.join(missing)}, which is not installed: "
            "pip install 'rotorstab[app]'"
        )
