"""What the picture process does: files of the paper's figures and of the live charts."""

from __future__ import annotations

from typing import Any

from rotorstab.figures import FIGURES

__all__ = ["MIME", "chart_file", "figure_file"]

MIME = {
    "pdf": "application/pdf",
    "svg": "image/svg+xml",
    "png": "image/png",
    "csv": "text/csv",
    "json": "application/json",
}


def _file(figure: Any, kind: str) -> bytes:
    """Return a figure as the bytes of one kind of file."""
    from rotorstab import export, plots_paper

    if kind == "csv":
        return export.figure_csv(figure).encode()
    if kind == "json":
        return export.figure_json(figure).encode()
    return plots_paper.figure_files(figure, [kind])[kind]


def figure_file(number: int, kind: str) -> bytes:
    """Return a figure of the paper as a file of one kind (a key of `MIME`)."""
    return _file(FIGURES[number](), kind)


def chart_file(page: str, chart: str, values: tuple[tuple[str, Any], ...], kind: str) -> bytes:
    """Return a live chart, for the given inputs, as a file of one kind."""
    from rotorstab.charts import chart_figure

    from .pages import PAGES
    from .state import State

    state = State()
    state.change(dict(values))
    made = next(one for one in PAGES if one.key == page)().compute(state)[chart]
    return _file(chart_figure(made, state.inputs()), kind)
