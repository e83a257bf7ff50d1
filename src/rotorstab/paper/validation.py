"""The validation table: every published value beside ours, as Markdown.

`docs/validation.md` is this text; a test fails when it is stale.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from .._tolerances import DECIMAL_ROUNDING
from . import CONCLUSIONS, FIGURES, FLOQUET_CONCLUSIONS, FLOQUET_FIGURES, Statement
from .published import PUBLISHED, Published
from .published.separate import DERIVED
from .verdicts import fixed

__all__ = ["validation_markdown"]

_HEAD = """\
# Validation

Made by `python -m rotorstab validation --output docs/validation.md --force`; do not edit.

"Ours" is rounded to one digit more than the other value; the difference is that of the rounded
numbers. A value is met when the difference is within "allowed": the last printed digit, or what
is stated. Non-dimensional units: load EI/L², frequency √(EI/ρAL⁴). The base case is Φ = 0.0192,
M̄_D = 5, Ī_D = 0.8, Ī_P = 1.6, r = 0.08.

"agree" and "differ" compare the text with the paper's own method; "confirmed" and "not
confirmed" say whether Floquet's method confirms it.
"""


def _row(entry: Published) -> str:
    """Return one line of the table."""
    ours = round(entry.ours(), entry.decimals + 1)
    difference = round(ours - entry.value, entry.decimals + 1) + 0.0  # no −0
    met = "yes" if abs(difference) <= entry.allowed * (1 + DECIMAL_ROUNDING) else "**no**"
    cells = (
        entry.quantity,
        entry.unit,
        fixed(entry.value, entry.decimals),
        fixed(ours, entry.decimals + 1),
        fixed(difference, entry.decimals + 1),
        f"{entry.allowed:g}",
        met,
        entry.source + (f"; {entry.note}" if entry.note else ""),
    )
    return "| " + " | ".join(cells) + " |"


def _statements(statements: Iterable[Statement]) -> list[str]:
    """Return a list of statements with their verdicts."""
    lines = []
    for statement in statements:
        lines.append(f"- **{statement.verdict}.** {statement.text}")
        lines.append(
            f"  Ours: {statement.ours}" + (f" *{statement.note}*" if statement.note else "")
        )
    return lines


@cache
def validation_markdown() -> str:
    """Return the whole document.

    Returns
    -------
    str
        Tables of values by kind of source, then what the text says of each figure and the
        paper's conclusions, each with its verdict by the paper's method and by Floquet.
    """
    lines = [_HEAD]
    for section in dict.fromkeys(entry.section for entry in PUBLISHED):
        other = "reference value" if section == DERIVED else "published"
        lines += [
            f"## {section}",
            "",
            f"| quantity | unit | {other} | ours | difference | allowed | met | source |",
            "|---|---|---:|---:|---:|---:|---|---|",
            *(_row(entry) for entry in PUBLISHED if entry.section == section),
            "",
        ]
    lines += ["## What the text says of each figure", ""]
    for number, make in FIGURES.items():
        figure = make(floquet=True) if number in FLOQUET_FIGURES else make()
        heading = f"### Figure {figure.number}. {figure.title}"
        lines += [heading, "", *_statements(figure.reading), ""]
    conclusions = (conclusion() for conclusion in CONCLUSIONS.values())
    confirmations = (confirmation() for confirmation in FLOQUET_CONCLUSIONS.values())
    lines += ["## The paper's conclusions on Bolotin's regions", "", *_statements(conclusions), ""]
    lines += ["## The paper's conclusions under Floquet", "", *_statements(confirmations)]
    return "\n".join(lines) + "\n"
