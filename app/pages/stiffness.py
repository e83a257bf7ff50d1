"""Stiffness: exact against linear influence coefficients, for any Φ and μ and up to the pole."""

from __future__ import annotations

from typing import Any

import numpy as np

from rotorstab.charts import Chart

from ..live.chart import LiveChart
from ..live.low import make_low
from ..results.comparisons import error_table, stiffness_comparison
from ..results.limits import Detail
from ..state import State
from .base import Page

__all__ = ["Stiffness"]


class Stiffness(Page):
    """Four coefficients, the error of the linear law, and where it reaches 1 % and 5 %."""

    key = "stiffness"
    title = "Stiffness"
    chart_keys = ("k11", "k12", "k21", "k22", "errors")

    def compute(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Chart]:
        """Return the five charts."""
        return stiffness_comparison(state.shear, state.effective_tangency())

    def built(self, key: str, chart: LiveChart) -> None:
        """Leave the height of a chart to its curves: the page gives each one its place."""
        chart.figure.min_height = None
        make_low(chart.figure)

    def answer(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Any]:
        """Return the table of loads at which an error level is reached; null where none is."""
        rows = [
            [value if np.isfinite(value) else None for value in row]
            for row in error_table(state.shear, state.effective_tangency())
        ]
        return {"errors_table": rows}
