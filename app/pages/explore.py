"""Explore: the instability chart, the load–frequency chart and the Campbell diagram."""

from __future__ import annotations

from typing import Any

import panel as pn

from ..analysis import Result
from ..live import LiveChart

__all__ = ["Explore"]


class Explore:
    """The three live charts of one session."""

    key = "explore"
    title = "Explore"

    def __init__(self, result: Result) -> None:
        self.charts = {key: LiveChart(chart) for key, chart in result.charts.items()}

    def roots(self) -> dict[str, Any]:
        """Return the panes by the name under which the template places them."""
        return {
            key.replace("-", "_"): pn.pane.Bokeh(chart.figure, sizing_mode="stretch_both")
            for key, chart in self.charts.items()
        }

    def show(self, result: Result) -> None:
        """Patch every chart to a new result."""
        for key, chart in result.charts.items():
            self.charts[key].show(chart)

    def reset_view(self) -> None:
        """Undo every zoom."""
        for chart in self.charts.values():
            chart.reset_view()
