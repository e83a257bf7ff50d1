"""The commands of the paper: its figures, Table 1, its conclusions and the validation.

Every function takes the parsed arguments and raises ValueError or OSError with one clear line.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ..drawing.files import write_file
from ..drawing.formats import FORMATS, TABLE_FORMATS
from ..paper import (
    CONCLUSIONS,
    FIGURES,
    FLOQUET_CONCLUSIONS,
    FLOQUET_FIGURES,
    Statement,
    paper_figure,
    table_1,
)
from ..paper.validation import validation_markdown
from .output import emit, figure_data, marked, text_table

__all__ = ["run_conclusions", "run_figure", "run_table", "run_validation"]


def _reading(title: str, statements: Sequence[Statement]) -> str:
    """Write statements for a terminal."""
    lines = [title]
    for statement in statements:
        lines += ["", f"  paper: {statement.text}", f"  ours:  {statement.ours}"]
        lines.append(f"  → {statement.verdict}")
        if statement.note:
            lines.append(f"  note:  {statement.note}")
    return "\n".join(lines) + "\n"


def run_figure(arguments: argparse.Namespace) -> None:
    """Print the reading of a figure of the paper, write it to a file, or write all figures."""
    if (arguments.number is None) == (arguments.all is None):
        raise ValueError("give either a figure's number, 2 to 9, or --all DIRECTORY")
    if arguments.all is not None:
        _write_all(Path(arguments.all), arguments.formats.split(","), arguments)
        return
    if arguments.floquet and arguments.number not in FLOQUET_FIGURES:
        raise ValueError(
            f"`--floquet` is for figures {FLOQUET_FIGURES[0]} to {FLOQUET_FIGURES[-1]}, "
            f"got {arguments.number}"
        )
    figure = paper_figure(arguments.number, arguments.floquet)
    emit(
        _reading(figure.heading, figure.reading),
        lambda name: figure_data(figure, [name])[name],
        arguments,
        FORMATS,
    )


def _write_all(directory: Path, formats: Sequence[str], arguments: argparse.Namespace) -> None:
    """Write every figure and the table, or nothing if a file exists and may not be overwritten."""
    force = arguments.force
    for name in formats:
        if name not in FORMATS:
            raise ValueError(f"`--formats` must be among {','.join(FORMATS)}, got {name!r}")
    directory.mkdir(exist_ok=True)
    table = [name for name in formats if name in TABLE_FORMATS]
    names = [f"figure_{n}.{name}" for n in FIGURES for name in formats]
    names += [f"table_1.{name}" for name in table]
    taken = [name for name in names if (directory / name).exists()]
    if taken and not force:
        raise ValueError(f"{directory / taken[0]} exists; --force overwrites it")
    for n in FIGURES:
        figure = paper_figure(n, arguments.floquet)
        for name, content in figure_data(figure, formats).items():
            content = marked(content, name, arguments)
            write_file(directory / f"figure_{n}.{name}", content, force)
    for name in table:
        data = TABLE_FORMATS[name].table(table_1())
        write_file(directory / f"table_1.{name}", marked(data, name, arguments), force)
    sys.stdout.write(f"{len(names)} files in {directory}\n")


def run_table(arguments: argparse.Namespace) -> None:
    """Write or print Table 1."""
    table = table_1()
    text = text_table(
        {
            "quantity": [row.name for row in table.rows],
            "unit": [row.unit for row in table.rows],
            "paper": [row.text for row in table.rows],
            "rotorstab": [row.ours for row in table.rows],
        }
    )
    emit(text, lambda name: TABLE_FORMATS[name].table(table), arguments, TABLE_FORMATS)


def run_conclusions(_: argparse.Namespace) -> None:
    """Print the five conclusions."""
    for letter, conclusion in CONCLUSIONS.items():
        statement, truth = conclusion(), FLOQUET_CONCLUSIONS[letter]()
        lines = [
            statement.text,
            *_verdict("Bolotin's regions", statement),
            *_verdict("Floquet", truth),
        ]
        sys.stdout.write("\n".join(lines) + "\n\n")


def _verdict(method: str, statement: Statement) -> list[str]:
    """Write what one method says of a conclusion."""
    lines = [f"  {method}: {statement.ours}", f"  → {statement.verdict}"]
    return lines + [f"  note: {statement.note}"] * bool(statement.note)


def run_validation(arguments: argparse.Namespace) -> None:
    """Write or print the validation table."""
    text = validation_markdown()
    emit(text, lambda _: text, arguments, ("md",))
