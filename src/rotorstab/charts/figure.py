"""What a figure is, as data: charts as its panels, parameters, and a reading."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from .quantities import GROWTH, Quantity
from .structure import Chart, Curve, Layer

__all__ = [
    "Figure",
    "Statement",
    "Value",
    "Verdict",
    "chart_figure",
    "growth_bands",
    "growth_layer",
    "growth_of",
]

Verdict = Literal[
    "agree",
    "differ",
    "agree in part",
    "confirmed",
    "not confirmed",
    "partly confirmed",
]
Value = float | str | list[float] | None


@dataclass(frozen=True)
class Statement:
    """One thing that a text says of a figure, compared with our numbers.

    Parameters
    ----------
    text : str
        What the paper says, in short.
    ours : str
        What was computed, with its numbers.
    verdict : {"agree", "differ", "agree in part"} or "confirmed" and its like
        The first three compare the text with the paper's own method, the others with Floquet.
    note : str
        Why they differ, or how far the statement goes; may be empty.
    """

    text: str
    ours: str
    verdict: Verdict
    note: str = ""


@dataclass(frozen=True, eq=False)
class Figure:
    """One chart or several, with what made them and what is read from them.

    Parameters
    ----------
    number : int or None
        Of a figure of the paper, 2 to 9; None for any other, such as a live chart.
    title, caption : str
        What it shows; the caption names the line styles.
    parameters : mapping
        Plain values that made it.
    panels : tuple of Chart
    reading : tuple of Statement
        What the text says of it, with our numbers, computed from these very arrays.
    footer : str
        The parameters in words, in small letters below the picture; may be empty.
    link : str
        Address of the view that it shows, also below the picture; empty where there is none.
    """

    number: int | None
    title: str
    caption: str
    parameters: Mapping[str, Value]
    panels: tuple[Chart, ...]
    reading: tuple[Statement, ...] = ()
    footer: str = ""
    link: str = ""

    @property
    def heading(self) -> str:
        """The title, after the number of a figure of the paper."""
        return self.title if self.number is None else f"Figure {self.number}. {self.title}"

    def panel(self, letter: str) -> Chart:
        """Return the panel of that letter."""
        return next(panel for panel in self.panels if panel.letter == letter)

    @property
    def has_floquet(self) -> bool:
        """Whether it shows what Floquet finds unstable."""
        return any(panel.shows_floquet for panel in self.panels)

    def groups(self) -> dict[str, Curve]:
        """Return one line or point of every group, in the order of drawing, dotted last."""
        curves = {curve.group: curve for panel in self.panels for curve in panel.series}
        return dict(sorted(curves.items(), key=lambda item: item[1].style == "dotted"))

    def plot(self) -> Any:
        """Return the figure as a HoloViews object, for a notebook.

        Call ``holoviews.extension("bokeh")`` once in the notebook.

        Returns
        -------
        holoviews.Layout
            The panels in at most three columns; see `Chart.plot`.

        Raises
        ------
        ImportError
            If HoloViews or Bokeh is not installed; the message says how to install them.
        """
        from ..drawing.notebook import notebook_layout

        return notebook_layout(self)


def growth_layer(chart: Chart) -> Layer | None:
    """Return the map of growth of a chart, None where it has none."""
    return next((layer for layer in chart.of_kind("map") if layer.quantity is not None), None)


def growth_bands(chart: Chart) -> Layer | None:
    """Return the bands of growth of a chart, None where it has none."""
    return next(iter(chart.of_kind("bands")), None)


def growth_of(chart: Chart) -> Quantity:
    """Return the growth rate in the units of a chart."""
    form = GROWTH.si
    assert form is not None
    return Quantity(GROWTH.words, form.symbol, form.measure.value) if chart.in_si else GROWTH


def chart_figure(
    chart: Chart, parameters: Mapping[str, Any], footer: str = "", link: str = ""
) -> Figure:
    """Return a live chart as a figure of one panel, for print and for tables.

    Parameters
    ----------
    chart : Chart
    parameters : mapping
        Plain values that made it; they are written into tables and into what files say of
        themselves.
    footer, link : str
        See `Figure`.

    Returns
    -------
    Figure
        Without a number.
    """
    return Figure(None, chart.title, "", dict(parameters), (chart,), footer=footer, link=link)
