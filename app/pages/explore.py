"""Explore: the instability chart, the load–frequency chart and the Campbell diagram."""

from __future__ import annotations

from typing import Any

from rotorstab.charts import Chart

from ..analysis import CHARTS, solve
from ..state import State
from .base import Page

__all__ = ["Explore"]


class Explore(Page):
    """The three live charts and the key numbers."""

    key = "explore"
    title = "Explore"
    chart_keys = CHARTS

    def compute(self, state: State) -> dict[str, Chart]:
        """Return the three charts."""
        return solve(state).charts

    def answer(self, state: State) -> dict[str, Any]:
        """Return the key numbers."""
        return {"numbers": solve(state).numbers}
