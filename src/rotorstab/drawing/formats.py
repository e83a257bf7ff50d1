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
from .plain_text import parameter_words

__all__ = [
    "FORMATS",
    "PICTURE_FORMATS",
    "TABLE_FORMATS",
    "Origin",
    "PictureFormat",
    "TableFormat",
]


@dataclass(frozen=True)
class Origin:
    """What a picture's file says of itself, for programs that read its metadata.

    Parameters
    ----------
    heading : str
    parameters : mapping
        Plain values that made it.
    link : str
        Address of the view that it shows; empty where there is none.
    """

    heading: str
    parameters: Mapping[str, Any]
    link: str = ""

    @property
    def keywords(self) -> str:
        """The parameters, as `name = value` separated by semicolons."""
        return parameter_words(self.parameters)


@dataclass(frozen=True)
class PictureFormat:
    """A format in which Matplotlib saves a figure.

    Parameters
    ----------
    mime : str
        MIME type.
    metadata : callable
        Takes the `Origin` of a picture and returns the `metadata` of Matplotlib's `savefig`:
        title, parameters and link, and None for every date, so that equal figures give equal
        files. It returns None for a format that has no metadata.
    """

    mime: str
    metadata: Callable[[Origin], dict[str, Any] | None]


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


def _pdf_metadata(origin: Origin) -> dict[str, Any]:
    """Return the document information of a PDF."""
    named = _named(origin, link="Subject", parameters="Keywords")
    return {"CreationDate": None, "ModDate": None, **named}


def _svg_metadata(origin: Origin) -> dict[str, Any]:
    """Return terms of the Dublin Core."""
    return {"Date": None, **_named(origin, link="Source", parameters="Description")}


def _png_metadata(origin: Origin) -> dict[str, Any]:
    """Return text chunks, under the names that the PNG standard registers."""
    return _named(origin, link="Source", parameters="Description")


def _named(origin: Origin, link: str, parameters: str) -> dict[str, Any]:
    """Return what there is of title, link and parameters, by the names of a format."""
    named = {"Title": origin.heading, link: origin.link, parameters: origin.keywords}
    return {name: text for name, text in named.items() if text}


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
