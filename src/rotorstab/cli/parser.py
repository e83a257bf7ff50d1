"""The command line: figures and table of the paper, whirl and regions of your own rotors.

Bad arguments give one line on stderr and exit code 2, never a traceback.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import fields
from importlib.metadata import PackageNotFoundError, entry_points, version
from typing import Any, NoReturn

import numpy as np

from ..drawing.formats import FORMATS, TABLE_FORMATS
from ..model.stiffness_law import STIFFNESS_LAWS
from ..paper import FIGURES
from ..rotors.shaft_disk import ShaftDisk
from .own_rotor_commands import FINITE_ELEMENT, LUMPED, run_regions, run_whirl
from .paper_commands import run_conclusions, run_figure, run_table, run_validation
from .values import Sweep, joined_options

__all__ = ["main"]

INSTALLED_COMMANDS = "rotorstab.commands"
"""Entry-point group of further commands. Each entry is a function that takes the sub-parsers of
argparse, adds its command and sets `run`. `serve` of the dashboard is one of them."""


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        """Print one line and exit with 2."""
        self.exit(2, f"{self.prog}: {message}\n")

    def _print_message(self, message: str, file: Any = None) -> None:
        """Print a help or version; argparse hides that it could not be written."""
        if file is sys.stdout:
            file.write(message)
        else:
            super()._print_message(message, file)


def _version() -> str:
    try:
        return version("rotorstab")
    except PackageNotFoundError:  # run from a folder of sources
        return "of no installed version"


def _add_output(parser: argparse.ArgumentParser, formats: Iterable[str]) -> None:
    endings = " ".join(f".{name}" for name in formats)
    parser.add_argument("--output", metavar="FILE", help=f"write a file: {endings}")
    tables = [TABLE_FORMATS[name] for name in formats if name in TABLE_FORMATS]
    if any(table.marked_for_excel for table in tables):
        parser.add_argument(
            "--excel", action="store_true", help="begin .csv with a byte order mark, for Excel"
        )
    parser.add_argument("--force", action="store_true", help="overwrite existing files")


def _add_rotor(parser: argparse.ArgumentParser) -> None:
    """Add the rotor's and the model's arguments; defaults are the paper's base case."""
    rotor = parser.add_argument_group("rotor, non-dimensional")
    for field in fields(ShaftDisk):
        flag = f"--{field.name.replace('_', '-')}"
        rotor.add_argument(flag, type=float, default=field.default, help="default %(default)s")
    rotor.add_argument(
        "--tangency", type=float, default=0.0, help="0 axial to 1 follower, default %(default)s"
    )
    model = parser.add_argument_group("model")
    models = (LUMPED, FINITE_ELEMENT)
    model.add_argument(
        "--model",
        choices=(*models, "exact"),  # "exact" is the old spelling of `--stiffness exact`
        metavar=f"{{{','.join(models)}}}",
        default=LUMPED,
        help="default %(default)s",
    )
    model.add_argument(
        "--stiffness",
        choices=tuple(STIFFNESS_LAWS),
        help="law of the lumped shaft's stiffness over the load, default linear",
    )
    model.add_argument("--elements", type=int, default=20)
    model.add_argument("--modes", type=int, help="reduce the finite elements, default all")
    for name in ("external", "internal"):
        model.add_argument(f"--{name}-damping", type=float, default=0.0, help="damping ratio")


def _parser() -> argparse.ArgumentParser:
    """Return the parser of every command."""
    parser = _Parser(prog="rotorstab", description=__doc__)
    parser.add_argument("--version", action="version", version=f"rotorstab {_version()}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    figure = commands.add_parser("figure", help="a figure of the paper: its reading, or a file")
    figure.add_argument("number", nargs="?", type=int, choices=tuple(FIGURES), metavar="NUMBER")
    figure.add_argument("--all", metavar="DIRECTORY", help="write every figure and Table 1")
    figure.add_argument(
        "--formats", default=",".join(FORMATS), help="with --all, default %(default)s"
    )
    figure.add_argument(
        "--floquet",
        action="store_true",
        help="4 to 9: add the regions that are unstable by Floquet's method, and which statements "
        "of the paper still hold",
    )
    _add_output(figure, FORMATS)
    figure.set_defaults(run=run_figure)

    table = commands.add_parser("table1", help="Table 1 and what follows from it")
    _add_output(table, TABLE_FORMATS)
    table.set_defaults(run=run_table)

    conclusions = commands.add_parser("conclusions", help="the paper's conclusions, checked")
    conclusions.set_defaults(run=run_conclusions)

    validation = commands.add_parser("validation", help="published values beside ours")
    _add_output(validation, ("md",))
    validation.set_defaults(run=run_validation)

    sweep = (
        "a number, a list 0,1,2 or a range 0:2:41 (from, to, how many); a comma separates values, "
        "a decimal number has a point; default 0"
    )
    several: dict[str, Any] = {"action": Sweep, "default": np.zeros(1)}
    whirl = commands.add_parser("whirl", help="whirl frequencies of your own rotor")
    whirl.add_argument("--spin-speed", **several, help=sweep)
    whirl.add_argument("--load", **several, help=sweep)
    _add_rotor(whirl)
    _add_output(whirl, TABLE_FORMATS)
    whirl.set_defaults(run=run_whirl)

    regions = commands.add_parser("regions", help="Bolotin regions of your own rotor")
    regions.add_argument("--spin-speed", **several, help=f"a panel each: {sweep}")
    regions.add_argument("--static-factor", **several, help=f"α_s, up to three: {sweep}")
    regions.add_argument("--largest-factor", type=float, default=1.0, help="β_d, top of the chart")
    _add_rotor(regions)
    _add_output(regions, FORMATS)
    regions.set_defaults(run=run_regions)

    for entry in entry_points(group=INSTALLED_COMMANDS):
        entry.load()(commands)
    return parser


def _complain(line: str) -> int:
    """Print one line on stderr, where there is one; return the exit code of a failure."""
    with suppress(OSError, AttributeError):
        print(f"rotorstab: {' '.join(line.split())}", file=sys.stderr)
    return 2


def _no_output(reason: str | None) -> int:
    """Report that stdout cannot be written, and redirect what is still in its buffer to nowhere."""
    if sys.stdout is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return _complain(f"the output could not be written: {reason}")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    argv : sequence of str, optional
        Arguments; the process's own by default.

    Returns
    -------
    int
        0, or 2 after one line on stderr.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    if sys.stdout is None:
        return _no_output("it is closed")
    try:
        code = _run(sys.argv[1:] if argv is None else argv)
        sys.stdout.flush()
    except BrokenPipeError:
        # the reader has seen enough; nothing more may be flushed at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        return _no_output(error.strerror)
    return code


def _run(argv: Sequence[str]) -> int:
    """Run a command; an OSError without the name of a file comes from stdout and is not caught."""
    try:
        arguments = _parser().parse_args(joined_options(argv))
        # a number past double precision ends here, not in a table of NaN and a warning
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            arguments.run(arguments)
    except SystemExit as stop:
        return int(stop.code or 0)
    except FloatingPointError:
        return _complain("an argument is too large or too small to compute with")
    except ValueError as error:
        return _complain(str(error))
    except OSError as error:
        if error.filename is None:
            raise
        return _complain(f"{error.strerror}: {error.filename}")
    return 0
