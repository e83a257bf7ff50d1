"""The file formats of figures and tables: every place that offers or writes one reads them here.

Nothing here loads HoloViews or Matplotlib: `printed` draws the pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..charts import Figure
from ..paper import Table
from . import tables

__all__ = ["FORMATS", "PICTURE_FORMATS", "TABLE_FORMATS", "PictureFormat", "TableFormat"]


@dataclass(frozen=True)
class PictureFormat:
    """A format in which Matplotlib saves a figure.

    Parameters
    ----------
    mime : str
        MIME type.
    metadata : callable
        Takes the heading of a figure and returns the `metadata` of Matplotlib's `savefig`: the
        title, and None for every date, so that equal figures give equal files. It returns None
        for a format that has no metadata.
    """

    mime: str
    metadata: Callable[[str], dict[str, Any] | None]


@dataclass(frozen=True)
class TableFormat:
    """A text format of numbers.

    Parameters
    ----------
    mime : str
        MIME type.
    figure : callable
        Writes a figure.
    table : callable
        Writes a table of the paper.
    columns : callable
        Writes named columns: takes the title, details, parameters and the columns.
    marked_for_excel : bool
        Whether Excel reads the file as UTF-8 only if it begins with a byte order mark.
    """

    mime: str
    figure: Callable[[Figure], str]
    table: Callable[[Table], str]
    columns: Callable[
        [str, Sequence[str], Mapping[str, Any], Mapping[str, Sequence[Any]]],
        str,
    ]
    marked_for_excel: bool = False


def _pdf_metadata(heading: str) -> dict[str, Any]:
    return {"CreationDate": None, "ModDate": None, "Title": heading}


def _svg_metadata(heading: str) -> dict[str, Any]:
    return {"Date": None, "Title": heading}


def _png_metadata(heading: str) -> dict[str, Any]:
    return {"Title": heading.encode("ascii", "replace").decode()}


PICTURE_FORMATS = {
    "pdf": PictureFormat("application/pdf", _pdf_metadata),
    "svg": PictureFormat("image/svg+xml", _svg_metadata),
    "png": PictureFormat("image/png", _png_metadata),
}
"""Formats of pictures by their name, which is the file ending too."""

TABLE_FORMATS = {
    "csv": TableFormat(
        "text/csv",
        tables.figure_csv,
        tables.table_csv,
        tables.columns_csv,
        marked_for_excel=True,
    ),
    "json": TableFormat(
        "application/json", tables.figure_json, tables.table_json, tables.columns_json
    ),
}
"""Formats of tables by their name, which is the file ending too."""

FORMATS: dict[str, PictureFormat | TableFormat] = {**PICTURE_FORMATS, **TABLE_FORMATS}
"""Every format in which a figure is written."""
