"""A program as cells: one text for an editor, and a notebook with the same cells."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

__all__ = ["Cell", "notebook_text", "program_text"]

_NOTEBOOK = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


@dataclass(frozen=True)
class Cell:
    """One cell of a notebook.

    Parameters
    ----------
    text : str
        Without a line break at its end.
    is_code : bool
        Whether it is Python; otherwise it is a text.
    """

    text: str
    is_code: bool = True


def program_text(cells: Sequence[Cell]) -> str:
    """Return cells as a Python file; editors know its marks `# %%` between the cells."""
    parts = []
    for cell in cells:
        if cell.is_code:
            parts.append(f"# %%\n{cell.text}\n")
        else:
            words = "".join(f"# {line}\n" for line in cell.text.splitlines())
            parts.append(f"# %% [markdown]\n{words}")
    return "\n".join(parts)


def notebook_text(cells: Sequence[Cell]) -> str:
    """Return cells as a Jupyter notebook in the format nbformat 4.5."""
    found = []
    for number, cell in enumerate(cells):
        entry: dict[str, Any] = {
            "cell_type": "code" if cell.is_code else "markdown",
            "id": f"cell-{number}",
            "metadata": {},
            "source": cell.text.splitlines(keepends=True),
        }
        if cell.is_code:
            entry |= {"execution_count": None, "outputs": []}
        found.append(entry)
    notebook = {"cells": found, "metadata": _NOTEBOOK, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(notebook, ensure_ascii=False, indent=1) + "\n"
