"""Several values of one argument: a number, a list such as 0,1,2 or a range such as 0:2:41."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["MOST_VALUES", "Sweep", "joined_options"]

MOST_VALUES = 10_000
"""Largest number of values a range or a sweep may have."""


class Sweep(argparse.Action):
    """Several values of one argument, with a warning where a comma may mean a decimal point."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option: str | None = None,
    ) -> None:
        """Store the values of a text."""
        try:
            setattr(namespace, self.dest, _values(values))
        except ValueError as error:
            parser.error(f"argument {option}: {error}")
        if found := re.fullmatch(r"(-?\d+),(\d+)", values):
            one, other = found.groups()
            line = (
                f"{parser.prog}: {option} {values} is read as 2 values, {one} and {other}; "
                f"a decimal number has a point: {one}.{other}"
            )
            print(line, file=sys.stderr)


def joined_options(argv: Sequence[str]) -> list[str]:
    """Join an option and a value such as -0.5:0.5:3, which would be read as an option itself."""
    joined: list[str] = []
    for word in argv:
        negative = re.match(r"[-−](\d|\.|inf|nan)", word)
        if negative and joined and re.fullmatch(r"--[a-z-]+", joined[-1]):
            joined[-1] += f"={word.replace('−', '-')}"
        else:
            joined.append(word)
    return joined


def _values(text: str) -> NDArray[np.float64]:
    """Read "1.5", "0,1,2" or "0:2:41" (from, to, how many)."""
    try:
        if ":" not in text:
            return np.array([float(part) for part in text.split(",")])
        start, stop, count = text.split(":")
        points = int(count)
        if not 2 <= points <= MOST_VALUES:
            raise ValueError
        return np.linspace(float(start), float(stop), points)
    except ValueError:
        raise ValueError(
            f"{text[:60]!r} is not a number, a list such as 0,1,2 or a range such as 0:2:41 "
            f"(from, to, 2 to {MOST_VALUES} values)"
        ) from None
