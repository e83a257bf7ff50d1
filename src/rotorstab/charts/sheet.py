"""What a page of several charts is, as data: charts, words and tables of one view."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .figure import Figure
from .structure import Chart

__all__ = ["Rows", "Sheet"]

Rows = tuple[tuple[str, str], ...]
"""Names and values of a table, as texts."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """One view of a rotor on one page.

    Parameters
    ----------
    heading : str
    charts : tuple of Chart
        The first one is drawn large, the others beside each other below it.
    point_charts : tuple of Chart
        Of a marked point: the response, then square ones; empty without a marked point.
    sentence : str
        About the marked point; may be empty.
    paragraphs : tuple of str
        Further words, smaller.
    tables : tuple of (str, rows)
        Title and rows of each table beside the charts.
    settings : (str, rows)
        Title and rows of the table below the charts.
    parameters : mapping
        Plain values that made the view, for programs that read the file's metadata.
    link : str
        Address of the view; may be empty.
    """

    heading: str
    charts: tuple[Chart, ...]
    point_charts: tuple[Chart, ...]
    sentence: str
    paragraphs: tuple[str, ...]
    tables: tuple[tuple[str, Rows], ...]
    settings: tuple[str, Rows]
    parameters: Mapping[str, Any]
    link: str = ""

    @property
    def main_figure(self) -> Figure:
        """The charts without those of the marked point, as a figure that has a common legend."""
        return Figure(None, self.heading, "", self.parameters, self.charts)
