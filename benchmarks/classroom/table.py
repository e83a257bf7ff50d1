"""A row of the table: the target, the measured value, and whether the target is met."""

import math
from dataclasses import dataclass

__all__ = ["Row", "percentile", "print_head"]


@dataclass(frozen=True)
class Row:
    """One line; `met` is None where there is no target."""

    what: str
    target: str
    measured: str
    met: bool | None = None

    def __str__(self):
        verdict = {True: "met", False: "**missed**", None: "–"}[self.met]
        return f"| {self.what} | {self.target} | {self.measured} | {verdict} |"


def percentile(values, part=0.95):
    """Return the smallest value that is not below a part of the values; NaN of none."""
    ordered = sorted(values)
    return ordered[max(0, math.ceil(part * len(ordered)) - 1)] if ordered else math.nan


def print_head():
    """Print the head of the table; rows follow as they are measured."""
    print("| what | target | measured | |\n|---|---|---|---|", flush=True)
