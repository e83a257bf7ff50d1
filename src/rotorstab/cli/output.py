"""What a command prints or writes: readings and tables as text, figures and tables as files.

Only pictures load HoloViews.
"""

from __future__ import annotations

import argparse
import errno
import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any
from unicodedata import combining

import numpy as np

from ..drawing.files import write_file
from ..drawing.formats import PICTURE_FORMATS, TABLE_FORMATS
from ..drawing.plain_text import parameter_words
from ..paper import Figure

__all__ = ["emit", "figure_data", "marked", "output_format", "output_path", "text_table"]


def output_format(path: str, allowed: Iterable[str]) -> str:
    """Return the format of a file, which is the ending of its name; ValueError for another one."""
    name = Path(path).suffix.lower()[1:]
    if name not in allowed:
        endings = ", ".join(f".{name}" for name in allowed)
        raise ValueError(f"`--output` must end in {endings}, got {path!r}")
    return name


def figure_data(figure: Figure, formats: Sequence[str]) -> dict[str, bytes | str]:
    """Return a figure as the contents of files, by format."""
    data: dict[str, bytes | str] = {}
    drawn = [name for name in formats if name in PICTURE_FORMATS]
    if drawn:
        try:
            from ..drawing.printed import figure_files

            footer = parameter_words(figure.parameters)
            data |= figure_files(replace(figure, footer=footer), drawn)
        except ImportError as error:
            others = " or ".join(f".{name}" for name in TABLE_FORMATS)
            raise ValueError(
                f".{drawn[0]} needs {error.name}, which is not installed: "
                f"pip install 'rotorstab[app]', or write {others}"
            ) from None
    for name in formats:
        if name in TABLE_FORMATS:
            data[name] = TABLE_FORMATS[name].figure(figure)
    return data


def text_table(columns: Mapping[str, Sequence[Any]]) -> str:
    """Write columns of equal length, aligned."""

    def cell(value: Any) -> str:
        if isinstance(value, float | np.floating):
            return "-" if np.isnan(value) else f"{value:.8g}"
        return "-" if value is None else str(value)

    blocks = [[name, *map(cell, values)] for name, values in columns.items()]

    def room(text: str) -> int:
        """Count characters; combining marks, as in Ω̄, take no room."""
        return sum(not combining(letter) for letter in text)

    widths = [max(map(room, block)) for block in blocks]
    rows = zip(*blocks, strict=True)
    lines = (
        "  ".join(
            " " * (width - room(text)) + text for text, width in zip(row, widths, strict=True)
        )
        for row in rows
    )
    return "\n".join(lines) + "\n"


def output_path(arguments: argparse.Namespace) -> Path:
    """Return the file that `--output` names, before anything is computed for it.

    Raises
    ------
    FileNotFoundError
        Where its folder is missing.
    ValueError
        Where the file exists and `--force` is not given.
    """
    path = Path(arguments.output)
    if not path.parent.exists():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    if path.exists() and not arguments.force:
        raise ValueError(f"{path} exists; --force overwrites it")
    return path


def emit(
    text: str,
    data: Callable[[str], bytes | str],
    arguments: argparse.Namespace,
    allowed: Iterable[str],
) -> None:
    """Print the text, or write the file that `--output` names in one of the allowed formats."""
    if arguments.output is None:
        sys.stdout.write(text)
        return
    name = output_format(arguments.output, allowed)
    path = output_path(arguments)
    write_file(path, marked(data(name), name, arguments), arguments.force)


def marked(data: bytes | str, name: str, arguments: argparse.Namespace) -> bytes | str:
    """Begin a CSV with a byte order mark where `--excel` asks for it: Excel then reads UTF-8."""
    marked = name in TABLE_FORMATS and TABLE_FORMATS[name].marked_for_excel
    if marked and isinstance(data, str) and arguments.excel:
        return "\ufeff" + data
    return data
