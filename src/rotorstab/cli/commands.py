"""What the commands of the command line do; `parser` reads their arguments.

Every function takes the parsed arguments and raises ValueError or OSError with one clear
line. Only drawing loads HoloViews.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any
from unicodedata import combining

import numpy as np

from .._arguments import number
from ..drawing.files import write_file
from ..drawing.formats import FORMATS, PICTURE_FORMATS, TABLE_FORMATS
from ..model.finite_element import finite_element
from ..model.lumped import lumped
from ..model.system import System
from ..paper import (
    CONCLUSIONS,
    FIGURES,
    FLOQUET_CONCLUSIONS,
    FLOQUET_FIGURES,
    Figure,
    Statement,
    own_regions,
    paper_figure,
    table_1,
)
from ..paper.validation import validation_markdown
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.frequencies import whirl_frequencies

__all__ = [
    "MOST_VALUES",
    "run_conclusions",
    "run_figure",
    "run_regions",
    "run_table",
    "run_validation",
    "run_whirl",
]

MOST_VALUES = 10_000
"""Largest number of values a range or a sweep may have."""


def _format(path: str, allowed: Iterable[str]) -> str:
    """Return the format of a file, which is the ending of its name."""
    name = Path(path).suffix.lower()[1:]
    if name not in allowed:
        endings = ", ".join(f".{name}" for name in allowed)
        raise ValueError(f"`--output` must end in {endings}, got {path!r}")
    return name


def _figure_data(figure: Figure, formats: Sequence[str]) -> dict[str, bytes | str]:
    """Return a figure as the contents of files, by format."""
    data: dict[str, bytes | str] = {}
    drawn = [name for name in formats if name in PICTURE_FORMATS]
    if drawn:
        try:
            from ..drawing.printed import figure_files

            data |= figure_files(figure, drawn)
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


def _reading(title: str, statements: Sequence[Statement]) -> str:
    """Write statements for a terminal."""
    lines = [title]
    for statement in statements:
        lines += ["", f"  paper: {statement.text}", f"  ours:  {statement.ours}"]
        lines.append(f"  → {statement.verdict}")
        if statement.note:
            lines.append(f"  note:  {statement.note}")
    return "\n".join(lines) + "\n"


def _text_table(columns: Mapping[str, Sequence[Any]]) -> str:
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


def _emit(
    text: str,
    data: Callable[[str], bytes | str],
    arguments: argparse.Namespace,
    allowed: Iterable[str],
) -> None:
    """Print the text, or write the file that `--output` names in one of the allowed formats."""
    if arguments.output is None:
        sys.stdout.write(text)
        return
    name = _format(arguments.output, allowed)
    path = Path(arguments.output)
    if path.exists() and not arguments.force:
        raise ValueError(f"{path} exists; --force overwrites it")
    write_file(path, _marked(data(name), name, arguments), arguments.force)


def _marked(data: bytes | str, name: str, arguments: argparse.Namespace) -> bytes | str:
    """Begin a CSV with a byte order mark where `--excel` asks for it: Excel then reads UTF-8."""
    marked = name in TABLE_FORMATS and TABLE_FORMATS[name].marked_for_excel
    if marked and isinstance(data, str) and arguments.excel:
        return "\ufeff" + data
    return data


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
    _emit(
        _reading(figure.heading, figure.reading),
        lambda name: _figure_data(figure, [name])[name],
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
        for name, content in _figure_data(figure, formats).items():
            content = _marked(content, name, arguments)
            write_file(directory / f"figure_{n}.{name}", content, force)
    for name in table:
        data = TABLE_FORMATS[name].table(table_1())
        write_file(directory / f"table_1.{name}", _marked(data, name, arguments), force)
    sys.stdout.write(f"{len(names)} files in {directory}\n")


def run_table(arguments: argparse.Namespace) -> None:
    """Write or print Table 1."""
    table = table_1()
    text = _text_table(
        {
            "quantity": [row.name for row in table.rows],
            "unit": [row.unit for row in table.rows],
            "paper": [row.text for row in table.rows],
            "rotorstab": [row.ours for row in table.rows],
        }
    )
    _emit(text, lambda name: TABLE_FORMATS[name].table(table), arguments, TABLE_FORMATS)


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
    _emit(text, lambda _: text, arguments, ("md",))


def _rotor(arguments: argparse.Namespace) -> ShaftDisk:
    return ShaftDisk(**{field.name: getattr(arguments, field.name) for field in fields(ShaftDisk)})


def _system(arguments: argparse.Namespace) -> System:
    """Return the rotor's system at rest, by the chosen model."""
    damping = (arguments.external_damping, arguments.internal_damping)
    if arguments.model == "finite-element":
        modes = None if arguments.modes is None else int(arguments.modes)
        return finite_element(
            _rotor(arguments), 0.0, arguments.tangency, arguments.elements, modes, *damping
        )
    # the other models have the names of their laws, which `lumped` checks
    law = "linear" if arguments.model == "lumped" else arguments.model
    return lumped(_rotor(arguments), 0.0, arguments.tangency, *damping, law)


def _parameters(arguments: argparse.Namespace, *names: str) -> dict[str, Any]:
    """Return the named arguments as plain values."""
    rotor = [field.name for field in fields(ShaftDisk)]
    values = {name: getattr(arguments, name) for name in (*rotor, "tangency", "model", *names)}
    if arguments.model == "finite-element":
        values |= {"elements": arguments.elements, "modes": arguments.modes}
    return {k: v.tolist() if isinstance(v, np.ndarray) else v for k, v in values.items()}


def run_whirl(arguments: argparse.Namespace) -> None:
    """Write or print whirl frequencies over spin speeds and loads."""
    spins, loads = arguments.spin_speed, arguments.load
    number("spin-speed × load values", spins.size * loads.size, 1, MOST_VALUES)
    frequencies = whirl_frequencies(_system(arguments).at_speed(spins[:, None]), loads)
    roots = frequencies.shape[-1]
    columns: dict[str, Sequence[Any]] = {
        "spin_speed": np.repeat(spins, loads.size * roots).tolist(),
        "load": np.tile(np.repeat(loads, roots), spins.size).tolist(),
        "root": list(range(1, roots + 1)) * (spins.size * loads.size),
        "frequency": frequencies.real.ravel().tolist(),
        "growth_rate": (-frequencies.imag.ravel() + 0.0).tolist(),
    }
    details = [
        "spin_speed, frequency, growth_rate [√(EI/ρAL⁴)], load [EI/L²]",
        "frequency above 0: forward whirl, below 0: backward",
    ]
    parameters = _parameters(arguments, "external_damping", "internal_damping")
    _emit(
        _text_table(columns),
        lambda name: TABLE_FORMATS[name].columns("Whirl frequencies", details, parameters, columns),
        arguments,
        TABLE_FORMATS,
    )


def run_regions(arguments: argparse.Namespace) -> None:
    """Write or print the Bolotin regions of a rotor that the arguments describe."""
    figure = own_regions(
        _system(arguments),
        arguments.shear,
        arguments.spin_speed.tolist(),
        arguments.static_factor.tolist(),
        arguments.largest_factor,
        _parameters(arguments),
    )
    columns: dict[str, list[Any]] = {"panel": [], "boundary": [], "beta_d": [], "theta/omega_n": []}
    for panel in figure.panels:
        for line in panel.series:
            for beta in np.linspace(0.0, arguments.largest_factor, 6):
                row = (panel.title, line.name, float(beta), float(np.interp(beta, line.y, line.x)))
                for column, value in zip(columns.values(), row, strict=True):
                    column.append(value)
    _emit(
        _text_table(columns),
        lambda name: _figure_data(figure, [name])[name],
        arguments,
        FORMATS,
    )
